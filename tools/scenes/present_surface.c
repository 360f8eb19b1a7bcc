/* SPDX-License-Identifier: MIT */
/* present_surface.c - vertices, colours and textures into the library's formats. */
#include "tools/scenes/present_surface.h"

#include "tools/scenes/present.h"
#include "tools/scenes/xform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PART_VERTICES = 65535, POSITION_STEPS = 32766, OFFSET_LIMIT = 1 << 20, MIN_UV_SHIFT = 1,
       MAX_UV_SHIFT = 15, MAX_TEXTURE_EDGE = 4096 };

struct stored_texture {
    const struct image *image;
    smear_texture texture;
    void *texels;                   /* null when another stored texture has them */
};

/* ------------------------------------------------------------------ small things */

bool out_of_memory(struct failure *f)
{
    return fail(f, "out of memory");
}

bool grow(void **array, int *room, int want, size_t size, struct failure *f)
{
    if (want <= *room)
        return true;
    int next = *room < 8 ? 8 : *room;
    while (next < want)
        next = next > (1 << 29) ? want : next * 2;
    void *grown = realloc(*array, (size_t)next * size);
    if (grown == NULL)
        return out_of_memory(f);
    memset((char *)grown + (size_t)*room * size, 0, (size_t)(next - *room) * size);
    *array = grown;
    *room = next;
    return true;
}

static double unit(double x)
{
    return x > 0.0 ? (x < 1.0 ? x : 1.0) : 0.0;     /* NaN becomes 0 */
}

uint8_t present_byte(double x)
{
    return (uint8_t)floor(unit(x) * 255.0 + 0.5);
}

uint8_t present_srgb_encode(double linear)
{
    double x = unit(linear);
    return present_byte(x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055);
}

double present_srgb_decode(uint8_t code)
{
    double x = code / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

const struct bounds empty_bounds = {
    { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY }
};

void add_bounds(struct bounds *b, const struct bounds *other)
{
    for (int axis = 0; axis < 3; axis++) {
        b->min[axis] = fmin(b->min[axis], other->min[axis]);
        b->max[axis] = fmax(b->max[axis], other->max[axis]);
    }
}

bool add_positions(struct bounds *b, const float *position, int count)
{
    for (int i = 0; i < count * 3; i++) {
        double x = position[i];
        if (!isfinite(x))
            return false;
        if (x < b->min[i % 3])
            b->min[i % 3] = x;
        if (x > b->max[i % 3])
            b->max[i % 3] = x;
    }
    return true;
}

/* ------------------------------------------------------------------ positions */

void split_step(double step, int32_t *scale, int *shift)
{
    int exponent;
    double mantissa = frexp(step, &exponent);
    *scale = (int32_t)ceil(ldexp(mantissa, 30));
    *shift = 30 - exponent;
}

struct grid grid_over(const struct bounds *b)
{
    struct grid grid = { .step = 1.0 };
    double half = 0.0, centre[3];
    bool fits = true;
    for (int axis = 0; axis < 3; axis++) {
        half = fmax(half, (b->max[axis] - b->min[axis]) / 2.0);
        centre[axis] = (b->min[axis] + b->max[axis]) / 2.0;
    }
    if (half > 0.0) {
        int32_t scale;
        int shift;
        split_step(half / POSITION_STEPS, &scale, &shift);
        grid.step = ldexp(scale, -shift);
    }
    for (int axis = 0; axis < 3; axis++)
        fits = fits && half > 0.0 && fabs(centre[axis] / grid.step) <= OFFSET_LIMIT - 1;
    for (int axis = 0; axis < 3; axis++) {
        if (fits)
            grid.offset[axis] = (int32_t)lround(centre[axis] / grid.step);
        else
            grid.fold[axis] = centre[axis];
    }
    return grid;
}

void quantise_positions(int16_t *out, const float *position, const struct part *part,
                        const struct grid *grid)
{
    for (int i = 0; i < part->vertex_count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            double x = position[part->source[i] * 3 + (uint32_t)axis] - grid->fold[axis];
            out[i * 3 + axis] = (int16_t)clamp(floor(x / grid->step + 0.5) - grid->offset[axis],
                                               -32767.0, 32767.0);
        }
    }
}

void quantise_normals(int8_t *out, const float *normal, const struct part *part)
{
    for (int i = 0; i < part->vertex_count; i++) {
        const float *n = normal + part->source[i] * 3;
        double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
        for (int axis = 0; axis < 3; axis++) {
            double x = length > 0.0 && isfinite(length) ? n[axis] / length : 0.0;
            out[i * 3 + axis] = (int8_t)lround(x * 127.0);
        }
    }
}

/* ------------------------------------------------------------------ texture coordinates */

/* Moves a range of texture coordinates by whole repeats so that it fits int16 at the finest step */
struct uv_fit {
    int shift;                      /* 0: none fits */
    double move;
};

static bool uv_fits(double min, double max, double move, int shift)
{
    return floor(ldexp(min + move, shift) + 0.5) >= -32768.0 &&
           floor(ldexp(max + move, shift) + 0.5) <= 32767.0;
}

static struct uv_fit fit_uv(double min, double max, enum model_wrap wrap)
{
    double period = wrap == MODEL_WRAP_CLAMP ? 0.0 : wrap == MODEL_WRAP_MIRROR ? 2.0 : 1.0;
    double middle = period > 0.0 ? -period * floor((min + max) / (2.0 * period) + 0.5) : 0.0;
    for (int shift = MAX_UV_SHIFT; shift >= MIN_UV_SHIFT; shift--) {
        /* unmoved first; then the nearest and its neighbours, as int16 has one more below zero */
        const double moves[] = { 0.0, middle, middle - period, middle + period };
        for (int i = 0; i < 4; i++)
            if (uv_fits(min, max, moves[i], shift))
                return (struct uv_fit){ shift, moves[i] };
    }
    return (struct uv_fit){ 0, 0.0 };
}

static void uv_range(const struct scene_surface *s, const uint32_t *vertex, int count, int axis,
                     double *min, double *max)
{
    *min = INFINITY;
    *max = -INFINITY;
    for (int i = 0; i < count; i++) {
        double x = s->uv[vertex[i] * 2 + (uint32_t)axis];
        *min = fmin(*min, x);
        *max = fmax(*max, x);
    }
}

/* How a surface's texture coordinates are stored. */
struct uv_plan {
    int shift;
    bool per_triangle;              /* each triangle moves by its own repeats */
    double move[2];                 /* of the whole surface */
};

static enum model_wrap wrap_of(const struct scene_surface *s, int axis)
{
    return axis == 0 ? s->material.wrap_u : s->material.wrap_v;
}

static bool plan_uv(const struct scene_surface *s, struct uv_plan *plan, struct failure *f)
{
    *plan = (struct uv_plan){ .shift = MAX_UV_SHIFT };
    for (int i = 0; i < s->vertex_count * 2; i++)
        if (!isfinite(s->uv[i]))
            return fail(f, "a texture coordinate is not a number (vertex %d)", i / 2);
    for (int axis = 0; axis < 2; axis++) {
        double min, max;
        uv_range(s, s->index, s->triangle_count * 3, axis, &min, &max);
        struct uv_fit fit = fit_uv(min, max, wrap_of(s, axis));
        plan->move[axis] = fit.move;
        if (fit.shift < plan->shift)
            plan->shift = fit.shift;
    }
    /* two steps per texel keep the error of a vertex within a quarter of a texel */
    int edge = s->material.image->width > s->material.image->height ? s->material.image->width
                                                                    : s->material.image->height;
    int need = 1;
    while (need < MAX_UV_SHIFT && (1 << need) < 2 * edge)
        need++;
    if (plan->shift >= need)
        return true;
    int each = MAX_UV_SHIFT;
    for (int t = 0; t < s->triangle_count; t++) {
        for (int axis = 0; axis < 2; axis++) {
            double min, max;
            uv_range(s, s->index + t * 3, 3, axis, &min, &max);
            int shift = fit_uv(min, max, wrap_of(s, axis)).shift;
            each = shift < each ? shift : each;
        }
    }
    if (each > plan->shift) {
        plan->shift = each;
        plan->per_triangle = true;
    }
    if (plan->shift < MIN_UV_SHIFT)
        return fail(f, "texture coordinates span more than 16383 repeats");
    return true;
}

/* ------------------------------------------------------------------ surfaces */

static void free_part(struct part *part)
{
    free(part->source);
    free(part->position);
    free(part->normal);
    free(part->uv);
    free(part->color);
    free(part->face_color);
    free(part->index);
}

/* Builds the parts of one surface triangle by triangle. */
struct builder {
    const struct scene_surface *surface;
    struct uv_plan uv;
    int *first;                     /* per surface vertex: its newest copy in this part, or -1 */
    int *next;                      /* per copy: the copy before */
    double *move;                   /* per copy: 2, the repeats it was moved by */
    struct part part;               /* being built; arrays have room for the largest part */
    int vertex_room;
};

static void builder_free(struct builder *b)
{
    free(b->first);
    free(b->next);
    free(b->move);
    free_part(&b->part);
}

static bool builder_start(struct builder *b, const struct scene_surface *s, struct failure *f)
{
    b->surface = s;
    if (s->uv != NULL && s->material.image != NULL && !plan_uv(s, &b->uv, f))
        return false;
    int64_t most = b->uv.per_triangle ? (int64_t)s->triangle_count * 3 : s->vertex_count;
    b->vertex_room = most > MAX_PART_VERTICES ? MAX_PART_VERTICES : (int)most;
    size_t room = (size_t)b->vertex_room;
    b->first = malloc((size_t)s->vertex_count * sizeof *b->first);
    b->next = malloc(room * sizeof *b->next);
    b->move = malloc(room * 2 * sizeof *b->move);
    b->part.source = malloc(room * sizeof *b->part.source);
    b->part.index = malloc((size_t)s->triangle_count * 3 * sizeof *b->part.index);
    if (b->first == NULL || b->next == NULL || b->move == NULL || b->part.source == NULL ||
        b->part.index == NULL)
        return out_of_memory(f);
    for (int i = 0; i < s->vertex_count; i++)
        b->first[i] = -1;
    return true;
}

/* The copy of a vertex moved by `move`, or -1 when this part has none yet. */
static int find_copy(const struct builder *b, uint32_t vertex, const double move[2])
{
    int copy = b->first[vertex];
    while (copy >= 0 && (b->move[copy * 2] != move[0] || b->move[copy * 2 + 1] != move[1]))
        copy = b->next[copy];
    return copy;
}

static void encode_color(uint8_t out[4], const float linear[4])
{
    for (int i = 0; i < 3; i++)
        out[i] = present_srgb_encode(linear[i]);
    out[3] = present_byte(linear[3]);
}

/* Copies the part into arrays of the right size, converts its attributes, starts the next one. */
static bool finish_part(struct builder *b, struct converted *c, int *room, struct failure *f)
{
    const struct scene_surface *s = b->surface;
    if (b->part.triangle_count == 0)
        return true;
    if (!grow((void **)&c->part, room, c->part_count + 1, sizeof *c->part, f))
        return false;
    struct part *part = &c->part[c->part_count++];      /* from here on, freed with the surface */
    bool textured = s->uv != NULL && s->material.image != NULL;
    size_t vertices = (size_t)b->part.vertex_count, triangles = (size_t)b->part.triangle_count;
    size_t corners = triangles * 3;
    bool colored = s->color != NULL && s->face_color == NULL;
    *part = (struct part){ .vertex_count = b->part.vertex_count,
                           .triangle_count = b->part.triangle_count,
                           .first_triangle = b->part.first_triangle };
    part->source = malloc(vertices * sizeof *part->source);
    part->index = malloc(corners * sizeof *part->index);
    part->position = malloc(vertices * 3 * sizeof *part->position);
    part->normal = s->normal != NULL ? malloc(vertices * 3 * sizeof *part->normal) : NULL;
    part->uv = textured ? malloc(vertices * 2 * sizeof *part->uv) : NULL;
    part->color = colored ? malloc(vertices * 4) : NULL;
    part->face_color = s->face_color != NULL ? malloc(triangles * 4) : NULL;
    if (part->source == NULL || part->index == NULL || part->position == NULL ||
        (s->normal != NULL && part->normal == NULL) || (textured && part->uv == NULL) ||
        (colored && part->color == NULL) || (s->face_color != NULL && part->face_color == NULL))
        return out_of_memory(f);
    memcpy(part->source, b->part.source, vertices * sizeof *part->source);
    memcpy(part->index, b->part.index, corners * sizeof *part->index);
    part->uv_shift = b->uv.shift;
    quantise_positions(part->position, s->position, part, &c->grid);
    smear_mesh mesh = { .position = part->position, .vertex_count = (uint16_t)part->vertex_count };
    smear_mesh_find_bounds(&mesh);
    memcpy(part->bounds, mesh.bounds, sizeof part->bounds);
    if (part->normal != NULL)
        quantise_normals(part->normal, s->normal, part);
    for (size_t i = 0; i < vertices * 2 && textured; i++) {
        double x = s->uv[part->source[i / 2] * 2 + (i & 1)] + b->move[i];
        part->uv[i] = (int16_t)floor(ldexp(x, part->uv_shift) + 0.5);
    }
    for (size_t i = 0; i < vertices && colored; i++)
        encode_color(part->color + i * 4, s->color + part->source[i] * 4);
    for (size_t i = 0; i < triangles && part->face_color != NULL; i++)
        encode_color(part->face_color + i * 4,
                     s->face_color + ((size_t)part->first_triangle + i) * 4);
    for (size_t i = 0; i < vertices; i++)
        b->first[part->source[i]] = -1;
    b->part.first_triangle += b->part.triangle_count;
    b->part.vertex_count = b->part.triangle_count = 0;
    return true;
}

static void triangle_move(const struct builder *b, const uint32_t *corner, double move[2])
{
    for (int axis = 0; axis < 2; axis++) {
        move[axis] = b->uv.move[axis];
        if (b->uv.per_triangle) {
            double min, max;
            uv_range(b->surface, corner, 3, axis, &min, &max);
            move[axis] = fit_uv(min, max, wrap_of(b->surface, axis)).move;
        }
    }
}

static bool convert_parts(struct converted *c, struct failure *f)
{
    const struct scene_surface *s = c->surface;
    struct builder b = { 0 };
    int room = 0;
    bool ok = s->vertex_count == 0 || s->triangle_count == 0 || builder_start(&b, s, f);
    for (int t = 0; ok && t < s->triangle_count && s->vertex_count > 0; t++) {
        const uint32_t *corner = s->index + t * 3;
        double move[2];
        triangle_move(&b, corner, move);
        /* three vertices more than there may be: at most two are wasted per part */
        if (b.part.vertex_count + 3 > b.vertex_room) {
            int missing = 0;
            for (int i = 0; i < 3; i++)
                missing += find_copy(&b, corner[i], move) < 0;
            if (b.part.vertex_count + missing > b.vertex_room)
                ok = finish_part(&b, c, &room, f);
        }
        for (int i = 0; ok && i < 3; i++) {
            int copy = find_copy(&b, corner[i], move);
            if (copy < 0) {
                copy = b.part.vertex_count++;
                b.part.source[copy] = corner[i];
                b.move[copy * 2] = move[0];
                b.move[copy * 2 + 1] = move[1];
                b.next[copy] = b.first[corner[i]];
                b.first[corner[i]] = copy;
            }
            b.part.index[b.part.triangle_count * 3 + i] = (uint16_t)copy;
        }
        b.part.triangle_count++;
    }
    ok = ok && finish_part(&b, c, &room, f);
    builder_free(&b);
    return ok;
}

static uint8_t wrap_mode(enum model_wrap wrap)
{
    return wrap == MODEL_WRAP_CLAMP    ? SMEAR_CLAMP
         : wrap == MODEL_WRAP_MIRROR ? SMEAR_MIRROR
                                     : SMEAR_REPEAT;
}

static bool is_opaque(const uint8_t *rgba, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (rgba[4 * i + 3] != 255)
            return false;
    return true;
}

static void *texels_8888(const uint8_t *rgba, size_t count)
{
    uint32_t *texels = malloc(count * sizeof *texels);
    for (size_t i = 0; i < count && texels != NULL; i++, rgba += 4)
        texels[i] = (uint32_t)rgba[3] << 24 | (uint32_t)rgba[0] << 16 | (uint32_t)rgba[1] << 8 | rgba[2];
    return texels;
}

/* Nearest levels. */
static void *texels_565(const uint8_t *rgba, size_t count)
{
    uint16_t *texels = malloc(count * sizeof *texels);
    for (size_t i = 0; i < count && texels != NULL; i++, rgba += 4) {
        int red = (rgba[0] * 62 + 255) / 510, green = (rgba[1] * 126 + 255) / 510;
        int blue = (rgba[2] * 62 + 255) / 510;
        texels[i] = (uint16_t)(red << 11 | green << 5 | blue);
    }
    return texels;
}

static const smear_texture *texture_for(struct texture_store *store, const struct scene_material *m,
                                        struct failure *f)
{
    uint8_t wrap_u = wrap_mode(m->wrap_u), wrap_v = wrap_mode(m->wrap_v);
    struct stored_texture *same = NULL;
    for (int i = 0; i < store->count; i++) {
        struct stored_texture *t = store->texture[i];
        if (t->image != m->image)
            continue;
        if (t->texture.wrap_u == wrap_u && t->texture.wrap_v == wrap_v)
            return &t->texture;
        same = t;
    }
    int width = m->image->width, height = m->image->height;
    if (width > MAX_TEXTURE_EDGE || height > MAX_TEXTURE_EDGE) {
        fail(f, "a texture of %dx%d is too large: at most %d either way", width, height,
             MAX_TEXTURE_EDGE);
        return NULL;
    }
    if (!grow((void **)&store->texture, &store->room, store->count + 1, sizeof *store->texture, f))
        return NULL;
    struct stored_texture *t = calloc(1, sizeof *t);
    if (t == NULL) {
        out_of_memory(f);
        return NULL;
    }
    store->texture[store->count++] = t;
    t->image = m->image;
    size_t count = (size_t)width * (size_t)height;
    if (same == NULL) {             /* else the other's texels are shared */
        const uint8_t *rgba = m->image->rgba;
        t->texture.format = store->narrow && is_opaque(rgba, count) ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888;
        t->texels = t->texture.format == SMEAR_TEXEL_565 ? texels_565(rgba, count) : texels_8888(rgba, count);
        if (t->texels == NULL) {
            out_of_memory(f);
            return NULL;
        }
    }
    t->texture = (smear_texture){ .texels = same != NULL ? same->texture.texels : t->texels,
                                  .width = (uint16_t)width, .height = (uint16_t)height,
                                  .format = same != NULL ? same->texture.format : t->texture.format,
                                  .wrap_u = wrap_u, .wrap_v = wrap_v };
    return &t->texture;
}

/* The library's round shadow, as dark as it shall be. */
static const smear_texture *blob_for(struct texture_store *store, double darkness, struct failure *f)
{
    enum { LEVELS = 32 };
    if (!grow((void **)&store->texture, &store->room, store->count + 1, sizeof *store->texture, f))
        return NULL;
    struct stored_texture *t = calloc(1, sizeof *t);
    uint32_t *palette = malloc(LEVELS * sizeof *palette);
    if (t == NULL || palette == NULL) {
        free(palette);
        free(t);
        out_of_memory(f);
        return NULL;
    }
    for (int i = 0; i < LEVELS; i++)
        palette[i] = (uint32_t)present_byte(darkness * i / (LEVELS - 1)) << 24;
    store->texture[store->count++] = t;
    t->texels = palette;
    t->texture = *smear_blob_material.texture;
    t->texture.palette = palette;
    return &t->texture;
}

static bool convert_shadow(struct converted *c, struct texture_store *store, struct failure *f)
{
    const struct scene_material *m = &c->surface->material;
    c->material = smear_shadow_material;
    c->material.color[3] = present_byte((double)m->base[3]);
    c->material.double_sided = 1;
    if (m->image == NULL)
        return true;
    if (m->shadow == SCENE_SHADOW_BLOB)
        c->material = smear_blob_material;
    c->material.texture = m->shadow == SCENE_SHADOW_BLOB ? blob_for(store, (double)m->base[3], f) : texture_for(store, m, f);
    return c->material.texture != NULL;
}

static bool convert_material(struct converted *c, struct texture_store *store, struct failure *f)
{
    const struct scene_material *m = &c->surface->material;
    smear_material *out = &c->material;
    if (m->shadow != SCENE_SHADOW_NONE)
        return convert_shadow(c, store, f);
    for (int i = 0; i < 3; i++)
        out->color[i] = present_srgb_encode(m->base[i]);
    out->color[3] = m->alpha == MODEL_ALPHA_OPAQUE ? 255 : present_byte(m->base[3]);
    out->unlit = m->unlit;
    out->double_sided = m->double_sided;
    out->gloss = m->gloss;
    out->shine = m->shine;
    out->bilinear = m->bilinear;
    if (m->alpha == MODEL_ALPHA_BLEND) {
        out->alpha = SMEAR_BLEND;
    } else if (m->alpha == MODEL_ALPHA_MASK && m->alpha_cutoff > 0.0f) {
        /* a / 255 >= cutoff, for whole a */
        double cutoff = ceil(clamp((double)m->alpha_cutoff * 255.0, 0.0, 256.0));
        out->alpha = SMEAR_CUTOUT;
        out->cutoff = (uint8_t)clamp(cutoff, 1.0, 255.0);
        c->invisible = cutoff > 255.0;
    } else {
        out->color[3] = 255;
    }
    /* alpha 0 would mean "white, opaque" to the library, but lets nothing be seen */
    c->invisible = c->invisible || out->color[3] == 0;
    if (m->image != NULL && c->surface->uv != NULL && !c->invisible) {
        out->texture = texture_for(store, m, f);
        return out->texture != NULL;
    }
    return true;
}

bool convert_surface(struct converted *c, struct texture_store *store, struct failure *f)
{
    return convert_material(c, store, f) && (c->invisible || convert_parts(c, f));
}

void converted_free(struct converted *c)
{
    for (int i = 0; i < c->part_count; i++)
        free_part(&c->part[i]);
    free(c->part);
}

void texture_store_free(struct texture_store *store)
{
    for (int i = 0; i < store->count; i++) {
        free(store->texture[i]->texels);
        free(store->texture[i]);
    }
    free(store->texture);
}
