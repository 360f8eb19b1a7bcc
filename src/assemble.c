/* SPDX-License-Identifier: MIT */
/* assemble.c - the loop over a draw's triangles.
 *
 * Order of work, cheapest rejection first: share an outcode, need clipping, face away, touch no pixel centre.
 * Only then are vertices shaded, moved to the other poses and stored, once each. */
#include "assemble.h"

#include "clip.h"
#include "fixmath.h"

void smear_assembler_reset(struct smear_assembler *a)
{
    for (uint32_t i = 0; i <= a->cache_mask; i++)
        a->cache[i].tag = 0;
    a->serial = 0;
}

static void fill_cached(struct smear_cached_vertex *v, const struct smear_assembler *a,
                        const struct smear_assembly *d, uint32_t index)
{
    v->stored = 0;
    smear_transform_vertex(&v->now, &d->now, d->position + 3 * index);
    for (int i = 0; i < d->extra_count; i++) {
        struct smear_homogeneous term;
        smear_transform_vertex(&term, &d->extra[i], d->extra_position[i] + 3 * index);
        v->now.x += term.x;
        v->now.y += term.y;
        v->now.w += term.w;
        v->now.distance += term.distance;
    }
    if (v->now.distance < d->now.near_distance) {
        v->outcode = OUT_NEAR;
        return;
    }
    smear_project(&v->screen, &d->now, &v->now, &a->viewport);
    v->outcode = outcode_sides(&v->screen, &a->viewport);
    if (v->now.distance > d->now.far_distance)
        v->outcode |= OUT_FAR;
}

static uint32_t displaced(int32_t there, int32_t ratio, int32_t now)
{
    const int64_t far_out = 1 << 27;
    int64_t d = there - ((int64_t)ratio * now >> 20);
    return (uint32_t)(int32_t)(d < -far_out ? -far_out : d > far_out ? far_out : d);
}

/* The words of MOTION_*: the point of the surface that is at `now` on the screen, seen at `h` in another pose. */
static void store_motion(uint32_t out[MOTION_WORDS], const struct smear_assembly *d, int pose,
                         const struct smear_homogeneous *h, const struct smear_homogeneous *now,
                         const struct smear_screen *screen, const struct smear_viewport *viewport)
{
    /* x' / w in q8 and w' / w in q20; the pose's rows have a scale of their own. */
    int scale = d->now.scale - d->pose[pose].scale;
    int zeros = count_leading_zeros((uint32_t)now->w);
    int32_t r = (int32_t)recip_norm((uint32_t)now->w << zeros);         /* 2^(61 - zeros) / w */
    int shift = zeros - 29 + scale;
    int32_t x = scale_sat(mulh_i32(h->x, r), clamp_i32(shift + 8, -31, 31));
    int32_t y = scale_sat(mulh_i32(h->y, r), clamp_i32(shift + 8, -31, 31));
    int32_t ratio = scale_sat(mulh_i32(h->w, r), clamp_i32(shift + 20, -31, 31));
    out[MOTION_DX] = displaced(x, ratio, screen->x - viewport->width * 128);
    out[MOTION_DY] = displaced(y, ratio, screen->y - viewport->height * 128);
    out[MOTION_RATIO] = (uint32_t)ratio;
}

static uint32_t *store_place(uint32_t *record, const struct smear_screen *screen)
{
    record[VERTEX_X] = (uint32_t)screen->x;
    record[VERTEX_Y] = (uint32_t)screen->y;
    record[VERTEX_DEPTH] = (uint32_t)screen->depth;
    return record;
}

static void store_color(uint32_t *record, const uint16_t channel[4])
{
    record[0] = (uint32_t)channel[0] | (uint32_t)channel[1] << 16;
    record[1] = (uint32_t)channel[2] | (uint32_t)channel[3] << 16;
}

static void store_uv(uint32_t *record, int32_t u, int32_t v)
{
    *record = ((uint32_t)u & 0xffffu) | (uint32_t)v << 16;
}

static void shade_vertex(struct smear_color *color, const struct smear_assembly *d, uint32_t index,
                         const uint8_t *face_color, uint32_t face_cosine, bool flip)
{
    const smear_mesh *mesh = d->mesh;
    uint32_t cosine = face_cosine;
    if (d->shading.lit && mesh->normal != NULL) {
        const int8_t *n = mesh->normal + 3 * index;
        if (flip) {
            const int8_t back[3] = { (int8_t)-max_i32(n[0], -127), (int8_t)-max_i32(n[1], -127),
                                     (int8_t)-max_i32(n[2], -127) };
            cosine = smear_light_normal(&d->shading, back);
        } else {
            cosine = smear_light_normal(&d->shading, n);
        }
    }
    smear_shade(color, &d->shading, mesh->color != NULL ? mesh->color + 4 * index : NULL, face_color,
                cosine);
}

/* The three vertices of a triangle on their way through. */
struct corner {
    uint32_t index;
    struct smear_cached_vertex *cached;
};

/* What a triangle has in common. */
struct face {
    bool back;                  /* seen from behind: double-sided */
    const uint8_t *color;
    uint32_t cosine;            /* flat light */
};

static void store_vertex(uint32_t *record, const struct smear_assembler *a,
                         const struct smear_assembly *d, const struct smear_segment *s,
                         const struct corner *c, const struct face *face)
{
    const smear_mesh *mesh = d->mesh;
    store_place(record, &c->cached->screen);
    if (s->uv != 0)
        store_uv(record + s->uv, mesh->uv[2 * c->index], mesh->uv[2 * c->index + 1]);
    if (s->color != 0) {
        struct smear_color color;
        shade_vertex(&color, d, c->index, face->color, face->cosine, face->back);
        store_color(record + s->color, color.channel);
    }
    for (int pose = 0; pose < s->moves; pose++) {
        struct smear_homogeneous h;
        smear_transform_vertex(&h, &d->pose[pose], d->pose_position[pose] + 3 * c->index);
        store_motion(record + s->motion + pose * MOTION_WORDS, d, pose, &h, &c->cached->now,
                     &c->cached->screen, &a->viewport);
    }
}

/* Twice the signed area in q16 pixels, positive when clockwise on the screen (y down): seen from behind. */
static int64_t area_of(const struct smear_screen *a, const struct smear_screen *b,
                       const struct smear_screen *c)
{
    int32_t x1 = b->x - a->x, y1 = b->y - a->y, x2 = c->x - a->x, y2 = c->y - a->y;
#if !SMEAR_HAS_MUL64
    const int32_t small = 1 << 14;
    if (x1 < small && x1 > -small && y1 < small && y1 > -small
        && x2 < small && x2 > -small && y2 < small && y2 > -small)
        return x1 * y2 - x2 * y1;
#endif
    return (int64_t)x1 * y2 - (int64_t)x2 * y1;
}

/* First tile row in which a pixel centre can be covered, or -1: none at all, or none in this part of the frame. */
static int first_row(const struct smear_assembler *a, const struct smear_screen *v[3])
{
    const struct smear_geometry *g = a->geometry;
    int32_t left = min_i32(v[0]->x, min_i32(v[1]->x, v[2]->x));
    int32_t right = max_i32(v[0]->x, max_i32(v[1]->x, v[2]->x));
    int32_t x0 = max_i32((left + 127) >> 8, 0), x1 = min_i32((right + 127) >> 8, a->viewport.width);
    if (x0 >= x1)
        return -1;
    int32_t top = min_i32(v[0]->y, min_i32(v[1]->y, v[2]->y));
    int32_t bottom = max_i32(v[0]->y, max_i32(v[1]->y, v[2]->y));
    int32_t y0 = max_i32((top + 127) >> 8, g->row_first * g->row_px);
    int32_t y1 = min_i32((bottom + 127) >> 8, min_i32(a->viewport.height, g->row_end * g->row_px));
    if (y0 >= y1)
        return -1;
    return (int)((uint32_t)y0 / (uint32_t)g->row_px);
}

static bool is_blend(const struct smear_assembly *d)
{
    return d->material->alpha == SMEAR_BLEND;
}

/* Lays out the vertex records of this draw. */
static struct smear_segment *open_segment(struct smear_assembler *a, const struct smear_assembly *d)
{
    struct smear_segment *s = smear_geometry_open(a->geometry);
    if (s == NULL)
        return NULL;
    const smear_mesh *mesh = d->mesh;
    bool textured = d->material->texture != NULL && mesh->uv != NULL;
    bool per_vertex = (d->shading.lit && mesh->normal != NULL) || mesh->color != NULL;
    int at = VERTEX_BASE_WORDS;
    s->draw = d->draw;
    s->uv = s->color = s->motion = 0;
    if (textured)
        s->uv = (uint8_t)at++;
    if (per_vertex) {
        s->color = (uint8_t)at;
        at += 2;
    }
    s->moves = a->keep_motion && !is_blend(d) ? d->moves : 0;
    if (s->moves != 0) {
        s->motion = (uint8_t)at;
        at += s->moves * MOTION_WORDS;
    }
    s->shade = per_vertex ? SHADE_GOURAUD
             : textured && !d->shading.lit && d->shading.white && mesh->face_color == NULL ? SHADE_NONE : SHADE_FLAT;
    s->flat_depth = d->now.orthographic;
    s->stride = (uint8_t)at;
    return s;
}

/* Vertices cannot be shared when a face's own light or colour goes into them. */
static bool shares_vertices(const struct smear_assembly *d, const struct smear_segment *s)
{
    return s->color == 0
        || (d->mesh->face_color == NULL && (!d->shading.lit || d->mesh->normal != NULL));
}

/* Room for one more triangle with `fresh` new vertices; opens a new segment where offsets run out. */
static struct smear_segment *make_room(struct smear_assembler *a, const struct smear_assembly *d,
                                       struct smear_segment *s, uint32_t fresh)
{
    struct smear_geometry *g = a->geometry;
    if (s == NULL || g->vertex_words + fresh * s->stride - s->base > 65536u) {
        s = open_segment(a, d);
        if (s == NULL)
            return NULL;
    }
    return geometry_has_room(g, fresh * s->stride, 1) ? s : NULL;
}

static struct smear_triangle *add_triangle(struct smear_assembler *a, const struct smear_segment *s,
                                           uint32_t color, int row, bool blend)
{
    struct smear_geometry *g = a->geometry;
    uint32_t i = g->triangle_count++;
    struct smear_triangle *t = geometry_triangle(g, i);
    t->segment = (uint16_t)(s - g->segment);
    t->color = color;
    smear_geometry_link(g, i, row, blend);
    a->triangles_drawn++;
    return t;
}

static uint32_t face_color_of(const struct smear_assembly *d, const struct smear_segment *s,
                              const struct face *face)
{
    if (s->shade != SHADE_FLAT)
        return 0xffffffffu;
    struct smear_color color;
    smear_shade(&color, &d->shading, NULL, face->color, face->cosine);
    return smear_color_pack(&color, d->shading.linear);
}

static struct face face_of(const struct smear_assembly *d, uint32_t triangle,
                           const struct corner corner[3], bool back)
{
    struct face face = { back, NULL, 65536u };
    if (d->mesh->face_color != NULL)
        face.color = d->mesh->face_color + 4 * triangle;
    if (d->shading.lit && d->mesh->normal == NULL) {
        const int16_t *p = d->position;
        const int16_t *v[3] = { p + 3 * corner[0].index, p + 3 * corner[1].index,
                                p + 3 * corner[2].index };
        face.cosine = smear_light_face(&d->shading, v[0], v[back ? 2 : 1], v[back ? 1 : 2]);
    }
    return face;
}

/* The triangle is cut: its polygon is stored as a fan, with vertices of its own. */
static bool add_clipped(struct smear_assembler *a, const struct smear_assembly *d,
                        struct smear_segment **segment, uint32_t triangle,
                        const struct corner corner[3])
{
    struct smear_clip_vertex polygon[SMEAR_CLIP_MAX];
    struct smear_screen screen[SMEAR_CLIP_MAX];
    const smear_mesh *mesh = d->mesh;
    int codes = 0;
    for (int i = 0; i < 3; i++) {
        struct smear_clip_vertex *v = &polygon[i];
        codes |= corner[i].cached->outcode;
        v->now = corner[i].cached->now;
        for (int pose = 0; pose < 2; pose++)
            v->pose[pose] = v->now;
        for (int pose = 0; pose < d->moves; pose++)
            smear_transform_vertex(&v->pose[pose], &d->pose[pose],
                                   d->pose_position[pose] + 3 * corner[i].index);
        v->uv[0] = mesh->uv != NULL ? mesh->uv[2 * corner[i].index] : 0;
        v->uv[1] = mesh->uv != NULL ? mesh->uv[2 * corner[i].index + 1] : 0;
        for (int c = 0; c < 4; c++)
            v->color[c] = 0;
    }

    /* Which side is seen decides the light, and only the cut polygon can tell: clip places first. */
    struct smear_clip_vertex probe[SMEAR_CLIP_MAX];
    for (int i = 0; i < 3; i++)
        probe[i] = polygon[i];
    int count = smear_clip_triangle(probe, &d->now, codes);
    int64_t area = 0;
    for (int i = 0; i < count; i++)
        smear_project(&screen[i], &d->now, &probe[i].now, &a->viewport);
    for (int i = 2; i < count; i++)
        area += area_of(&screen[0], &screen[i - 1], &screen[i]);
    bool back = (area > 0) != d->mirrored;
    if (area == 0 || (back && !d->material->double_sided))
        return true;

    struct face face = face_of(d, triangle, corner, back);
    if (*segment == NULL)
        *segment = open_segment(a, d);
    if (*segment == NULL)
        return false;
    if ((*segment)->color != 0) {
        for (int i = 0; i < 3; i++) {
            struct smear_color color;
            shade_vertex(&color, d, corner[i].index, face.color, face.cosine, back);
            for (int c = 0; c < 4; c++)
                polygon[i].color[c] = color.channel[c];
        }
    }
    count = smear_clip_triangle(polygon, &d->now, codes);

    const int32_t guard = SMEAR_GUARD_PX << 8;
    int32_t cx = a->viewport.width << 7, cy = a->viewport.height << 7;
    for (int i = 0; i < count; i++) {
        smear_project(&screen[i], &d->now, &polygon[i].now, &a->viewport);
        screen[i].x = clamp_i32(screen[i].x, cx - guard, cx + guard);
        screen[i].y = clamp_i32(screen[i].y, cy - guard, cy + guard);
    }
    for (int i = 2; i < count; i++) {
        const int fan[3] = { 0, i - 1, i };
        const struct smear_screen *place[3] = { &screen[0], &screen[i - 1], &screen[i] };
        /* Rounding may turn a sliver of the fan over: it covers nothing that is not covered. */
        int64_t part = area_of(place[0], place[1], place[2]);
        int row = part == 0 || (part > 0) != (area > 0) ? -1 : first_row(a, place);
        if (row < 0)
            continue;
        struct smear_segment *s = make_room(a, d, *segment, 3);
        if (s == NULL)
            return false;
        *segment = s;
        uint16_t offset[3];
        for (int k = 0; k < 3; k++) {
            const struct smear_clip_vertex *v = &polygon[fan[k]];
            uint32_t *record = a->geometry->pool + a->geometry->vertex_words;
            offset[k] = (uint16_t)(a->geometry->vertex_words - s->base);
            a->geometry->vertex_words += s->stride;
            store_place(record, place[k]);
            if (s->uv != 0)
                store_uv(record + s->uv, v->uv[0], v->uv[1]);
            if (s->color != 0) {
                const uint16_t channel[4] = { (uint16_t)v->color[0], (uint16_t)v->color[1],
                                              (uint16_t)v->color[2], (uint16_t)v->color[3] };
                store_color(record + s->color, channel);
            }
            for (int pose = 0; pose < s->moves; pose++)
                store_motion(record + s->motion + pose * MOTION_WORDS, d, pose, &v->pose[pose],
                             &v->now, place[k], &a->viewport);
        }
        struct smear_triangle *t = add_triangle(a, s, face_color_of(d, s, &face), row, is_blend(d));
        t->vertex[0] = offset[0];
        t->vertex[1] = offset[area > 0 ? 1 : 2];
        t->vertex[2] = offset[area > 0 ? 2 : 1];
    }
    return true;
}

/* A triangle that lies within the guard band; `clockwise` on the screen. */
static bool add_whole(struct smear_assembler *a, const struct smear_assembly *d,
                      struct smear_segment **segment, bool shares, uint32_t triangle,
                      const struct corner corner[3], bool clockwise)
{
    const struct smear_screen *place[3] = { &corner[0].cached->screen, &corner[1].cached->screen,
                                            &corner[2].cached->screen };
    int row = first_row(a, place);
    if (row < 0)
        return true;
    struct smear_segment *s = make_room(a, d, *segment, 3);
    if (s == NULL)
        return false;
    *segment = s;
    bool back = clockwise != d->mirrored;
    struct face face = face_of(d, triangle, corner, back);
    struct smear_triangle *t = add_triangle(a, s, face_color_of(d, s, &face), row, is_blend(d));
    struct smear_geometry *g = a->geometry;
    /* Seen from behind, normals flip: such a vertex is not the one its front faces share. */
    shares = shares && (!back || s->color == 0);
    for (int i = 0; i < 3; i++) {
        struct smear_cached_vertex *v = corner[i].cached;
        uint32_t word = v->stored - 1;
        if (!shares || v->stored <= s->base) {
            word = g->vertex_words;
            g->vertex_words += s->stride;
            store_vertex(g->pool + word, a, d, s, &corner[i], &face);
            if (shares)
                v->stored = word + 1;
        }
        t->vertex[clockwise || i == 0 ? i : 3 - i] = (uint16_t)(word - s->base);
    }
    return true;
}

static SMEAR_NOINLINE struct smear_cached_vertex *miss(const struct smear_assembler *a,
                                                      const struct smear_assembly *d, uint32_t tag,
                                                      struct smear_cached_vertex *v,
                                                      const struct smear_cached_vertex *in_use1,
                                                      const struct smear_cached_vertex *in_use2,
                                                      struct smear_cached_vertex *spare)
{
    /* A slot that this triangle already uses for another vertex must not be overwritten. */
    if (v == in_use1 || v == in_use2)
        v = spare;
    v->tag = tag;
    fill_cached(v, a, d, tag & 0xffffu);
    return v;
}

/* The transformed vertex: remembered, or made now. */
static inline struct smear_cached_vertex *look_up(const struct smear_assembler *a,
                                                  const struct smear_assembly *d, uint32_t tag,
                                                  const struct smear_cached_vertex *in_use1,
                                                  const struct smear_cached_vertex *in_use2,
                                                  struct smear_cached_vertex *spare)
{
    struct smear_cached_vertex *v = &a->cache[tag & a->cache_mask];
    return v->tag == tag ? v : miss(a, d, tag, v, in_use1, in_use2, spare);
}

bool smear_assemble(struct smear_assembler *a, const struct smear_assembly *d, bool drop)
{
    const smear_mesh *mesh = d->mesh;
    struct smear_segment *segment = open_segment(a, d);
    if (segment == NULL) {
        if (drop)
            a->triangles_dropped += mesh->triangle_count;
        return drop;
    }
    bool shares = shares_vertices(d, segment);
    uint32_t tag = ++a->serial << 16;
    const uint16_t *index = mesh->index;
    struct smear_cached_vertex spare[3];

    for (uint32_t i = 0; i < mesh->triangle_count; i++, index += 3) {
        uint32_t i0 = index[0], i1 = index[1], i2 = index[2];
        if (max_u32(i0, max_u32(i1, i2)) >= mesh->vertex_count) {
            a->triangles_dropped++;
            continue;
        }
        struct smear_cached_vertex *v0 = look_up(a, d, tag | i0, NULL, NULL, &spare[0]);
        struct smear_cached_vertex *v1 = look_up(a, d, tag | i1, v0, NULL, &spare[1]);
        struct smear_cached_vertex *v2 = look_up(a, d, tag | i2, v0, v1, &spare[2]);
        if ((v0->outcode & v1->outcode & v2->outcode & OUT_REJECT) != 0)
            continue;
        struct corner corner[3] = { { i0, v0 }, { i1, v1 }, { i2, v2 } };
        bool added;
        if (((v0->outcode | v1->outcode | v2->outcode) & OUT_CLIP) != 0) {
            added = add_clipped(a, d, &segment, i, corner);
        } else {
            int64_t area = area_of(&v0->screen, &v1->screen, &v2->screen);
            bool back = (area > 0) != d->mirrored;
            if (area == 0 || (back && !d->material->double_sided))
                continue;
            added = add_whole(a, d, &segment, shares, i, corner, area > 0);
        }
        if (!added) {
            if (!drop)
                return false;
            a->triangles_dropped++;
        }
    }
    return true;
}
