/* SPDX-License-Identifier: MIT */
/* course.c - see course.h. A closed curve in polar coordinates, whose radius and height are sums of sines. */
#include "platform/game/course.h"

#include <stddef.h>

enum {
    ACROSS = 6,                     /* vertices of a row: grass, kerb, road, kerb, grass lie between them */
    ROWS = COURSE_CHUNK + 1,
    TREES = 4, TREE_CORNERS = 5,    /* a pyramid */
    VERTICES = ROWS * ACROSS + TREES * TREE_CORNERS,
    TRIANGLES = COURSE_CHUNK * (ACROSS - 1) * 2 + TREES * 4,
    STEPS = 5                       /* log2 of vertex steps in a metre */
};

static smear_vec3 middle[COURSE_SEGMENTS], beside[COURSE_SEGMENTS];     /* beside: a metre to the right */
static int16_t position[COURSE_CHUNKS][VERTICES * 3];
static uint16_t corner[TRIANGLES * 3];
static uint8_t color[TRIANGLES * 4];
static smear_mesh mesh[COURSE_CHUNKS];

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

static int16_t *put(int16_t *to, smear_vec3 p)
{
    *to++ = (int16_t)(p.x >> (16 - STEPS));
    *to++ = (int16_t)(p.y >> (16 - STEPS));
    *to++ = (int16_t)(p.z >> (16 - STEPS));
    return to;
}

static void find_positions(int chunk)
{
    static const int32_t across[ACROSS] = { SMEAR_Q16(-30), SMEAR_Q16(-6), SMEAR_Q16(-5), SMEAR_Q16(5), SMEAR_Q16(6), SMEAR_Q16(30) };
    const int32_t first = chunk * COURSE_CHUNK;
    int16_t *to = position[chunk];
    for (int32_t row = 0; row < ROWS; row++)
        for (int i = 0; i < ACROSS; i++)
            to = put(to, course_place((first + row) << 16, across[i], 0));
    for (int32_t i = 0; i < TREES; i++) {
        const int32_t along = (first + 2 * i + 1) << 16, wide = SMEAR_Q16(1.4), deep = SMEAR_Q16(0.2);
        const int32_t right = ((i + chunk) & 1) != 0 ? SMEAR_Q16(9) + i * SMEAR_Q16(1) : SMEAR_Q16(-9) - chunk % 3 * SMEAR_Q16(2);
        to = put(to, course_place(along, right, SMEAR_Q16(4) + i * SMEAR_Q16(0.4)));
        to = put(to, course_place(along - deep, right - wide, 0));
        to = put(to, course_place(along - deep, right + wide, 0));
        to = put(to, course_place(along + deep, right + wide, 0));
        to = put(to, course_place(along + deep, right - wide, 0));
    }
}

static void add_triangle(int *count, int a, int b, int c, uint32_t rgb)
{
    uint16_t *to = &corner[3 * *count];
    uint8_t *paint = &color[4 * *count];
    to[0] = (uint16_t)a, to[1] = (uint16_t)b, to[2] = (uint16_t)c;
    paint[0] = (uint8_t)(rgb >> 16), paint[1] = (uint8_t)(rgb >> 8), paint[2] = (uint8_t)rgb, paint[3] = 255;
    ++*count;
}

/* Corners and colours are those of every chunk. */
static void make_corners(void)
{
    static const uint32_t strip[ACROSS - 1][2] = { { 0x4f9a3c, 0x5aa845 }, { 0xd02c2c, 0xf2f2f2 }, { 0x5a5d66, 0x63666f },
                                                   { 0xd02c2c, 0xf2f2f2 }, { 0x4f9a3c, 0x5aa845 } };
    static const uint32_t leaves[4] = { 0x1f6b3a, 0x2b8047, 0x17552d, 0x236f3d };
    int count = 0;
    for (int row = 0; row < COURSE_CHUNK; row++)
        for (int i = 0; i + 1 < ACROSS; i++) {
            const int a = row * ACROSS + i, b = a + ACROSS;
            add_triangle(&count, a, a + 1, b + 1, strip[i][row & 1]);
            add_triangle(&count, a, b + 1, b, strip[i][row & 1]);
        }
    for (int i = 0; i < TREES; i++)
        for (int side = 0; side < 4; side++) {
            const int top = ROWS * ACROSS + i * TREE_CORNERS;
            add_triangle(&count, top, top + 1 + side, top + 1 + (side + 1) % 4, leaves[side]);
        }
}

void course_make(void)
{
    find_middle();
    make_corners();
    for (int chunk = 0; chunk < COURSE_CHUNKS; chunk++) {
        find_positions(chunk);
        mesh[chunk] = (smear_mesh){ .position = position[chunk], .vertex_count = VERTICES, .index = corner,
                                    .triangle_count = TRIANGLES, .face_color = color, .shift = STEPS };
        smear_mesh_find_bounds(&mesh[chunk]);
    }
}

const smear_mesh *course_chunk(int chunk)
{
    return &mesh[(chunk % COURSE_CHUNKS + COURSE_CHUNKS) % COURSE_CHUNKS];
}
