/* SPDX-License-Identifier: MIT */
/* test_errors.c - every field that may be wrong: its number is its own, and its text names it. */
#include "tests/rig.h"
#include "tests/test.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

void suite_errors(void);

/* True when `result` stands for that field: a number of its own, a sentence that begins with the name. */
static bool names(int result, const char *field)
{
    const char *text = smear_error_text(result);
    const bool ok = CHECK(result <= SMEAR_ERR_FIELD) && CHECK_EQ(smear_error_kind(result), SMEAR_ERR_ARG)
                 && CHECK(text != NULL && strstr(text, field) == text && strlen(text) > strlen(field) + 2);
    if (!ok) {
        test_print(field);
        test_print(" wanted, got: ");
        test_print(text != NULL ? text : "nothing");
        test_print("\n");
    }
    return ok;
}

/* A value in a field of one, two or four bytes. */
struct bad {
    const char *name;
    size_t offset, size;
    int32_t value;
};

static void put(void *where, const struct bad *bad)
{
    const int16_t half = (int16_t)bad->value;
    const uint8_t byte = (uint8_t)bad->value;
    const void *value = bad->size == 4 ? (const void *)&bad->value : bad->size == 2 ? (const void *)&half : (const void *)&byte;
    memcpy((uint8_t *)where + bad->offset, value, bad->size);
}

#define DESC(field, value) { "desc." #field, offsetof(smear_desc, field), sizeof ((smear_desc *)0)->field, value }
#define FRAME(field, value) { "frame." #field, offsetof(smear_frame, field), sizeof ((smear_frame *)0)->field, value }
#define DRAW(field, value) { "draw." #field, offsetof(smear_draw, field), sizeof ((smear_draw *)0)->field, value }
#define MESH(field, value) { "draw.mesh", offsetof(smear_mesh, field), sizeof ((smear_mesh *)0)->field, value }

static void test_the_text_of_a_bad_desc_names_the_field(void)
{
    static const struct bad bad[] = {
        DESC(width, 0), DESC(width, 2049), DESC(height, -5), DESC(max_triangles, (16 << 20) + 1),
        DESC(methods, 1 << SMEAR_METHOD_COUNT), DESC(tile, 12), DESC(reach, 65), DESC(reach, -1), DESC(strip, 40),
        DESC(band_rows, 1), DESC(bands, 3), DESC(format, SMEAR_L1_PAGES + 1), DESC(workers, 9), DESC(vertex_cache, 65),
        DESC(reuse.cache_static, 2), DESC(reuse.buffer_age, 8), DESC(filter.passes, 4), DESC(filter.scatter, 2),
        DESC(display.dither, SMEAR_DITHER_DIFFUSE + 1), DESC(display.doubled, SMEAR_DOUBLED_XY + 1)
    };
    uint64_t *memory = malloc(1 << 20);
    int last = 0;
    for (size_t i = 0; i < sizeof bad / sizeof *bad && CHECK(memory != NULL); i++) {
        smear_context *ctx = NULL;
        smear_desc desc = small_desc(64, 48);
        desc.methods |= SMEAR_SET(SMEAR_AUTO);
        desc.tile = 16;
        desc.flush = take_band;
        CHECK(smear_memory_size(&desc) > 0);
        put(&desc, &bad[i]);
        const int result = smear_init(&ctx, &desc, memory, 1 << 20);
        names(result, bad[i].name);
        CHECK(smear_memory_size(&desc) == 0 && ctx == NULL);
        CHECK(i == 0 || result != last || strcmp(bad[i].name, bad[i - 1].name) == 0);
        last = result;
    }
    smear_context *ctx = NULL;
    const smear_desc mute = small_desc(64, 48);
    names(smear_init(&ctx, &mute, memory, 1 << 20), "desc.flush");
    free(memory);
}

static void test_the_text_of_a_bad_frame_names_the_field(void)
{
    static const struct bad bad[] = {
        FRAME(method, SMEAR_METHOD_COUNT), FRAME(method, SMEAR_AUTO), FRAME(light_space, SMEAR_LIGHT_ENCODED + 1),
        FRAME(samples, 1025), FRAME(shutter.degrees, 3601), FRAME(shutter.exposure, SMEAR_LEADING + 1),
        FRAME(shutter.mode, SMEAR_SHUTTER_FIXED + 1), FRAME(shutter.reference_hz, 1001), FRAME(shutter.frame_us, 1000001),
        FRAME(filter.kind, SMEAR_FILTER_PINGPONG + 1), FRAME(filter.weights, SMEAR_WEIGHTS_JIMENEZ + 1),
        FRAME(filter.camera_step, 3), FRAME(filter.pingpong.passes, 4), FRAME(filter.pingpong.taps, 1),
        FRAME(filter.pingpong.base, 1), FRAME(filter.pingpong.jitter, 129), FRAME(filter.pingpong.spread, 2),
        FRAME(scale.rotation, 16129), FRAME(scale.translation, 16129)
    };
    struct rig r;
    smear_desc desc = small_desc(32, 32);
    if (rig_begin(&r, &desc, false)) {
        struct scene s;
        make_scene(&s, 0, SMEAR_RECONSTRUCT);
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
            smear_frame f = s.frame;
            put(&f, &bad[i]);
            names(smear_begin(r.ctx, &f), bad[i].name);
        }
        smear_frame f = s.frame;
        f.camera = NULL;
        names(smear_begin(r.ctx, &f), "frame.camera");
        const uint8_t closed[SMEAR_SHUTTER_POINTS] = { 0 };
        f = s.frame;
        f.shutter.curve = closed;
        names(smear_begin(r.ctx, &f), "frame.shutter.curve");
        const smear_light nowhere = { .diffuse = { 1, 1, 1 } };
        f = s.frame;
        f.light = &nowhere;
        names(smear_begin(r.ctx, &f), "frame.light");
        f = s.frame;
        f.layer_count = 1;
        names(smear_begin(r.ctx, &f), "frame.layer");
        CHECK_EQ(rig_frame(&r, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
    }
    rig_end(&r);
}

static void test_the_text_of_a_bad_draw_names_the_field(void)
{
    static const struct bad bad[] = {
        DRAW(motion, SMEAR_MOTION_NONE + 1), DRAW(billboard, SMEAR_BILLBOARD_UPRIGHT + 1)
    };
    static const struct bad bad_mesh[] = { MESH(shift, 63), MESH(shift, -33), MESH(uv_shift, 16), MESH(scale, -1),
                                           MESH(offset[1], (1 << 20) + 1) };
    struct rig r;
    smear_desc desc = small_desc(32, 32);
    if (rig_begin(&r, &desc, false)) {
        struct scene s;
        make_scene(&s, 0, SMEAR_NONE);
        CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
            smear_draw d = s.draw[1];
            put(&d, &bad[i]);
            names(smear_submit(r.ctx, &d), bad[i].name);
        }
        for (size_t i = 0; i < sizeof bad_mesh / sizeof *bad_mesh; i++) {
            smear_mesh mesh = square;
            smear_draw d = s.draw[1];
            put(&mesh, &bad_mesh[i]);
            d.mesh = &mesh;
            names(smear_submit(r.ctx, &d), bad_mesh[i].name);
        }
        smear_draw d = s.draw[1];
        d.mesh = NULL;
        names(smear_submit(r.ctx, &d), "draw.mesh");
        smear_texture texture = checker_texture;
        texture.width = 0;
        const smear_material material = { .texture = &texture }, strange = { .alpha = SMEAR_BLEND + 1 };
        d = s.draw[1];
        d.material = &material;
        names(smear_submit(r.ctx, &d), "draw.material");
        d.material = &strange;
        names(smear_submit(r.ctx, &d), "draw.material");
        CHECK_EQ(smear_submit(r.ctx, &s.draw[1]), SMEAR_OK);
        CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
    }
    rig_end(&r);
}

static void test_an_id_is_taken_once_per_frame(void)
{
    struct rig r;
    smear_desc desc = small_desc(48, 32);
    if (rig_begin(&r, &desc, false))
        for (int frame = 0; frame < 3; frame++) {
            struct scene s;
            make_scene(&s, 0.1 * frame, SMEAR_NONE);
            uint8_t *picture = rig_copy(&r, &s.frame, &s.draw[1], 2);
            smear_draw again = s.draw[3];
            again.id = s.draw[1].id;
            CHECK(again.id != 0 && s.draw[2].id != again.id);
            rig_forget_output(&r);
            CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
            CHECK_EQ(smear_submit(r.ctx, &s.draw[1]), SMEAR_OK);
            CHECK_EQ(smear_submit(r.ctx, &s.draw[2]), SMEAR_OK);
            names(smear_submit(r.ctx, &again), "draw.id");
            names(smear_submit(r.ctx, &s.draw[2]), "draw.id");
            CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
            CHECK(picture != NULL && same_picture(&r, picture));
            free(picture);
        }
    rig_end(&r);
}

static void test_draws_without_id_may_be_many(void)
{
    struct rig r;
    smear_desc desc = small_desc(48, 32);
    if (rig_begin(&r, &desc, false)) {
        struct scene s;
        make_scene(&s, 0, SMEAR_NONE);
        for (int i = 0; i < SCENE_DRAWS; i++)
            s.draw[i].id = 0;
        CHECK_EQ(rig_frame(&r, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
    }
    rig_end(&r);
}

static void test_every_number_has_a_sentence(void)
{
    static const int results[] = { SMEAR_OK, SMEAR_ERR_ARG, SMEAR_ERR_MEMORY, SMEAR_ERR_ORDER, SMEAR_ERR_FULL, -5, -77, 3,
                                   INT32_MIN, INT32_MAX, SMEAR_ERR_FIELD - 10000 };
    for (size_t i = 0; i < sizeof results / sizeof *results; i++)
        CHECK(smear_error_text(results[i]) != NULL && smear_error_text(results[i])[0] != '\0');
    for (int i = SMEAR_ERR_FIELD; i > SMEAR_ERR_FIELD - 300; i--) {
        const char *text = smear_error_text(i);
        const size_t length = text != NULL ? strlen(text) : 0;
        CHECK(length > 0 && text[length - 1] != '.' && smear_error_kind(i) == SMEAR_ERR_ARG);
    }
    CHECK_EQ(smear_error_kind(SMEAR_ERR_FULL), SMEAR_ERR_FULL);
    CHECK_EQ(smear_error_kind(-42), -42);
    CHECK_EQ(smear_error_kind(SMEAR_ERR_NEEDS - 1), SMEAR_ERR_MEMORY);
    CHECK(strncmp(smear_error_text(-5000), "memory: too little", 18) == 0);
    CHECK(strcmp(smear_error_text(SMEAR_ERR_NEEDS + 1), "unknown error") == 0);
}

void suite_errors(void)
{
    RUN(test_the_text_of_a_bad_desc_names_the_field);
    RUN(test_the_text_of_a_bad_frame_names_the_field);
    RUN(test_the_text_of_a_bad_draw_names_the_field);
    RUN(test_an_id_is_taken_once_per_frame);
    RUN(test_draws_without_id_may_be_many);
    RUN(test_every_number_has_a_sentence);
}
