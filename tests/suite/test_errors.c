/* SPDX-License-Identifier: MIT */
/* test_errors.c - every field that may be wrong: its number is its own, and its text names it. */
#include "tests/rig.h"

#include "smear_overlay.h"

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

#define IN(type, name, field, value) { name, offsetof(type, field), sizeof ((type *)0)->field, value }
#define DESC(field, value) IN(smear_desc, "desc." #field, field, value)
#define FRAME(field, value) IN(smear_frame, "frame." #field, field, value)
#define DRAW(field, value) IN(smear_draw, "draw." #field, field, value)
#define MESH(field, value) IN(smear_mesh, "draw.mesh", field, value)
#define TEXTURE(field, value) IN(smear_texture, "draw.material", field, value)
#define CAMERA(field, value) IN(smear_camera, "frame.camera", field, value)

static void test_the_text_of_a_bad_desc_names_the_field(void)
{
    static const struct bad bad[] = {
        DESC(width, 0), DESC(width, -1), DESC(width, 2049), DESC(height, 0), DESC(height, -5), DESC(height, 2049),
        DESC(max_triangles, (16 << 20) + 1), DESC(max_triangles, -1), DESC(methods, SMEAR_SET(SMEAR_METHOD_COUNT)),
        DESC(tile, 2), DESC(tile, 4), DESC(tile, 12), DESC(tile, 128), DESC(tile, -8), DESC(reach, 65), DESC(reach, -1),
        DESC(strip, 40), DESC(bands, 3), DESC(format, SMEAR_L1_PAGES + 1), DESC(format, 255), DESC(workers, 9), DESC(workers, 255),
        DESC(vertex_cache, 8), DESC(vertex_cache, 65), DESC(vertex_cache, 8192), DESC(band_rows, 1), DESC(band_rows, 6),
        DESC(band_rows, 32), DESC(band_rows, -8), DESC(band_rows, 12), DESC(reuse.cache_static, 2), DESC(reuse.buffer_age, 8),
        DESC(filter.passes, 4), DESC(filter.scatter, 2), DESC(display.dither, SMEAR_DITHER_DIFFUSE),
        DESC(display.dither, SMEAR_DITHER_DIFFUSE + 1), DESC(display.doubled, SMEAR_DOUBLED_XY + 1),
        /* of a filter alone */
        DESC(band_rows, 1), DESC(band_rows, 6), DESC(band_rows, 32), DESC(band_rows, 12), DESC(reuse.cache_static, 1),
        DESC(reuse.buffer_age, 1), DESC(tile, 8)
    };
    uint64_t *memory = malloc(1 << 20);
    int last = 0;
    for (size_t i = 0; i < sizeof bad / sizeof *bad && CHECK(memory != NULL); i++) {
        smear_context *ctx = NULL;
        smear_desc desc = small_desc(64, 48);
        desc.methods |= i + 7 < sizeof bad / sizeof *bad ? SMEAR_SET(SMEAR_AUTO) : 0;
        desc.tile = desc.reach = 16;
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
    smear_desc desc = small_desc(64, 48);
    names(smear_init(&ctx, &desc, memory, 1 << 20), "desc.flush");
    desc.flush = take_band;
    CHECK_EQ(smear_error_kind(smear_init(NULL, &desc, memory, 1 << 20)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_init(&ctx, NULL, memory, 1 << 20)), SMEAR_ERR_ARG);
    CHECK(smear_memory_size(NULL) == 0 && ctx == NULL);
    free(memory);
}

/* Each as the frame's camera, and as that at shutter open or close. */
static void check_cameras(struct rig *r, const smear_camera *good)
{
    static const struct bad field[] = {
        CAMERA(focal, 0), CAMERA(focal, -1), CAMERA(near_plane, 0), CAMERA(near_plane, -65536), CAMERA(far_plane, 6553),
        CAMERA(far_plane, -1), CAMERA(half_height, -1), CAMERA(half_height, 65536) /* orthographic: needs a far plane */,
        CAMERA(pose.basis[4], 2 * SMEAR_BASIS_ONE + 1), CAMERA(pose.basis[8], INT32_MIN)
    };
    enum { FIELDS = sizeof field / sizeof *field };
    for (int i = 0; i < FIELDS + 4; i++) {
        smear_camera bad = *good;
        bad.near_plane = 6553;
        bad.far_plane = 0;
        if (i < FIELDS)
            put(&bad, &field[i]);
        /* An axis of 1.02; two that are not upright to each other; a mirror; nothing. */
        for (int e = 1; i >= FIELDS && e < 9; e += 3)
            bad.pose.basis[e] = i == FIELDS ? bad.pose.basis[e] + bad.pose.basis[e] / 50
                              : i == FIELDS + 1 ? bad.pose.basis[e] + bad.pose.basis[e + 1] / 50 : -bad.pose.basis[e];
        if (i == FIELDS + 3)
            memset(bad.pose.basis, 0, sizeof bad.pose.basis);
        bool ok = names(smear_begin(r->ctx, &(smear_frame){ .camera = &bad }), "frame.camera");
        ok = names(smear_begin(r->ctx, &(smear_frame){ .camera = good, .open = &bad }), "frame.open") && ok;
        ok = names(smear_begin(r->ctx, &(smear_frame){ .camera = good, .close = &bad }), "frame.close") && ok;
        if (!ok)
            CHECK_EQ(i, -1);
    }
}

static void test_the_text_of_a_bad_frame_names_the_field(void)
{
    static const struct bad bad[] = {
        FRAME(method, SMEAR_METHOD_COUNT), FRAME(method, SMEAR_AUTO), FRAME(method, SMEAR_SUBFRAMES), FRAME(method, SMEAR_TIMEMASK),
        FRAME(method, SMEAR_PINGPONG), FRAME(method, SMEAR_HALF), FRAME(method, SMEAR_OBJECT), FRAME(method, SMEAR_LAYERED),
        FRAME(method, SMEAR_ACCUMULATE), FRAME(light_space, SMEAR_LIGHT_ENCODED + 1),
        FRAME(samples, 1025), FRAME(shutter.degrees, 3601), FRAME(shutter.exposure, SMEAR_LEADING + 1),
        FRAME(shutter.mode, SMEAR_SHUTTER_FIXED + 1), FRAME(shutter.reference_hz, 1001), FRAME(shutter.frame_us, 1000001),
        FRAME(filter.kind, SMEAR_FILTER_PINGPONG + 1), FRAME(filter.weights, SMEAR_WEIGHTS_JIMENEZ + 1),
        FRAME(filter.camera_step, 3), FRAME(filter.camera_step, 8), FRAME(filter.pingpong.passes, 4), FRAME(filter.pingpong.taps, 1),
        FRAME(filter.pingpong.taps, 65), FRAME(filter.pingpong.base, 1), FRAME(filter.pingpong.base, 65),
        FRAME(filter.pingpong.jitter, 129), FRAME(filter.pingpong.spread, 2), FRAME(scale.rotation, 16129),
        FRAME(scale.translation, 16129)
    };
    smear_desc desc = small_desc(32, 32);
    desc.methods |= SMEAR_SET(SMEAR_CAMERA);
    RIG(r, &desc, false);
    struct scene s;
    make_scene(&s, 0, SMEAR_RECONSTRUCT);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        smear_frame f = s.frame;
        put(&f, &bad[i]);
        names(smear_begin(r.ctx, &f), bad[i].name);
    }
    check_cameras(&r, &s.camera);
    const uint8_t closed[SMEAR_SHUTTER_POINTS] = { 0 };
    const smear_light nowhere = { .diffuse = { 1, 1, 1 } };
    names(smear_begin(r.ctx, &(smear_frame){ .camera = NULL }), "frame.camera");
    names(smear_begin(r.ctx, &(smear_frame){ .camera = &s.camera, .shutter.curve = closed }), "frame.shutter.curve");
    names(smear_begin(r.ctx, &(smear_frame){ .camera = &s.camera, .light = &nowhere }), "frame.light");
    names(smear_begin(r.ctx, &(smear_frame){ .camera = &s.camera, .layer_count = 1 }), "frame.layer");
    names(smear_begin(r.ctx, &(smear_frame){ .camera = &s.camera, .method = SMEAR_CAMERA, .filter.kind = SMEAR_FILTER_PINGPONG }),
          "frame.filter.kind");
    CHECK_EQ(smear_error_kind(smear_begin(r.ctx, NULL)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_begin(NULL, &s.frame)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_render(NULL), SMEAR_ERR_ARG);
    smear_work(NULL, 1);
    CHECK_EQ(smear_render(r.ctx), SMEAR_ERR_ORDER);         /* nothing was begun */
    CHECK_EQ(rig_frame(&r, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
    desc.methods = SMEAR_SET(SMEAR_NONE);       /* no window */
    RIG(sharp, &desc, false);
    names(smear_begin(sharp.ctx, &s.frame), "frame.method");
    CHECK_EQ(render_scene(&sharp, 0, SMEAR_DEFAULT_METHOD), SMEAR_OK);
}

static void test_the_text_of_bad_fog_and_edges_names_the_field(void)
{
    static const struct {
        int32_t near_plane, far_plane;
        bool good;
    } fogs[] = {
        { 0, 65536, true }, { -1, 65536, false }, { 65536, 65536, false }, { 131072, 65536, false }, { 65536, 65536 + 257, false },
        { 65536, 65536 + 300, true }, { 0, 0, false }, { 0, 1000, false }, { INT32_MAX - 1, INT32_MAX, false },
        { 0, INT32_MAX, true }, { 0, INT32_MIN, false }
    };
    static const struct {
        int method, edges;
        bool good;
    } edges[] = {
        { SMEAR_AUTO, SMEAR_EDGES_SMOOTH, true },      { SMEAR_AUTO, 2, false },
        { SMEAR_NONE, SMEAR_EDGES_SMOOTH, false },     { SMEAR_TIMEMASK, SMEAR_EDGES_SMOOTH, false },
        { SMEAR_ACCUMULATE, SMEAR_EDGES_SMOOTH, false }, { SMEAR_NONE, SMEAR_EDGES_HARD, true },
    };
    struct scene s;
    smear_desc desc = small_desc(32, 32);
    desc.methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_TIMEMASK) | SMEAR_SET(SMEAR_ACCUMULATE);
    RIG(r, &desc, false);
    for (size_t i = 0; i < sizeof fogs / sizeof *fogs; i++) {
        const smear_fog fog = { .near_plane = fogs[i].near_plane, .far_plane = fogs[i].far_plane };
        make_scene(&s, 0, SMEAR_NONE);
        s.frame.fog = &fog;
        const int result = smear_begin(r.ctx, &s.frame);
        CHECK(fogs[i].good ? result == SMEAR_OK : names(result, "frame.fog: "));
    }
    for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
        make_scene(&s, 0, edges[i].method);
        s.frame.edges = (uint8_t)edges[i].edges;
        const int result = smear_begin(r.ctx, &s.frame);
        CHECK(edges[i].good ? result == SMEAR_OK : names(result, "frame.edges: "));
    }
    /* Tiles that are kept without the picture. */
    desc.methods = SMEAR_SET(SMEAR_AUTO);
    desc.reuse.buffer_age = 1;
    for (int cache = 0; cache < 2; cache++) {
        desc.reuse.cache_static = (uint8_t)cache;
        if (rig_begin(&r, &desc, false)) {
            make_scene(&s, 0, SMEAR_AUTO);
            s.frame.edges = SMEAR_EDGES_SMOOTH;
            CHECK_EQ(smear_begin(r.ctx, &s.frame) == SMEAR_OK, cache == 1);
        }
        rig_end(&r);
    }
}

static void test_the_text_of_a_bad_draw_names_the_field_and_the_rest_is_drawn(void)
{
    static const struct bad bad[] = {
        DRAW(motion, SMEAR_MOTION_NONE + 1), DRAW(billboard, SMEAR_BILLBOARD_UPRIGHT + 1),
        MESH(shift, 63), MESH(shift, -33), MESH(uv_shift, 16), MESH(scale, -1), MESH(offset[0], (1 << 20) + 1),
        MESH(offset[1], (1 << 20) + 1), MESH(offset[2], -(1 << 20) - 1), TEXTURE(width, 0), TEXTURE(height, 0), TEXTURE(width, 4097),
        TEXTURE(height, 65535), TEXTURE(format, SMEAR_TEXEL_PALETTE8 + 1), TEXTURE(format, SMEAR_TEXEL_PALETTE8) /* no palette */,
        TEXTURE(wrap_u, SMEAR_MIRROR + 1), TEXTURE(wrap_v, 200)
    };
    smear_desc desc = small_desc(32, 32);
    RIG(r, &desc, false);
    struct scene s;
    make_scene(&s, 0, SMEAR_NONE);
    uint8_t *picture = rig_copy(&r, &s.frame, &s.draw[1], 1);
    rig_forget_output(&r);
    CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
    const size_t count = sizeof bad / sizeof *bad;
    for (size_t i = 0; i < count + 5; i++) {
        smear_mesh mesh = square;
        smear_texture texture = checker_texture;
        smear_material material = { .texture = &texture };
        smear_draw d = { .mesh = &mesh, .material = &material, .now = &s.pose[3] };
        if (i < count)
            put(bad[i].name[6] == 'e' ? (void *)&mesh : bad[i].name[6] == 'a' ? (void *)&texture : (void *)&d, &bad[i]);
        const char *name = i < count ? bad[i].name : "draw.mesh";
        switch (i - count) {
        case 0: d.mesh = NULL; break;
        case 1: mesh.position = NULL; break;
        case 2: mesh.index = NULL; break;
        case 3: texture.texels = NULL, name = "draw.material"; break;
        case 4: material.alpha = SMEAR_SHADOW + 1, name = "draw.material"; break;
        default: break;
        }
        names(smear_submit(r.ctx, &d), name);
    }
    CHECK_EQ(smear_error_kind(smear_submit(r.ctx, NULL)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_submit(NULL, &s.draw[1])), SMEAR_ERR_ARG);
    CHECK_EQ(smear_submit(r.ctx, &s.draw[1]), SMEAR_OK);
    CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
    CHECK(picture != NULL && same_picture(&r, picture));
    free(picture);
}

static int begin_with_points(smear_context *ctx, const smear_points *points)
{
    struct scene s;
    const smear_overlay overlay = { NULL, 0, points };
    make_scene(&s, 0, SMEAR_NONE);
    s.frame.overlay = &overlay;
    return smear_begin(ctx, &s.frame);
}

static int begin_with_item(smear_context *ctx, const smear_overlay_item *item)
{
    struct scene s;
    const smear_overlay overlay = { item, 1, NULL };
    make_scene(&s, 0, SMEAR_NONE);
    s.frame.overlay = &overlay;
    return smear_begin(ctx, &s.frame);
}

static void test_the_text_of_a_bad_item_or_point_names_the_field(void)
{
    static const uint8_t codes[6] = { 1, 2, 3, 0, 0, 1 };
    static const uint32_t palette[256] = { 0 };
    static const smear_image sprite = { codes, palette, 3, 2, 2, SMEAR_IMAGE_PALETTE4 };
    static const smear_image bad[] = { { codes, NULL, 3, 2, 2, SMEAR_IMAGE_PALETTE4 },
                                       { codes, palette, 2, 3, 1, SMEAR_IMAGE_PALETTE8 + 1 },
                                       { codes, palette, 2049, 3, 1, SMEAR_IMAGE_PALETTE8 }, { NULL, NULL, 3, 3, 0, SMEAR_IMAGE_MASK4 } };
    const smear_desc desc = small_desc(32, 32);
    smear_font font = smear_font_8x8;
    font.glyph.height = 0;
    RIG(r, &desc, false);
    names(begin_with_item(r.ctx, NULL), "frame.overlay");
    names(begin_with_item(r.ctx, &(smear_overlay_item){ .scale = 9 }), "overlay.item.scale");
    names(begin_with_item(r.ctx, &(smear_overlay_item){ .text = "" }), "overlay.item.font");
    names(begin_with_item(r.ctx, &(smear_overlay_item){ .text = "", .font = &font }), "overlay.item.font");
    names(begin_with_item(r.ctx, &(smear_overlay_item){ .image = &sprite, .cell = 2 }), "overlay.item.cell");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        names(begin_with_item(r.ctx, &(smear_overlay_item){ .image = &bad[i] }), "overlay.item.image");
    CHECK_EQ(begin_with_item(r.ctx, &(smear_overlay_item){ .image = &sprite }), SMEAR_OK);
    const smear_shape half = { smear_shape_line.find_box, NULL };
    names(begin_with_item(r.ctx, &(smear_overlay_item){ .shape = &half }), "overlay.item.shape");
    names(begin_with_item(r.ctx, &(smear_overlay_item){ .shape = &smear_shape_turned, .image = &bad[0] }), "overlay.item.image");
    CHECK_EQ(begin_with_item(r.ctx, &(smear_overlay_item){ .shape = &smear_shape_turned }), SMEAR_OK);
    names(begin_with_points(r.ctx, &(smear_points){ NULL, 1 }), "overlay.points");
    smear_point point = { .size = -1 };
    names(begin_with_points(r.ctx, &(smear_points){ &point, 1 }), "overlay.point.size");
    point = (smear_point){ .mode = SMEAR_POINT_BLEND + 1 };
    names(begin_with_points(r.ctx, &(smear_points){ &point, 1 }), "overlay.point.mode");
    /* Rows of another renderer have none. */
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_points points = { NULL, 0 };
    const smear_overlay overlay = { NULL, 0, &points };
    names(smear_filter_begin(r.ctx, &(smear_frame){ .camera = &camera, .method = SMEAR_RECONSTRUCT, .overlay = &overlay }),
          "overlay.points");
}

static void test_diffusion_is_refused_where_it_cannot_be(void)
{
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++) {
        smear_desc desc = { .width = 45, .height = 38, .format = (uint8_t)format, .flush = take_band,
                            .display.dither = SMEAR_DITHER_DIFFUSE };
        CHECK_EQ(smear_memory_size(&desc) != 0, format >= SMEAR_L4);
        desc.reuse.buffer_age = 1;
        CHECK(smear_memory_size(&desc) == 0);
    }
}

static void test_an_id_is_taken_once_per_frame(void)
{
    static const uint16_t methods[] = { SMEAR_SET(SMEAR_NONE), SMEAR_SET(SMEAR_AUTO), SMEAR_SET(SMEAR_RECONSTRUCT) };
    for (int m = 0; m < 3; m++) {
        static const uint32_t id[] = { 5, 0, 6, 0, 7 };
        smear_desc desc = small_desc(48, 32);
        desc.methods = methods[m];
        desc.max_draws = 7;
        RIG(r, &desc, false);
        for (int frame = 0; frame < 3; frame++) {
            struct scene s;
            make_scene(&s, 0.1 * frame, SMEAR_NONE);
            for (int i = 0; i < SCENE_DRAWS; i++)
                s.draw[i].id = id[i];
            uint8_t *picture = rig_copy(&r, &s.frame, s.draw, SCENE_DRAWS);
            rig_forget_output(&r);
            CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
            for (int i = 0; i < SCENE_DRAWS; i++) {
                CHECK_EQ(smear_submit(r.ctx, &s.draw[i]), SMEAR_OK);
                if (id[i] != 0)
                    names(smear_submit(r.ctx, &s.draw[i]), "draw.id");
            }
            CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
            CHECK(picture != NULL && same_picture(&r, picture));
            free(picture);
        }
    }
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
    CHECK(strstr(smear_error_text(SMEAR_ERR_ROOM), "max_triangles") != NULL);
    CHECK(strncmp(smear_error_text(-5000), "memory: too little", 18) == 0);
    CHECK(strcmp(smear_error_text(SMEAR_ERR_NEEDS + 1), "unknown error") == 0);
}

#include "build/suites/errors.h"
