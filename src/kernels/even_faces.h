/* SPDX-License-Identifier: MIT */
/* even_faces.h - whether each face of a mesh has one colour and one normal, as flat ones come out of modelling programs. It is
 * looked for in all triangles of all draws of each frame. */
#ifndef SMEAR_KERNELS_EVEN_FACES_H
#define SMEAR_KERNELS_EVEN_FACES_H


/* Triples of indices; of each vertex a colour of four bytes and a normal of three, or null. */
struct even_faces {
    const uint16_t *index;
    uint32_t triangles, vertices;
    const uint8_t *normal, *color;
};

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

/* False, too, if an index is too large. */
static inline bool even_faces(const struct even_faces *f)
{
    const uint8_t *normal = f->normal, *color = f->color;
    const uint16_t *index = f->index, *const end = index + 3 * f->triangles;
    for (; index < end; index += 3) {
        const uint32_t a = index[0], b = index[1], c = index[2];
        if (max_u32(a, max_u32(b, c)) >= f->vertices)
            return false;
        if (normal != NULL
            && !(even_normal(normal + 3 * a, normal + 3 * b) && even_normal(normal + 3 * a, normal + 3 * c)))
            return false;
        if (color != NULL && !(even_color(color + 4 * a, color + 4 * b) && even_color(color + 4 * a, color + 4 * c)))
            return false;
    }
    return true;
}

#endif
