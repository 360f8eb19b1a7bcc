/* SPDX-License-Identifier: MIT */
/* cases.c - see cases.h. */
#include "tests/fuzz/cases.h"

#include "smear_math.h"

#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ numbers */

/* splitmix64 */
uint32_t source_word(struct source *s)
{
    if (s->left >= 2) { /* the first counts most: ranges are told by the upper bits */
        const uint32_t word = (uint32_t)s->bytes[0] << 24 | (uint32_t)s->bytes[1] << 16 | (uint32_t)s->bytes[0] << 8 | s->bytes[1];
        s->bytes += 2;
        s->left -= 2;
        return word;
    }
    uint64_t z = s->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (uint32_t)((z ^ z >> 31) >> 16);
}

int32_t source_range(struct source *s, int32_t low, int32_t high)
{
    return (int32_t)(low + (int64_t)((uint64_t)source_word(s) * ((uint64_t)((int64_t)high - low) + 1) >> 32));
}

bool source_chance(struct source *s, int one_in)
{
    return source_range(s, 1, one_in) == 1;
}

int32_t source_any(struct source *s)
{
    static const int32_t extreme[] = { INT32_MAX, INT32_MIN, 0, 1, -1, -INT32_MAX, 1 << 30, 1 << 16, 1 << 24, -(1 << 24) };
    const uint32_t word = source_word(s), shift = source_word(s) & 31u;
    return source_chance(s, 3) ? extreme[source_range(s, 0, 9)] : (int32_t)word >> shift;
}

/* A number near `middle`, or sometimes anything. */
static int32_t about(struct fuzz_case *c, int32_t middle, int32_t spread)
{
    struct source *s = &c->source;
    if (c->extreme && source_chance(s, 5))
        return source_any(s);
    const int64_t v = (int64_t)middle + source_range(s, -spread, spread);
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN
                                                     : (int32_t)v;
}

static int32_t positive(struct fuzz_case *c, int32_t middle)
{
    const int32_t v = about(c, middle, middle / 2);
    return v == INT32_MIN ? INT32_MAX : v < 0 ? -v
                                  : v == 0    ? 1
                                              : v;
}

/* 0, the default, mostly; else low .. high. */
static int32_t option(struct source *s, int one_in, int32_t low, int32_t high)
{
    return source_chance(s, one_in) ? source_range(s, low, high) : 0;
}

/* A number in -most .. most, small ones often. Of two calls in one expression either may be the first: each has its line. */
static int32_t some_step(struct source *s, int32_t most)
{
    const int32_t step = source_range(s, -most, most);
    return step >> source_range(s, 0, 12);
}

/* ------------------------------------------------------------------ memory */

static void *take(struct fuzz_case *c, size_t size)
{
    void *block = malloc(size != 0 ? size : 1);
    if (block == NULL || c->blocks == CASE_BLOCKS)
        abort();
    return c->block[c->blocks++] = block;
}

void *case_random(struct fuzz_case *c, size_t size)
{
    uint8_t *bytes = take(c, size);
    for (size_t i = 0; i < size; i++)
        bytes[i] = (uint8_t)(source_word(&c->source) >> 8);
    return bytes;
}

void case_free(struct fuzz_case *c)
{
    for (int i = 0; i < c->blocks; i++)
        free(c->block[i]);
    c->blocks = 0;
}

/* ------------------------------------------------------------------ textures and meshes */

static void make_texture(struct fuzz_case *c, smear_texture *t)
{
    static const uint8_t bytes[3] = { 4, 2, 1 };
    struct source *s = &c->source;
    t->width = (uint16_t)source_range(s, 1, 17);
    t->height = (uint16_t)source_range(s, 1, 17);
    if (source_chance(s, 2)) {
        const int bits = c->large ? 6 : 4;
        t->width = (uint16_t)(1 << source_range(s, 0, bits));
        t->height = source_chance(s, 2) ? t->width : (uint16_t)(1 << source_range(s, 0, bits));
    }
    if (source_chance(s, c->large ? 12 : 200)) {
        t->width = (uint16_t)source_range(s, 1, 4096);
        t->height = (uint16_t)source_range(s, 1, 65536 / t->width < 4096 ? 65536 / t->width : 4096);
    }
    t->format = (uint8_t)source_range(s, 0, SMEAR_TEXEL_PALETTE8);
    t->wrap_u = (uint8_t)source_range(s, 0, SMEAR_MIRROR);
    t->wrap_v = (uint8_t)source_range(s, 0, SMEAR_MIRROR);
    size_t texels = (size_t)t->width * t->height;
    const bool halves = (t->width & (t->width - 1)) == 0 && (t->height & (t->height - 1)) == 0;
    const int most = halves ? source_range(s, 0, 12) : 0;
    for (; t->levels < most && (t->width | t->height) >> (t->levels + 1) != 0; t->levels++)
        texels += (size_t)((t->width >> (t->levels + 1)) + 1) * (size_t)((t->height >> (t->levels + 1)) + 1);
    t->texels = case_random(c, texels * bytes[t->format]);
    t->palette = t->format == SMEAR_TEXEL_PALETTE8 ? case_random(c, 256 * 4) : NULL;
}

/* A grid of squares, which shares vertices as models do. */
static void make_grid(struct fuzz_case *c, int16_t *position, uint16_t *index, int across, int down)
{
    struct source *s = &c->source;
    const int step = source_range(s, 1, 65535 / (across > down ? across : down)), waves = source_range(s, 0, 3000);
    for (int y = 0; y <= down; y++)
        for (int x = 0; x <= across; x++, position += 3) {
            position[0] = (int16_t)((x - across / 2) * step);
            position[1] = (int16_t)((y - down / 2) * step);
            position[2] = (int16_t)((x * 7 + y * 13) % 17 * waves / 17);
        }
    for (int y = 0; y < down; y++)
        for (int x = 0; x < across; x++, index += 6) {
            const uint16_t at = (uint16_t)(y * (across + 1) + x), below = (uint16_t)(at + across + 1);
            const uint16_t square[6] = { at, (uint16_t)(at + 1), below, (uint16_t)(at + 1), (uint16_t)(below + 1), below };
            memcpy(index, square, sizeof square);
        }
}

static void make_soup(struct fuzz_case *c, int16_t *position, int vertices, uint16_t *index, int triangles)
{
    struct source *s = &c->source;
    if (c->triangles != 0) {
        case_many_cloud(c, position, vertices, index, triangles);
        return;
    }
    const int size = source_chance(s, 4) ? 32767 : source_range(s, 1, 2000);
    for (int i = 0; i < vertices * 3; i++)
        position[i] = (int16_t)source_range(s, -size - (size == 32767), size);
    for (int i = 0; i < triangles * 3; i++)
        index[i] = (uint16_t)source_range(s, 0, vertices - 1);
}

/* Vertices as another pose has them. */
static const int16_t *make_other(struct fuzz_case *c, const int16_t *position, int vertices)
{
    struct source *s = &c->source;
    int16_t *other = take(c, (size_t)vertices * 3 * sizeof *other);
    const int change = source_chance(s, 4) ? 65535 : source_range(s, 0, 300), one_in = source_range(s, 1, 6);
    for (int i = 0; i < vertices * 3; i++) {
        const int v = position[i] + (source_chance(s, one_in) ? source_range(s, -change, change) : 0);
        other[i] = (int16_t)(v > INT16_MAX ? INT16_MAX : v < INT16_MIN ? INT16_MIN
                                                                       : v);
    }
    return other;
}

static void make_surface(struct fuzz_case *c, smear_mesh *m)
{
    struct source *s = &c->source;
    const size_t vertices = m->vertex_count, triangles = m->triangle_count;
    const uint32_t has = source_word(s);
    m->normal = has & 1 ? case_random(c, vertices * 3) : NULL;
    m->color = has & 4 ? case_random(c, vertices * 4) : NULL;
    m->face_color = has & 8 ? case_random(c, triangles * 4) : NULL;
    /* Whatever the texture's size: so many texels at most are below 32768. */
    m->uv_shift = (uint8_t)source_range(s, 13, 15);
    if (!(has & 2))
        return;
    int16_t *uv = take(c, vertices * 4);
    const int range = source_chance(s, 3) ? 32767 : 1 << m->uv_shift;
    for (size_t i = 0; i < vertices * 2; i++)
        uv[i] = (int16_t)source_range(s, -range, range - (range == 32768));
    m->uv = uv;
}

static bool has(const smear_desc *d, unsigned set)
{
    return (d->methods & set) != 0;
}

static void make_mesh(struct fuzz_case *c, int at)
{
    struct source *s = &c->source;
    smear_mesh *m = &c->mesh[at];
    const int most = c->large ? 12 : 4;
    int across = source_range(s, 1, most), down = source_range(s, 1, most), vertices = source_range(s, 1, 2 * most),
        triangles = source_range(s, 0, c->large ? 30 : 8);
    const bool grid = source_chance(s, 2);
    if (c->triangles != 0)
        case_many_mesh(c, &across, &down, &vertices, &triangles);
    const bool huge = at == 0 && c->triangles == 0 && source_chance(s, c->large ? 8 : 800);
    if (huge)
        c->desc.max_triangles = HUGE_ROOM;
    if (grid && huge) { /* the near plane may cut each triangle of a path 16 times */
        const bool paths = has(&c->desc, SMEAR_SET_TEMPORAL);
        across = source_range(s, 60, paths ? 80 : 254);
        down = source_range(s, 60, paths ? 80 : 255);
    }
    if (grid) {
        vertices = (across + 1) * (down + 1);
        triangles = 2 * across * down;
    } else if (huge) {
        vertices = 65535;
    }
    int16_t *position = take(c, (size_t)vertices * 3 * sizeof *position);
    uint16_t *index = take(c, (size_t)triangles * 3 * sizeof *index);
    if (grid)
        make_grid(c, position, index, across, down);
    else
        make_soup(c, position, vertices, index, triangles);
    *m = (smear_mesh){ .position = position, .index = index, .vertex_count = (uint16_t)vertices, .triangle_count = (uint32_t)triangles };
    make_surface(c, m);
    int32_t largest = 1;
    for (int i = 0; i < vertices * 3; i++)
        largest = abs(position[i]) > largest ? abs(position[i]) : largest;
    while (largest >> m->shift > 1)
        m->shift++;
    m->shift = (int8_t)(m->shift + source_range(s, -2, 2));
    if (c->extreme && source_chance(s, 3)) {
        m->shift = (int8_t)source_range(s, -32, 62);
        m->scale = positive(c, 1 << 10);
    }
    for (int i = 0; i < 3 && source_chance(s, 4); i++)
        m->offset[i] = source_chance(s, 3) ? source_range(s, -(1 << 20), 1 << 20) : source_range(s, -largest, largest);
    if (source_chance(s, 2))
        smear_mesh_find_bounds(m);
    c->position[at] = position;
    for (int k = 0; k < 2; k++)
        c->other[at][k] = make_other(c, position, vertices);
}

/* ------------------------------------------------------------------ places */

/* A rotation about any axis; by little, or by any angle. */
static smear_transform rotation(struct fuzz_case *c, bool little)
{
    struct source *s = &c->source;
    uint32_t angle[3];
    for (int i = 0; i < 3; i++)
        angle[i] = little ? (uint32_t)source_range(s, -(1 << 27), 1 << 27) : source_word(s);
    return smear_compose(smear_rotate_y(angle[0]), smear_compose(smear_rotate_x(angle[1]), smear_rotate_z(angle[2])));
}

static void make_pose(struct fuzz_case *c, smear_transform *t)
{
    struct source *s = &c->source;
    *t = rotation(c, source_chance(s, 2));
    if (source_chance(s, 3))
        for (int i = 0; i < 9; i++)
            t->basis[i] = about(c, t->basis[i], 1 << 24);
    const int32_t aside = source_chance(s, 4) ? 40 << 16 : 3 << 16;
    t->origin[0] = about(c, 0, aside);
    t->origin[1] = about(c, 0, aside);
    const int32_t ahead = source_chance(s, 4) ? 0 : -5 * 65536;
    t->origin[2] = about(c, ahead, source_chance(s, 6) ? 40 << 16 : 4 << 16);
}

/* Where it was or will be: a little elsewhere, or anywhere. */
static void make_moved(struct fuzz_case *c, smear_transform *t, const smear_transform *from)
{
    struct source *s = &c->source;
    if (source_chance(s, 8)) {
        make_pose(c, t);
        return;
    }
    *t = source_chance(s, 2) ? smear_compose(*from, rotation(c, true)) : *from;
    for (int i = 0; i < 3; i++) {
        const int32_t step = some_step(s, 1 << 17);
        t->origin[i] = (int32_t)((uint32_t)from->origin[i] + (uint32_t)step);
    }
}

static void make_camera(struct fuzz_case *c, smear_camera *camera, bool orthographic)
{
    struct source *s = &c->source;
    *camera = (smear_camera){ .pose = rotation(c, true), .focal = positive(c, 1 << 17), .near_plane = positive(c, 1 << 13) };
    if (source_chance(s, 6))
        camera->pose = rotation(c, false);
    for (int i = 0; i < 3; i++)
        camera->pose.origin[i] = about(c, 0, 1 << 16);
    if (camera->near_plane == INT32_MAX)
        camera->near_plane--;
    if (orthographic)
        camera->half_height = positive(c, 3 << 16);
    if (orthographic || source_chance(s, 3)) {
        const int32_t far = positive(c, 20 << 16);
        camera->far_plane = far > camera->near_plane ? far : camera->near_plane + 1;
    }
}

static void make_moved_camera(struct fuzz_case *c, smear_camera *camera, const smear_camera *from)
{
    struct source *s = &c->source;
    if (source_chance(s, 10)) {
        make_camera(c, camera, source_chance(s, 2));
        return;
    }
    *camera = *from;
    if (source_chance(s, 4))
        camera->focal = positive(c, 1 << 17);
    if (source_chance(s, 2))
        camera->pose = smear_compose(from->pose, rotation(c, true));
    for (int i = 0; i < 3; i++)
        camera->pose.origin[i] = (int32_t)((uint32_t)from->pose.origin[i]
                                           + (uint32_t)some_step(s, 1 << 16));
}

/* ------------------------------------------------------------------ draws */

static void make_draw(struct fuzz_case *c, int i)
{
    struct source *s = &c->source;
    int mesh = source_range(s, 0, CASE_MESHES - 1);
    if (mesh == 0 && i != 0 && c->triangles == 0 && c->mesh[0].vertex_count > 1000) /* once is enough */
        mesh = 1;
    const uint32_t look = source_word(s), kind = source_word(s);
    smear_material *m = &c->material[i];
    *m = (smear_material){
        .texture = look & 1 ? &c->texture[source_range(s, 0, CASE_TEXTURES - 1)] : NULL,
        .alpha = (uint8_t)(look & 6 ? SMEAR_OPAQUE : source_range(s, 0, SMEAR_SHADOW)),
        .unlit = look >> 4 & 1,
        .double_sided = look >> 5 & 1,
        .bilinear = look >> 6 & 1,
        .cutoff = (uint8_t)(look >> 8),
        .gloss = (uint8_t)(look >> 16 & 1 ? look >> 24 : 0),
        .shine = (uint8_t)(look >> 17 & 15)
    };
    for (int k = 0; k < 4 && (look & 128); k++)
        m->color[k] = (uint8_t)source_word(s);
    make_pose(c, &c->pose[i][0]);
    for (int k = 1; k < 3; k++)
        make_moved(c, &c->pose[i][k], &c->pose[i][0]);
    c->draw[i] =
        (smear_draw){ .id = kind & 1 ? (uint32_t)i + 1 : 0,
                      .mesh = &c->mesh[mesh],
                      .material = kind & 2 ? m : NULL,
                      .now = kind & 12 ? &c->pose[i][0] : NULL,
                      .open = kind & 16 ? &c->pose[i][1] : NULL,
                      .close = kind & 32 ? &c->pose[i][2] : NULL,
                      .open_position = kind & 192 ? NULL : c->other[mesh][0],
                      .close_position = kind & 768 ? NULL : c->other[mesh][1],
                      .motion = (uint8_t)(kind & 7168 ? SMEAR_MOTION_FULL : source_range(s, 0, SMEAR_MOTION_NONE)),
                      .cut = source_chance(s, 16),
                      .billboard = (uint8_t)(kind >> 13 & 7 ? SMEAR_BILLBOARD_NONE : source_range(s, 0, SMEAR_BILLBOARD_UPRIGHT)),
                      .path = (uint8_t)option(s, 2, SMEAR_PATH_DEFAULT, SMEAR_PATH_SCREW),
                      .layers = (uint8_t)option(s, 3, 1, 255) };
    if (source_chance(s, 12)) { /* poses of another mesh: nothing is known of the deformation */
        const int32_t most = c->draw[i].mesh->vertex_count;
        c->draw[i].open_count = (uint16_t)source_range(s, 0, most);
        c->draw[i].close_count = (uint16_t)source_range(s, 0, most);
    }
    if (kind >> 16 & 1)
        c->draw[i].material = m;
}

/* ------------------------------------------------------------------ desc */

static const unsigned sets[] = {
    SMEAR_SET(SMEAR_NONE), SMEAR_SET(SMEAR_ACCUMULATE), SMEAR_SET_ACCUMULATE_BANDS, SMEAR_SET(SMEAR_RECONSTRUCT),
    SMEAR_SET(SMEAR_AUTO), SMEAR_SET(SMEAR_TIMEMASK), SMEAR_SET(SMEAR_SUBFRAMES), SMEAR_SET(SMEAR_PINGPONG),
    SMEAR_SET(SMEAR_HALF) | SMEAR_SET(SMEAR_PINGPONG), SMEAR_SET(SMEAR_CAMERA), SMEAR_SET(SMEAR_OBJECT),
    SMEAR_SET(SMEAR_LAYERED), SMEAR_SET_TEMPORAL, SMEAR_SET_FILTERS, SMEAR_SET_LAYERS,
    SMEAR_SET_TEMPORAL | SMEAR_SET(SMEAR_NONE), SMEAR_SET_FILTERS | SMEAR_SET_LAYERS | SMEAR_SET_TEMPORAL | SMEAR_SET(SMEAR_ACCUMULATE)
};

/* Tiles, strips and bands that go with the methods and the reach. */
static void make_tiles(struct source *s, smear_desc *d)
{
    const bool reaches = has(d, SMEAR_SET_FILTERS | SMEAR_SET_LAYERS | SMEAR_SET_SKETCH);
    const bool four = !d->filter.scatter && !d->reuse.buffer_age && !has(d, SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_HALF));
    d->reach = (int16_t)(source_chance(s, 2) ? source_range(s, 0, 16) : source_range(s, 1, 64));
    if (!reaches)
        d->reach = (int16_t)source_range(s, 0, 64);
    d->tile = (int16_t)(1 << source_range(s, four ? 2 : 3, 6));
    const int reach = !reaches ? 1 : d->reach != 0   ? d->reach
                               : d->height / 20 > 64 ? 64
                                                     : d->height / 20;
    while (d->tile < reach && !d->filter.scatter)
        d->tile = (int16_t)(d->tile * 2);
    if (has(d, SMEAR_SET_TEMPORAL) && source_chance(s, 2)) {
        const int most = 64 < 32767 / d->tile ? 64 : 32767 / d->tile;
        d->strip = (int16_t)(d->tile * source_range(s, 1, most));
    }
}

static void make_band_rows(struct source *s, smear_desc *d)
{
    const int step = d->format == SMEAR_L1_PAGES ? 8 : 1;
    d->band_rows = 0;
    if (d->tile % step != 0) /* what zero means is no whole page */
        d->format = SMEAR_L1;
    if (source_chance(s, 2))
        return;
    if (!d->reuse.buffer_age && !has(d, SMEAR_SET_FILTERS | SMEAR_SET_LAYERS | SMEAR_SET_TEMPORAL))
        d->band_rows = (int16_t)(d->format == SMEAR_L1_PAGES ? 8 * source_range(s, 1, 6) : source_range(s, 2, 40));
    else if (!d->reuse.buffer_age && !has(d, SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_HALF)) && d->format != SMEAR_L1_PAGES)
        d->band_rows = (int16_t)(d->tile >> source_range(s, 0, 1));
}

/* A list of few triangles is full at once: parts of parts, which are slow with many. */
static int32_t some_room(struct fuzz_case *c)
{
    struct source *s = &c->source;
    if (!c->large && source_chance(s, 12))
        return source_range(s, 1, 12);
    return source_range(s, c->large ? 100 : 10, 600);
}

static void make_desc(struct fuzz_case *c)
{
    struct source *s = &c->source;
    smear_desc *d = &c->desc;
    *d = (smear_desc){ .width = (int16_t)source_range(s, 1, 70),
                       .height = (int16_t)source_range(s, 1, 50),
                       .max_triangles = (uint32_t)some_room(c),
                       .max_draws = CASE_DRAWS,
                       .methods = (uint16_t)sets[source_range(s, 0, (int32_t)(sizeof sets / sizeof *sets) - 1)],
                       .format = (uint8_t)source_range(s, 0, SMEAR_L1_PAGES),
                       .display.dither = (uint8_t)source_range(s, 0, SMEAR_DITHER_BLUE),
                       .bands = (uint8_t)source_range(s, 0, 2),
                       .workers = (uint8_t)(source_chance(s, 4) ? source_range(s, 1, 8) : 0),
                       .vertex_cache = (uint16_t)(16 << source_range(s, 0, 8)),
                       .debug.crc = source_chance(s, 3) };
    if (has(d, SMEAR_SET(SMEAR_AUTO)) && d->width % 2 != 0) /* most targets are beyond SMEAR_DRAFT */
        d->methods |= SMEAR_SET_SKETCH;
    if (c->triangles != 0)
        case_many_desc(c);
    if (d->format >= SMEAR_L4 && source_chance(s, 4))
        d->display.dither = SMEAR_DITHER_DIFFUSE;
    d->display.doubled = (uint8_t)option(s, 6, SMEAR_DOUBLED_X, SMEAR_DOUBLED_XY);
    if (source_chance(s, c->large ? 8 : 2000)) {
        d->width = (int16_t)source_range(s, 1, 2048);
        d->height = (int16_t)source_range(s, 1, 65536 / d->width < 2048 ? 65536 / d->width : 2048);
    }
    if (has(d, SMEAR_SET_TEMPORAL) || d->methods == SMEAR_SET(SMEAR_NONE)) {
        d->reuse.cache_static = has(d, SMEAR_SET_TEMPORAL) && source_chance(s, 3);
        d->reuse.buffer_age = (uint8_t)option(s, 3, 1, 7);
        if (d->display.dither == SMEAR_DITHER_DIFFUSE)
            d->reuse.buffer_age = 0;
    }
    d->reuse.one_pose = source_chance(s, 4);
    if (has(d, SMEAR_SET_FILTERS)) {
        d->filter.passes = (uint8_t)option(s, 2, 1, 3);
        d->filter.scatter = !has(d, SMEAR_SET_TEMPORAL | SMEAR_SET(SMEAR_PINGPONG) | SMEAR_SET(SMEAR_HALF))
                         && source_chance(s, 2);
    }
    make_tiles(s, d);
    make_band_rows(s, d);
}

smear_desc case_other_desc(struct fuzz_case *c)
{
    struct source *s = &c->source;
    smear_desc d = c->desc;
    d.workers = (uint8_t)(source_chance(s, 4) ? source_range(s, 1, 8) : 1);
    d.vertex_cache = (uint16_t)(16 << source_range(s, 0, 8));
    d.bands = (uint8_t)source_range(s, 0, 2);
    d.max_triangles = (uint32_t)source_range(s, !c->large && source_chance(s, 8) ? 1 : 60, 400);
    if (c->mesh[0].vertex_count > 1000 || source_chance(s, 2))
        d.max_triangles = HUGE_ROOM;
    d.reuse.cache_static = d.reuse.buffer_age = 0;
    const uint8_t format = d.format;
    make_band_rows(s, &d);
    d.format = format;
    return d;
}

/* ------------------------------------------------------------------ frames */

static uint8_t a_method(struct source *s, const smear_desc *d)
{
    uint8_t of[SMEAR_METHOD_COUNT];
    int count = 0;
    of[count++] = SMEAR_DEFAULT_METHOD;
    for (int m = SMEAR_ACCUMULATE; m < SMEAR_METHOD_COUNT; m++)
        if (has(d, SMEAR_SET(m)) || (m == SMEAR_ACCUMULATE && has(d, SMEAR_SET_ACCUMULATE_BANDS)))
            of[count++] = (uint8_t)m;
    return source_chance(s, 8) ? (uint8_t)SMEAR_NONE : of[source_range(s, 0, count - 1)];
}

static void make_shutter(struct fuzz_case *c)
{
    struct source *s = &c->source;
    smear_shutter *shutter = &c->frame.shutter;
    *shutter = (smear_shutter){
        .degrees = (uint16_t)option(s, 2, 1, source_chance(s, 3) ? 3600 : 360),
        .exposure = (uint8_t)source_range(s, 0, SMEAR_LEADING),
        .poses = source_chance(s, 3),
        .path = (uint8_t)option(s, 2, SMEAR_PATH_DEFAULT, SMEAR_PATH_SCREW)
    };
    if (source_chance(s, 5)) {
        shutter->mode = (uint8_t)source_range(s, 0, SMEAR_SHUTTER_FIXED);
        shutter->reference_hz = (uint16_t)option(s, 2, 1, 1000);
        shutter->frame_us = (uint32_t)source_range(s, 1, 1000000);
        shutter->us = (uint32_t)option(s, 2, 1, INT32_MAX);
    }
    if (!source_chance(s, 5))
        return;
    for (int i = 0; i < SMEAR_SHUTTER_POINTS; i++)
        c->curve[i] = (uint8_t)(source_chance(s, 2) ? source_word(s) : 0);
    const int32_t open = source_range(s, 0, SMEAR_SHUTTER_POINTS - 1);
    c->curve[open] = (uint8_t)source_range(s, 1, 255);
    shutter->curve = c->curve;
}

static void make_filter(struct fuzz_case *c)
{
    struct source *s = &c->source;
    const smear_desc *d = &c->desc;
    smear_filter *f = &c->frame.filter;
    const int passes = d->filter.passes != 0 ? d->filter.passes : has(d, SMEAR_SET(SMEAR_PINGPONG)) ? 2
                                                                                                    : 1;
    *f = (smear_filter){
        .kind = (uint8_t)source_range(s, 0, has(d, SMEAR_SET(SMEAR_PINGPONG)) ? SMEAR_FILTER_PINGPONG : SMEAR_FILTER_RECONSTRUCT),
        .flags = (uint8_t)(source_chance(s, 2) ? source_word(s) & 31u : 0),
        .weights = (uint8_t)source_range(s, 0, SMEAR_WEIGHTS_JIMENEZ),
        .camera_step = (uint8_t)(1 << source_range(s, 0, 3) >> 1)
    };
    f->pingpong = (smear_pingpong){ .passes = (uint8_t)source_range(s, 1, passes),
                                    .taps = (uint8_t)option(s, 2, 2, 64),
                                    .base = (uint8_t)option(s, 2, 2, 64),
                                    .jitter = (uint8_t)option(s, 2, 1, 128),
                                    .bias = (uint8_t)option(s, 2, 1, 255),
                                    .spread = source_chance(s, 3) };
}

static uint16_t a_scale(struct source *s)
{
    return (uint16_t)(source_chance(s, 4) ? (int32_t)SMEAR_SCALE_NONE : source_chance(s, 4) ? source_range(s, 1, 16128)
                                                                                            : source_range(s, 1, 1024));
}

static void make_layers(struct fuzz_case *c)
{
    struct source *s = &c->source;
    make_camera(c, &c->layer_camera[0], source_chance(s, 3));
    for (int i = 1; i < 3; i++)
        make_moved_camera(c, &c->layer_camera[i], &c->layer_camera[0]);
    c->frame.layer_count = (uint8_t)option(s, 2, 1, SMEAR_LAYERS_MAX);
    c->frame.layer = c->frame.layer_count != 0 ? c->layer : NULL;
    for (int i = 0; i < c->frame.layer_count; i++) {
        const uint8_t method[4] = { SMEAR_DEFAULT_METHOD, SMEAR_NONE, SMEAR_OBJECT, SMEAR_LAYERED };
        const bool camera = source_chance(s, 3);
        c->layer[i] = (smear_layer){ .mask = (uint8_t)source_range(s, 1, 255),
                                     .method = method[source_range(s, 0, 3)],
                                     .over = source_chance(s, 3),
                                     .two_camera = source_chance(s, 4),
                                     .shutter_degrees = (uint16_t)option(s, 3, 1, 3600),
                                     .camera = camera ? &c->layer_camera[0] : NULL,
                                     .open = camera && source_chance(s, 2) ? &c->layer_camera[1] : NULL,
                                     .close = camera && source_chance(s, 2) ? &c->layer_camera[2] : NULL };
    }
}

/* So that a frame takes milliseconds: instants of a whole frame, most of all, cost what they say. */
static uint16_t some_samples(struct fuzz_case *c, uint8_t method)
{
    struct source *s = &c->source;
    const int large = c->desc.width * c->desc.height > 4000 || c->triangles > CASE_DEAR ? 4 : 1;
    if (method == SMEAR_ACCUMULATE || method == SMEAR_DEFAULT_METHOD)
        return (uint16_t)source_range(s, 1, 6 / large + 1);
    if (method == SMEAR_SUBFRAMES)
        return (uint16_t)source_range(s, 0, source_chance(s, c->large ? 10 : 400) ? 1024 / large : 24 / large);
    return (uint16_t)source_range(s, 0, source_chance(s, c->large ? 8 : 100) ? 1024 / large : 40);
}

static void make_settings(struct fuzz_case *c)
{
    struct source *s = &c->source;
    const uint8_t method = c->triangles != 0 && source_chance(s, 3) ? (uint8_t)SMEAR_NONE : a_method(s, &c->desc);
    c->frame = (smear_frame){ .camera = &c->camera[0],
                              .open = source_chance(s, 3) ? &c->camera[1] : NULL,
                              .close = source_chance(s, 3) ? &c->camera[2] : NULL,
                              .method = method,
                              .light_space = (uint8_t)source_range(s, 0, SMEAR_LIGHT_ENCODED),
                              .cut = source_chance(s, 12),
                              .samples = some_samples(c, method),
                              .clear = source_word(s),
                              .light = source_chance(s, 4) ? &c->light : NULL };
    make_shutter(c);
    make_filter(c);
    if (source_chance(s, 3))
        c->frame.scale = (smear_motion_scale){ a_scale(s), a_scale(s), a_scale(s) };
    if (has(&c->desc, SMEAR_SET_TEMPORAL)) {
        c->frame.target = (uint16_t)source_range(s, SMEAR_BALANCED, source_chance(s, 3) ? 65535 : 1000);
        if (c->triangles <= CASE_DEAR && source_chance(s, c->large ? 2 : 12))
            c->frame.target = (uint16_t)option(s, 2, 1, SMEAR_BALANCED);
        c->frame.budget = source_chance(s, 6) ? (uint32_t)source_any(s) : 0;
        const bool can = method == SMEAR_AUTO || method == SMEAR_SUBFRAMES;
        if (can && source_chance(s, 4) && (!c->desc.reuse.buffer_age || c->desc.reuse.cache_static))
            c->frame.edges = SMEAR_EDGES_SMOOTH;
    }
    if (has(&c->desc, SMEAR_SET_LAYERS))
        make_layers(c);
    for (int i = 0; i < 3; i++) {
        c->light.direction[i] = source_any(s);
        c->light.ambient[i] = (uint16_t)source_word(s);
        c->light.diffuse[i] = (uint16_t)source_word(s);
    }
    c->light.direction[1] |= 1;
}

/* What is another from frame to frame. */
static void move_on(struct fuzz_case *c, bool keeps)
{
    struct source *s = &c->source;
    if (source_chance(s, keeps ? 6 : 2))
        make_moved_camera(c, &c->camera[0], &c->camera[source_range(s, 0, 2)]);
    for (int i = 0; i < c->draws; i++)
        if (source_chance(s, keeps ? 6 : 2))
            make_moved(c, &c->pose[i][0], &c->pose[i][source_range(s, 0, 2)]);
    if (source_chance(s, 10)) {
        const int at = source_range(s, 0, CASE_MESHES - 1);
        c->position[at][source_range(s, 0, 2)] ^= 5;
        if (source_chance(s, 2))
            smear_mesh_find_bounds(&c->mesh[at]);
        else
            memset(c->mesh[at].bounds, 0, sizeof c->mesh[at].bounds);
        c->frame.refresh = 1;
    }
}

static void make_fog(struct fuzz_case *c)
{
    struct source *s = &c->source;
    const int32_t near_plane = about(c, 2 << 16, 2 << 16);
    c->fog = (smear_fog){ .color = source_word(s), .near_plane = near_plane > 0 ? near_plane : 0 };
    const int64_t far = (int64_t)c->fog.near_plane + (c->fog.near_plane >> 7) + 2 + positive(c, 10 << 16);
    c->fog.far_plane = far < INT32_MAX ? (int32_t)far : INT32_MAX;
    const bool thick = c->fog.far_plane - c->fog.near_plane > c->fog.far_plane >> 8;
    c->frame.fog = thick && source_chance(s, 4) ? &c->fog : NULL;
}

/* Where a lamp is near what is drawn, which lies about the origin. */
static void make_lights(struct fuzz_case *c)
{
    struct source *s = &c->source;
    c->lights = (smear_lights){ .shader = &smear_lights_shader, .reach = source_chance(s, 3) ? positive(c, 4 << 16) : 0 };
    for (int i = 0; i < 3; i++) {
        c->lights.direction[i] = source_any(s);
        c->lights.diffuse[i] = (uint16_t)source_word(s);
        c->lights.lamp_diffuse[i] = (uint16_t)source_word(s);
        c->lights.lamp[i] = about(c, 0, 3 << 16);
    }
}

/* What is beyond one light and one colour. */
static void make_scene(struct fuzz_case *c)
{
    struct source *s = &c->source;
    make_lights(c);
    c->sky = (smear_sky)SMEAR_SKY(source_word(s), source_word(s), source_word(s), source_word(s));
    c->scene = (smear_scene){ SMEAR_WITH_SKY && source_chance(s, 4) ? &c->sky : NULL, source_chance(s, 4) ? &c->lights : NULL };
    c->frame.scene = c->scene.sky != NULL || c->scene.lights != NULL ? &c->scene : NULL;
}

void case_frame(struct fuzz_case *c, int k)
{
    struct source *s = &c->source;
    const bool keeps = c->desc.reuse.cache_static || c->desc.reuse.buffer_age;
    if (k == 0 || source_chance(s, keeps ? 6 : 2))
        make_settings(c);
    c->frame.refresh = 0;
    if (c->with_overlay)
        case_frame_overlay(c);
    if (k != 0)
        move_on(c, keeps);
    if (k == 0 || source_chance(s, keeps ? 6 : 2))
        make_fog(c);
    if (k == 0 || source_chance(s, keeps ? 6 : 2))
        make_scene(c);
    if (c->fog.far_plane <= c->camera[0].near_plane)
        c->frame.fog = NULL;
}

/* ------------------------------------------------------------------ the whole */

static void make_case(struct fuzz_case *c)
{
    struct source *s = &c->source;
    c->extreme = source_chance(s, 3);
    c->large = source_chance(s, 24) && c->triangles == 0;
    make_desc(c);
    c->frames = source_range(s, 2, c->desc.reuse.buffer_age || c->desc.reuse.cache_static ? 6 : 4);
    for (int i = 0; i < CASE_TEXTURES; i++)
        make_texture(c, &c->texture[i]);
    for (int i = 0; i < CASE_MESHES; i++)
        make_mesh(c, i);
    make_camera(c, &c->camera[0], source_chance(s, 4));
    for (int i = 1; i < 3; i++)
        make_moved_camera(c, &c->camera[i], &c->camera[0]);
    c->with_overlay = source_chance(s, 3);
    if (c->with_overlay)
        case_make_overlay(c);
    if (c->triangles == 0)
        c->draws = source_range(s, 0, c->large ? CASE_DRAWS : 4);
    for (int i = 0; i < CASE_DRAWS; i++)
        make_draw(c, i);
    if (c->triangles != 0)
        case_many_plain(c);
}

void case_make(struct fuzz_case *c, uint64_t number, bool wild)
{
    memset(c, 0, sizeof *c);
    c->source.state = number * 0x2545f4914f6cdd1du + (wild ? 77u : 0u);
    c->wild = wild;
    make_case(c);
}

void case_make_of_bytes(struct fuzz_case *c, const uint8_t *bytes, size_t size, bool wild)
{
    memset(c, 0, sizeof *c);
    c->source = (struct source){ .bytes = bytes, .left = size };
    c->wild = wild;
    make_case(c);
}

void case_make_of(struct fuzz_case *c, uint64_t state, int triangles, int draws)
{
    memset(c, 0, sizeof *c);
    c->source.state = state;
    c->triangles = triangles;
    c->draws = draws;
    make_case(c);
}
