/* SPDX-License-Identifier: MIT */
/* course.c - see course.h. A closed curve in polar coordinates, whose radius and height are sums of sines. */
#include "platform/game/course.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    ACROSS = 6,                     /* vertices of a row: grass, kerb, road, kerb, grass lie between them */
    TREE_CORNERS = 5,               /* a pyramid */
    PAIR = 2 * ACROSS + TREE_CORNERS,       /* vertices of two segments: their first rows, a tree */
    PAIR_TRIANGLES = 2 * (ACROSS - 1) * 2 + 4,
    PAIRS = COURSE_SEGMENTS / 2, SEEN = COURSE_SEEN / 2 + 1,
    TRIANGLES = SEEN * PAIR_TRIANGLES,
    NEAR_LEAST = 4,                 /* pairs; beyond them, and one more for 80 rows of the picture, a segment is half a row high */
    STEPS = 5                       /* log2 of vertex steps in a metre */
};

static smear_vec3 middle[COURSE_SEGMENTS], beside[COURSE_SEGMENTS];     /* beside: a metre to the right */
/* The circuit, and so much of its beginning once more that what is seen lies in one piece from any pair on. */
static int16_t position[(PAIRS + SEEN) * PAIR + ACROSS][3];
static uint16_t corner[TRIANGLES * 3];
static uint8_t color[TRIANGLES * 4];
static smear_mesh mesh = { .vertex_count = SEEN * PAIR + ACROSS, .index = corner, .face_color = color, .shift = STEPS };

static int32_t times(int32_t length, int32_t factor_q24)
{
    return (int32_t)((int64_t)length * factor_q24 >> 24);
}

static int wrapped(int segment)
{
    return (segment % COURSE_SEGMENTS + COURSE_SEGMENTS) % COURSE_SEGMENTS;
}

static void find_middle(void)
{
    for (int i = 0; i < COURSE_SEGMENTS; i++) {
        const uint32_t a = (uint32_t)i * (UINT32_MAX / COURSE_SEGMENTS + 1u);
        const int32_t radius = SMEAR_Q16(112) + times(SMEAR_Q16(24), smear_sin(2 * a)) + times(SMEAR_Q16(5), smear_sin(5 * a))
                             + times(SMEAR_Q16(12), smear_sin(3 * a + SMEAR_DEGREES(50)));
        const int32_t height = times(SMEAR_Q16(4), smear_sin(3 * a)) + times(SMEAR_Q16(2), smear_cos(5 * a));
        middle[i] = smear_vec(times(radius, smear_cos(a)), height, times(radius, smear_sin(a)));
    }
    /* The camera's own way to look along the road says where its right is. */
    for (int i = 0; i < COURSE_SEGMENTS; i++) {
        const smear_vec3 from = middle[wrapped(i - 1)], to = middle[wrapped(i + 1)];
        const smear_transform along = smear_look_at(from, smear_vec(to.x, from.y, to.z), smear_vec(0, SMEAR_Q16(1), 0));
        beside[i] = smear_vec(along.basis[0] >> 8, 0, along.basis[6] >> 8);
    }
}

smear_vec3 course_place(int32_t along, int32_t right, int32_t up)
{
    const int i = wrapped(along >> 16), next = wrapped(i + 1);
    const int32_t part = (along & 0xffff) << 8;         /* q24 */
    const smear_vec3 a = middle[i], b = middle[next], p = beside[i], q = beside[next];
    const int32_t x = p.x + times(q.x - p.x, part), z = p.z + times(q.z - p.z, part);
    return smear_vec(a.x + times(b.x - a.x, part) + (int32_t)((int64_t)x * right >> 16), a.y + times(b.y - a.y, part) + up,
                     a.z + times(b.z - a.z, part) + (int32_t)((int64_t)z * right >> 16));
}

int32_t course_bend(int32_t along)
{
    const int i = wrapped(along >> 16);
    const smear_vec3 p = beside[i], q = beside[wrapped(i + 1)];
    return (int32_t)(((int64_t)p.x * q.z - (int64_t)p.z * q.x) >> 16);
}

/* ------------------------------------------------------------------ meshes */

static void put(int vertex, smear_vec3 p)
{
    position[vertex][0] = (int16_t)(p.x >> (16 - STEPS));
    position[vertex][1] = (int16_t)(p.y >> (16 - STEPS));
    position[vertex][2] = (int16_t)(p.z >> (16 - STEPS));
}

static void put_row(int vertex, int32_t segment)
{
    static const int32_t across[ACROSS] = { SMEAR_Q16(-30), SMEAR_Q16(-6), SMEAR_Q16(-5), SMEAR_Q16(5), SMEAR_Q16(6), SMEAR_Q16(30) };
    for (int i = 0; i < ACROSS; i++)
        put(vertex + i, course_place(segment << 16, across[i], 0));
}

static void put_tree(int vertex, int32_t pair)
{
    const int32_t i = pair % 4, group = pair / 4, along = (2 * pair + 1) << 16, wide = SMEAR_Q16(1.4), deep = SMEAR_Q16(0.2);
    const int32_t right = ((i + group) & 1) != 0 ? SMEAR_Q16(9) + i * SMEAR_Q16(1) : SMEAR_Q16(-9) - group % 3 * SMEAR_Q16(2);
    put(vertex, course_place(along, right, SMEAR_Q16(4) + i * SMEAR_Q16(0.4)));
    put(vertex + 1, course_place(along - deep, right - wide, 0));
    put(vertex + 2, course_place(along - deep, right + wide, 0));
    put(vertex + 3, course_place(along + deep, right + wide, 0));
    put(vertex + 4, course_place(along + deep, right - wide, 0));
}

static void add_triangle(int *count, int a, int b, int c, uint32_t rgb)
{
    uint16_t *to = &corner[3 * *count];
    uint8_t *paint = &color[4 * *count];
    to[0] = (uint16_t)a, to[1] = (uint16_t)b, to[2] = (uint16_t)c;
    paint[0] = (uint8_t)(rgb >> 16), paint[1] = (uint8_t)(rgb >> 8), paint[2] = (uint8_t)rgb, paint[3] = 255;
    ++*count;
}

/* A row of four-cornered pieces from one row of vertices to another. */
static void add_strips(int *count, int from, int to, const uint32_t *rgb)
{
    for (int i = 0; i + 1 < ACROSS; i++) {
        add_triangle(count, from + i, from + i + 1, to + i + 1, rgb[i]);
        add_triangle(count, from + i, to + i + 1, to + i, rgb[i]);
    }
}

/* Corners and colours are those of any pairs. Far ones are a piece of the mean of both segments' colours, and of their trees the
 * narrow sides are left out. */
static void make_corners(int near)
{
    static const uint32_t strip[3][ACROSS - 1] = { { 0x4f9a3c, 0xd02c2c, 0x5a5d66, 0xd02c2c, 0x4f9a3c },
                                                   { 0x5aa845, 0xf2f2f2, 0x63666f, 0xf2f2f2, 0x5aa845 },
                                                   { 0x55a141, 0xe18f8f, 0x5f626b, 0xe18f8f, 0x55a141 } };
    static const uint32_t leaves[4] = { 0x1f6b3a, 0x2b8047, 0x17552d, 0x236f3d };
    int count = 0;
    for (int pair = 0; pair < SEEN; pair++) {
        const int first = pair * PAIR, top = first + 2 * ACROSS;
        const bool far = pair >= near;
        if (!far)
            add_strips(&count, first, first + ACROSS, strip[0]);
        add_strips(&count, far ? first : first + ACROSS, first + PAIR, strip[far ? 2 : 1]);
        for (int side = 0; side < 4; side += far ? 2 : 1)
            add_triangle(&count, top, top + 1 + side, top + 1 + (side + 1) % 4, leaves[side]);
    }
    mesh.triangle_count = (uint32_t)count;
}

void course_make(int height)
{
    find_middle();
    make_corners(NEAR_LEAST + height / 80);
    for (int pair = 0; pair < PAIRS + SEEN; pair++) {
        put_row(pair * PAIR, 2 * pair);
        put_row(pair * PAIR + ACROSS, 2 * pair + 1);
        put_tree(pair * PAIR + 2 * ACROSS, pair % PAIRS);
    }
    put_row((PAIRS + SEEN) * PAIR, 2 * (PAIRS + SEEN));
}

const smear_mesh *course_ahead(int32_t along)
{
    mesh.position = position[wrapped(along >> 16) / 2 * PAIR];
    return &mesh;
}
