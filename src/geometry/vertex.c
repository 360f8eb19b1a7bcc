/* SPDX-License-Identifier: MIT */
/* vertex.c - layouts of vertex records, and the colours of vertices and faces. */
#include "geometry/vertex.h"

#include "base/pixel.h"
#include "geometry/clip.h"
#include "geometry/path.h"
#include "kernels/triangles.h"

/* Compares without a loop or branch. */
static inline bool even_normal(const uint8_t *a, const uint8_t *b)
{
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
}

static inline bool even_color(const uint8_t *a, const uint8_t *b)
{
    uint32_t first, second;
    __builtin_memcpy(&first, a, sizeof first);
    __builtin_memcpy(&second, b, sizeof second);
    return first == second;
}

enum { FLAT_CODES = 3 };       /* triangles whose channels differ by no more are of one colour */

void smear_placement_add(struct smear_homogeneous *h, const struct smear_placement *p, uint32_t index)
{
    for (int i = 0; i < p->extra_count; i++) {
        struct smear_homogeneous term;
        smear_transform_vertex(&term, &p->extra[i], p->extra_position[i] + 3 * index);
        homogeneous_add(h, &term);
    }
}

static inline void transform_corner(struct smear_homogeneous *h, const struct smear_placement *p, const int16_t b[6], int i)
{
    const int16_t corner[3] = { b[i & 1 ? 3 : 0], b[i & 2 ? 4 : 1], b[i & 4 ? 5 : 2] };
    smear_transform_vertex(h, &p->now, corner);
}

/* Returns those of `sides` that all corners of a box in the mesh lie beyond. All that is between corners does, too: before they are
 * divided by w, its places are sums of theirs. Corners are taken inwards by more than places are rounded by. */
static inline int sides_beside(const struct smear_placement *p, const int16_t b[6], const struct smear_viewport *viewport, int sides)
{
    for (int i = 0; i < 8 && sides != 0; i++) {
        struct smear_homogeneous h;
        transform_corner(&h, p, b, i);
        h.x -= h.x > 0 ? 1 : -1;
        h.y -= h.y > 0 ? 1 : -1;
        h.w += 1 + (max_i32(h.w, 0) >> 7);
        sides &= smear_outcode_behind(h, viewport) | (h.distance < p->now.depths.near_distance ? OUT_NEAR : 0)
               | (h.distance > p->now.depths.far_distance ? OUT_FAR : 0);
    }
    return sides;
}

/* Whether a box of the positions lies beyond one side of the view at every instant of the assembly. */
static bool box_is_beside(const struct smear_assembly *d, const int16_t *position, const int16_t box[6],
                          const struct smear_viewport *viewport)
{
    int sides = OUT_REJECT;
    for (int i = SMEAR_WITH_SUBFRAMES && d->path ? 2 : 0; i >= 0 && sides != 0; i--) {
        const struct smear_placement *const p = i == 0 ? &d->at : &d->motion.key[i - 1];
        sides = p->extra_count == 0 && p->position == position ? sides_beside(p, box, viewport, sides) : 0;
    }
    return sides != 0;
}

int smear_placement_project(struct smear_screen *screen, const struct smear_placement *p, uint32_t index,
                            const struct smear_viewport *viewport)
{
    return placement_project_any_inline(screen, p, index, viewport);
}

bool smear_vertex_is_beside(const struct smear_assembly *d, const struct smear_viewport *viewport)
{
    const int16_t *b = d->mesh->bounds;
    return (b[0] | b[1] | b[2] | b[3] | b[4] | b[5]) != 0 && box_is_beside(d, d->mesh->position, b, viewport);
}

bool smear_vertex_run_is_beside(const struct smear_assembly *d, const struct smear_viewport *viewport, uint32_t first, uint32_t end)
{
    const uint16_t *index = d->mesh->index + 3 * first;
    int16_t box[6];
    if (*index >= d->mesh->vertex_count)
        return false;
    positions_box(box, d->at.position + 3 * *index, 1);
    if (!box_is_beside(d, d->at.position, box, viewport))       /* nor is a box around it: most runs in the view cost no more */
        return false;
    const struct index_range r = indices_range(index, (int32_t)(3 * (end - first)));
    if (r.most >= d->mesh->vertex_count || r.most - r.least >= 3 * (end - first))
        return false;
    positions_box(box, d->at.position + 3 * r.least, (int32_t)(r.most - r.least + 1));
    return box_is_beside(d, d->at.position, box, viewport);
}

struct smear_segment *smear_vertex_segment(struct smear_assembler *a, const struct smear_assembly *d)
{
    struct smear_segment *s = smear_bins_open(a->bins);
    if (s == NULL)
        return NULL;
    const smear_mesh *mesh = d->mesh;
    const bool textured = assembly_is_textured(d);
    bool by_vertices = SMEAR_WITH_GOURAUD && ((d->shading.lit && mesh->normal != NULL) || mesh->color != NULL);
    bool per_vertex = by_vertices && !assembly_is_flat(d);
    int at = VERTEX_BASE_WORDS;
    s->draw = d->draw;
    s->uv = s->color = s->motion = 0;
    if (textured)
        s->uv = (uint8_t)at++;
    if (per_vertex)
        s->color = (uint8_t)at;
    if (by_vertices)            /* flat draws take as much room, so that what fits does not depend on it */
        at += 2;
    s->moves = SMEAR_WITH_RECONSTRUCT && a->keep_motion && !is_blend(d) ? d->moves : 0;
    if (segment_moves(s) != 0) {
        s->motion = (uint8_t)at;
        at += s->moves * MOTION_WORDS;
    }
    s->path = 0;
    if (SMEAR_WITH_SUBFRAMES && d->path) {
        s->path = 1;
        s->motion = (uint8_t)at;
        at += PATH_WORDS;
    }
    const bool unshaded = !d->shading.lit && d->shading.white && mesh->face_color == NULL && mesh->color == NULL;
    s->shade = per_vertex ? SHADE_GOURAUD : textured && unshaded ? SHADE_NONE : SHADE_FLAT;
    s->flat = assembly_is_flat(d);
    s->flat_depth = is_orthographic(&d->at.now);
    s->stride = (uint8_t)at;
    return s;
}

/* False, too, if an index is too large. */
bool smear_vertex_is_flat(const smear_mesh *mesh, bool lit)
{
    const uint8_t *const normal = lit ? (const uint8_t *)mesh->normal : NULL, *const color = mesh->color;
    const uint16_t *index = mesh->index, *const end = index + 3 * mesh->triangle_count;
    const uint32_t vertices = mesh->vertex_count;
    if (normal == NULL && color == NULL)
        return false;
    for (; index < end; index += 3) {
        const uint32_t a = index[0], b = index[1], c = index[2];
        if (max_u32(a, max_u32(b, c)) >= vertices)
            return false;
        if (normal != NULL && !(even_normal(normal + 3 * a, normal + 3 * b) && even_normal(normal + 3 * a, normal + 3 * c)))
            return false;
        if (color != NULL && !(even_color(color + 4 * a, color + 4 * b) && even_color(color + 4 * a, color + 4 * c)))
            return false;
    }
    return true;
}

/* Returns the cosine of the light at a vertex with a normal, or at its back. */
static uint32_t cosine_at(const struct smear_assembly *d, uint32_t index, bool flip)
{
    const int8_t *n = d->mesh->normal + 3 * index;
    const int8_t back[3] = { (int8_t)-max_i32(n[0], -127), (int8_t)-max_i32(n[1], -127), (int8_t)-max_i32(n[2], -127) };
    return smear_light_normal(&d->shading, flip ? back : n);
}

/* Finds the lit colour of a vertex of the face. */
SMEAR_INLINE void shade_vertex(struct smear_color *color, const struct smear_assembly *d, uint32_t index, const struct smear_face *face)
{
    const smear_mesh *mesh = d->mesh;
    uint32_t cosine = face->cosine;
    if (SMEAR_WITH_GOURAUD && d->shading.lit && mesh->normal != NULL)
        cosine = cosine_at(d, index, face->back);
    smear_shade(color, &d->shading, mesh->color != NULL ? mesh->color + 4 * index : NULL, face->color, cosine);
}

void smear_vertex_store_color(uint32_t *out, const struct smear_assembly *d, uint32_t index, uint32_t triangle, bool back)
{
    struct smear_color color;
    const struct smear_face face = smear_face_of(d, triangle, back);
    if (shading_has_lights(&d->shading)) {
        d->lights.vertex(&color, d, index, &face);
        store_color(out, color.channel);
        return;
    }
    shade_vertex(&color, d, index, &face);
    store_color(out, color.channel);
}

void smear_vertex_for_clipping(struct smear_clip_vertex *v, const struct smear_assembly *d,
                               const struct smear_segment *s, uint32_t index, const struct smear_face *face)
{
    __builtin_memset(v->uv, 0, sizeof v->uv + sizeof v->color);
    if (segment_textured(s)) {
        const int16_t *uv = d->mesh->uv + 2 * index;
        v->uv[0] = shl_wrap(uv[0], d->uv_up);
        v->uv[1] = shl_wrap(uv[1], d->uv_up);
    }
    if (segment_colored(s)) {
        struct smear_color color;
        if (shading_has_lights(&d->shading))
            d->lights.vertex(&color, d, index, face);
        else
            shade_vertex(&color, d, index, face);
        for (int c = 0; c < CLIP_COLORS; c++)
            v->color[c] = color.channel[c];
    }
}

void smear_vertex_take_clipped(struct smear_clip_vertex *v, const struct smear_segment *s, const int32_t *record)
{
    for (int i = 0; i < 2; i++)
        v->uv[i] = segment_textured(s) ? (int16_t)(record[s->uv] >> 16 * i) : 0;
    for (int c = 0; c < CLIP_COLORS; c++)
        v->color[c] = segment_colored(s) ? (uint16_t)((uint32_t)record[s->color + c / 2] >> 16 * (c % 2)) : 0;
}

void smear_vertex_store_clipped(uint32_t *record, const struct smear_segment *s, const struct smear_clip_vertex *v)
{
    if (segment_textured(s))
        store_uv(record + s->uv, v->uv[0], v->uv[1]);
    for (int c = 0; SMEAR_WITH_GOURAUD && segment_colored(s) && c < 4; c += 2)
        record[s->color + c / 2] = (uint32_t)v->color[c] | (uint32_t)v->color[c + 1] << 16;
}

static inline bool same_color(const uint8_t *a, const uint8_t *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}

/* Returns the shaded colour of a face, packed. */
static inline uint32_t shaded_face(const struct smear_assembly *d, const struct smear_face *face)
{
    struct smear_color color;
    if (shading_has_lights(&d->shading)) {
        d->lights.used->by->face(&color, d, face);
        return smear_color_pack(&color, d->shading.transfer);
    }
    smear_shade(&color, &d->shading, face->vertex_color, face->color, face->cosine);
    return smear_color_pack(&color, d->shading.transfer);
}

uint32_t smear_face_color(const struct smear_assembly *d, const struct smear_segment *s, const struct smear_face *face)
{
    if (s->shade != SHADE_FLAT)
        return 0xffffffffu;
    static const uint8_t white[4] = { 255, 255, 255, 255 };
    struct smear_lit *const last = SMEAR_LIGHT_IS_DEAR && face->vertex_color == NULL ? d->shading.last : NULL;
    const uint8_t *const color = face->color != NULL ? face->color : white;
    if (last != NULL && last->color != NULL && last->color_cosine == face->cosine && same_color(last->color, color))
        return last->packed;
    const uint32_t packed = shaded_face(d, face);
    if (last != NULL) {
        last->color = color;
        last->color_cosine = face->cosine;
        last->packed = packed;
    }
    return packed;
}

/* Returns the code of channel c (r g b) of a vertex as pixels get it (see channel_value in setup.h). */
static uint32_t channel_code(const struct smear_segment *s, const int32_t *record, int c, smear_transfer transfer)
{
    uint32_t word = (uint32_t)record[s->color + (c >> 1)];
    return code_of_channel((uint32_t)channel_of_vertex(c & 1 ? word >> 16 : word & 0xffffu, transfer), transfer);
}

bool smear_vertex_flat_color(uint32_t *color, const struct smear_segment *s, const int32_t *const record[3], smear_transfer transfer)
{
    if (s->shade != SHADE_GOURAUD || s->uv != 0)
        return false;
    uint32_t mean = 0;
    for (int c = 0; c < 3; c++) {
        uint32_t least = 255, most = 0;
        for (int i = 0; i < 3; i++) {
            uint32_t code = channel_code(s, record[i], c, transfer);
            least = min_u32(least, code);
            most = max_u32(most, code);
        }
        if (most - least > FLAT_CODES)
            return false;
        mean = mean << 8 | (least + most) >> 1;
    }
    *color = mean;
    return true;
}

struct smear_face smear_face_of(const struct smear_assembly *d, uint32_t triangle, bool back)
{
    struct smear_face face = { back, NULL, NULL, 65536u, triangle };
    const uint16_t *index = d->mesh->index + 3 * triangle;
    if (d->mesh->face_color != NULL)
        face.color = d->mesh->face_color + 4 * triangle;
    if (assembly_is_flat(d) && d->mesh->color != NULL)
        face.vertex_color = d->mesh->color + 4 * index[0];
    if (assembly_is_flat(d) && d->shading.lit && d->mesh->normal != NULL) {
        face.cosine = cosine_at(d, index[0], back);
    } else if (d->shading.lit && d->mesh->normal == NULL) {
        const int16_t *p = d->at.position;
        face.cosine = smear_light_face(&d->shading, p + 3 * index[0], p + 3 * index[back ? 2 : 1], p + 3 * index[back ? 1 : 2]);
    }
    return face;
}

/* ------------------------------------------------------------------ bounds */

void smear_mesh_find_bounds(smear_mesh *mesh)
{
    if (SMEAR_WITH_BOUNDS)
        positions_box_reference(mesh->bounds, mesh->position, (int32_t)mesh->vertex_count);
}
