/* SPDX-License-Identifier: MIT */
/* validate.c - see validate.h. Single fields go by tables of ranges; what depends on several has a function each. */
#include "validate.h"

#include "base/base.h"
#include "base/jobs.h"
#include "display/pixel_format.h"
#include "base/compiled.h"
#include "others.h"
#include "smear_memory.h"
#include "smear_overlay.h"
#include "temporal/subframes.h"
#include "temporal/tile_method.h"

/* ------------------------------------------------------------------ ranges */

/* What 0 means for scales, of which SMEAR_SCALE_NONE means 0. */
enum { WHOLE = 256 };

/* A field of a struct: what 0 means, and its range: up to most 2^up. */
struct field {
    uint8_t offset, size : 4, up : 4;       /* size 1, 2 or 4 */
    uint8_t fault;
    uint16_t least, otherwise, most;
};

#define UP_OF(most) ((most) > 1 << 20 ? 10 : (most) > 65535 ? 6 : 0)
#define FIELD(type, member, fault, otherwise, least, most) \
    { (uint8_t)offsetof(type, member), sizeof(((type *)0)->member), UP_OF(most), FAULT_NUMBER_##fault, least, otherwise, \
      (most) >> UP_OF(most) }

static uint32_t read_field(const uint8_t *at, int size)
{
    uint32_t value = 0;
    if (size == 1)
        return *at;
    if (size == 4) {
        __builtin_memcpy(&value, at, 4);
        return value;
    }
    uint16_t narrow;
    __builtin_memcpy(&narrow, at, 2);
    return narrow;
}

static void write_field(uint8_t *at, int size, uint32_t value)
{
    const uint16_t narrow = (uint16_t)value;
    if (size == 1)
        *at = (uint8_t)value;
    else
        __builtin_memcpy(at, size == 2 ? (const void *)&narrow : (const void *)&value, (size_t)size);
}

/* Fills in what 0 means; returns SMEAR_OK or the first field that is out of range. Negative values are out of every
 * range. */
static int resolve_fields(void *record, const struct field *field, int count)
{
    for (int i = 0; i < count; i++, field++) {
        uint8_t *at = (uint8_t *)record + field->offset;
        uint32_t value = read_field(at, field->size);
        const uint32_t given = value;
        if (value == 0)
            value = field->otherwise;
        else if (value == SMEAR_SCALE_NONE && field->otherwise == WHOLE)
            value = 0;
        if (value != given)
            write_field(at, field->size, value);
        if (value < field->least || value > (uint32_t)field->most << field->up)
            return SMEAR_ERR_FIELD - 1 - field->fault;
    }
    return SMEAR_OK;
}

static bool is_power_of_two(uint32_t x)
{
    return x != 0 && (x & (x - 1)) == 0;
}

/* ------------------------------------------------------------------ desc */

#define DESC(member, fault, otherwise, least, most) FIELD(smear_desc, member, DESC_##fault, otherwise, least, most)
static const struct field desc_fields[] = {
    DESC(width, WIDTH, 0, 1, 2048), DESC(height, HEIGHT, 0, 1, 2048),
    DESC(max_triangles, TRIANGLES, 1024, 1, 16u << 20), DESC(max_draws, DRAWS, 16, 1, 65535),
    DESC(bands, BANDS, 1, 1, 2), DESC(format, FORMAT, 0, 0, SMEAR_L1_PAGES),
    DESC(workers, WORKERS, 1, 1, SMEAR_WORKERS_MAX), DESC(vertex_cache, VERTEX_CACHE, 128, 16, 4096),
    DESC(reuse.cache_static, CACHE_STATIC, 0, 0, SMEAR_CACHE_STATIC_MOST),
    DESC(reuse.buffer_age, BUFFER_AGE, 0, 0, SMEAR_BUFFER_AGE_MOST),
    DESC(reuse.one_pose, ONE_POSE, 0, 0, 1),
    DESC(filter.passes, PASSES, 0, 0, SMEAR_PASSES_MOST),
    DESC(filter.scatter, SCATTER, 0, 0, SMEAR_SCATTER_MOST),
    DESC(display.dither, DITHER, SMEAR_DITHER_DEFAULT, 0, SMEAR_DITHER_DIFFUSE),
    DESC(display.doubled, DOUBLED, 0, 0, SMEAR_DOUBLED_MOST)
};
#undef DESC

static int resolve_methods(smear_desc *d)
{
    if (d->methods == 0)
        d->methods = SMEAR_SET_DEFAULT;
    if ((d->methods & ~(unsigned)SMEAR_SET_COMPILED) != 0)
        return FAULT(DESC_METHODS);
    if (has_lines(d) && !wants(d, SMEAR_SET(SMEAR_AUTO)))
        return FAULT(DESC_METHODS);
    if (d->debug.inspect != NULL && !SMEAR_INSPECT_MOST)
        return FAULT(DESC_INSPECT);
    if (!is_temporal(d) && d->reuse.cache_static)
        return FAULT(DESC_CACHE_STATIC);
    if (!is_temporal(d) && d->reuse.buffer_age && (d->methods & ~SMEAR_SET(SMEAR_NONE)) != 0)
        return FAULT(DESC_BUFFER_AGE);
    if (d->filter.scatter
        && (!has_window(d) || wants(d, SMEAR_SET_TEMPORAL | SMEAR_SET(SMEAR_PINGPONG) | SMEAR_SET(SMEAR_HALF))))
        return FAULT(DESC_SCATTER);
    if (d->filter.passes == 0)
        d->filter.passes = wants(d, SMEAR_SET(SMEAR_PINGPONG)) ? 2 : 1;
    return d->filter.passes > 1 && !has_window(d) ? FAULT(DESC_PASSES) : SMEAR_OK;
}

/* Returns the smallest usual tile that is not below `px`. */
static int32_t tile_above(int32_t px)
{
    return px <= 8 ? 8 : px <= 16 ? 16 : px <= 32 ? 32 : 64;
}

/* Where memory is plenty and a desc says nothing, bands that need not be tiles are a quarter of the frame in whole tiles, up to
 * 64 rows: fewer triangles lie in several of them. SMEAR_BAND_ROWS_ has the same. */
enum { HAS_HIGH_BANDS = sizeof(void *) >= 8 };

static int resolve_tile(smear_desc *d)
{
    const bool reaches = has_reach(d);
    if (!reaches)
        d->reach = 0;
    else if (d->reach == 0)
        d->reach = (int16_t)clamp_i32(d->height * 5 / 100, 1, 64);
    if (d->reach < 0 || d->reach > 64)
        return FAULT(DESC_REACH);
    if (d->tile == 0) {
        d->tile = (int16_t)(reaches ? tile_above(d->reach) : min_i32(tile_above((d->width + 19) / 20), 32));
        if (HAS_HIGH_BANDS && !has_tiles(d) && d->band_rows == 0)
            d->band_rows = (int16_t)min_i32((d->height + 4 * d->tile - 1) / (4 * d->tile) * d->tile, 64);
    }
    const bool may_be_4 = !d->filter.scatter && !has_buffer_age(d)
                       && !wants(d, SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_HALF));
    if (!is_power_of_two((uint32_t)d->tile) || d->tile < (may_be_4 ? 4 : 8) || d->tile > 64
        || (d->tile < d->reach && !d->filter.scatter))
        return FAULT(DESC_TILE);
    return SMEAR_OK;
}

/* Bands and strips are measured in tiles. */
static int resolve_bands(smear_desc *d)
{
    if (d->band_rows == 0)
        d->band_rows = d->tile;
    /* Tiles may be finished in several bands by filters that read the window alone. */
    const bool may_divide = !has_buffer_age(d) && !wants(d, SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_HALF));
    if (d->band_rows < 2 || (d->format == SMEAR_L1_PAGES && d->band_rows % 8 != 0)
        || (has_tiles(d) && d->band_rows != d->tile && (!may_divide || d->tile % d->band_rows != 0)))
        return FAULT(DESC_BAND_ROWS);
    if (!is_temporal(d))
        d->strip = d->tile;
    else if (d->strip == 0)
        d->strip = (int16_t)max_i32(d->tile, min_i32(8 * d->tile, SMEAR_STRIP));
    if (d->strip < d->tile || d->strip % d->tile != 0 || d->strip > STRIP_TILES_MAX * d->tile)
        return FAULT(DESC_STRIP);
    d->strip = (int16_t)min_i32(d->strip, (d->width + d->tile - 1) / d->tile * d->tile);
    return SMEAR_OK;
}

int smear_resolve_desc(smear_desc *d)
{
    int result = resolve_fields(d, desc_fields, (int)(sizeof desc_fields / sizeof *desc_fields));
    if (result == SMEAR_OK)
        result = resolve_methods(d);
    if (result == SMEAR_OK)
        result = resolve_tile(d);
    if (result == SMEAR_OK)
        result = resolve_bands(d);
    if (result != SMEAR_OK)
        return result;
    if (!is_power_of_two(d->vertex_cache))
        return FAULT(DESC_VERTEX_CACHE);
    if (!smear_format_has(d->format, SMEAR_DITHER_NONE))
        return FAULT(DESC_FORMAT);
    if (format_diffuses(d) && d->reuse.buffer_age)
        return FAULT(DESC_DITHER);
    return smear_format_has(d->format, d->display.dither) ? SMEAR_OK : FAULT(DESC_DITHER);
}

/* ------------------------------------------------------------------ frame */

#define FRAME(member, fault, otherwise, least, most) FIELD(smear_frame, member, FRAME_##fault, otherwise, least, most)
static const struct field frame_fields[] = {
    FRAME(method, METHOD, 0, 0, SMEAR_METHOD_COUNT - 1),
    FRAME(light_space, LIGHT_SPACE, SMEAR_LIGHT_SPACE_LEAST, SMEAR_LIGHT_SPACE_LEAST, SMEAR_LIGHT_ENCODED),
    FRAME(samples, SAMPLES, 0, 0, 1024)
};
/* What is said of motion. */
static const struct field blur_fields[] = {
    FRAME(shutter.degrees, DEGREES, 180, 1, 3600),
    FRAME(shutter.exposure, EXPOSURE, 0, 0, SMEAR_LEADING),
    FRAME(shutter.mode, MODE, 0, 0, SMEAR_SHUTTER_MODE_MOST),
    FRAME(shutter.path, PATH, SMEAR_PATH_LEAST, SMEAR_PATH_LEAST, SMEAR_PATH_MOST),
    FRAME(shutter.reference_hz, REFERENCE, 30, 1, 1000), FRAME(shutter.frame_us, TIME, 0, 0, 1000000),
#if !SMEAR_SHUTTER_US_ANY
    FRAME(shutter.us, US, 0, 0, 0),
#endif
    FRAME(filter.weights, WEIGHTS, 0, 0, SMEAR_WEIGHTS_MOST),
    FRAME(filter.camera_step, STEP, 0, 0, SMEAR_CAMERA_STEP_MOST),
#if SMEAR_WITH_FILTERS
    FRAME(filter.kind, KIND, 0, 0, SMEAR_FILTER_PINGPONG),
    FRAME(filter.pingpong.passes, PASSES, 2, 1, SMEAR_PASSES_MOST), FRAME(filter.pingpong.taps, TAPS, 8, 2, 64),
    FRAME(filter.pingpong.base, BASE, 0, 0, 64), FRAME(filter.pingpong.jitter, JITTER, 0, 0, 128),
    FRAME(filter.pingpong.spread, SPREAD, 0, 0, 1),
#endif
    FRAME(scale.rotation, ROTATION, WHOLE, SMEAR_SCALE_LEAST, SMEAR_SCALE_MOST),
    FRAME(scale.translation, TRANSLATION, WHOLE, SMEAR_SCALE_LEAST, SMEAR_SCALE_MOST),
    FRAME(scale.object, OBJECT, WHOLE, SMEAR_SCALE_LEAST, SMEAR_SCALE_MOST)
};
#undef FRAME

/* Returns the method that a desc has by default. */
static uint8_t default_method(const smear_desc *d)
{
    const unsigned set = d->methods & ~SMEAR_SET(SMEAR_NONE);
    if (wants(d, SMEAR_SET(SMEAR_AUTO)))
        return SMEAR_AUTO;
    for (int method = SMEAR_ACCUMULATE; method < SMEAR_METHOD_COUNT; method++)
        if ((set & SMEAR_SET(method)) != 0 || (method == SMEAR_ACCUMULATE && (set & SMEAR_SET_ACCUMULATE_BANDS) != 0))
            return (uint8_t)method;
    return SMEAR_NONE;
}

static bool is_one_bit(uint8_t format)
{
    return format == SMEAR_L1 || format == SMEAR_L1_PAGES;
}

static int resolve_method(smear_frame *f, const smear_desc *d)
{
    if (f->method == SMEAR_DEFAULT_METHOD)
        f->method = default_method(d);
    const bool sums = f->method == SMEAR_ACCUMULATE;
    if (f->method != SMEAR_NONE && !wants(d, sums ? SMEAR_SET_SUMS : SMEAR_SET(f->method)))
        return FAULT(FRAME_METHOD);
    if (f->samples == 0)
        f->samples = f->method == SMEAR_SUBFRAMES || f->method == SMEAR_TIMEMASK ? 32 : 8;
    if (f->method == SMEAR_TIMEMASK)
        f->samples = f->samples <= 8 ? 8 : f->samples <= 16 ? 16 : 32;
    if ((sums && f->samples > SMEAR_SUM_SAMPLES_MOST)
        || (f->method == SMEAR_SUBFRAMES && f->samples > SMEAR_SUBFRAMES_MOST))
        return FAULT(FRAME_SAMPLES);
    /* A tile that the display keeps would have edges with tiles that are not drawn. */
    if (f->edges != SMEAR_EDGES_HARD
        && ((f->method != SMEAR_AUTO && f->method != SMEAR_SUBFRAMES) || f->edges > SMEAR_EDGES_MOST
            || (has_buffer_age(d) && !caches_static(d))))
        return FAULT(FRAME_EDGES);
    /* Steps of so few greys hide an error of several codes. */
    if (is_temporal(d) && f->target == 0)
        f->target = d->format == SMEAR_L4 || is_one_bit(d->format) ? SMEAR_DRAFT : SMEAR_BALANCED;
    return SMEAR_OK;
}

int smear_resolve_frame(smear_frame *f, const smear_desc *d)
{
    int result = resolve_fields(f, frame_fields, (int)(sizeof frame_fields / sizeof *frame_fields));
    if (result == SMEAR_OK && SMEAR_BLURS)
        result = resolve_fields(f, blur_fields, (int)(sizeof blur_fields / sizeof *blur_fields));
    if (result == SMEAR_OK)
        result = resolve_method(f, d);
    if (result == SMEAR_OK)
        result = SMEAR_WITH_RECONSTRUCT ? smear_filter_resolve(f, d) : SMEAR_OK;
    if (result != SMEAR_OK)
        return result;
    if (f->shutter.frame_us == 0 && (f->shutter.mode != SMEAR_SHUTTER_NATIVE || f->shutter.us != 0))
        return FAULT(FRAME_TIME);
    const smear_light *light = f->light;
    return light != NULL && (light->direction[0] | light->direction[1] | light->direction[2]) == 0 ? FAULT(FRAME_LIGHT)
                                                                                                   : SMEAR_OK;
}

/* Whether a basis is a rotation: products of two columns are 0, of one with itself 1, and the third is the first times the
 * second, within 1/64. Entries in q14, so that three products fit. */
static bool is_rotation(const int32_t basis[9])
{
    const int32_t one = 1 << 28, slack = one / 64;
    int32_t b[9], volume = 0;
    for (int i = 0; i < 9; i++) {
        if (basis[i] > SMEAR_BASIS_ONE + SMEAR_BASIS_ONE / 64 || basis[i] < -SMEAR_BASIS_ONE - SMEAR_BASIS_ONE / 64)
            return false;
        b[i] = (basis[i] + (1 << 9)) >> 10;
    }
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = 3 - i - j;
        const int32_t square = b[i] * b[i] + b[3 + i] * b[3 + i] + b[6 + i] * b[6 + i] - one;
        const int32_t product = b[i] * b[j] + b[3 + i] * b[3 + j] + b[6 + i] * b[6 + j];
        if (square > slack || square < -slack || product > slack || product < -slack)
            return false;
        volume += b[i] * ((b[3 + j] * b[6 + k] - b[3 + k] * b[6 + j]) >> 14);
    }
    return volume > 0;
}

static bool is_camera(const smear_camera *c)
{
    if (!is_rotation(c->pose.basis))
        return false;
    if (c->near_plane <= 0 || (c->far_plane != 0 && c->far_plane <= c->near_plane))
        return false;
    return SMEAR_ORTHOGRAPHIC_MOST && c->half_height > 0 ? c->far_plane != 0
                                                         : c->half_height == 0 && c->focal > 0;
}

static bool is_camera_or_null(const smear_camera *c) { return c == NULL || is_camera(c); }

int smear_check_cameras(const smear_frame *f)
{
    if (f->camera == NULL || !is_camera(f->camera))
        return FAULT(FRAME_CAMERA);
    if (!is_camera_or_null(f->open))
        return FAULT(FRAME_OPEN);
    return is_camera_or_null(f->close) ? SMEAR_OK : FAULT(FRAME_CLOSE);
}

/* A camera near the end of the fog would see nothing but fog. */
int smear_check_fog(const smear_frame *f)
{
    const smear_fog *fog = f->fog;
    if (fog == NULL)
        return SMEAR_OK;
    return SMEAR_FOG_MOST && fog->near_plane >= 0 && fog->far_plane > f->camera->near_plane
                && fog->far_plane - fog->near_plane > fog->far_plane >> 8
             ? SMEAR_OK : FAULT(FRAME_FOG);
}

static bool is_layer(const smear_layer *l)
{
    return l->mask != 0 && (l->method == 0 || l->method == SMEAR_NONE || smear_method_has_layers(l->method))
        && l->shutter_degrees <= 3600
        && (l->camera == NULL ? l->open == NULL && l->close == NULL
                              : is_camera(l->camera) && is_camera_or_null(l->open) && is_camera_or_null(l->close));
}

int smear_check_layers(const smear_frame *f)
{
    if ((f->layer == NULL) != (f->layer_count == 0) || f->layer_count > SMEAR_LAYERS_MOST)
        return FAULT(FRAME_LAYER);
    for (int i = 0; i < SMEAR_LAYERS_MOST && i < f->layer_count; i++)
        if (!is_layer(&f->layer[i]))
            return FAULT(FRAME_LAYER);
    return SMEAR_OK;
}

/* ------------------------------------------------------------------ overlay */

static bool is_image(const smear_image *m)
{
    return m->pixels != NULL && m->width >= 1 && m->width <= 2048 && m->height >= 1 && m->height <= 2048
        && m->format <= SMEAR_IMAGE_PALETTE8 && (m->format <= SMEAR_IMAGE_MASK4 || m->palette != NULL);
}

static int check_item(const smear_overlay_item *item)
{
    const smear_image *m = item->image;
    if (item->scale > 8)
        return FAULT(ITEM_SCALE);
    if (item->shape != NULL && (item->shape->find_box == NULL || item->shape->draw_row == NULL))
        return FAULT(ITEM_SHAPE);
    if (item->shape == NULL && item->text != NULL)
        return item->font != NULL && is_image(&item->font->glyph) ? SMEAR_OK : FAULT(ITEM_FONT);
    if (m != NULL && !is_image(m))
        return FAULT(ITEM_IMAGE);
    return m != NULL && item->cell != 0 && item->cell >= m->cells ? FAULT(ITEM_CELL) : SMEAR_OK;
}

static int check_points(const smear_points *points)
{
    if (points->point == NULL && points->count != 0)
        return FAULT(FRAME_POINTS);
    for (int i = 0; i < points->count; i++) {
        const smear_point *point = &points->point[i];
        if (point->size < 0 || point->mode > SMEAR_POINT_BLEND)
            return point->size < 0 ? FAULT(POINT_SIZE) : FAULT(POINT_MODE);
    }
    return SMEAR_OK;
}

int smear_check_overlay(const smear_overlay *overlay)
{
    if (overlay == NULL)
        return SMEAR_OK;
    if (!SMEAR_OVERLAY_MOST || (overlay->item == NULL && overlay->count != 0))
        return FAULT(FRAME_OVERLAY);
    for (int i = 0; SMEAR_OVERLAY_MOST && i < overlay->count; i++) {
        const int result = check_item(&overlay->item[i]);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OVERLAY_MOST && overlay->points != NULL ? check_points(overlay->points) : SMEAR_OK;
}

/* ------------------------------------------------------------------ draw */

static bool is_texture(const smear_texture *t)
{
    return SMEAR_TEXTURE_MOST && t->texels != NULL && t->width - 1u < 4096u && t->height - 1u < 4096u
        && t->format <= (t->palette != NULL ? SMEAR_TEXEL_PALETTE8 : SMEAR_TEXEL_565) && t->wrap_u <= SMEAR_MIRROR
        && t->wrap_v <= SMEAR_MIRROR && texture_has_levels(t->width, t->height, t->levels);
}

static bool is_mesh(const smear_mesh *m)
{
    if (m == NULL || m->position == NULL || (m->index == NULL && m->triangle_count != 0))
        return false;
    if (m->shift < -32 || m->shift > 62 || m->uv_shift > 15 || m->scale < 0)
        return false;
    for (int i = 0; i < 3; i++)
        if (m->offset[i] > 1 << 20 || m->offset[i] < -(1 << 20))
            return false;
    return true;
}

static bool is_material(const smear_material *m)
{
    return m->alpha <= SMEAR_ALPHA_MOST && (m->texture == NULL || is_texture(m->texture));
}

int smear_check_draw(const smear_draw *draw)
{
    if (!is_mesh(draw->mesh))
        return FAULT(DRAW_MESH);
    if (draw->motion > SMEAR_MOTION_NONE)
        return FAULT(DRAW_MOTION);
    if (draw->billboard > SMEAR_BILLBOARD_MOST)
        return FAULT(DRAW_BILLBOARD);
    if (draw->path > SMEAR_PATH_MOST || (draw->path != 0 && draw->path < SMEAR_PATH_LEAST))
        return FAULT(DRAW_PATH);
    if (!SMEAR_VERTEX_COLORS_MOST && (draw->mesh->normal != NULL || draw->mesh->color != NULL))
        return FAULT(DRAW_MESH_COLORS);
    if (!SMEAR_DEFORM_MOST && (draw->open_position != NULL || draw->close_position != NULL))
        return FAULT(DRAW_POSITION);
    return draw->material == NULL || is_material(draw->material) ? SMEAR_OK : FAULT(DRAW_MATERIAL);
}

#if SMEAR_WITH_DEBUG
/* One after the other, each with its end: the kinds from SMEAR_OK down to SMEAR_ERR_ROOM, the faults, too little memory. */
#define TEXT(name, text) text "\0"
static const char texts[] = "no error\0"
                            "a required argument is missing\0"
                            "memory: too little, or not 8-byte aligned\0"
                            "a call out of turn\0"
                            "more draws than desc.max_draws\0"
                            "desc.max_triangles: too few for a time mask\0" SMEAR_FAULTS(TEXT)
                            "memory: too little, or not 8-byte aligned: minus this number of bytes is enough\0"
                            "unknown error";
#undef TEXT

/* How many are kinds; how many there are before the last two. */
enum { KINDS = 1 - SMEAR_ERR_ROOM, TEXTS = KINDS + (int)SMEAR_FAULT_COUNT };

const char *smear_error_text(int result)
{
    int number = result <= SMEAR_ERR_NEEDS ? TEXTS : TEXTS + 1;
    if (result <= 0 && result >= SMEAR_ERR_ROOM)
        number = -result;
    else if (result < SMEAR_ERR_FIELD && result >= SMEAR_ERR_FIELD - (int)SMEAR_FAULT_COUNT)
        number = (int)KINDS + SMEAR_ERR_FIELD - 1 - result;
    const char *text = texts;
    while (number-- > 0)
        while (*text++ != '\0')
            ;
    return text;
}

#else
const char *smear_error_text(int result)
{
    (void)result;
    return "see smear_result";
}
#endif
