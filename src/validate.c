/* SPDX-License-Identifier: MIT */
/* validate.c - see validate.h. */
#include "validate.h"

#include "display/pixel_format.h"
#include "methods/accumulate.h"
#include "needs.h"
#include "ports/pingpong.h"
#include "temporal/subframes.h"
#include "temporal/tile_method.h"

/* ------------------------------------------------------------------ desc */

static bool is_power_of_two(uint32_t x)
{
    return x != 0 && (x & (x - 1)) == 0;
}

/* What was compiled in (smear_config.h). */
static bool has_method(int method)
{
    return method == SMEAR_ACCUMULATE         ? SMEAR_WITH_ACCUMULATE
         : method == SMEAR_RECONSTRUCT        ? SMEAR_WITH_RECONSTRUCT
         : method == SMEAR_TIMEMASK           ? SMEAR_WITH_TIMEMASK
         : smear_method_is_temporal(method)      ? SMEAR_WITH_SUBFRAMES
         : smear_method_has_layers(method) ? SMEAR_WITH_LAYERS
         : smear_method_is_filter(method)     ? SMEAR_WITH_FILTERS
                                              : true;
}

/* Fills in defaults; false when something is out of range. */
bool smear_resolve_desc(smear_desc *d)
{
    if ((d->timed && !SMEAR_WITH_SUBFRAMES) || (d->accumulate && !SMEAR_WITH_ACCUMULATE) || d->accumulate > 2
        || (d->inspect != NULL && !SMEAR_WITH_INSPECT) || (d->layers && !SMEAR_WITH_LAYERS)
        || ((d->passes > 1 || d->half || d->scatter) && !SMEAR_WITH_FILTERS))
        return false;
    /* Asked for, not as it turns out: the picture depends on the tile. */
    const bool has_reach = !is_temporal(d) || !d->sharp;
    if (!SMEAR_WITH_RECONSTRUCT)
        d->sharp = 1;
    if (d->width < 1 || d->width > 2048 || d->height < 1 || d->height > 2048)
        return false;
    if (d->scatter > 1 || (d->scatter && (d->sharp || d->timed || d->half || d->passes > 1)))
        return false;
    if (d->reach == 0)
        d->reach = (int16_t)clamp_i32(d->height * 5 / 100, 1, 64);
    if (d->reach < 1 || d->reach > 64)
        return false;
    if (d->tile == 0)
        d->tile = (int16_t)(!has_reach ? 32
                          : d->reach <= 8 ? 8 : d->reach <= 16 ? 16 : d->reach <= 32 ? 32 : 64);
    if (!is_power_of_two((uint32_t)d->tile) || d->tile < 4 || d->tile > 64
        || (d->tile < d->reach && !d->scatter))
        return false;
    if (d->tile == 4 && (d->scatter || d->half || is_temporal(d) || has_layers(d)))
        return false;
    if (d->band_rows == 0)
        d->band_rows = d->tile;
    if (d->band_rows < 2 || (d->format == SMEAR_L1_PAGES && d->band_rows % 8 != 0))
        return false;
    /* Tiles may be finished in strips, by filters that read the window alone. */
    if (has_tiles(d) && d->band_rows != d->tile
        && (d->tile % d->band_rows != 0 || is_temporal(d) || has_layers(d) || d->half))
        return false;
    if (SMEAR_WITH_SUBFRAMES && (d->cache_static || d->buffer_age)
        && (!SMEAR_WITH_DAMAGE || !d->timed || d->cache_static > 1 || d->buffer_age > 7))
        return false;
    if (d->bands == 0)
        d->bands = 1;
    if (d->workers == 0)
        d->workers = 1;
    if (d->strip == 0 || !is_temporal(d))
        d->strip = (int16_t)max_i32(d->tile, is_temporal(d) ? SMEAR_STRIP : 0);
    if (d->strip % d->tile != 0 || d->strip > STRIP_TILES_MAX * d->tile)
        return false;
    d->strip = (int16_t)min_i32(d->strip, (d->width + d->tile - 1) / d->tile * d->tile);
    if (d->max_draws == 0)
        d->max_draws = 16;
    if (d->max_triangles == 0)
        d->max_triangles = 1024;
    if (d->passes == 0)
        d->passes = 1;
    if (d->vertex_cache == 0)
        d->vertex_cache = 64;
    if (d->passes > PINGPONG_PASSES_MAX || d->half > 1 || ((d->passes > 1 || d->half) && !has_window(d)))
        return false;
    return d->bands <= 2 && d->workers <= SMEAR_WORKERS_MAX && smear_format_has(d->format, d->dither)
        && d->max_triangles <= 16u << 20
        && is_power_of_two(d->vertex_cache) && d->vertex_cache >= 16 && d->vertex_cache <= 4096;
}

/* ------------------------------------------------------------------ frame */

bool smear_is_camera(const smear_camera *c)
{
    for (int i = 0; i < 9; i++)
        if (c->pose.basis[i] > 2 * SMEAR_BASIS_ONE || c->pose.basis[i] < -2 * SMEAR_BASIS_ONE)
            return false;
    if (c->near_plane <= 0 || (c->far_plane != 0 && c->far_plane <= c->near_plane))
        return false;
    return SMEAR_WITH_ORTHOGRAPHIC && c->half_height > 0 ? c->far_plane != 0
                                                         : c->half_height == 0 && c->focal > 0;
}

/* A scale of motion as it is used. False when out of range, or left out. */
static bool resolve_scale(uint16_t *scale)
{
    if (*scale == 0)
        *scale = 256;
    else if (*scale == SMEAR_SCALE_NONE)
        *scale = 0;
    return SMEAR_WITH_SCALES ? *scale <= 16128 : *scale == 256;
}

static bool is_one_bit(uint8_t format)
{
    return format == SMEAR_L1 || format == SMEAR_L1_PAGES;
}

/* Defaults of a frame; false when something is out of range. */
bool smear_resolve_frame(smear_frame *f, const smear_desc *desc)
{
    if (f->method == SMEAR_DEFAULT_METHOD)
        f->method = desc->timed                            ? SMEAR_AUTO
                  : desc->sharp || !SMEAR_WITH_RECONSTRUCT ? SMEAR_NONE
                                                             : SMEAR_RECONSTRUCT;
    if (f->samples == 0)
        f->samples = f->method == SMEAR_SUBFRAMES || f->method == SMEAR_TIMEMASK ? 32 : 8;
    /* Steps of so few greys hide an error of several codes. */
    if (f->target == 0)
        f->target = desc->format == SMEAR_L4 || is_one_bit(desc->format) ? SMEAR_DRAFT : SMEAR_BALANCED;
    if (f->shutter_degrees == 0)
        f->shutter_degrees = 180;
    if (SMEAR_WITH_FILTERS && f->method == SMEAR_CAMERA && f->camera_step == 0)
        f->camera_step = 1;
    if (f->method == SMEAR_RECONSTRUCT || !SMEAR_WITH_FILTERS
        || (f->method == SMEAR_HALF && f->filter == SMEAR_FILTER_DEFAULT))
        f->filter = SMEAR_FILTER_RECONSTRUCT;
    else if (f->method == SMEAR_PINGPONG)
        f->filter = SMEAR_FILTER_PINGPONG;
    else if (f->filter == SMEAR_FILTER_DEFAULT)
        f->filter = SMEAR_FILTER_MEAN;
    if (SMEAR_WITH_FILTERS
        && (f->filter > SMEAR_FILTER_PINGPONG || f->weights > SMEAR_WEIGHTS_JIMENEZ
            || (f->camera_step & (f->camera_step - 1)) != 0 || f->camera_step > 4))
        return false;
    if (f->method > SMEAR_LAYERED || !has_method(f->method) || f->exposure > SMEAR_LEADING
        || f->light > SMEAR_LIGHT_ENCODED || (f->light == SMEAR_LIGHT_LINEAR && !SMEAR_WITH_LINEAR)
        || f->samples > 1024 || f->shutter_degrees > 3600
        || (!SMEAR_WITH_LINEAR && f->method == SMEAR_SUBFRAMES && f->samples > SMEAR_PACKED_INSTANTS))
        return false;
    if (!SMEAR_WITH_FILTERS && (f->camera_step != 0 || f->weights != 0))
        return false;
    if (SMEAR_WITH_FILTERS && !smear_pingpong_resolve(&f->pingpong))
        return false;
    if (SMEAR_WITH_SHUTTER_MODES && f->reference_hz == 0)
        f->reference_hz = 30;
    if (!SMEAR_WITH_SHUTTER_MODES && (f->shutter_mode != SMEAR_SHUTTER_NATIVE || f->shutter_us != 0))
        return false;
    if (SMEAR_WITH_SHUTTER_MODES
        && (f->shutter_mode > SMEAR_SHUTTER_FIXED || f->reference_hz > 1000 || f->frame_us > 1000000
            || ((f->shutter_mode != SMEAR_SHUTTER_NATIVE || f->shutter_us != 0) && f->frame_us == 0)))
        return false;
    if (!resolve_scale(&f->turn_scale) || !resolve_scale(&f->way_scale) || !resolve_scale(&f->object_scale))
        return false;
    if (SMEAR_WITH_RECONSTRUCT && smear_method_is_filter(f->method) && desc->sharp)
        return false;
    if (SMEAR_WITH_FILTERS && smear_method_is_filter(f->method) && f->filter == SMEAR_FILTER_PINGPONG
        && f->pingpong.passes > desc->passes)
        return false;
    if (SMEAR_WITH_FILTERS && f->method == SMEAR_HALF && !desc->half)
        return false;
    if (SMEAR_WITH_LAYERS && smear_method_has_layers(f->method) && !desc->layers)
        return false;
    if (SMEAR_WITH_SUBFRAMES && smear_method_is_temporal(f->method) && !desc->timed)
        return false;
    return f->method != SMEAR_ACCUMULATE || (desc->accumulate != 0 && f->samples <= SUM_SAMPLES_MAX);
}

static bool is_layer(const smear_layer *l)
{
    return l->mask != 0 && (l->method == 0 || l->method == SMEAR_NONE || smear_method_has_layers(l->method))
        && l->shutter_degrees <= 3600
        && (l->camera == NULL ? l->open == NULL && l->close == NULL
                              : smear_is_camera(l->camera) && (l->open == NULL || smear_is_camera(l->open))
                                    && (l->close == NULL || smear_is_camera(l->close)));
}

bool smear_are_layers(const smear_frame *f)
{
    if (!SMEAR_WITH_LAYERS)
        return f->layer == NULL && f->layer_count == 0;
    if ((f->layer == NULL) != (f->layer_count == 0) || f->layer_count > SMEAR_LAYERS_MAX)
        return false;
    for (int i = 0; i < f->layer_count; i++)
        if (!is_layer(&f->layer[i]))
            return false;
    return true;
}

/* ------------------------------------------------------------------ draw */

static bool is_texture(const smear_texture *t)
{
    return SMEAR_WITH_TEXTURE && t->texels != NULL && t->width >= 1 && t->width <= 4096 && t->height >= 1
        && t->height <= 4096 && t->format <= SMEAR_TEXEL_PALETTE8
        && (t->format != SMEAR_TEXEL_PALETTE8 || t->palette != NULL) && t->wrap_u <= SMEAR_MIRROR
        && t->wrap_v <= SMEAR_MIRROR;
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

bool smear_is_draw(const smear_draw *draw)
{
    const smear_material *m = draw->material;
    if (!is_mesh(draw->mesh) || draw->motion > SMEAR_MOTION_NONE
        || draw->billboard > (SMEAR_WITH_BILLBOARDS ? SMEAR_BILLBOARD_UPRIGHT : SMEAR_BILLBOARD_NONE))
        return false;
    if ((!SMEAR_WITH_IDS && draw->id != 0)
        || (!SMEAR_WITH_GOURAUD && (draw->mesh->normal != NULL || draw->mesh->color != NULL))
        || (!SMEAR_WITH_DEFORM && (draw->open_position != NULL || draw->close_position != NULL)))
        return false;
    if (m != NULL
        && (m->alpha > (SMEAR_WITH_ALPHA ? SMEAR_BLEND : SMEAR_OPAQUE)
            || (m->texture != NULL && !is_texture(m->texture)) || (m->bilinear && !SMEAR_WITH_BILINEAR)))
        return false;
    return true;
}
