/* SPDX-License-Identifier: MIT */
/* ref_draw.c - one sharp instant in double precision; see ref.h for the conventions.
 *
 *   triangles   to camera space, culled, cut at near and far, projected
 *   visibility  the nearest triangle of each pixel, by exact edge functions in pixel space
 *   shading     once per pixel, from barycentrics that are linear in homogeneous screen coordinates
 *   blending    in submission order over the finished opaque picture
 *
 * Camera space here is x right, y up, d the distance along -Z. The homogeneous barycentrics are
 * those of Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates" (1997);
 * they come from the uncut triangle, so that clipping changes coverage only. */
#include "tools/ref/ref.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CORNERS = 5 };       /* a triangle cut by two planes */

struct vec3 { double x, y, d; };
struct point { double x, y; };

/* a + bx x + by y over the screen in pixels. */
struct plane { double a, bx, by; };

/* A camera ready for use: where world points go. */
struct view {
    double right[3], up[3], forward[3], origin[3];
    bool orthographic;
    double scale;               /* pixels per unit of x/d, or of x when orthographic */
    double half_width, half_height;     /* of the screen in pixels */
    double znear, zfar;         /* zfar INFINITY: none */
};

/* A triangle that faces the camera. */
struct record {
    int32_t id;
    int draw, triangle;
    bool flipped;               /* back face of a double-sided material */
    struct plane corner[3];     /* homogeneous barycentrics; their sum is 1/d (orthographic: 1) */
    struct plane nearness;      /* 1/d, or -d when orthographic: greater is nearer */
    bool shaded;                /* the rest is filled in when first seen */
    double color[3][4];         /* working values at the corners */
    double uv[3][2];
    struct vec3 distance;       /* d of the corners, in x, y, d */
    bool moves;
    struct vec3 open[3], close[3];
};

struct painter {
    const struct scene_instant *now, *open, *close;
    const struct ref_options *options;
    struct ref_frame *frame;
    struct view view, view_open, view_close;
    bool camera_cut;
    double decode[256];         /* texel code to working value */
    int record_count, record_capacity;
    struct record *record;
    int32_t *seen;              /* per pixel: record, or -1 */
    double *nearness;           /* per pixel */
};

/* ------------------------------------------------------------------ spaces */

static bool view_set(struct view *v, const struct scene_camera *camera, int width, int height,
                     struct failure *f)
{
    const double *m = camera->pose;
    for (int i = 0; i < 3; i++) {
        v->right[i] = m[i];
        v->up[i] = m[4 + i];
        v->forward[i] = -m[8 + i];
        v->origin[i] = m[12 + i];
    }
    v->orthographic = camera->orthographic;
    v->half_width = 0.5 * width;
    v->half_height = 0.5 * height;
    if (camera->orthographic)
        v->scale = v->half_height / camera->half_height;
    else
        v->scale = v->half_height / tan(0.5 * camera->yfov);
    v->znear = camera->znear;
    v->zfar = camera->zfar > 0.0 ? camera->zfar : INFINITY;
    if (!isfinite(v->scale) || v->scale <= 0.0 || !(v->znear > 0.0 || camera->orthographic)
        || !(v->zfar > v->znear))
        return fail(f, "camera without a view (reference)");
    return true;
}

static struct vec3 to_camera(const struct view *v, const double world[16], const float *position)
{
    double p[3], x = (double)position[0], y = (double)position[1], z = (double)position[2];
    for (int i = 0; i < 3; i++)
        p[i] = world[i] * x + world[4 + i] * y + world[8 + i] * z + world[12 + i] - v->origin[i];
    return (struct vec3){
        v->right[0] * p[0] + v->right[1] * p[1] + v->right[2] * p[2],
        v->up[0] * p[0] + v->up[1] * p[1] + v->up[2] * p[2],
        v->forward[0] * p[0] + v->forward[1] * p[1] + v->forward[2] * p[2],
    };
}

/* d > 0, or orthographic. */
static struct point to_screen(const struct view *v, struct vec3 p)
{
    double k = v->orthographic ? v->scale : v->scale / p.d;
    return (struct point){ v->half_width + k * p.x, v->half_height - k * p.y };
}

static struct vec3 subtract(struct vec3 a, struct vec3 b)
{
    return (struct vec3){ a.x - b.x, a.y - b.y, a.d - b.d };
}

static struct vec3 cross(struct vec3 a, struct vec3 b)
{
    return (struct vec3){ a.y * b.d - a.d * b.y, a.d * b.x - a.x * b.d, a.x * b.y - a.y * b.x };
}

static double dot(struct vec3 a, struct vec3 b)
{
    return a.x * b.x + a.y * b.y + a.d * b.d;
}

static double plane_at(const struct plane *p, double x, double y)
{
    return p->a + p->bx * x + p->by * y;
}

/* The linear form n.(x, y, 1) of a camera ray's x/d and y/d (x and y when orthographic), over the
 * screen. */
static struct plane plane_of_rays(const struct view *v, struct vec3 n, double factor)
{
    double s = factor / v->scale;
    return (struct plane){ factor * n.d - s * v->half_width * n.x + s * v->half_height * n.y,
                           s * n.x, -s * n.y };
}

/* ------------------------------------------------------------------ triangles */

/* Keeps what has d >= limit (side +1) or d <= limit (side -1). New corners are made from the kept
 * end towards the cut one, so that triangles which share an edge share its cut. */
static int clip(const struct vec3 *in, int count, struct vec3 *out, double limit, double side)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        struct vec3 a = in[i], b = in[(i + 1) % count];
        double da = side * (a.d - limit), db = side * (b.d - limit);
        if (da >= 0.0)
            out[kept++] = a;
        if ((da >= 0.0) != (db >= 0.0)) {
            if (da < 0.0) {
                struct vec3 swap = a;
                double swap_d = da;
                a = b, b = swap;
                da = db, db = swap_d;
            }
            double t = da / (da - db);
            out[kept++] = (struct vec3){ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), limit };
        }
    }
    return kept;
}

static struct record *record_add(struct painter *p, struct failure *f)
{
    if (p->record_count == p->record_capacity) {
        int capacity = p->record_capacity == 0 ? 256 : p->record_capacity * 2;
        struct record *grown = realloc(p->record, (size_t)capacity * sizeof *grown);
        if (grown == NULL) {
            fail(f, "no memory for %d triangles (reference)", capacity);
            return NULL;
        }
        p->record = grown;
        p->record_capacity = capacity;
    }
    struct record *r = &p->record[p->record_count++];
    memset(r, 0, sizeof *r);
    return r;
}

/* Fills the planes of a triangle. Returns false for one that is seen edge on, or from behind and
 * culled. */
static bool record_set(struct record *r, const struct view *v, const struct vec3 c[3],
                       bool mirrored, bool double_sided)
{
    struct vec3 edge1 = subtract(c[1], c[0]), edge2 = subtract(c[2], c[0]);
    struct vec3 normal = cross(edge1, edge2);
    double facing = v->orthographic ? normal.d : dot(c[0], normal);
    if (facing == 0.0 || !isfinite(facing))
        return false;
    r->flipped = (facing > 0.0) == mirrored;
    if (r->flipped && !double_sided)
        return false;
    if (v->orthographic) {
        for (int i = 0; i < 3; i++) {
            struct vec3 from = c[(i + 1) % 3], to = c[(i + 2) % 3];
            struct vec3 line = { from.y - to.y, to.x - from.x, from.x * to.y - from.y * to.x };
            r->corner[i] = plane_of_rays(v, line, 1.0 / facing);
        }
        for (int i = 0; i < 3; i++) {
            double d = c[i].d;
            r->nearness.a -= d * r->corner[i].a;
            r->nearness.bx -= d * r->corner[i].bx;
            r->nearness.by -= d * r->corner[i].by;
        }
    } else {
        for (int i = 0; i < 3; i++)
            r->corner[i] = plane_of_rays(v, cross(c[(i + 1) % 3], c[(i + 2) % 3]), 1.0 / facing);
        r->nearness = plane_of_rays(v, normal, 1.0 / facing);
    }
    r->distance = (struct vec3){ c[0].d, c[1].d, c[2].d };
    return true;
}

/* ------------------------------------------------------------------ shading */

static double determinant(const double m[16])
{
    return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2])
         + m[8] * (m[1] * m[6] - m[5] * m[2]);
}

/* Inverse transpose up to a positive factor: the matrix of cofactors, negated for a mirror. */
static void normal_to_world(const double m[16], double sign, const double n[3], double out[3])
{
    const double *a = m, *b = m + 4, *c = m + 8;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = sign * (n[0] * (b[j] * c[k] - b[k] * c[j]) + n[1] * (c[j] * a[k] - c[k] * a[j])
                         + n[2] * (a[j] * b[k] - a[k] * b[j]));
    }
}

/* The light of design.md: 0.30 + 0.70 max(0, n.l); a zero normal gets the ambient part. */
static double lit(const double n[3])
{
    static const double l[3] = { 0.36, 0.80, 0.48 };    /* of length 1 */
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double cosine = length > 0.0 ? (n[0] * l[0] + n[1] * l[1] + n[2] * l[2]) / length : 0.0;
    return 0.30 + 0.70 * (cosine > 0.0 ? cosine : 0.0);
}

static void flat_normal(const struct scene_draw *draw, const uint32_t *index, double out[3])
{
    double e[2][3];
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++)
            e[k][i] = (double)draw->position[3 * (size_t)index[k + 1] + (size_t)i]
                    - (double)draw->position[3 * (size_t)index[0] + (size_t)i];
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = e[0][j] * e[1][k] - e[0][k] * e[1][j];
    }
}

static void shade_corners(const struct painter *p, struct record *r)
{
    const struct scene_draw *draw = &p->now->draw[r->draw];
    const struct scene_surface *surface = draw->surface;
    const struct scene_material *material = &surface->material;
    const uint32_t *index = surface->index + 3 * (size_t)r->triangle;
    double sign = determinant(draw->world) < 0.0 ? -1.0 : 1.0;
    double object[3] = { 0.0, 0.0, 0.0 }, world[3];
    bool flat = draw->normal == NULL;
    if (flat)
        flat_normal(draw, index, object);
    for (int k = 0; k < 3; k++) {
        size_t at = index[k];
        double light = 1.0;
        if (!material->unlit) {
            if (!flat)
                for (size_t i = 0; i < 3; i++)
                    object[i] = (double)draw->normal[3 * at + i];
            normal_to_world(draw->world, r->flipped ? -sign : sign, object, world);
            light = lit(world);
        }
        for (size_t i = 0; i < 4; i++) {
            double value = (double)material->base[i];
            if (surface->face_color != NULL)
                value *= (double)surface->face_color[4 * (size_t)r->triangle + i];
            else if (surface->color != NULL)
                value *= (double)surface->color[4 * at + i];
            if (i < 3)
                value *= light;
            value = value > 0.0 ? (value < 1.0 ? value : 1.0) : 0.0;
            r->color[k][i] = i < 3 && p->options->encoded ? ref_srgb_encode(value) : value;
        }
        if (surface->uv != NULL) {
            r->uv[k][0] = (double)surface->uv[2 * at];
            r->uv[k][1] = (double)surface->uv[2 * at + 1];
        }
    }
}

/* The pose of a draw at another instant, or null when it has none there that belongs to this one. */
static const struct scene_draw *counterpart(const struct painter *p,
                                            const struct scene_instant *other, int index)
{
    if (index >= other->draw_count)
        return NULL;
    const struct scene_draw *now = &p->now->draw[index], *then = &other->draw[index];
    return then->hidden || then->epoch != now->epoch ? NULL : then;
}

static void move_corners(const struct painter *p, struct record *r)
{
    const struct ref_options *o = p->options;
    int motion = o->motion != NULL && r->draw < o->motion_count ? o->motion[r->draw]
                                                                : SCENE_MOTION_FULL;
    r->moves = p->open != NULL && !p->camera_cut && motion != SCENE_MOTION_NONE;
    if (!r->moves)
        return;
    const struct scene_draw *now = &p->now->draw[r->draw];
    const struct scene_draw *open = counterpart(p, p->open, r->draw);
    const struct scene_draw *close = counterpart(p, p->close, r->draw);
    if (open == NULL || close == NULL || motion == SCENE_MOTION_CAMERA)
        open = close = now;
    for (size_t k = 0; k < 3; k++) {
        size_t at = 3 * (size_t)now->surface->index[3 * (size_t)r->triangle + k];
        r->open[k] = to_camera(&p->view_open, open->world, open->position + at);
        r->close[k] = to_camera(&p->view_close, close->world, close->position + at);
    }
}

static long wrap_texel(double texel, int size, enum model_wrap wrap)
{
    if (!(fabs(texel) < 1e15))
        texel = 0.0;
    double n = size;
    switch (wrap) {
    case MODEL_WRAP_CLAMP:
        return texel < 0.0 ? 0 : texel > n - 1.0 ? size - 1 : (long)texel;
    case MODEL_WRAP_MIRROR:
        texel -= 2.0 * n * floor(texel / (2.0 * n));
        return (long)(texel < n ? texel : 2.0 * n - 1.0 - texel);
    case MODEL_WRAP_REPEAT:
    default:
        return (long)(texel - n * floor(texel / n));
    }
}

static void texel_at(const struct painter *p, const struct scene_material *m, double u, double v,
                     double out[4])
{
    long x = wrap_texel(u, m->image->width, m->wrap_u);
    long y = wrap_texel(v, m->image->height, m->wrap_v);
    const uint8_t *texel = m->image->rgba + 4 * (y * m->image->width + x);
    for (int i = 0; i < 3; i++)
        out[i] = p->decode[texel[i]];
    out[3] = texel[3] / 255.0;
}

static void texture_at(const struct painter *p, const struct scene_material *m, double u, double v,
                       double out[4])
{
    u *= m->image->width;
    v *= m->image->height;
    if (!m->bilinear) {
        texel_at(p, m, floor(u), floor(v), out);
        return;
    }
    double left = floor(u - 0.5), top = floor(v - 0.5);
    double fu = u - 0.5 - left, fv = v - 0.5 - top;
    double texel[4][4];
    for (int k = 0; k < 4; k++)
        texel_at(p, m, left + (k & 1), top + (k >> 1), texel[k]);
    for (int i = 0; i < 4; i++)
        out[i] = (texel[0][i] * (1.0 - fu) + texel[1][i] * fu) * (1.0 - fv)
               + (texel[2][i] * (1.0 - fu) + texel[3][i] * fu) * fv;
}

static void weights_at(const struct record *r, double x, double y, double w[3])
{
    for (int k = 0; k < 3; k++)
        w[k] = plane_at(&r->corner[k], x, y);
    double scale = 1.0 / (w[0] + w[1] + w[2]);
    for (int k = 0; k < 3; k++)
        w[k] *= scale;
}

/* Working colour and alpha of a triangle at a pixel centre. */
static void shade(const struct painter *p, struct record *r, const double w[3], double out[4])
{
    const struct scene_surface *surface = p->now->draw[r->draw].surface;
    const struct scene_material *material = &surface->material;
    if (!r->shaded) {
        shade_corners(p, r);
        move_corners(p, r);
        r->shaded = true;
    }
    for (int i = 0; i < 4; i++)
        out[i] = w[0] * r->color[0][i] + w[1] * r->color[1][i] + w[2] * r->color[2][i];
    if (material->image != NULL && surface->uv != NULL) {
        double texel[4];
        texture_at(p, material, w[0] * r->uv[0][0] + w[1] * r->uv[1][0] + w[2] * r->uv[2][0],
                   w[0] * r->uv[0][1] + w[1] * r->uv[1][1] + w[2] * r->uv[2][1], texel);
        for (int i = 0; i < 4; i++)
            out[i] *= texel[i];
    }
}

static struct vec3 blend_corners(const struct vec3 c[3], const double w[3])
{
    return (struct vec3){ w[0] * c[0].x + w[1] * c[1].x + w[2] * c[2].x,
                          w[0] * c[0].y + w[1] * c[1].y + w[2] * c[2].y,
                          w[0] * c[0].d + w[1] * c[1].d + w[2] * c[2].d };
}

static void velocity_at(const struct painter *p, const struct record *r, const double w[3],
                        double out[2])
{
    out[0] = out[1] = 0.0;
    if (!r->moves)
        return;
    struct vec3 open = blend_corners(r->open, w), close = blend_corners(r->close, w);
    if ((!p->view_open.orthographic && !(open.d > 0.0))
        || (!p->view_close.orthographic && !(close.d > 0.0))) {
        out[0] = out[1] = NAN;
        return;
    }
    struct point from = to_screen(&p->view_open, open), to = to_screen(&p->view_close, close);
    double scale = p->options->velocity_scale != 0.0 ? p->options->velocity_scale : 1.0;
    out[0] = scale * (to.x - from.x);
    out[1] = scale * (to.y - from.y);
}

/* ------------------------------------------------------------------ coverage */

/* An edge of a convex polygon, kept from its lesser end so that both polygons which share it
 * compute the same number, one with the opposite sign. */
struct edge {
    double x, y;                /* a point on it */
    double step_x, step_y;      /* inside is step_x (px - x) + step_y (py - y) > 0 */
    bool owns_border;           /* a pixel centre exactly on it is inside: left or top edge */
    double row;                 /* the second product, of this row */
};

static int edges_set(const struct point *corner, int count, struct edge *edge)
{
    double area = 0.0;
    for (int i = 1; i + 1 < count; i++)
        area += (corner[i].x - corner[0].x) * (corner[i + 1].y - corner[0].y)
              - (corner[i].y - corner[0].y) * (corner[i + 1].x - corner[0].x);
    if (area == 0.0 || !isfinite(area))
        return 0;
    int used = 0;
    for (int i = 0; i < count; i++) {
        struct point a = corner[i], b = corner[(i + 1) % count];
        double sign = area > 0.0 ? 1.0 : -1.0;
        if (a.x == b.x && a.y == b.y)
            continue;
        if (b.x < a.x || (b.x == a.x && b.y < a.y)) {
            struct point swap = a;
            a = b, b = swap;
            sign = -sign;
        }
        struct edge *e = &edge[used++];
        e->x = a.x;
        e->y = a.y;
        e->step_x = -sign * (b.y - a.y);
        e->step_y = sign * (b.x - a.x);
        e->owns_border = e->step_x > 0.0 || (e->step_x == 0.0 && e->step_y > 0.0);
    }
    return used;
}

static bool is_inside(const struct edge *edge, int count, double x)
{
    for (int i = 0; i < count; i++) {
        double value = edge[i].step_x * (x - edge[i].x) + edge[i].row;
        if (value < 0.0 || (value == 0.0 && !edge[i].owns_border) || isnan(value))
            return false;
    }
    return true;
}

/* The covered pixels of row y between *left and *right, which come in as the bounds of the polygon.
 * Each edge function grows or falls along a row even in rounded arithmetic, so what is inside all
 * of them is one run: a crossing estimated by division is widened by two pixels and then narrowed
 * by the exact test. */
static bool row_span(struct edge *edge, int count, int y, int *left, int *right)
{
    double first = *left, last = *right;
    for (int i = 0; i < count; i++) {
        edge[i].row = edge[i].step_y * (y + 0.5 - edge[i].y);
        double crossing = edge[i].x - edge[i].row / edge[i].step_x - 0.5;
        if (edge[i].step_x > 0.0 && crossing - 2.0 > first)
            first = floor(crossing - 2.0);
        else if (edge[i].step_x < 0.0 && crossing + 2.0 < last)
            last = ceil(crossing + 2.0);
    }
    if (!(first <= last))
        return false;
    int x0 = (int)first, x1 = (int)last;
    while (x0 <= x1 && !is_inside(edge, count, x0 + 0.5))
        x0++;
    while (x1 > x0 && !is_inside(edge, count, x1 + 0.5))
        x1--;
    *left = x0;
    *right = x1;
    return x0 <= x1;
}

static int clamp_pixel(double value, int limit)
{
    return value < 0.0 ? 0 : value > limit ? limit : (int)value;
}

/* Called for the covered pixels of one row, left <= right. */
typedef void row_fn(struct painter *p, int record, int y, int left, int right);

static void cover(struct painter *p, int record, const struct point *corner, int count, row_fn *row)
{
    struct edge edge[MAX_CORNERS];
    int edges = edges_set(corner, count, edge);
    if (edges < 3)
        return;
    double min_x = INFINITY, max_x = -INFINITY, min_y = INFINITY, max_y = -INFINITY;
    for (int i = 0; i < count; i++) {
        min_x = fmin(min_x, corner[i].x);
        max_x = fmax(max_x, corner[i].x);
        min_y = fmin(min_y, corner[i].y);
        max_y = fmax(max_y, corner[i].y);
    }
    int width = p->frame->width, height = p->frame->height;
    if (max_x < 0.0 || max_y < 0.0 || min_x > width || min_y > height)
        return;
    int x0 = clamp_pixel(floor(min_x - 0.5), width - 1), x1 = clamp_pixel(ceil(max_x), width - 1);
    int y0 = clamp_pixel(floor(min_y - 0.5), height - 1), y1 = clamp_pixel(ceil(max_y), height - 1);
    for (int y = y0; y <= y1; y++) {
        int left = x0, right = x1;
        if (row_span(edge, edges, y, &left, &right))
            row(p, record, y, left, right);
    }
}

/* Ties within one part in 10^12, rounding of coplanar triangles, go to the first. */
static bool is_nearer(double nearness, double than)
{
    return nearness - than > 1e-12 * fabs(than);
}

static void row_opaque(struct painter *p, int record, int y, int left, int right)
{
    struct plane nearness = p->record[record].nearness;
    size_t row = (size_t)y * (size_t)p->frame->width;
    for (int x = left; x <= right; x++) {
        size_t at = row + (size_t)x;
        double n = plane_at(&nearness, x + 0.5, y + 0.5);
        if (is_nearer(n, p->nearness[at])) {
            p->nearness[at] = n;
            p->seen[at] = record;
        }
    }
}

static void row_cutout(struct painter *p, int record, int y, int left, int right)
{
    struct record *r = &p->record[record];
    double cutoff = (double)p->now->draw[r->draw].surface->material.alpha_cutoff;
    for (int x = left; x <= right; x++) {
        size_t at = (size_t)y * (size_t)p->frame->width + (size_t)x;
        double n = plane_at(&r->nearness, x + 0.5, y + 0.5);
        if (is_nearer(n, p->nearness[at])) {
            double w[3], color[4];
            weights_at(r, x + 0.5, y + 0.5, w);
            shade(p, r, w, color);
            if (color[3] >= cutoff) {
                p->nearness[at] = n;
                p->seen[at] = record;
            }
        }
    }
}

static void row_blend(struct painter *p, int record, int y, int left, int right)
{
    struct record *r = &p->record[record];
    for (int x = left; x <= right; x++) {
        size_t at = (size_t)y * (size_t)p->frame->width + (size_t)x;
        if (is_nearer(plane_at(&r->nearness, x + 0.5, y + 0.5), p->nearness[at])) {
            double w[3], color[4];
            weights_at(r, x + 0.5, y + 0.5, w);
            shade(p, r, w, color);
            for (size_t i = 0; i < 3; i++) {
                double *below = &p->frame->color[3 * at + i];
                *below += color[3] * (color[i] - *below);
            }
        }
    }
}

/* ------------------------------------------------------------------ the frame */

static bool draw_triangles(struct painter *p, int draw_index, int32_t first_id, row_fn *row,
                           struct failure *f)
{
    const struct scene_draw *draw = &p->now->draw[draw_index];
    const struct scene_surface *surface = draw->surface;
    const struct view *v = &p->view;
    bool mirrored = determinant(draw->world) < 0.0;
    struct vec3 *vertex = malloc(sizeof *vertex * (size_t)(surface->vertex_count > 0
                                                           ? surface->vertex_count : 1));
    if (vertex == NULL)
        return fail(f, "no memory for %d vertices (reference)", surface->vertex_count);
    for (int i = 0; i < surface->vertex_count; i++)
        vertex[i] = to_camera(v, draw->world, draw->position + 3 * (size_t)i);
    bool ok = true;
    for (int t = 0; t < surface->triangle_count && ok; t++) {
        const uint32_t *index = surface->index + 3 * (size_t)t;
        struct vec3 near_cut[MAX_CORNERS], cut[MAX_CORNERS];
        struct point corner[MAX_CORNERS];
        struct record made = { .id = first_id + t, .draw = draw_index, .triangle = t };
        if (index[0] >= (uint32_t)surface->vertex_count
            || index[1] >= (uint32_t)surface->vertex_count
            || index[2] >= (uint32_t)surface->vertex_count) {
            ok = fail(f, "index out of range (triangle %d of draw %d)", t, draw_index);
            break;
        }
        struct vec3 c[3] = { vertex[index[0]], vertex[index[1]], vertex[index[2]] };
        int count = clip(c, 3, near_cut, v->znear, 1.0);
        if (count >= 3 && isfinite(v->zfar)) {
            count = clip(near_cut, count, cut, v->zfar, -1.0);
        } else {
            memcpy(cut, near_cut, sizeof cut);
        }
        if (count < 3 || !record_set(&made, v, c, mirrored, surface->material.double_sided))
            continue;
        struct record *kept = record_add(p, f);
        if (kept == NULL) {
            ok = false;
            break;
        }
        *kept = made;
        for (int i = 0; i < count; i++)
            corner[i] = to_screen(v, cut[i]);
        cover(p, p->record_count - 1, corner, count, row);
    }
    free(vertex);
    return ok;
}

static bool draw_all(struct painter *p, bool blended, struct failure *f)
{
    int64_t id = 0;
    for (int i = 0; i < p->now->draw_count; i++) {
        const struct scene_draw *draw = &p->now->draw[i];
        enum model_alpha alpha = draw->surface->material.alpha;
        if (id + draw->surface->triangle_count > INT32_MAX)
            return fail(f, "too many triangles (draw %d)", i);
        if (!draw->hidden && (alpha == MODEL_ALPHA_BLEND) == blended) {
            row_fn *row = blended ? row_blend : alpha == MODEL_ALPHA_MASK ? row_cutout : row_opaque;
            if (!draw_triangles(p, i, (int32_t)id, row, f))
                return false;
        }
        id += draw->surface->triangle_count;
    }
    return true;
}

static void resolve(struct painter *p)
{
    struct ref_frame *frame = p->frame;
    double clear[3];
    for (int i = 0; i < 3; i++)
        clear[i] = p->decode[p->options->clear >> (16 - 8 * i) & 255];
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < frame->width; x++) {
            size_t at = (size_t)y * (size_t)frame->width + (size_t)x;
            double *color = &frame->color[3 * at];
            frame->depth[at] = INFINITY;
            frame->velocity[2 * at] = frame->velocity[2 * at + 1] = 0.0;
            frame->triangle[at] = frame->draw[at] = -1;
            if (p->seen[at] < 0) {
                memcpy(color, clear, sizeof clear);
                continue;
            }
            struct record *r = &p->record[p->seen[at]];
            double w[3], shaded[4];
            weights_at(r, x + 0.5, y + 0.5, w);
            shade(p, r, w, shaded);
            memcpy(color, shaded, sizeof clear);
            velocity_at(p, r, w, &frame->velocity[2 * at]);
            frame->depth[at] = w[0] * r->distance.x + w[1] * r->distance.y + w[2] * r->distance.d;
            frame->triangle[at] = r->id;
            frame->draw[at] = r->draw;
        }
    }
}

static bool frame_alloc(struct ref_frame *frame, const struct ref_options *o, struct failure *f)
{
    memset(frame, 0, sizeof *frame);
    if (o->width < 1 || o->height < 1 || o->width > IMAGE_MAX_EDGE || o->height > IMAGE_MAX_EDGE)
        return fail(f, "no such size (%d x %d)", o->width, o->height);
    size_t pixels = (size_t)o->width * (size_t)o->height;
    frame->width = o->width;
    frame->height = o->height;
    frame->encoded = o->encoded;
    frame->color = malloc(pixels * 3 * sizeof *frame->color);
    frame->depth = malloc(pixels * sizeof *frame->depth);
    frame->velocity = malloc(pixels * 2 * sizeof *frame->velocity);
    frame->triangle = malloc(pixels * sizeof *frame->triangle);
    frame->draw = malloc(pixels * sizeof *frame->draw);
    if (frame->color == NULL || frame->depth == NULL || frame->velocity == NULL
        || frame->triangle == NULL || frame->draw == NULL)
        return fail(f, "no memory for a frame (%d x %d)", o->width, o->height);
    return true;
}

static bool painter_set(struct painter *p, struct failure *f)
{
    const struct ref_options *o = p->options;
    if ((p->open == NULL) != (p->close == NULL))
        return fail(f, "one pose of two given (reference)");
    if (!view_set(&p->view, &p->now->camera, o->width, o->height, f))
        return false;
    if (p->open != NULL) {
        if (!view_set(&p->view_open, &p->open->camera, o->width, o->height, f)
            || !view_set(&p->view_close, &p->close->camera, o->width, o->height, f))
            return false;
        p->camera_cut = p->open->camera.epoch != p->now->camera.epoch
                     || p->close->camera.epoch != p->now->camera.epoch;
    }
    size_t pixels = (size_t)o->width * (size_t)o->height;
    p->seen = malloc(pixels * sizeof *p->seen);
    p->nearness = malloc(pixels * sizeof *p->nearness);
    if (p->seen == NULL || p->nearness == NULL)
        return fail(f, "no memory for a frame (%d x %d)", o->width, o->height);
    for (size_t i = 0; i < pixels; i++) {
        p->seen[i] = -1;
        p->nearness[i] = p->view.orthographic ? -DBL_MAX : 0.0;
    }
    for (int i = 0; i < 256; i++)
        p->decode[i] = o->encoded ? i / 255.0 : ref_srgb_decode(i / 255.0);
    return true;
}

bool ref_draw(const struct scene_instant *now, const struct scene_instant *open,
              const struct scene_instant *close, const struct ref_options *options,
              struct ref_frame *out, struct failure *f)
{
    struct painter painter = { .now = now, .open = open, .close = close, .options = options,
                               .frame = out };
    bool ok = frame_alloc(out, options, f) && painter_set(&painter, f)
           && draw_all(&painter, false, f);
    if (ok) {
        resolve(&painter);
        ok = draw_all(&painter, true, f);
    }
    free(painter.record);
    free(painter.seen);
    free(painter.nearness);
    if (!ok)
        ref_frame_free(out);
    return ok;
}

void ref_frame_free(struct ref_frame *frame)
{
    free(frame->color);
    free(frame->depth);
    free(frame->velocity);
    free(frame->triangle);
    free(frame->draw);
    memset(frame, 0, sizeof *frame);
}
