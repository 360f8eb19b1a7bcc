/* SPDX-License-Identifier: MIT */
/* test_inputs.c - what is kept from frame to frame (desc.reuse) depends on every field of every struct that a frame points to:
 * each bit of each is turned, and turned back, and the pictures are those of a context that keeps nothing. The lists of fields
 * name all that the structs have: a new field does not compile until it has a line here. Host only. */
#include "smear_scene.h"

#include "tests/rig.h"

#include "smear_overlay.h"
#include "smear_scene.h"

enum { WIDTH = 64, HEIGHT = 32, PIXELS = WIDTH * HEIGHT };

/* ------------------------------------------------------------------ fields */

/* N(type, field, bytes, most), A(type, field, bytes of an element, most): a number, an array of numbers; those above `most` would be
 * read beyond an array's end. P(type, field): a pointer, which the other scene has, too. S(type, field): a struct that has a list of
 * its own, or what no picture depends on. */
#define TRANSFORM(N, A, P, S) A(smear_transform, basis, 4, ANY) A(smear_transform, origin, 4, ANY)
#define MESH(N, A, P, S) \
    P(smear_mesh, position) P(smear_mesh, normal) P(smear_mesh, uv) P(smear_mesh, color) P(smear_mesh, face_color) \
    P(smear_mesh, index) N(smear_mesh, triangle_count, 4, 2) N(smear_mesh, vertex_count, 2, 4) N(smear_mesh, shift, 1, ANY) \
            N(smear_mesh, uv_shift, 1, ANY) N(smear_mesh, scale, 4, ANY) A(smear_mesh, offset, 4, ANY) S(smear_mesh, bounds)
#define TEXTURE(N, A, P, S) \
    P(smear_texture, texels) P(smear_texture, palette) N(smear_texture, width, 2, 64) N(smear_texture, height, 2, 64) \
        N(smear_texture, format, 1, ANY) N(smear_texture, wrap_u, 1, ANY) N(smear_texture, wrap_v, 1, ANY) N(smear_texture, levels, 1, 3)
#define MATERIAL(N, A, P, S) \
    P(smear_material, texture) A(smear_material, color, 1, ANY) N(smear_material, alpha, 1, ANY) N(smear_material, cutoff, 1, ANY) \
        N(smear_material, unlit, 1, ANY) N(smear_material, double_sided, 1, ANY) N(smear_material, bilinear, 1, ANY) \
            N(smear_material, gloss, 1, ANY) N(smear_material, shine, 1, ANY)
#define CAMERA(N, A, P, S) \
    S(smear_camera, pose) N(smear_camera, focal, 4, ANY) N(smear_camera, half_height, 4, ANY) N(smear_camera, near_plane, 4, ANY) \
        N(smear_camera, far_plane, 4, ANY)
#define DRAW(N, A, P, S) \
    N(smear_draw, id, 4, ANY) P(smear_draw, mesh) P(smear_draw, material) P(smear_draw, now) P(smear_draw, open) P(smear_draw, close) \
    P(smear_draw, open_position) P(smear_draw, close_position) N(smear_draw, motion, 1, ANY) N(smear_draw, cut, 1, ANY) \
    N(smear_draw, billboard, 1, ANY) N(smear_draw, path, 1, ANY) N(smear_draw, open_count, 2, 4) N(smear_draw, close_count, 2, 4) \
                N(smear_draw, layers, 1, ANY)
#define LIGHT(N, A, P, S) A(smear_light, direction, 4, ANY) A(smear_light, ambient, 2, ANY) A(smear_light, diffuse, 2, ANY)
#define LIGHTS(N, A, P, S) \
    P(smear_lights, shader) A(smear_lights, direction, 4, ANY) A(smear_lights, diffuse, 2, ANY) A(smear_lights, lamp_diffuse, 2, ANY) \
        A(smear_lights, lamp, 4, ANY) N(smear_lights, reach, 4, ANY)
#define FOG(N, A, P, S) N(smear_fog, color, 4, ANY) N(smear_fog, near_plane, 4, ANY) N(smear_fog, far_plane, 4, ANY)
#define SHUTTER(N, A, P, S) \
    N(smear_shutter, degrees, 2, ANY) N(smear_shutter, exposure, 1, ANY) N(smear_shutter, poses, 1, ANY) N(smear_shutter, mode, 1, ANY) \
    N(smear_shutter, path, 1, ANY) N(smear_shutter, reference_hz, 2, ANY) N(smear_shutter, frame_us, 4, ANY) N(smear_shutter, us, 4, ANY) \
            P(smear_shutter, curve)
#define FRAME(N, A, P, S) \
    P(smear_frame, camera) P(smear_frame, open) P(smear_frame, close) N(smear_frame, method, 1, ANY) N(smear_frame, light_space, 1, ANY) \
    N(smear_frame, cut, 1, ANY) N(smear_frame, refresh, 1, ANY) N(smear_frame, samples, 2, ANY) N(smear_frame, target, 2, ANY) \
    N(smear_frame, budget, 4, ANY) N(smear_frame, clear, 4, ANY) P(smear_frame, light) P(smear_frame, fog) S(smear_frame, shutter) \
    S(smear_frame, filter) A(smear_frame, scale, 2, ANY) P(smear_frame, layer) N(smear_frame, layer_count, 1, NONE) \
                    N(smear_frame, edges, 1, REFUSED) P(smear_frame, overlay) P(smear_frame, scene)
#define SKY(N, A, P, S) \
    N(smear_sky, zenith, 4, ANY) N(smear_sky, horizon, 4, ANY) N(smear_sky, ground, 4, ANY) N(smear_sky, nadir, 4, ANY) \
        A(smear_sky, own, 4, NONE) P(smear_sky, kind)
#define SCENE(N, A, P, S) P(smear_scene, sky) P(smear_scene, lights)
#define IMAGE(N, A, P, S) \
    P(smear_image, pixels) P(smear_image, palette) N(smear_image, width, 2, 64) N(smear_image, height, 2, 64) N(smear_image, cells, 2, 4) \
        N(smear_image, format, 1, ANY)
#define FONT(N, A, P, S) S(smear_font, glyph) N(smear_font, first, 1, ANY) N(smear_font, advance, 1, ANY)
#define ITEM(N, A, P, S) \
    N(smear_overlay_item, x, 2, ANY) N(smear_overlay_item, y, 2, ANY) N(smear_overlay_item, width, 2, ANY) \
    N(smear_overlay_item, height, 2, ANY) A(smear_overlay_item, color, 1, ANY) N(smear_overlay_item, scale, 1, ANY) \
            N(smear_overlay_item, cell, 2, ANY) P(smear_overlay_item, image) P(smear_overlay_item, font) P(smear_overlay_item, text) \
            P(smear_overlay_item, shape) N(smear_overlay_item, to_x, 2, ANY) N(smear_overlay_item, to_y, 2, ANY) \
                    N(smear_overlay_item, turn, 2, ANY) N(smear_overlay_item, zoom, 2, ANY)
#define POINT(N, A, P, S) \
    A(smear_point, now, 4, ANY) A(smear_point, before, 4, ANY) N(smear_point, size, 4, ANY) A(smear_point, color, 1, ANY) \
        N(smear_point, fade, 1, ANY) N(smear_point, mode, 1, ANY) S(smear_point, place)
#define POINTS(N, A, P, S) P(smear_points, point) N(smear_points, count, 2, 2)
#define OVERLAY(N, A, P, S) P(smear_overlay, item) N(smear_overlay, count, 2, 3) P(smear_overlay, points)

/* Each list once: the tables, and what says that nothing is left out. */
#define LISTS(X) \
    X(TRANSFORM, smear_transform) X(MESH, smear_mesh) X(TEXTURE, smear_texture) X(MATERIAL, smear_material) X(CAMERA, smear_camera) \
    X(DRAW, smear_draw) X(LIGHT, smear_light) X(LIGHTS, smear_lights) X(SCENE, smear_scene) X(FOG, smear_fog) \
    X(SKY, smear_sky) X(SHUTTER, smear_shutter) X(FRAME, smear_frame) X(IMAGE, smear_image) \
                X(FONT, smear_font) X(ITEM, smear_overlay_item) X(POINT, smear_point) X(POINTS, smear_points) X(OVERLAY, smear_overlay)

/* REFUSED: any, but a display that is kept goes with none. */
enum { ANY = 0, NONE = -1, REFUSED = -2, NUMBER = 0, POINTER, OTHER };

struct field {
    const char *name;
    size_t offset, size;
    uint32_t unit;
    int most, kind;
};

#define AT(type, field) #type "." #field, offsetof(type, field), sizeof(((type *)0)->field)
#define N_FIELD(type, field, unit, most) { AT(type, field), unit, most, NUMBER },
#define P_FIELD(type, field) { AT(type, field), sizeof(void *), 0, POINTER },
#define S_FIELD(type, field) { AT(type, field), 1, 0, OTHER },
#define TABLE(list, type) static const struct field type##_fields[] = { list(N_FIELD, N_FIELD, P_FIELD, S_FIELD) };
LISTS(TABLE)

/* Initializers without a name, one for each field of a list: one too few is a field that was forgotten. */
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wmissing-braces"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#define N_ZERO(type, field, unit, most) 0,
#define A_ZERO(type, field, unit, most) { 0 },
#define P_ZERO(type, field) NULL,
#define S_ZERO(type, field) { 0 },
#define WHOLE(list, type) static const type type##_whole = { list(N_ZERO, A_ZERO, P_ZERO, S_ZERO) };
LISTS(WHOLE)
#pragma GCC diagnostic pop

/* ------------------------------------------------------------------ a scene of all of them */

struct scene_of_all {
    int16_t position[3 * 4], uv[2 * 4];
    int8_t normal[3 * 4];
    uint8_t color[4 * 4], face_color[4 * 2];
    uint16_t index[3 * 2];
    uint32_t texels[64 * 8], palette[256];
    uint8_t pixels[4 * 64 * 8], curve[SMEAR_SHUTTER_POINTS];
    char text[4];
    smear_transform now, past;
    smear_mesh mesh;
    smear_texture texture;
    smear_material material;
    smear_camera camera, before;
    smear_draw draw;
    smear_light light;
    smear_fog fog;
    smear_sky sky;
    smear_scene extras;
    smear_image image;
    smear_font font;
    smear_overlay_item item[5];
    smear_point point[2];
    smear_points points;
    smear_overlay overlay;
    smear_lights lights;
    smear_frame frame;
};

/* Two scenes whose arrays differ: each pointer of one may be that of the other. */
static struct scene_of_all scene, other;

static void fill(void *bytes, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++)
        ((uint8_t *)bytes)[i] = (uint8_t)((seed = seed * 1664525u + 1013904223u) >> 24);
}

#define FILL(array, seed) fill(array, sizeof(array), seed)

static void make_arrays(struct scene_of_all *s, uint32_t seed, int size)
{
    const int16_t corner[12] = { -200, -150, 0, 220, -160, 0, 190, 170, 0, -210, 140, 0 };
    const uint16_t side[2][6] = { { 0, 1, 2, 0, 2, 3 }, { 1, 2, 3, 0, 1, 3 } };
    for (int i = 0; i < 12; i++)
        s->position[i] = (int16_t)(corner[i] * size / 8);
    memcpy(s->index, side[seed & 1], sizeof s->index);
    FILL(s->uv, seed);
    FILL(s->normal, seed);
    FILL(s->color, seed);
    FILL(s->face_color, seed);
    FILL(s->texels, seed);
    FILL(s->palette, seed);
    FILL(s->pixels, seed);
    FILL(s->curve, seed);
    memcpy(s->text, seed & 1 ? "AB" : "BCA", 3 + !(seed & 1));
    for (int i = 0; i < 8; i++)
        s->uv[i] = (int16_t)(s->uv[i] / 4);
    for (int i = 0; i < 4; i++)
        s->normal[3 * i + 2] = 100;
}

static void make_all(struct scene_of_all *s, uint32_t seed, int size, uint8_t method)
{
    memset(s, 0, sizeof *s);
    make_arrays(s, seed, size);
    s->now = s->past = pose_at(0.1 * size - 0.8, 0, -4, 0.2, 0.1);
    s->mesh = (smear_mesh){ .position = s->position, .normal = s->normal, .uv = s->uv, .color = s->color, .face_color = s->face_color,
                            .index = s->index, .triangle_count = 2, .vertex_count = 4, .shift = 8 };
    s->texture = (smear_texture){ .texels = s->texels, .palette = s->palette, .width = 8, .height = 8, .format = SMEAR_TEXEL_PALETTE8 };
    s->material = (smear_material){ .texture = &s->texture, .color = { 200, 210, 190, 255 }, .double_sided = 1,
                                    .gloss = 100, .shine = 3 };
    s->camera = s->before = camera_at(0, 0, 0, 0);
    s->light = (smear_light){ { 10000, 20000, 30000 }, { 20000, 21000, 22000 }, { 40000, 39000, 38000 } };
    s->fog = (smear_fog){ 0x406080, q16(1), q16(20) };
    s->sky = (smear_sky)SMEAR_SKY(0x4060a0, 0xc0d0e0, 0x60705f, 0x202010);
    s->extras = (smear_scene){ &s->sky, &s->lights };
    s->draw = (smear_draw){ .mesh = &s->mesh, .material = &s->material, .now = &s->now };
    s->image = (smear_image){ .pixels = s->pixels, .palette = s->palette, .width = 8, .height = 8, .cells = 3,
                              .format = SMEAR_IMAGE_PALETTE4 };
    s->font = (smear_font){ { .pixels = s->pixels, .palette = s->palette, .width = 6, .height = 7, .cells = 2 }, 'A', 8 };
    s->item[0] = (smear_overlay_item){ .x = 3, .y = 2, .color = { 250, 240, 20, 255 }, .font = &s->font, .text = s->text };
    s->item[1] = (smear_overlay_item){ .x = 40, .y = 20, .cell = 1, .image = &s->image };
    s->item[2] = (smear_overlay_item){ .x = 20, .y = 26, .width = 9, .height = 3, .color = { 20, 240, 20, 200 } };
    s->item[3] = (smear_overlay_item){ .x = 9, .y = 20, .image = &s->image, .shape = &smear_shape_turned, .turn = 5000, .zoom = 300 };
    s->item[4] = (smear_overlay_item){ .x = 9, .y = 9, .width = 40, .to_x = 180, .to_y = -70, .shape = &smear_shape_line };
    for (int i = 0; i < 2; i++)
        s->point[i] = (smear_point){ .now = { q16(i - 0.4), q16(0.5), q16(-3) }, .before = { q16(i - 0.4), q16(0.5), q16(-3) },
                                     .size = q16(0.2), .color = { 250, 90, 80 }, .fade = 20, .mode = SMEAR_POINT_BLEND };
    s->points = (smear_points){ s->point, 2 };
    s->overlay = (smear_overlay){ s->item, 3, &s->points };
    s->frame = (smear_frame){ .camera = &s->camera, .method = method, .clear = 0x102030, .light = &s->light, .fog = &s->fog,
                              .shutter.frame_us = 20000, .overlay = &s->overlay, .scene = &s->extras };
    s->lights = (smear_lights){ &smear_lights_shader, { 20000, -10000, 30000 }, { 9000, 8000, 7000 }, { 30000, 20000, 10000 },
                                { q16(0.3), q16(0.4), q16(-3) }, q16(4) };
}

/* ------------------------------------------------------------------ what is shown */

/* A context that keeps, before a display that does, and one that sends all of every frame. */
struct pair {
    struct rig keeps, whole;
    uint32_t shown[PIXELS], want[PIXELS];
    uint32_t frames, kept;
};

static int put_band(void *user, const smear_band *band, uint32_t *pixels)
{
    (void)user;
    for (int y = 0; y < band->height; y++)
        memcpy(pixels + (band->y + y) * WIDTH + band->x, (const uint8_t *)band->pixels + (size_t)y * band->stride,
               4u * (size_t)band->width);
    return 0;
}

static struct pair pair;

static int put_kept(void *user, const smear_band *band) { return put_band(user, band, pair.shown); }
static int put_whole(void *user, const smear_band *band) { return put_band(user, band, pair.want); }

static bool pair_begin(unsigned methods, bool caches)
{
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .max_triangles = 200, .max_draws = 2, .methods = (uint16_t)methods, .tile = 8,
                        .flush = put_whole };
    memset(&pair, 0, sizeof pair);
    const bool ok = rig_begin(&pair.whole, &desc, false);
    desc.flush = put_kept;
    desc.reuse.buffer_age = !caches;
    desc.reuse.cache_static = caches;
    return rig_begin(&pair.keeps, &desc, false) && ok;
}

/* Draws the scene in both contexts. False where it is refused. */
static bool draw_both(void)
{
    smear_stats stats;
    if (rig_frame(&pair.keeps, &scene.frame, &scene.draw, 1) != SMEAR_OK)
        return false;
    CHECK_EQ(rig_frame(&pair.whole, &scene.frame, &scene.draw, 1), SMEAR_OK);
    smear_get_stats(pair.keeps.ctx, &stats);
    pair.frames++;
    pair.kept += stats.tiles_kept != 0 || stats.static_cached;
    return true;
}

/* ------------------------------------------------------------------ what is turned */

static uint32_t value_of(const uint8_t *at, uint32_t unit)
{
    uint32_t value = 0;
    memcpy(&value, at, unit);
    return value;
}

/* Draws what was changed at `at`, and as it was before. True where the frame is taken. */
static bool compare(const char *name, uint8_t *at, const void *value, size_t size)
{
    uint8_t before[sizeof(void *)];
    memcpy(before, at, size);
    memcpy(at, value, size);
    const bool taken = draw_both();
    const bool same = !taken || memcmp(pair.shown, pair.want, sizeof pair.want) == 0;
    memcpy(at, before, size);
    if (taken)
        CHECK(draw_both());
    if (!CHECK(same && memcmp(pair.shown, pair.want, sizeof pair.want) == 0)) {
        char text[100];
        snprintf(text, sizeof text, "    %s, byte %d of the scene\n", name, (int)(at - (uint8_t *)&scene));
        test_print(text);
    }
    return taken;
}

/* Turns each bit of a number's elements. */
static int turn_numbers(const struct field *f, uint8_t *at)
{
    int taken = 0;
    for (size_t k = 0; k < f->size; k += f->unit)
        for (uint32_t bit = 0; bit < 8 * f->unit; bit++) {
            const uint32_t value = value_of(at + k, f->unit) ^ 1u << bit;
            if (f->most == ANY || f->most == REFUSED || value <= (uint32_t)(f->most == NONE ? 0 : f->most))
                taken += compare(f->name, at + k, &value, f->unit);
        }
    return taken;
}

/* Each pointer becomes null, and that of the other scene. */
static int turn_pointer(const struct field *f, uint8_t *at)
{
    const void *null = NULL, *elsewhere;
    memcpy(&elsewhere, (uint8_t *)&other + (at - (uint8_t *)&scene), sizeof elsewhere);
    const int taken = compare(f->name, at, &null, sizeof null);
    return taken + (elsewhere != NULL ? compare(f->name, at, &elsewhere, sizeof elsewhere) : 0);
}

static void turn_fields(const struct field *f, size_t count, void *record)
{
    size_t end = 0;
    for (size_t i = 0; i < count; i++, f++) {
        uint8_t *at = (uint8_t *)record + f->offset;
        CHECK(i == 0 || f->offset >= end);     /* in the order of the struct, each once */
        end = f->offset + f->size;
        const int taken = f->kind == POINTER ? turn_pointer(f, at) : f->kind == NUMBER && f->most != NONE ? turn_numbers(f, at) : 1;
        if (!CHECK(taken != 0 || (f->most == REFUSED && pair.keeps.desc.reuse.buffer_age != 0))) {
            test_print(f->name);
            test_print(": nothing of it is taken\n");
        }
    }
}

#define TURN(type, record) turn_fields(type##_fields, sizeof type##_fields / sizeof *type##_fields, record)

static void turn_all(void)
{
    TURN(smear_transform, &scene.now);
    TURN(smear_mesh, &scene.mesh);
    TURN(smear_texture, &scene.texture);
    TURN(smear_material, &scene.material);
    TURN(smear_camera, &scene.camera);
    TURN(smear_transform, &scene.camera.pose);
    TURN(smear_draw, &scene.draw);
    TURN(smear_light, &scene.light);
    TURN(smear_fog, &scene.fog);
    TURN(smear_lights, &scene.lights);
    TURN(smear_sky, &scene.sky);
    TURN(smear_scene, &scene.extras);
    TURN(smear_shutter, &scene.frame.shutter);
    TURN(smear_frame, &scene.frame);
    TURN(smear_image, &scene.image);
    TURN(smear_image, &scene.font.glyph);
    TURN(smear_font, &scene.font);
    for (int i = 0; i < 5; i++)
        TURN(smear_overlay_item, &scene.item[i]);
    TURN(smear_point, &scene.point[1]);
    TURN(smear_points, &scene.points);
    TURN(smear_overlay, &scene.overlay);
    for (int i = 0; i < 3; i++)
        turn_numbers(&(struct field){ "text", 0, 1, 1, ANY, NUMBER }, (uint8_t *)&scene.text[i]);
}

static void check_inputs(uint8_t method, unsigned methods, bool caches)
{
    make_all(&scene, 1, 8, method);
    make_all(&other, 2, 6, method);
    if (pair_begin(methods, caches) && CHECK(draw_both()) && CHECK(draw_both()))
        turn_all();
    CHECK(pair.frames > 4000 && pair.kept > pair.frames / 10);
    rig_end(&pair.keeps);
    rig_end(&pair.whole);
}

static void test_a_blurred_display_follows_every_field(void)
{
    check_inputs(SMEAR_AUTO, SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_SUBFRAMES) | SMEAR_SET(SMEAR_NONE), false);
}

static void test_a_sharp_display_follows_every_field(void)
{
    check_inputs(SMEAR_NONE, SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_NONE), false);
}

static void test_a_kept_window_follows_every_field(void)
{
    check_inputs(SMEAR_AUTO, SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_SUBFRAMES), true);
}

#include "build/suites/inputs.h"
