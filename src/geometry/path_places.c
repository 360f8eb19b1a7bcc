/* SPDX-License-Identifier: MIT */
/* path_places.c - see path_places.h. */
#include "geometry/path_places.h"

#include "kernels/wide8.h"

#if SMEAR_WITH_SUBFRAMES && SMEAR_AVX2

SMEAR_AVX2_FUNCTION void smear_path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d)
{
    const struct smear_viewport *const viewport = &a->viewport;
    const uint32_t count = d->mesh->vertex_count & ~7u;
    if (count == 0)
        return;
    for (int key = 0; key < KEYS; key++) {
        const struct smear_placement *const at = placement_of(d, key);
        const struct smear_depths *const depths = &at->now.depths;
        if (is_orthographic(&at->now) || (SMEAR_WITH_DEFORM && at->extra_count != 0))
            return;
        p->position[key] = at->position;
        p->setup[key] = (struct place_setup){ at->now.m, depths->near_distance, depths->far_distance, depths->depth_mantissa,
                                              depths->depth_shift, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX, viewport->width << 7,
                                              viewport->height << 7 };
        place_rows8_make(&p->rows[key], &p->setup[key]);
    }
    p->viewport = viewport;
    p->count = count;
    __builtin_memset(p->eight, 0, sizeof p->eight);
}

/* A bit where `which` is all ones. */
SMEAR_AVX2_INLINE lanes8i only8(lanes8i which, int32_t bit) { return which & bit; }

/* outcode_sides() */
SMEAR_AVX2_INLINE lanes8i sides8(const struct smear_place place[8], const struct smear_viewport *viewport)
{
    const int32_t right = viewport->width << 8, bottom = viewport->height << 8, guard = SMEAR_GUARD_PX << 8;
    const struct lanes8_four all = lanes8_turned(lanes8i_load_two(place, place + 4), lanes8i_load_two(place + 1, place + 5),
                                                 lanes8i_load_two(place + 2, place + 6), lanes8i_load_two(place + 3, place + 7));
    const lanes8i x = all.of[0], y = all.of[1];
    const lanes8i code = only8(x < 0, OUT_LEFT) | only8(x > right, OUT_RIGHT) | only8(y < 0, OUT_TOP) | only8(y > bottom, OUT_BOTTOM);
    const lanes8i far = (lanes8i_abs(x - (right >> 1)) > guard) | (lanes8i_abs(y - (bottom >> 1)) > guard);
    return code | only8(far & (code != 0), OUT_GUARD);
}

/* All ones where a b < c d. */
SMEAR_AVX2_INLINE lanes8i less8(lanes8i a, int32_t b, lanes8i c, int32_t d)
{
    const struct wide8 more = wide8_cross(a, lanes8i_all(b), c, lanes8i_all(d));
    return wide8_signs(&more);
}

/* smear_outcode_behind(), of what lies before the near plane. */
SMEAR_AVX2_INLINE lanes8i behind8(lanes8i x, lanes8i y, lanes8i w, const struct smear_viewport *viewport)
{
    const int32_t width = viewport->width, height = viewport->height;
    return lanes8i_all(OUT_NEAR) | only8(less8(x, 2, w, -width), OUT_LEFT) | only8(less8(w, width, x, 2), OUT_RIGHT)
         | only8(less8(y, 2, w, -height), OUT_TOP) | only8(less8(w, height, y, 2), OUT_BOTTOM);
}

static SMEAR_AVX2_FUNCTION void find_eight(struct path_places *p, uint32_t eight, uint32_t slot)
{
    lanes8i outcodes = lanes8i_all(0);
    p->eight[slot] = eight + 1;
    p->found[slot] = 255;
    for (int key = 0; key < KEYS; key++) {
        const int16_t *const v = p->position[key] + 24 * eight;
        const struct place_row8 *const row = p->rows[key].row;
        uint32_t found = places_avx2(p->place[slot][key], v, &p->rows[key]);
        lanes8i code = sides8(p->place[slot][key], p->viewport);
        if (found != 255) {
            lanes8 xy, yz;
            place_vertices8(&xy, &yz, v);
            const lanes8i w = place_row8_of(&row[2], xy, yz), near = w < p->setup[key].near_distance;
            code = lanes8i_choose(near, behind8(place_row8_of(&row[0], xy, yz), place_row8_of(&row[1], xy, yz), w, p->viewport), code);
            found |= lanes8i_signs(near);
        }
        p->found[slot] &= found;
        outcodes |= (lanes8i)((lanes8)code << (uint32_t)(8 * key));
    }
    lanes8i_store(p->outcodes[slot], outcodes);
}

bool smear_path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag)
{
    const uint32_t eight = (tag & 0xffffu) >> 3, k = tag & 7u, slot = eight % PATH_EIGHTS;
    if (p->eight[slot] != eight + 1)
        find_eight(p, eight, slot);
    if ((p->found[slot] >> k & 1u) == 0)
        return false;
    v->tag = tag;
    v->stored = 0;
    v->screen[OPEN] = p->place[slot][OPEN][k].screen;
    v->screen[CLOSE] = p->place[slot][CLOSE][k].screen;
    v->screen[MIDDLE] = p->place[slot][MIDDLE][k].screen;
    v->outcodes = p->outcodes[slot][k];
    return true;
}
#endif

#if SMEAR_WITH_SUBFRAMES && SMEAR_VERTEX_SETUP
void smear_path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d)
{
    p->d = d;
    p->viewport = &a->viewport;
    p->ready = true;
    for (int key = 0; key < KEYS && p->ready; key++)
        p->ready = smear_vertex_setup(&p->setup[key], placement_of(d, key), p->viewport);
}

bool smear_path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag)
{
    struct smear_homogeneous passing;
    v->tag = tag;
    v->stored = 0;
    v->outcodes = 0;
    for (int key = 0; key < KEYS; key++) {
        const int16_t *const position = placement_of(p->d, key)->position + 3 * (tag & 0xffffu);
        struct vertex_setup *const setup = &p->setup[key];
        if (!vertex_find(&v->screen[key], &passing, position, setup)
            && !smear_vertex_find_unready(&v->screen[key], &passing, position, setup))
            return false;
        v->outcodes |= (uint32_t)outcode_sides(&v->screen[key], p->viewport) << 8 * key;
    }
    return true;
}
#endif
