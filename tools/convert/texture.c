/* SPDX-License-Identifier: MIT */
/* texture.c - smaller pictures, palettes, and colours instead of a texture. Integers throughout, so that the
 * same picture gives the same bytes on every host. */
#include "tools/convert/build.h"

#include "tools/image/palette.h"
#include "tools/model/exact.h"

#include "base/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DISTINCT = 65536, REFINEMENTS = 12 };         /* of palette_of */

/* ------------------------------------------------------------------ smaller pictures */

/* Whether every material with this picture ignores its alpha. */
static bool is_opaque_picture(const struct converter *c, int image)
{
    for (int i = 0; i < c->model->material_count; i++)
        if (c->model->material[i].image == image && c->model->material[i].alpha != MODEL_ALPHA_OPAQUE)
            return false;
    return true;
}

/* Pixel (x, y) of the smaller picture: the mean of what lies under it, in linear light, weighed by alpha. */
static void shrink_pixel(const struct image *from, const struct image *to, int x, int y, uint8_t out[4])
{
    uint64_t sum[3] = { 0, 0, 0 }, alpha = 0, all = 0;
    int64_t x0 = (int64_t)x * from->width, x1 = x0 + from->width;       /* in 1/to->width of a pixel */
    int64_t y0 = (int64_t)y * from->height, y1 = y0 + from->height;
    for (int64_t v = y0 / to->height; v * to->height < y1; v++) {
        int64_t top = v * to->height > y0 ? v * to->height : y0;
        int64_t bottom = (v + 1) * to->height < y1 ? (v + 1) * to->height : y1;
        for (int64_t u = x0 / to->width; u * to->width < x1; u++) {
            int64_t left = u * to->width > x0 ? u * to->width : x0;
            int64_t right = (u + 1) * to->width < x1 ? (u + 1) * to->width : x1;
            const uint8_t *p = from->rgba + 4 * ((size_t)v * (size_t)from->width + (size_t)u);
            uint64_t area = (uint64_t)(right - left) * (uint64_t)(bottom - top);
            for (int k = 0; k < 3; k++)
                sum[k] += area * p[3] * smear_srgb_decode[p[k]];
            alpha += area * p[3];
            all += area;
        }
    }
    for (int k = 0; k < 3; k++)
        out[k] = alpha > 0 ? exact_srgb_code((uint32_t)((sum[k] + alpha / 2) / alpha)) : 0;
    out[3] = (uint8_t)((alpha + all / 2) / all);
}

const struct image *shrunk_picture(struct converter *c, int index)
{
    const struct image *whole = &c->model->image[index];
    struct image *to = &c->picture[index], from = *whole;
    if (to->rgba != NULL)
        return to;
    int halvings = 0, larger = from.width > from.height ? from.width : from.height;
    while (larger >> halvings > c->options->texture_edge)
        halvings++;
    to->width = from.width >> halvings > 0 ? from.width >> halvings : 1;
    to->height = from.height >> halvings > 0 ? from.height >> halvings : 1;
    to->rgba = pile_alloc(c->pile, (size_t)to->width * (size_t)to->height, 4, c->f);
    from.rgba = pile_alloc(c->pile, (size_t)from.width * (size_t)from.height, 4, c->f);
    if (to->rgba == NULL || from.rgba == NULL) {
        to->rgba = NULL;
        return NULL;
    }
    memcpy(from.rgba, whole->rgba, (size_t)from.width * (size_t)from.height * 4);
    for (size_t i = 0; is_opaque_picture(c, index) && i < (size_t)from.width * (size_t)from.height; i++)
        from.rgba[4 * i + 3] = 255;
    if (halvings == 0) {
        to->rgba = from.rgba;
        return to;
    }
    for (int y = 0; y < to->height; y++)
        for (int x = 0; x < to->width; x++)
            shrink_pixel(&from, to, x, y, to->rgba + 4 * ((size_t)y * (size_t)to->width + (size_t)x));
    return to;
}

/* Whether smaller pictures follow this one: a material repeats it both ways, and they halve evenly. */
static bool has_levels(const struct converter *c, int image, const struct image *picture)
{
    const int w = picture->width, h = picture->height;
    bool repeats = false;
    for (int i = 0; i < c->model->material_count; i++) {
        const struct model_material *m = &c->model->material[i];
        repeats = repeats || (m->image == image && m->wrap_u == MODEL_WRAP_REPEAT && m->wrap_v == MODEL_WRAP_REPEAT);
    }
    return c->options->mipmaps && repeats && (w & (w - 1)) == 0 && (h & (h - 1)) == 0;
}

/* All levels of a picture one behind the other, as a picture of one row. */
static bool leveled_picture(struct converter *c, const struct image *picture, int *levels, struct image *all)
{
    int w = picture->width, h = picture->height;
    size_t size = (size_t)w * (size_t)h * 4;
    for (*levels = 0; w > 1 || h > 1; ++*levels) {
        w = w > 1 ? w / 2 : 1;
        h = h > 1 ? h / 2 : 1;
        size += (size_t)w * (size_t)h * 4;
    }
    *all = (struct image){ .width = (int)(size / 4), .height = 1, .rgba = pile_alloc(c->pile, size, 1, c->f) };
    if (all->rgba == NULL)
        return false;
    struct image from = *picture;
    size_t at = (size_t)from.width * (size_t)from.height * 4;
    memcpy(all->rgba, picture->rgba, at);
    from.rgba = all->rgba;
    for (int i = 0; i < *levels; i++) {
        struct image to = { .width = from.width > 1 ? from.width / 2 : 1, .height = from.height > 1 ? from.height / 2 : 1,
                            .rgba = all->rgba + at };
        for (int y = 0; y < to.height; y++)
            for (int x = 0; x < to.width; x++, at += 4)
                shrink_pixel(&from, &to, x, y, all->rgba + at);
        from = to;
    }
    return true;
}

/* ------------------------------------------------------------------ colours instead of a texture */

static int wrapped(double at, int size, enum model_wrap wrap)
{
    double texel = floor(at * size);
    if (wrap == MODEL_WRAP_CLAMP)
        return (int)fmax(0, fmin(texel, size - 1));
    double period = wrap == MODEL_WRAP_MIRROR ? 2.0 * size : size;
    int within = (int)fmin(texel - period * floor(texel / period), period - 1);
    return within < size ? within : 2 * size - 1 - within;
}

struct color_sum {
    double linear[3], alpha, count;
};

static void add_texel(struct color_sum *sum, const struct image *image, const struct model_material *m,
                      double u, double v)
{
    int x = wrapped(u, image->width, m->wrap_u), y = wrapped(v, image->height, m->wrap_v);
    const uint8_t *p = image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
    double alpha = m->alpha == MODEL_ALPHA_OPAQUE ? 1 : p[3] / 255.0;
    for (int k = 0; k < 3; k++)
        sum->linear[k] += alpha * smear_srgb_decode[p[k]] / 65535.0;
    sum->alpha += alpha;
    sum->count += 1;
}

/* The mean of the texels a triangle shows. */
static void triangle_color(const struct shape *s, const struct image *image, const struct model_material *m,
                           int triangle, float out[4])
{
    const float *uv[3];
    double longest = 0;
    for (int k = 0; k < 3; k++)
        uv[k] = s->uv + 2 * s->index[3 * triangle + k];
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, fmax(fabs((double)uv[k][0] - (double)uv[(k + 1) % 3][0]) * image->width,
                                     fabs((double)uv[k][1] - (double)uv[(k + 1) % 3][1]) * image->height));
    int n = longest < 24 ? (int)longest + 1 : 24;
    struct color_sum sum = { { 0, 0, 0 }, 0, 0 };
    for (int i = 0; i < n; i++)
        for (int j = 0; i + j < n; j++)
            for (int half = 0; half < (i + j + 1 < n ? 2 : 1); half++) {
                double a = (i + (1 + half) / 3.0) / n, b = (j + (1 + half) / 3.0) / n, rest = 1 - a - b;
                add_texel(&sum, image, m,
                          a * (double)uv[0][0] + b * (double)uv[1][0] + rest * (double)uv[2][0],
                          a * (double)uv[0][1] + b * (double)uv[1][1] + rest * (double)uv[2][1]);
            }
    for (int k = 0; k < 3; k++)
        out[k] = sum.alpha > 0 ? (float)(sum.linear[k] / sum.alpha) : 0;
    out[3] = (float)(sum.alpha / sum.count);
}

/* Smooth shading wants colours at vertices: the mean of their triangles. Where colours of the picture meet,
 * its coordinates differ and so do the vertices. */
static bool to_vertices(struct converter *c, struct shape *s, const float *face)
{
    size_t vertices = (size_t)s->vertex_count;
    bool has_colors = s->color != NULL;
    float *color = pile_alloc(c->pile, vertices, 4 * sizeof *color, c->f);
    int *faces = pile_alloc(c->pile, vertices, sizeof *faces, c->f);
    if (color == NULL || faces == NULL)
        return false;
    for (int i = 0; i < 3 * s->triangle_count; i++) {
        faces[s->index[i]]++;
        for (size_t k = 0; k < 4; k++)
            color[4 * s->index[i] + k] += face[4 * (size_t)(i / 3) + k];
    }
    for (size_t i = 0; i < 4 * vertices; i++)
        color[i] = color[i] / (float)(faces[i / 4] > 0 ? faces[i / 4] : 1) * (has_colors ? s->color[i] : 1);
    s->color = color;
    return true;
}

bool bake_texture(struct converter *c, struct shape *s)
{
    const struct model_material *m = &c->model->material[s->material];
    float *face = pile_alloc(c->pile, (size_t)s->triangle_count, 4 * sizeof *face, c->f);
    if (face == NULL)
        return false;
    for (int t = 0; t < s->triangle_count; t++)
        triangle_color(s, &c->model->image[m->image], m, t, face + 4 * t);
    s->uv = NULL;
    if (s->normal != NULL || s->color != NULL)
        return to_vertices(c, s, face);
    s->face_color = face;
    return true;
}

/* ------------------------------------------------------------------ textures */

static double channel_error(uint32_t a, uint32_t b)
{
    double sum = 0;
    for (int k = 1; k < 4; k++) {
        double d = color_channel(a, k) - color_channel(b, k);
        sum += d * d;
    }
    return sum / 3;
}

static uint32_t expand_565(unsigned texel)
{
    unsigned r = texel >> 11, g = texel >> 5 & 63, b = texel & 31;
    return 0xff000000u | (r << 3 | r >> 2) << 16 | (g << 2 | g >> 4) << 8 | (b << 3 | b >> 2);
}

static unsigned pack_565(uint32_t argb)
{
    unsigned r = ((unsigned)color_channel(argb, 1) * 31 + 127) / 255,
             g = ((unsigned)color_channel(argb, 2) * 63 + 127) / 255;
    return r << 11 | g << 5 | ((unsigned)color_channel(argb, 3) * 31 + 127) / 255;
}

/* Fills texels and palette; returns the squared error in codes of the first `whole` pixels. */
static bool fill_texels(struct converter *c, const struct image *image, size_t whole, struct out_texture *t, double *error)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    size_t size = t->texture.format == SMEAR_TEXEL_8888 ? 4 : t->texture.format == SMEAR_TEXEL_565 ? 2 : 1;
    void *texels = pile_alloc(c->pile, count, size, c->f);
    uint32_t *palette = NULL, last = 0;
    int entry = -1;
    *error = 0;
    if (texels == NULL)
        return false;
    if (t->texture.format == SMEAR_TEXEL_PALETTE8) {
        palette = pile_alloc(c->pile, 256, sizeof *palette, c->f);
        uint32_t *colors = pile_alloc(c->pile, count, sizeof *colors, c->f);
        for (size_t i = 0; i < count && colors != NULL; i++)
            colors[i] = color_of(image->rgba + 4 * i);
        if (palette != NULL && colors != NULL)
            t->palette_count = palette_of(colors, count, c->options->colors, MAX_DISTINCT, REFINEMENTS, palette);
        if (t->palette_count == 0)
            return fail(c->f, "out of memory");
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t argb = color_of(image->rgba + 4 * i), shown = argb;
        if (palette != NULL) {
            if (entry < 0 || argb != last)
                entry = palette_nearest(argb, palette, t->palette_count);
            last = argb;
            ((uint8_t *)texels)[i] = (uint8_t)entry;
            shown = palette[entry];
        } else if (t->texture.format == SMEAR_TEXEL_565) {
            ((uint16_t *)texels)[i] = (uint16_t)pack_565(argb);
            shown = expand_565(pack_565(argb));
        } else {
            ((uint32_t *)texels)[i] = argb;
        }
        *error += i < whole ? channel_error(argb, shown) : 0;
    }
    *error /= (double)whole;
    t->texture.texels = texels;
    t->texture.palette = palette;
    return true;
}

size_t convert_texel_count(const smear_texture *t)
{
    size_t count = 0;
    for (int i = 0; i <= t->levels; i++)
        count += (size_t)(t->width >> i > 0 ? t->width >> i : 1) * (size_t)(t->height >> i > 0 ? t->height >> i : 1);
    return count;
}

static uint8_t wrap_of(enum model_wrap wrap)
{
    return wrap == MODEL_WRAP_CLAMP ? SMEAR_CLAMP : wrap == MODEL_WRAP_MIRROR ? SMEAR_MIRROR : SMEAR_REPEAT;
}

static smear_texel_format format_of(const struct converter *c, int image)
{
    if (c->options->texture == CONVERT_RGB8888)
        return SMEAR_TEXEL_8888;
    /* 565 has no alpha */
    return c->options->texture == CONVERT_RGB565 && is_opaque_picture(c, image) ? SMEAR_TEXEL_565
                                                                                : SMEAR_TEXEL_PALETTE8;
}

bool texture_for(struct converter *c, const struct model_material *m, int *texture)
{
    struct out_texture *all = c->texture.data, made = { .image = m->image, .same = c->texture.count };
    const struct image *image = shrunk_picture(c, m->image);
    if (image == NULL)
        return false;
    made.texture = (smear_texture){ .width = (uint16_t)image->width, .height = (uint16_t)image->height,
                                    .format = (uint8_t)format_of(c, m->image), .wrap_u = wrap_of(m->wrap_u),
                                    .wrap_v = wrap_of(m->wrap_v) };
    for (int i = 0; i < c->texture.count; i++) {
        if (all[i].image != m->image)
            continue;
        if (all[i].texture.wrap_u == made.texture.wrap_u && all[i].texture.wrap_v == made.texture.wrap_v) {
            *texture = i;
            return true;
        }
        made.same = all[i].same;
    }
    struct convert_texture_report report = {
        .from_width = c->model->image[m->image].width, .from_height = c->model->image[m->image].height,
        .width = image->width, .height = image->height
    };
    if (made.same < c->texture.count) {
        made.texture.texels = all[made.same].texture.texels;
        made.texture.palette = all[made.same].texture.palette;
        made.texture.levels = all[made.same].texture.levels;
        made.palette_count = all[made.same].palette_count;
    } else {
        struct image leveled = *image;
        int levels = 0;
        double error;
        if (has_levels(c, m->image, image) && !leveled_picture(c, image, &levels, &leveled))
            return false;
        made.texture.levels = (uint8_t)levels;
        if (!fill_texels(c, &leveled, (size_t)image->width * (size_t)image->height, &made, &error))
            return false;
        report.rms = sqrt(error);
    }
    report.colors = made.palette_count;
    struct out_texture *out = list_add(&c->texture, 1, c->f);
    struct convert_texture_report *reports = list_add(&c->texture_report, 1, c->f);
    if (out == NULL || reports == NULL)
        return false;
    *out = made;
    *reports = report;
    *texture = c->texture.count - 1;
    return true;
}

bool finish_textures(struct converter *c)
{
    struct conversion *out = c->out;
    size_t count = (size_t)c->texture.count, materials = (size_t)c->material.count;
    const struct out_texture *texture = c->texture.data;
    const struct out_material *material = c->material.data;
    smear_material *table = pile_alloc(c->pile, materials, sizeof *table, c->f);
    out->texture = pile_alloc(c->pile, count, sizeof *out->texture, c->f);
    out->palette_count = pile_alloc(c->pile, count, sizeof *out->palette_count, c->f);
    out->same_texels = pile_alloc(c->pile, count, sizeof *out->same_texels, c->f);
    if (table == NULL || out->texture == NULL || out->palette_count == NULL || out->same_texels == NULL)
        return false;
    for (size_t i = 0; i < count; i++) {
        out->texture[i] = texture[i].texture;
        out->palette_count[i] = texture[i].palette_count;
        out->same_texels[i] = texture[i].same;
    }
    for (size_t i = 0; i < materials; i++) {
        table[i] = material[i].material;
        if (material[i].texture >= 0)
            table[i].texture = out->texture + material[i].texture;
    }
    out->texture_count = c->texture.count;
    out->model.material = table;
    out->model.material_count = (uint16_t)materials;
    return true;
}
