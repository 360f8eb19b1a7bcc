/* SPDX-License-Identifier: MIT */
/* rig.c - see rig.h. */
#include "tests/rig.h"

#include "tools/player/crew.h"

int take_band(void *user, const smear_band *band)
{
    struct rig *r = user;
    if (band->y != r->next_row || band->width != r->desc.width || band->size == 0)
        r->bands_in_order = false;
    r->next_row = band->y + band->height;
    if (r->picture_size + band->size <= r->picture_room)
        memcpy(r->picture + r->picture_size, band->pixels, band->size);
    r->picture_size += band->size;
    if (r->bands++ == r->fail_at)
        return r->fail_with;
    if (r->reports_sent)
        smear_band_done(r->ctx);
    return 0;
}

int place_band(void *user, const smear_band *band)
{
    struct rig *r = user;
    for (int y = 0; y < band->height; y++)
        memcpy(r->picture + ((band->y + y) * r->desc.width + band->x) * 4, (const uint8_t *)band->pixels + (uint32_t)y * band->stride,
               (size_t)band->width * 4);
    r->sent += band->width * band->height;
    return 0;
}

static void take_row(void *user, int y, const uint32_t *color, const uint16_t *depth, const int32_t *velocity)
{
    struct rig *r = user;
    size_t w = (size_t)r->desc.width, at = (size_t)y * w;
    memcpy(r->color + at, color, w * sizeof *color);
    memcpy(r->depth + at, depth, w * sizeof *depth);
    memcpy(r->velocity + 2 * at, velocity, 2 * w * sizeof *velocity);
    r->inspected++;
}

smear_desc small_desc(int width, int height)
{
    return (smear_desc){ .width = (int16_t)width, .height = (int16_t)height, .reach = 8,
                         .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .max_triangles = 400,
                         .max_draws = 8, .format = SMEAR_XRGB8888 };
}

bool rig_begin(struct rig *r, const smear_desc *desc, bool inspect)
{
    memset(r, 0, sizeof *r);
    r->desc = *desc;
    if (r->desc.flush == NULL)
        r->desc.flush = take_band;
    r->desc.debug.inspect = inspect ? take_row : NULL;
    r->desc.user = r;
    if (r->desc.idle == NULL)
        r->desc.idle = crew_idle;
    r->fail_at = -1;
    size_t pixels = (size_t)desc->width * (size_t)desc->height;
    r->bytes = smear_memory_size(&r->desc);
    r->block = malloc(r->bytes + 2 * GUARD);
    r->picture_room = pixels * 4;
    r->picture = calloc(pixels, 4);
    r->color = calloc(pixels, sizeof *r->color);
    r->depth = calloc(pixels, sizeof *r->depth);
    r->velocity = calloc(pixels, 2 * sizeof *r->velocity);
    if (!CHECK(r->block != NULL && r->picture != NULL && r->color != NULL && r->depth != NULL
               && r->velocity != NULL))
        return false;
    memset(r->block, PATTERN, r->bytes + 2 * GUARD);
    struct failure f;
    if (desc->workers > 1)
        r->crew = crew_start(desc->workers, &f);
    return CHECK(r->bytes > 0) && CHECK(desc->workers <= 1 || r->crew != NULL)
        && CHECK_EQ(smear_init(&r->ctx, &r->desc, r->block + GUARD, r->bytes), SMEAR_OK);
}

void rig_must_begin(struct rig *r, const smear_desc *desc, bool inspect)
{
    if (rig_begin(r, desc, inspect))
        return;
    test_print("no rig in ");
    test_print(test_state.name);
    test_print("\n");
    fflush(stdout);
    exit(1);
}

bool guards_intact(const struct rig *r)
{
    for (size_t i = 0; i < GUARD; i++)
        if (r->block[i] != PATTERN || r->block[GUARD + r->bytes + i] != PATTERN)
            return false;
    return true;
}

void rig_end(struct rig *r)
{
    crew_stop(r->crew);
    if (r->block != NULL)
        CHECK(guards_intact(r));
    free(r->block);
    free(r->picture);
    free(r->color);
    free(r->depth);
    free(r->velocity);
    memset(r, 0, sizeof *r);
}

void rig_forget_output(struct rig *r)
{
    r->picture_size = 0;
    r->bands = r->next_row = r->inspected = 0;
    r->bands_in_order = true;
}

int rig_frame(struct rig *r, const smear_frame *frame, const smear_draw *draw, int count)
{
    rig_forget_output(r);
    int result = smear_begin(r->ctx, frame);
    for (int i = 0; i < count && result == SMEAR_OK; i++)
        result = smear_submit(r->ctx, &draw[i]);
    return result != SMEAR_OK ? result : crew_render(r->crew, r->ctx);
}

uint8_t *rig_copy(struct rig *r, const smear_frame *frame, const smear_draw *draw, int count)
{
    CHECK_EQ(rig_frame(r, frame, draw, count), SMEAR_OK);
    CHECK(r->bands_in_order && r->next_row == r->desc.height && r->picture_size <= r->picture_room);
    uint8_t *copy = malloc(r->picture_room);
    if (CHECK(copy != NULL))
        memcpy(copy, r->picture, r->picture_room);
    return copy;
}

bool same_picture(const struct rig *r, const uint8_t *picture)
{
    for (size_t i = 0; i < r->picture_size; i++)
        if (r->picture[i] != picture[i])
            return CHECK_EQ((int64_t)i, -1);        /* where they differ */
    return true;
}

void rig_rgb(const struct rig *r, uint8_t *rgb)
{
    const uint32_t *pixel = (const uint32_t *)(const void *)r->picture;
    for (int i = 0; i < 3 * r->desc.width * r->desc.height; i++)
        rgb[i] = (uint8_t)(pixel[i / 3] >> (16 - 8 * (i % 3)));
}

double rms_of(const void *a, const void *b, int pixels)
{
    const uint32_t *one = (const uint32_t *)a, *other = (const uint32_t *)b;
    double sum = 0;
    for (int i = 0; i < pixels; i++)
        for (int shift = 0; shift < 24; shift += 8)
            sum += pow((double)(one[i] >> shift & 255u) - (double)(other[i] >> shift & 255u), 2);
    return sqrt(sum / (3.0 * pixels));
}

/* ------------------------------------------------------------------ poses and cameras */

void random_rotation(int32_t basis[9], double scale)
{
    double q[4], length = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = uniform(-1, 1);
        length += q[i] * q[i];
    }
    length = sqrt(length);
    double w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
    const double m[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
        2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
        2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
    };
    for (int i = 0; i < 9; i++)
        basis[i] = (int32_t)lrint(m[i] * scale * (1 << 24));
}

int32_t q16(double v) { return (int32_t)lrint(v * 65536); }
int32_t q24(double v) { return (int32_t)lrint(v * (1 << 24)); }

smear_transform pose_at(double x, double y, double z, double yaw, double pitch)
{
    double cy = cos(yaw), sy = sin(yaw), cp = cos(pitch), sp = sin(pitch);
    return (smear_transform){ { q24(cy), q24(sy * sp), q24(sy * cp), 0, q24(cp), q24(-sp),
                                q24(-sy), q24(cy * sp), q24(cy * cp) },
                              { q16(x), q16(y), q16(z) } };
}

smear_camera camera_at(double x, double y, double z, double yaw)
{
    return (smear_camera){ .pose = pose_at(x, y, z, yaw, 0), .focal = 65536, .near_plane = 6554,
                           .far_plane = 100 * 65536 };
}

/* ------------------------------------------------------------------ meshes: one step is 1/256 unit */

const int16_t square_position[] = { -256, -256, 0, 256, -256, 0, 256, 256, 0, -256, 256, 0 };
const int16_t square_uv[] = { 0, 32767, 32767, 32767, 32767, 0, 0, 0 };
const uint16_t square_index[] = { 0, 1, 2, 0, 2, 3 };
const smear_mesh square = {
    .position = square_position, .uv = square_uv, .index = square_index, .triangle_count = 2,
    .vertex_count = 4, .shift = STEP
};

const int16_t cube_position[] = {
    -256, -256, -256, 256, -256, -256, 256, 256, -256, -256, 256, -256,
    -256, -256, 256, 256, -256, 256, 256, 256, 256, -256, 256, 256
};
static const int8_t cube_normal[] = {
    -73, -73, -73, 73, -73, -73, 73, 73, -73, -73, 73, -73, -73, -73, 73, 73, -73, 73, 73, 73, 73, -73, 73, 73
};
static const uint8_t cube_color[] = {
    255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255,
    0, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 64, 64, 64, 255
};
const uint16_t cube_index[] = {
    4, 5, 6, 4, 6, 7, 1, 0, 3, 1, 3, 2, 5, 1, 2, 5, 2, 6, 0, 4, 7, 0, 7, 3, 7, 6, 2, 7, 2, 3, 0, 1, 5, 0, 5, 4
};
const smear_mesh cube = {
    .position = cube_position, .normal = cube_normal, .color = cube_color, .index = cube_index,
    .triangle_count = 12, .vertex_count = 8, .shift = STEP
};

uint32_t checker[8 * 8];
const smear_texture checker_texture = { .texels = checker, .width = 8, .height = 8 };

void make_checker(void)
{
    for (uint32_t i = 0; i < 64; i++)
        checker[i] = ((i ^ i >> 3) & 1u ? 0xffe0c020u : 0xff2040a0u) + (i << 8);
}

static uint32_t leaf[16 * 16];
static const smear_texture leaf_texture = { .texels = leaf, .width = 16, .height = 16 };

void make_scene(struct scene *s, double t, int method)
{
    make_checker();
    for (uint32_t i = 0; i < 256; i++)
        leaf[i] = (i & 4u) ^ (i >> 4 & 4u) ? 0xff30b040u : 0x0030b040u;
    memset(s, 0, sizeof *s);
    s->pose[0] = pose_at(0, -1, -2, 0, -1.5707963);
    for (int i = 0; i < 9; i++)
        s->pose[0].basis[i] *= 6;
    s->pose[1] = pose_at(-1.5 + t, 0.2, -5, t, 0.3);
    s->pose[2] = pose_at(1.5, 0.3 - 0.5 * t, -6, -2 * t, 0.1);
    s->pose[3] = pose_at(0.4 * t, 0, -3.5, 0.2, 0);
    s->pose[4] = pose_at(0.5 - 0.8 * t, 0.4, -4, 0, 0);
    s->material[0] = (smear_material){ .texture = &checker_texture };
    s->material[2] = (smear_material){ .color = { 255, 180, 90, 255 } };
    s->material[3] = (smear_material){ .color = { 80, 160, 255, 128 }, .alpha = SMEAR_BLEND, .unlit = 1 };
    s->material[4] = (smear_material){ .texture = &leaf_texture, .alpha = SMEAR_CUTOUT, .double_sided = 1 };
    for (int i = 0; i < SCENE_DRAWS; i++)
        s->draw[i] = (smear_draw){ .id = (uint32_t)i + 1, .mesh = i == 1 || i == 2 ? &cube : &square,
                                   .material = &s->material[i], .now = &s->pose[i] };
    s->camera = camera_at(0.1 * t, 0.1, 0, 0.05 * t);
    s->frame = (smear_frame){ .camera = &s->camera, .method = (uint8_t)method, .clear = 0x203040 };
}

int render_scene(struct rig *r, double t, int method)
{
    struct scene s;
    make_scene(&s, t, method);
    s.frame.camera = &s.camera;
    return rig_frame(r, &s.frame, s.draw, SCENE_DRAWS);
}
