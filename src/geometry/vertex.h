/* SPDX-License-Identifier: MIT */
/* vertex.h - what both assemblers share: a draw that is assembled, its vertex records, its faces. */
#ifndef SMEAR_VERTEX_H
#define SMEAR_VERTEX_H

#include "base/fixmath.h"
#include "base/jobs.h"
#include "geometry/bins.h"
#include "geometry/light.h"
#include "geometry/transform.h"

/* ------------------------------------------------------------------ a draw */

/* A transformed vertex: an entry of a direct-mapped cache. */
struct smear_cached_vertex {
    uint32_t tag;                   /* draw serial << 16 | vertex index */
    uint32_t stored;                /* its record in the pool: word + 1, or 0 */
    struct smear_screen screen;
    int32_t outcode;
};

/* What the three vertices of a triangle share. */
struct smear_face {
    bool back;                      /* it is seen from behind, and double-sided */
    const uint8_t *color;
    const uint8_t *vertex_color;    /* the colour of all three vertices, where the draw is flat */
    uint32_t cosine;                /* of the light, where it is flat */
    uint32_t triangle;
};

/* Tiles of the frame that something reaches into: columns x0 .. x1 and rows y0 .. y1, both ends included; none where x0 > x1. */
struct smear_tile_box {
    uint8_t x0, x1, y0, y1;
};

static inline struct smear_tile_box tile_box_none(void) { return (struct smear_tile_box){ UINT8_MAX, 0, UINT8_MAX, 0 }; }

/* Which tiles are drawn at all, with smear_desc.buffer_age. */
struct smear_damaged_tiles {
    uint8_t *tile;                  /* row by row; 0: the display shows it already */
    uint8_t columns, shift;         /* tiles of a row, less one; log2 of their size */
    bool only;                      /* triangles beyond damaged tiles are left out */
    struct smear_tile_box *seen;    /* grows by where triangles are seen, or null */
};

enum { TILE_DAMAGED_NOW = 0x80 };       /* a moving triangle is seen in it */

/* Cores that assemble parts of the draws may mark a tile at once: they all write the same. */
static inline void tile_mark(uint8_t *tile)
{
#if SMEAR_CLAIMS
    __atomic_store_n(tile, (uint8_t)(__atomic_load_n(tile, __ATOMIC_RELAXED) | TILE_DAMAGED_NOW), __ATOMIC_RELAXED);
#else
    volatile uint8_t *const mark = tile;
    *mark = (uint8_t)(*mark | TILE_DAMAGED_NOW);
#endif
}

static inline struct smear_tile_box tile_box_of(const struct smear_damaged_tiles *d, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    return (struct smear_tile_box){ (uint8_t)(x0 >> d->shift), (uint8_t)((x1 - 1) >> d->shift),
                                    (uint8_t)(y0 >> d->shift), (uint8_t)((y1 - 1) >> d->shift) };
}

static inline bool tile_box_is_damaged(const struct smear_damaged_tiles *d, struct smear_tile_box box)
{
    for (int row = box.y0; row <= box.y1; row++)
        for (int column = box.x0; column <= box.x1; column++)
            if (d->tile[row * (d->columns + 1) + column] != 0)
                return true;
    return false;
}

static inline void tile_box_add(struct smear_tile_box *all, struct smear_tile_box box)
{
    all->x0 = box.x0 < all->x0 ? box.x0 : all->x0;
    all->x1 = box.x1 > all->x1 ? box.x1 : all->x1;
    all->y0 = box.y0 < all->y0 ? box.y0 : all->y0;
    all->y1 = box.y1 > all->y1 ? box.y1 : all->y1;
}

/* Where in a draw to begin, or where the store was full: a triangle, of which some parts (a side, triangles that clipping
 * left) are there already. */
struct smear_resume {
    uint32_t triangle;
    uint16_t parts;
};

/* What all draws of a frame share. */
struct smear_assembler {
    struct smear_viewport viewport;
    struct smear_bins *bins;
    struct smear_cached_vertex *cache;
    uint32_t cache_mask;
    uint32_t serial;                /* number of the draw within the context's life: tags of older ones never match */
    bool cache_has_paths;           /* it holds vertices of assemble_path.c */
    bool keep_motion;               /* the method reads velocities */
    bool keep_paths;                /* the method looks at several instants */
    uint32_t path_count, path_limit;    /* triangles with a path: listed, and at most */
    bool lines;                     /* what stands still will be blurred along lines */
    uint32_t path_static_count;     /* those of them whose path has no length: they are listed among the static ones */
    uint32_t triangles_drawn, triangles_dropped;
    struct smear_resume resume;
    int16_t path_x0, path_x1;       /* what moves, and is not blended, is left out where it is beside these columns */
    const struct smear_tile_box *ranges;        /* boxes of the draw that is assembled, or null: ranges.h */
    const struct smear_damaged_tiles *damaged;  /* where moving triangles mark their tiles; null without buffer_age */
};

/* Where a draw's vertices are at one instant: a projection, or a sum of some (smear_projection_weigh)
 * where poses of a mesh that deforms are mixed. */
struct smear_placement {
    struct smear_projection now;
    const int16_t *position;
    int extra_count;                    /* further terms of the sum */
    struct smear_projection extra[SMEAR_WITH_DEFORM ? 2 : 1];
    const int16_t *extra_position[SMEAR_WITH_DEFORM ? 2 : 1];
};

/* Vertices may be anywhere on the line through two positions of the mesh. */
#define SMEAR_PARTS_OF_DEFORMS ((SMEAR_WITH_SCALES || SMEAR_WITH_CURVES) && SMEAR_WITH_DEFORM)

/* Velocity is measured between these poses or, where there is one, between it and the drawn instant. */
struct smear_measured_poses {
    struct smear_projection pose[SMEAR_WITH_RECONSTRUCT ? 2 : 1];
    const int16_t *position[SMEAR_WITH_RECONSTRUCT ? 2 : 1];
    struct smear_projection rest[SMEAR_WITH_RECONSTRUCT && SMEAR_PARTS_OF_DEFORMS ? 2 : 1];
};

/* One draw with everything that does not change from triangle to triangle. */
struct smear_assembly {
    const smear_mesh *mesh;
    const smear_material *material;     /* never null */
    uint32_t first, end;                /* its triangles that are assembled */
    uint16_t draw;                      /* its index, for the raster */
    bool mirrored;                      /* negative determinant: the winding flips */
    bool backs;                         /* faces are seen from behind, too: what turns inside out has either in front */
    bool path;                          /* motion.key is set, and records get a path (path.h); moves is 0 */
    bool flat;                          /* triangles have one colour each, though vertices have normals or colours */
    bool has_rest;                      /* part of a deformation: the mesh's own vertices are added by measured.rest */
    bool fixed;                         /* no points: its pixels must know whose they are (smear_raster_draw.fixed, fog) */
    uint8_t moves;                      /* as smear_segment.moves */
    uint8_t uv_up;                      /* as struct smear_sampler has it */
    struct smear_placement at;          /* the instant that is drawn */
    /* Finds the placement at open (0) or close (1) or the instant that is drawn (2) in units of 2^coarse pixels, for what is cut. */
    void (*place_fine)(struct smear_placement *place, const struct smear_assembly *d, int key, int coarse);
    const void *place_of, *instant;
    union {                             /* large, and on the stack: `measured` where moves is not 0, `key` with a path */
        struct smear_measured_poses measured;
        struct smear_placement key[SMEAR_WITH_SUBFRAMES ? 2 : 1];   /* shutter open and close */
    } motion;
    struct smear_shading shading;
    struct smear_lit lit;               /* of shading.last */
    struct smear_lights_seen lights;    /* of shading.lights */
};

/* Faces may take what was found of those before them: once the shading is made. */
static inline void assembly_remember_light(struct smear_assembly *d)
{
    if (SMEAR_LIGHT_IS_DEAR && !shading_has_lights(&d->shading)) {
        d->lit.normal[0] = INT32_MAX;
        d->lit.color = NULL;
        d->shading.last = &d->lit;
    }
}

/* These are false at compile time where the methods and surfaces that need them were left out. */
static inline bool assembler_keeps_motion(const struct smear_assembler *a)
{
    return SMEAR_WITH_RECONSTRUCT && a->keep_motion;
}

static inline bool assembler_keeps_paths(const struct smear_assembler *a)
{
    return SMEAR_WITH_SUBFRAMES && a->keep_paths;
}

static inline bool assembler_has_damage(const struct smear_assembler *a)
{
    return SMEAR_WITH_DAMAGE && a->damaged != NULL;
}

/* Returns how many parts of a triangle have been added already. */
static inline uint32_t parts_before(const struct smear_assembler *a, uint32_t triangle)
{
    return triangle == a->resume.triangle ? a->resume.parts : 0;
}

static inline bool assembly_has_path(const struct smear_assembly *d) { return SMEAR_WITH_SUBFRAMES && d->path; }

/* Adds a placement's further terms to its first. */
void smear_placement_add(struct smear_homogeneous *h, const struct smear_placement *p, uint32_t index);

static inline bool assembly_is_flat(const struct smear_assembly *d) { return SMEAR_FIND_FLAT && d->flat; }

static inline bool assembly_is_textured(const struct smear_assembly *d)
{
    return SMEAR_WITH_TEXTURE && d->material->texture != NULL && d->mesh->uv != NULL;
}

static inline void placement_transform(struct smear_homogeneous *h, const struct smear_placement *p, uint32_t index)
{
    transform_vertex(h, &p->now, p->position + 3 * index);
    if (SMEAR_WITH_DEFORM && p->extra_count != 0)
        smear_placement_add(h, p, index);
}

/* Transforms a vertex as it is in a pose of the assembly. */
static inline void pose_transform(struct smear_homogeneous *h, const struct smear_assembly *d, int pose, uint32_t index)
{
    const struct smear_measured_poses *m = &d->motion.measured;
    transform_vertex(h, &m->pose[pose], m->position[pose] + 3 * index);
    if (SMEAR_PARTS_OF_DEFORMS && d->has_rest) {
        struct smear_homogeneous rest;
        transform_vertex(&rest, &m->rest[pose], d->mesh->position + 3 * index);
        homogeneous_add(h, &rest);
    }
}

/* Transforms and projects a vertex; returns its outcode. A vertex behind the near plane is not projected. */
int smear_placement_project(struct smear_screen *screen, const struct smear_placement *p, uint32_t index,
                            const struct smear_viewport *viewport);

/* Finds where a transformed vertex is on the screen; returns its outcode. */
static inline int placement_see(struct smear_screen *screen, const struct smear_homogeneous *h, const struct smear_placement *p,
                                const struct smear_viewport *viewport)
{
    if (h->distance < p->now.depths.near_distance)
        return OUT_NEAR | smear_outcode_behind(*h, viewport);
    project(screen, &p->now.depths, h, viewport);
    int code = outcode_sides(screen, viewport);
    return h->distance > p->now.depths.far_distance ? code | OUT_FAR : code;
}

/* Does what smear_placement_project does, without a call. */
static inline int placement_project_any_inline(struct smear_screen *screen, const struct smear_placement *p, uint32_t index,
                                               const struct smear_viewport *viewport)
{
    struct smear_homogeneous h;
    placement_transform(&h, p, index);
    return placement_see(screen, &h, p, viewport);
}

/* Does so without a call for most that a camera with a perspective sees, now. */
static inline int placement_project_inline(struct smear_screen *screen, const struct smear_placement *p, uint32_t index,
                                           const struct smear_viewport *viewport)
{
    struct smear_homogeneous h;         /* in registers, as no call knows it */
    if ((SMEAR_WITH_DEFORM && p->extra_count != 0) || is_orthographic(&p->now))
        return smear_placement_project(screen, p, index, viewport);
    transform_vertex(&h, &p->now, p->position + 3 * index);
    return placement_see(screen, &h, p, viewport);
}

/* Whether the mesh's bounds lie beyond one side of the view at every instant of the assembly. */
bool smear_vertex_is_beside(const struct smear_assembly *d, const struct smear_viewport *viewport);

/* Whether triangles [first, end) do, as far as the box of their vertices tells. */
bool smear_vertex_run_is_beside(const struct smear_assembly *d, const struct smear_viewport *viewport, uint32_t first, uint32_t end);

static inline bool assembly_is_beside(const struct smear_assembly *d, const struct smear_viewport *viewport)
{
    return SMEAR_WITH_BOUNDS && smear_vertex_is_beside(d, viewport);
}

/* ------------------------------------------------------------------ records */

static inline uint32_t *store_place(uint32_t *record, const struct smear_screen *screen)
{
    record[VERTEX_X] = (uint32_t)screen->x;
    record[VERTEX_Y] = (uint32_t)screen->y;
    record[VERTEX_DEPTH] = (uint32_t)screen->depth;
    return record;
}

static inline void store_color(uint32_t *record, const uint16_t channel[4])
{
    record[0] = (uint32_t)channel[0] | (uint32_t)channel[1] << 16;
    record[1] = (uint32_t)channel[2] | (uint32_t)channel[3] << 16;
}

static inline void store_uv(uint32_t *record, int32_t u, int32_t v)
{
    *record = ((uint32_t)u & 0xffffu) | (uint32_t)v << 16;
}

static inline void store_mesh_uv(uint32_t *record, const struct smear_assembly *d, uint32_t index)
{
    const int16_t *uv = d->mesh->uv + 2 * index;
    store_uv(record, shl_wrap(uv[0], d->uv_up), shl_wrap(uv[1], d->uv_up));
}

/* Whether all three vertices of every triangle have one colour and, where the draw is lit, one normal: so flat faces
 * come out of modelling programs. */
bool smear_vertex_is_flat(const smear_mesh *mesh, bool lit);

/* Finds out whether the draw's triangles have one colour each. Fog and textures see that in linear light: they would mix the
 * colour's code, where colours of vertices are light of 16 bits. */
static inline void assembly_find_flat(struct smear_assembly *d)
{
    if (SMEAR_FIND_FLAT)
        d->flat = d->material->alpha == SMEAR_OPAQUE && !(shading_has_lights(&d->shading) && d->mesh->normal != NULL)
               && (!shading_is_linear(&d->shading) || (!d->fixed && !assembly_is_textured(d)))
               && smear_vertex_is_flat(d->mesh, d->shading.lit);
}

/* Starts a segment for more records of this draw; null when the table is full. */
struct smear_segment *smear_vertex_segment(struct smear_assembler *a, const struct smear_assembly *d);

/* Shades vertex `index` of a triangle, seen from behind or not, and stores its colour. */
void smear_vertex_store_color(uint32_t *out, const struct smear_assembly *d, uint32_t index, uint32_t triangle, bool back);

struct smear_clip_vertex;

/* Fills in what is interpolated when a triangle is clipped, but not its places: the uv and colour of vertex `index`
 * that the segment's records have. */
void smear_vertex_for_clipping(struct smear_clip_vertex *v, const struct smear_assembly *d,
                               const struct smear_segment *s, uint32_t index, const struct smear_face *face);

/* The same of a record. */
void smear_vertex_take_clipped(struct smear_clip_vertex *v, const struct smear_segment *s, const int32_t *record);

/* Stores those attributes. */
void smear_vertex_store_clipped(uint32_t *record, const struct smear_segment *s, const struct smear_clip_vertex *v);

/* Finds the colour of three stored vertices. Returns false unless they have one, or nearly, and no texture. */
bool smear_vertex_flat_color(uint32_t *color, const struct smear_segment *s, const int32_t *const record[3], smear_transfer transfer);

/* ------------------------------------------------------------------ faces */

struct smear_face smear_face_of(const struct smear_assembly *d, uint32_t triangle, bool back);

/* Returns the face's colour, 0xAARRGGBB, where the segment's triangles have SHADE_FLAT, else white. */
uint32_t smear_face_color(const struct smear_assembly *d, const struct smear_segment *s, const struct smear_face *face);

static inline int64_t area_of(const struct smear_screen *a, const struct smear_screen *b, const struct smear_screen *c)
{
    return edges_area(b->x - a->x, b->y - a->y, c->x - a->x, c->y - a->y);
}

/* Returns a number of the sign of area_of. */
static inline int32_t side_of(const struct smear_screen *a, const struct smear_screen *b, const struct smear_screen *c)
{
    const int32_t x1 = b->x - a->x, y1 = b->y - a->y, x2 = c->x - a->x, y2 = c->y - a->y;
    const uint32_t small = 1 << 15;
    if (!SMEAR_HAS_MUL64 && !SMEAR_SMALL_CODE
        && (((uint32_t)x1 + small) | ((uint32_t)y1 + small) | ((uint32_t)x2 + small) | ((uint32_t)y2 + small)) < 2 * small)
        return x1 * y2 - x2 * y1;
    const int64_t area = edges_area(x1, y1, x2, y2);
    return area < 0 ? -1 : area > 0;
}

/* Pixels whose centres may be covered. */
struct box {
    int32_t x0, y0, x1, y1;
};

static inline struct box box_of(const struct smear_screen *a, const struct smear_screen *b, const struct smear_screen *c)
{
    struct box box;
    box_span(&box.x0, &box.x1, a->x, b->x, c->x);
    box_span(&box.y0, &box.y1, a->y, b->y, c->y);
    return box;
}

/* Adds the margin in which what does not cover the box's centres may be seen all the same. */
static inline void box_widen(struct box *box, const struct smear_assembler *a)
{
    const int32_t margin = bins_margin(a->bins);
    box->x0 -= margin;
    box->y0 -= margin;
    box->x1 += margin;
    box->y1 += margin;
}

/* Cuts a box to the part of the frame that is being filled. */
static inline void box_cut(struct box *box, const struct smear_assembler *a)
{
    const struct smear_bins *g = a->bins;
    box->x0 = max_i32(box->x0, 0);
    box->x1 = min_i32(box->x1, a->viewport.width);
    box->y0 = max_i32(box->y0, g->row_first * g->row_px);
    box->y1 = min_i32(box->y1, min_i32(a->viewport.height, g->row_end * g->row_px));
}

static inline bool box_is_empty(const struct box *box)
{
    return box->x0 >= box->x1 || box->y0 >= box->y1;
}

static inline bool is_blend(const struct smear_assembly *d)
{
    return SMEAR_WITH_ALPHA && d->material->alpha >= SMEAR_BLEND;
}

/* Whether faces share their vertices' records: not when a face's own light or colour goes into them. */
static inline bool shares_vertices(const struct smear_assembly *d, const struct smear_segment *s)
{
    return !segment_by_vertices(s) || (d->mesh->face_color == NULL && (!d->shading.lit || d->mesh->normal != NULL));
}

/* Makes room for `entries` more triangles with three new vertices and `words` besides: returns the segment, or a new one where offsets run
 * out, or null where the store is full. */
static inline struct smear_segment *make_room(struct smear_assembler *a, const struct smear_assembly *d,
                                              struct smear_segment *s, uint32_t entries, uint32_t words)
{
    struct smear_bins *g = a->bins;
    if (s == NULL || g->vertex_words + 3u * s->stride + words - s->base > 65536u) {
        s = smear_vertex_segment(a, d);
        if (s == NULL)
            return NULL;
    }
    return bins_has_room(g, 3u * s->stride + words, entries) ? s : NULL;
}

#endif
