/* SPDX-License-Identifier: MIT */
/* cases_many.c - cases of 256 to 20,000 triangles, drawn by 2 to 8 workers, with room for all or for some: see cases.h. From 256
 * on, workers assemble draws in parts of their own, and draw rows of tiles apart. Pictures are of 8 x 8 to 180 x 160 pixels; in parts, of
 * 90 x 60 at most, and of more than CASE_DEAR triangles one case of eight is: a row is filled again for each instant. */
#include "tests/fuzz/cases.h"

#include <stdlib.h>

enum { LEAST = 256,
       MOST = 20000,
       CLUSTER = 12 }; /* vertices that are near each other */

void case_make_many(struct fuzz_case *c, uint64_t number)
{
    struct source s = { .state = number * 0x9fb21c651e98df25u };
    const int fewer = source_range(&s, 0, 6), halves = fewer > 2 || source_chance(&s, 4) ? fewer : fewer + 3; /* few more often than many */
    const int most = MOST >> halves;
    const int triangles = source_range(&s, most / 2 > LEAST ? most / 2 : LEAST, most);
    const int draws = source_chance(&s, 3) ? 1 : source_range(&s, 1, CASE_DRAWS);
    case_make_of(c, s.state, triangles, draws);
}

void case_many_desc(struct fuzz_case *c)
{
    struct source *s = &c->source;
    smear_desc *d = &c->desc;
    const int32_t some = source_range(s, c->triangles / 16, c->triangles / 2);
    const bool has_room = source_chance(s, 3) || (c->triangles > CASE_DEAR && !source_chance(s, 8));
    d->max_triangles = (uint32_t)(has_room ? 4 * c->triangles : some);
    d->width = (int16_t)source_range(s, 8, has_room ? 180 : 90);
    d->height = (int16_t)source_range(s, 8, source_chance(s, 2) ? 30 : has_room ? 160 : 60);
    d->workers = (uint8_t)source_range(s, 2, 8);
    if (source_chance(s, 4)) /* rows of tiles apart: what takes no window, beside what takes memory */
        d->methods = (uint16_t)(SMEAR_SET(SMEAR_NONE) | SMEAR_SET(SMEAR_AUTO));
}

/* Nothing that keeps workers from drawing rows of tiles apart. */
void case_many_plain(struct fuzz_case *c)
{
    if (source_chance(&c->source, 2))
        return;
    c->with_overlay = false;
    for (int i = 0; i < CASE_DRAWS; i++)
        c->material[i].alpha = SMEAR_OPAQUE;
}

smear_desc case_many_other(struct fuzz_case *c)
{
    smear_desc d = c->desc;
    d.workers = 1;
    d.max_triangles = (uint32_t)(c->triangles * 4 + 20000);
    d.reuse.cache_static = d.reuse.buffer_age = 0;
    return d;
}

void case_many_mesh(struct fuzz_case *c, int *across, int *down, int *vertices, int *triangles)
{
    struct source *s = &c->source;
    const int count = c->triangles / c->draws + 1;
    *across = 1;
    while (2 * *across * *across < count)
        ++*across;
    *down = *across;
    if (source_chance(s, 3)) { /* long ones */
        *down = source_range(s, 1, 255);
        *across = (count + 2 * *down - 1) / (2 * *down);
    }
    *triangles = count;
    *vertices = source_range(s, CLUSTER, 2 * count + CLUSTER);
    *vertices = *vertices < 65535 ? *vertices : 65535;
}

/* Small triangles all over a box, each of vertices near each other. */
void case_many_cloud(struct fuzz_case *c, int16_t *position, int vertices, uint16_t *index, int triangles)
{
    struct source *s = &c->source;
    const int box = source_range(s, 100, 30000), size = source_range(s, 1, source_chance(s, 4) ? box : box / 8 + 1);
    for (int i = 0; i < vertices; i++) {
        int16_t *at = position + 3 * i, *first = position + 3 * (i / CLUSTER * CLUSTER);
        for (int k = 0; k < 3; k++) {
            const int32_t v = i % CLUSTER == 0 ? source_range(s, -box, box) : first[k] + source_range(s, -size, size);
            at[k] = (int16_t)(v > INT16_MAX ? INT16_MAX : v < INT16_MIN ? INT16_MIN
                                                                        : v);
        }
    }
    for (int i = 0; i < triangles; i++) {
        const int first = source_range(s, 0, (vertices - 1) / CLUSTER) * CLUSTER, rest = vertices - first;
        for (int k = 0; k < 3; k++)
            index[3 * i + k] = (uint16_t)(first + source_range(s, 0, (rest < CLUSTER ? rest : CLUSTER) - 1));
    }
}
