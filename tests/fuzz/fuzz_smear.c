/* SPDX-License-Identifier: MIT */
/* fuzz_smear.c - libFuzzer target: bytes become a desc, meshes, textures and a few frames of wild
 * draws, rendered in exactly smear_memory_size() bytes. Every array the library reads has exactly
 * the size it promises to read, so that the sanitizer sees a step beyond.
 *
 * Beyond not crashing: bands come in order and cover the frame, and a second context with ample
 * room for triangles, another vertex cache and band height draws the same picture. */
#include "smear.h"
#include "smear_math.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool ok)
{
    if (!ok)
        abort();
}

/* ------------------------------------------------------------------ bytes to values */

struct source {
    const uint8_t *data;
    size_t size;
};

static uint8_t take(struct source *s)
{
    if (s->size == 0)
        return 0;
    s->size--;
    return *s->data++;
}

static uint32_t take_word(struct source *s)
{
    uint32_t word = 0;
    for (int i = 0; i < 4; i++)
        word = word << 8 | take(s);
    return word;
}

/* low .. high, both included */
static int take_range(struct source *s, int low, int high)
{
    uint32_t span = (uint32_t)(high - low + 1);
    uint32_t value = take(s);
    if (span > 256)
        value = value << 8 | take(s);
    return low + (int)(value % span);
}

static bool take_chance(struct source *s, int one_in)
{
    return take(s) % one_in == 0;
}

/* A number in the neighbourhood of `unit`, or anything at all. */
static int32_t take_value(struct source *s, int32_t unit)
{
    static const int32_t extreme[] = { INT32_MAX, INT32_MIN, 0, 1, -1, -INT32_MAX, 1 << 30, 1 << 16 };
    uint8_t kind = take(s);
    if (kind < 160)
        return unit / 64 * (int8_t)take(s);
    if (kind < 200)
        return extreme[take(s) & 7u];
    uint32_t word = take_word(s);
    return (int32_t)(kind < 230 ? word : word >> (take(s) & 31u));
}

static int32_t take_positive(struct source *s, int32_t unit)
{
    int32_t v = take_value(s, unit);
    return v == INT32_MIN ? INT32_MAX : v < 0 ? -v : v == 0 ? 1 : v;
}

/* ------------------------------------------------------------------ memory that is given back at the end */

enum { BLOCKS = 160 };

struct pool {
    void *block[BLOCKS];
    int count;
};

static void *pool_take(struct pool *p, size_t size)
{
    require(p->count < BLOCKS);
    void *block = malloc(size != 0 ? size : 1);
    require(block != NULL);
    p->block[p->count++] = block;
    return block;
}

static void *pool_bytes(struct pool *p, struct source *s, size_t size)
{
    uint8_t *bytes = pool_take(p, size);
    for (size_t i = 0; i < size; i++)
        bytes[i] = s->size != 0 ? take(s) : (uint8_t)(i * 37 + size);
    return bytes;
}

static void pool_free(struct pool *p)
{
    for (int i = 0; i < p->count; i++)
        free(p->block[i]);
}

/* ------------------------------------------------------------------ a scene */

enum { DRAWS = 6, MESHES = 3, TEXTURES = 2 };

struct scene {
    smear_texture texture[TEXTURES];
    smear_mesh mesh[MESHES];
    const int16_t *other_position[MESHES];
    smear_transform pose[DRAWS][3];
    smear_material material[DRAWS];
    smear_draw draw[DRAWS];
    int draws;
    smear_camera camera[3];
    smear_frame frame;
    uint8_t shutter[SMEAR_SHUTTER_POINTS];
};

static void take_texture(struct source *s, struct pool *p, smear_texture *t)
{
    static const uint8_t bytes[3] = { 4, 2, 1 };
    t->width = (uint16_t)take_range(s, 1, 16);
    t->height = (uint16_t)take_range(s, 1, 16);
    if (take_chance(s, 8))
        t->width = (uint16_t)(take_chance(s, 2) ? 4096 : take_range(s, 1, 4096));
    else if (take_chance(s, 2))         /* squares that have loops of their own */
        t->width = t->height = (uint16_t)(1 << take_range(s, 0, take_chance(s, 4) ? 8 : 6));
    t->format = take(s) % 3;
    t->wrap_u = take(s) % 3;
    t->wrap_v = take(s) % 3;
    size_t size = (size_t)t->width * t->height * bytes[t->format];
    t->levels = (uint8_t)take_range(s, 0, 13);      /* what is refused, too; the rest is smaller than the whole */
    if (t->levels > 0)
        size *= 2;
    size += 64;
    uint8_t *texels = pool_take(p, size);
    for (size_t i = 0; i < size; i++)
        texels[i] = (uint8_t)(i * 41 >> (i & 3));
    t->texels = texels;
    t->palette = t->format == SMEAR_TEXEL_PALETTE8 ? pool_bytes(p, s, 256 * 4) : NULL;
}

/* `wild`: indices may be out of range. */
static void take_mesh(struct source *s, struct pool *p, smear_mesh *m, const int16_t **other, bool wild)
{
    int vertices = take_range(s, 1, 24), triangles = take_range(s, 0, 30);
    int16_t *position[2];
    for (int k = 0; k < 2; k++) {
        position[k] = pool_take(p, (size_t)vertices * 3 * sizeof **position);
        for (int i = 0; i < vertices * 3; i++) {
            int scale = take_chance(s, 4) ? 256 : 1;
            position[k][i] = k == 1 && take_chance(s, 2) ? position[0][i] : (int16_t)((int8_t)take(s) * scale);
        }
    }
    uint16_t *index = pool_take(p, (size_t)triangles * 3 * sizeof *index);
    for (int i = 0; i < triangles * 3; i++)
        index[i] = (uint16_t)(take(s) % (vertices + wild));
    uint8_t has = take(s);
    *m = (smear_mesh){
        .position = position[0], .index = index, .triangle_count = (uint32_t)triangles,
        .vertex_count = (uint16_t)vertices, .shift = 6, .uv_shift = (uint8_t)take_range(s, 0, 15)
    };
    if (has & 1)
        m->normal = pool_bytes(p, s, (size_t)vertices * 3);
    if (has & 2)
        m->uv = pool_bytes(p, s, (size_t)vertices * 4);
    if (has & 4)
        m->color = pool_bytes(p, s, (size_t)vertices * 4);
    if (has & 8)
        m->face_color = pool_bytes(p, s, (size_t)triangles * 4);
    if (has & 16) {
        m->shift = (int8_t)take_range(s, -32, 62);
        m->scale = take_positive(s, 1 << 10);
        for (int i = 0; i < 3; i++)
            m->offset[i] = take_range(s, -32768, 32767) * (has & 32 ? 32 : 1);
    }
    *other = position[1];
}

static void take_transform(struct source *s, smear_transform *t)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    *t = identity;
    uint8_t kind = take(s);
    for (int i = 0; i < 9 && kind & 1; i++)
        t->basis[i] = take_value(s, SMEAR_BASIS_ONE);
    for (int i = 0; i < 3; i++)
        t->origin[i] = kind & 2 ? take_value(s, 4 << 16) : (int8_t)take(s) * 1024;
    if (!(kind & 4))            /* mostly in front of a camera at the origin */
        t->origin[2] = (int32_t)((uint32_t)t->origin[2] - (3u << 16));
}

static void take_camera(struct source *s, smear_camera *c)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    uint8_t kind = take(s);
    *c = (smear_camera){ .pose = identity, .focal = 1 << 16, .near_plane = 1 << 13, .far_plane = 0 };
    if (kind & 1) {
        const uint32_t about_y = take_word(s), about_x = take_word(s);
        c->pose = smear_compose(smear_rotate_y(about_y), smear_rotate_x(about_x));
    }
    if (kind >> 6 == 3 && take_chance(s, 8))    /* no rotation: such a camera is refused */
        for (int i = 0; i < 9; i++) {
            int32_t v = take_value(s, SMEAR_BASIS_ONE);
            c->pose.basis[i] = v > 2 * SMEAR_BASIS_ONE ? 2 * SMEAR_BASIS_ONE
                             : v < -2 * SMEAR_BASIS_ONE ? -2 * SMEAR_BASIS_ONE : v;
        }
    for (int i = 0; i < 3 && kind & 2; i++)
        c->pose.origin[i] = take_value(s, 1 << 16);
    if (kind & 4)
        c->focal = take_positive(s, 1 << 16);
    if (kind & 8)
        c->near_plane = take_positive(s, 1 << 14);
    if (kind & 16)
        c->half_height = take_positive(s, 4 << 16);
    if (kind & 48) {
        if (c->near_plane == INT32_MAX)
            c->near_plane--;
        int32_t far = take_positive(s, 20 << 16);
        c->far_plane = far > c->near_plane ? far : c->near_plane + 1;
    }
}

static void take_frame(struct source *s, struct scene *scene, int method)
{
    uint8_t kind = take(s);
    for (int i = 0; i < (kind & 3) && i < 3; i++)
        take_camera(s, &scene->camera[i]);
    scene->frame = (smear_frame){
        .camera = &scene->camera[0],
        .open = kind & 4 ? &scene->camera[1] : NULL,
        .close = kind & 8 ? &scene->camera[2] : NULL,
        .method = (uint8_t)method, .shutter.exposure = take(s) % 3, .light_space = take(s) & 1, .shutter.poses = kind >> 4 & 1,
        .cut = kind >> 5 == 7, .filter.flags = take(s),
        .samples = (uint16_t)take_range(s, 0, method == SMEAR_ACCUMULATE ? 6 : method == SMEAR_SUBFRAMES ? 40 : 1024),
        .shutter.degrees = (uint16_t)(take_chance(s, 2) ? 0 : take_range(s, 0, 3600)), .clear = take_word(s)
    };
    if (smear_method_is_temporal(method)) {
        scene->frame.target = (uint16_t)(take_chance(s, 2) ? 0 : take_range(s, 0, 65535));
        if (take_chance(s, 4)) {
            for (int i = 0; i < SMEAR_SHUTTER_POINTS; i++)
                scene->shutter[i] = take(s);
            scene->frame.shutter.curve = scene->shutter;
        }
    }
    if (smear_method_is_filter(method) && method != SMEAR_RECONSTRUCT) {
        smear_frame *f = &scene->frame;
        f->filter.kind = take(s) & 3;
        f->filter.camera_step = (uint8_t)(1 << take(s) % 4 >> 1);
        f->filter.weights = take(s) & 3;
        f->filter.pingpong = (smear_pingpong){ .passes = take(s) % 4, .taps = take(s) & 31, .base = take(s) & 31,
                                        .jitter = take(s) & 127, .bias = take(s), .spread = take(s) & 1 };
        f->shutter.mode = take(s) % 3;
        f->shutter.frame_us = take_word(s) % 1000001u;
        f->shutter.reference_hz = (uint16_t)take_range(s, 0, 1000);
        f->shutter.us = take_chance(s, 2) ? take_word(s) : 0;
        f->scale.rotation = (uint16_t)(take_word(s) & 1023u);
        f->scale.translation = (uint16_t)(take_word(s) & 1023u);
        f->scale.object = (uint16_t)(take_word(s) & 1023u);
    }
    int changes = take_range(s, 0, scene->draws);
    for (int i = 0; i < changes; i++) {
        int at = take_range(s, 0, DRAWS - 1);
        int pose = take(s) % 3;
        take_transform(s, &scene->pose[at][pose]);
    }
}

static void take_draws(struct source *s, struct scene *scene)
{
    scene->draws = take_range(s, 0, DRAWS);
    for (int i = 0; i < DRAWS; i++) {
        uint8_t kind = take(s), look = take(s);
        int mesh = take(s) % MESHES;
        for (int pose = 0; pose < 3; pose++)
            if (pose == 0 || kind & 1 << pose)
                take_transform(s, &scene->pose[i][pose]);
        scene->material[i] = (smear_material){
            .texture = look & 1 ? &scene->texture[look >> 1 & 1] : NULL, .alpha = (uint8_t)((look >> 2) % 3),
            .unlit = look >> 4 & 1, .double_sided = look >> 5 & 1, .bilinear = look >> 6 & 1, .cutoff = take(s)
        };
        if (look & 128)
            for (int c = 0; c < 4; c++)
                scene->material[i].color[c] = take(s);
        scene->draw[i] = (smear_draw){
            .id = take(s) % 8u, .mesh = &scene->mesh[mesh], .material = kind & 8 ? NULL : &scene->material[i],
            .now = kind & 16 ? NULL : &scene->pose[i][0], .open = kind & 2 ? &scene->pose[i][1] : NULL,
            .close = kind & 4 ? &scene->pose[i][2] : NULL,
            .open_position = kind & 32 ? scene->other_position[mesh] : NULL,
            .close_position = kind & 64 ? scene->other_position[mesh] : NULL,
            .motion = (uint8_t)(kind >> 7 ? take(s) % 3 : 0), .cut = look % 11 == 0
        };
    }
}

/* ------------------------------------------------------------------ contexts */

struct rig {
    smear_context *ctx;
    smear_desc desc;
    int next_row, fail_at, band;
    uint32_t sum;               /* of the frame's bytes, in order */
    uint8_t *shown;             /* with desc.buffer_age: all of them, as bands leave them */
    int next_column;
    uint32_t inspected;
};

static uint32_t add_byte(uint32_t sum, uint8_t byte)
{
    return (sum ^ byte) * 16777619u;
}

/* Rows of bytes: of pixels, or of pages. */
static size_t pitch_of(const smear_desc *d)
{
    static const uint8_t bits[] = { 32, 16, 16, 16, 8, 8, 4, 1, 8 };
    return ((size_t)d->width * bits[d->format] + 7) / 8;
}

static size_t rows_of(const smear_desc *d, int rows)
{
    return d->format == SMEAR_L1_PAGES ? ((size_t)rows + 7) / 8 : (size_t)rows;
}

static void put_band(struct rig *r, const smear_band *band)
{
    const size_t pitch = pitch_of(&r->desc), left = pitch * (size_t)band->x / (size_t)r->desc.width;
    const size_t rows = rows_of(&r->desc, band->height);
    require(band->size == band->stride * rows && left + band->stride <= pitch);
    for (size_t y = 0; y < rows; y++)
        memcpy(r->shown + (rows_of(&r->desc, band->y) + y) * pitch + left,
               (const uint8_t *)band->pixels + y * band->stride, band->stride);
}

static int take_band(void *user, const smear_band *band)
{
    struct rig *r = user;
    const uint8_t *bytes = band->pixels;
    require(band->width > 0 && band->height > 0 && band->x >= 0 && band->x + band->width <= r->desc.width);
    if (r->shown != NULL) {
        require(band->y > r->next_row || (band->y == r->next_row && band->x >= r->next_column));
        r->next_row = band->y;
        r->next_column = band->x + band->width;
        put_band(r, band);
    } else {
        require(band->y == r->next_row && band->width == r->desc.width);
        r->next_row = band->y + band->height;
        for (uint32_t i = 0; i < band->size; i++)
            r->sum = add_byte(r->sum, bytes[i]);
    }
    require(band->y + band->height <= r->desc.height);
    if (r->band++ == r->fail_at)
        return -42;             /* a refused band counts as sent */
    if (r->desc.bands == 2)
        smear_band_done(r->ctx);
    return 0;
}

static void look_at_row(void *user, int y, const uint32_t *color, const uint16_t *depth, const int32_t *velocity)
{
    struct rig *r = user;
    require(y >= 0 && y < r->desc.height);
    for (int x = 0; x < r->desc.width; x++)
        r->inspected += color[x] + depth[x] + (uint32_t)velocity[2 * x] + (uint32_t)velocity[2 * x + 1];
}

static smear_desc take_desc(struct source *s)
{
    uint8_t kind = take(s);
    smear_desc d = {
        .width = (int16_t)take_range(s, 1, 70), .height = (int16_t)take_range(s, 1, 50),
        .reach = (int16_t)take_range(s, 0, 20), .format = take(s) % (SMEAR_L1_PAGES + 1), .display.dither = take(s) % 3,
        .bands = kind & 1 ? 2 : 0, .debug.crc = 1,
        .max_draws = (uint16_t)take_range(s, 1, DRAWS), .max_triangles = (uint32_t)take_range(s, 1, 160),
        .vertex_cache = (uint16_t)(16 << take_range(s, 0, 3))
    };
    if (kind & 8)
        d.width = (int16_t)take_range(s, 1, 2048);
    if (kind & 16)
        d.height = (int16_t)take_range(s, 1, kind & 8 ? 20 : 600);
    if (kind & 32)
        d.reach = (int16_t)take_range(s, 1, 64);
    if (kind & 64)
        d.tile = (int16_t)(4 << take_range(s, 0, 4));
    d.methods = (uint16_t)((kind & 2 ? SMEAR_SET(SMEAR_NONE) : SMEAR_SET(SMEAR_RECONSTRUCT))
                           | (kind & 4 ? SMEAR_SET(SMEAR_ACCUMULATE) : 0) | (kind & 128 ? SMEAR_SET_TEMPORAL : 0));
    if ((d.methods & SMEAR_SET_TEMPORAL) == 0)
        d.band_rows = (int16_t)(take_range(s, 0, 8) * (kind & 2 ? 8 : 2));
    return d;
}

static bool rig_open(struct rig *r, struct pool *p, const smear_desc *desc, bool inspect)
{
    *r = (struct rig){ .desc = *desc, .fail_at = -1 };
    r->desc.flush = take_band;
    r->desc.debug.inspect = inspect ? look_at_row : NULL;
    r->desc.user = r;
    size_t bytes = smear_memory_size(&r->desc);
    if (bytes == 0 || bytes > 8u << 20)
        return false;
    void *memory = pool_take(p, bytes);
    memset(memory, 0xa5, bytes);
    if (desc->reuse.buffer_age)
        r->shown = pool_take(p, pitch_of(desc) * rows_of(desc, desc->height));
    require(smear_init(&r->ctx, &r->desc, memory, bytes - 1) == -(int)bytes);
    return smear_init(&r->ctx, &r->desc, memory, bytes) == SMEAR_OK;
}

/* Returns what smear_render returned; frames that are refused are no failure. */
static int rig_frame(struct rig *r, const struct scene *scene)
{
    r->next_row = r->band = r->next_column = 0;
    r->sum = 0x811c9dc5u;
    if (smear_begin(r->ctx, &scene->frame) != SMEAR_OK)
        return SMEAR_ERR_ARG;
    for (int i = 0; i < scene->draws; i++)
        smear_submit(r->ctx, &scene->draw[i]);
    int result = smear_render(r->ctx);
    for (size_t i = 0; r->shown != NULL && i < pitch_of(&r->desc) * rows_of(&r->desc, r->desc.height); i++)
        r->sum = add_byte(r->sum, r->shown[i]);
    return result;
}

static void filter_frame(struct rig *r, struct source *s, const struct scene *scene)
{
    size_t w = (size_t)r->desc.width;
    r->next_row = r->band = r->next_column = 0;
    r->fail_at = -1;
    if (smear_filter_begin(r->ctx, &scene->frame) != SMEAR_OK)
        return;
    uint32_t *color = malloc(w * 4), *depth = malloc(w * 4);
    int16_t *velocity = malloc(w * 4);
    require(color != NULL && depth != NULL && velocity != NULL);
    uint32_t seed = take_word(s), shift = take(s);
    for (int y = 0; y < r->desc.height; y++) {
        for (size_t x = 0; x < w; x++) {
            seed = seed * 1664525u + 1013904223u;
            color[x] = seed;
            depth[x] = seed >> 3 >> (shift & 31u);
            velocity[2 * x] = (int16_t)((int16_t)(seed >> 8) >> (shift >> 5));
            velocity[2 * x + 1] = (int16_t)((int16_t)(seed >> 16) >> (shift >> 5));
        }
        require(smear_filter_row(r->ctx, color, depth, velocity) == SMEAR_OK);
    }
    require(r->shown != NULL || r->next_row == r->desc.height);
    free(color);
    free(depth);
    free(velocity);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct scene scene;
    struct source source = { data, size }, *s = &source;
    struct pool pool = { .count = 0 };
    struct rig rig, ample;
    memset(&scene, 0, sizeof scene);

    uint8_t kind = take(s);
    bool wild_index = kind & 1;
    smear_desc desc = take_desc(s);
    const bool has_window = (desc.methods & SMEAR_SET(SMEAR_RECONSTRUCT)) != 0;
    const bool is_temporal = (desc.methods & SMEAR_SET_TEMPORAL) != 0;
    if (has_window) {
        desc.filter.passes = kind >> 4 & 3;
        desc.methods |= (uint16_t)(SMEAR_SET(SMEAR_CAMERA) | (desc.filter.passes != 0 ? SMEAR_SET(SMEAR_PINGPONG) : 0)
                                   | (kind & 64 ? SMEAR_SET(SMEAR_HALF) : 0));
        desc.filter.scatter = (kind >> 7) & !is_temporal & (desc.filter.passes == 0) & !(kind >> 6 & 1);
        if (desc.filter.scatter && desc.tile != 0)
            desc.reach = (int16_t)(desc.reach * 2 <= 64 ? desc.reach * 2 : 64);
    }
    const uint8_t keeps = is_temporal ? take(s) & 3 : 0;
    desc.reuse.buffer_age = keeps & 1;
    desc.reuse.cache_static = keeps >> 1;
    bool open = rig_open(&rig, &pool, &desc, kind & 2);
    /* The same picture from another context: more room, other cuts, all drawn and sent. */
    desc.reuse.buffer_age = desc.reuse.cache_static = 0;
    desc.max_triangles = 3000;
    desc.vertex_cache = 256;
    if (!has_window && !is_temporal)
        desc.band_rows = (int16_t)(desc.format == SMEAR_L1_PAGES ? 8 : 16);
    bool compare = open && !wild_index && rig_open(&ample, &pool, &desc, false);

    for (int i = 0; i < TEXTURES; i++)
        take_texture(s, &pool, &scene.texture[i]);
    for (int i = 0; i < MESHES; i++)
        take_mesh(s, &pool, &scene.mesh[i], &scene.other_position[i], wild_index);
    for (int i = 0; i < 3; i++)
        take_camera(s, &scene.camera[i]);
    take_draws(s, &scene);

    int frames = take_range(s, 1, keeps != 0 ? 8 : 4);
    for (int k = 0; k < frames && open; k++) {
        int method = take_range(s, SMEAR_DEFAULT_METHOD, is_temporal ? SMEAR_AUTO : SMEAR_RECONSTRUCT);
        if (has_window && take_chance(s, 3))
            method = SMEAR_CAMERA + take(s) % 3;
        if (keeps == 0 || k == 0 || take_chance(s, 3))
            take_frame(s, &scene, method);
        if (keeps != 0 && take_chance(s, 2))        /* one moves on, or stops: the rest stands still */
            scene.pose[take(s) % DRAWS][0].origin[take(s) % 3] += (int32_t)take_word(s) >> 12;
        rig.fail_at = kind & 4 ? take(s) % 4 : -1;
        for (int i = 0; i < MESHES; i++)        /* of which the other context knows nothing */
            smear_mesh_find_bounds(&scene.mesh[i]);
        int result = rig_frame(&rig, &scene);
        require(result == SMEAR_ERR_ARG || result == SMEAR_OK || (result == -42 && rig.fail_at >= 0));
        require(result != SMEAR_OK || rig.shown != NULL || rig.next_row == rig.desc.height);
        if (compare) {
            smear_stats a, b;
            for (int i = 0; i < MESHES; i++)
                memset(scene.mesh[i].bounds, 0, sizeof scene.mesh[i].bounds);
            int other = rig_frame(&ample, &scene);
            require((other == SMEAR_ERR_ARG) == (result == SMEAR_ERR_ARG));
            smear_get_stats(rig.ctx, &a);
            smear_get_stats(ample.ctx, &b);
            if (result == SMEAR_OK && a.triangles_dropped == 0 && b.triangles_dropped == 0)
                require(rig.sum == ample.sum && (rig.shown != NULL || a.crc32 == b.crc32));
        }
        if (kind & 8)
            filter_frame(&rig, s, &scene);
    }
    pool_free(&pool);
    return 0;
}
