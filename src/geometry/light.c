/* SPDX-License-Identifier: MIT */
/* light.c - see light.h. */
#include "geometry/light.h"

#include "base/fixmath.h"
#include "base/pixel.h"

static SMEAR_PRODUCT_CALL int64_t dot(const int32_t a[3], const int32_t b[3]) { return dot_wide(a, 1, b, 1); }

/* Finds a vector at right angles to two others, and returns the bits that any of its magnitudes has. */
static SMEAR_PRODUCT_CALL uint64_t cross_product(int64_t out[3], const int32_t a[3], const int32_t b[3])
{
    uint64_t bits = 0;
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        out[i] = cross_wide(a[j], a[k], b[j], b[k]);
        bits |= magnitude(out[i]);
    }
    return bits;
}

/* Returns floor(sqrt(x)), exactly, of 33 to 48 bits: as sqrt_floor_64, in half of the precision. Normals have so many. */
static inline uint32_t sqrt_floor_48(uint64_t x)
{
    const uint32_t high = (uint32_t)(x >> 32), low = (uint32_t)x;
    const int shift = (count_leading_zeros(high) & ~1) - 16;
    /* n = x 2^shift has 47 or 48 bits. A line is within 3 %, Heron's rule then within 2^-11 in 16 bits. */
    const uint32_t top = (uint32_t)(x >> (16 - shift)), line = min_u32(11244u + ((top >> 16) * 11244u >> 15), 32767u);
    const uint32_t seed = smear_recip_seed[line >> 5 & 511u];           /* 2^25 / line */
    uint32_t r = 2 * line + (uint32_t)(((int32_t)((top >> 2) - line * line) >> 6) * (int32_t)seed >> 19);
    r = min_u32(max_u32(r, 32768), 65535);
    /* And within a step or two of 24 bits. */
    const int32_t rest = (int32_t)((top << 8 | (low << shift >> 8 & 255u)) - (r * r << 8));
    r = ((r << 8) + (uint32_t)(mulh_i32(rest, (int32_t)recip_norm(r << 16)) >> 14)) >> (shift >> 1);
    int32_t left = (int32_t)(low - r * r);
    while (left < 0)
        left += (int32_t)(2 * r-- - 1);
    while (left > (int32_t)(2 * r))
        left -= (int32_t)(2 * r++ + 1);
    return r;
}

static SMEAR_RARE uint32_t length_of_any(uint64_t square)
{
    return sqrt_floor_64(square);
}

/* This file has one copy, whose name linker scripts can choose for fast memory. */
static SMEAR_RARE uint32_t length_from(uint64_t square)
{
    if (SMEAR_LIGHT_IS_DEAR && square >> 48 == 0 && square >> 32 != 0)
        return sqrt_floor_48(square);
    return SMEAR_LIGHT_IS_DEAR ? length_of_any(square) : sqrt_floor_64(square);
}

/* Shifts numbers so that the largest, whose magnitude has the highest bit of `largest`, has that many bits. */
static void shift_to(int32_t *out, const int64_t *in, int count, uint64_t largest, int bits)
{
    const int shift = 64 - count_leading_zeros_64(largest | 1) - bits;
    for (int i = 0; i < count; i++)
        out[i] = (int32_t)(shift >= 0 ? in[i] >> shift : (int64_t)((uint64_t)in[i] << -shift));
}

void smear_unit_direction(int32_t out[3], const int32_t in[3])
{
    int32_t d[3];
    uint32_t largest = 1, square = 0;
    for (int i = 0; i < 3; i++)
        largest |= magnitude_i32(in[i]);
    const int shift = 32 - count_leading_zeros(largest) - 15;           /* squares have 30 bits, their sum 32 */
    for (int i = 0; i < 3; i++) {
        d[i] = shift >= 0 ? in[i] >> shift : in[i] * (1 << -shift);
        square += (uint32_t)(d[i] * d[i]);
    }
    const int32_t length = (int32_t)max_u32(length_from(square), 1);        /* 15 to 16 bits */
    for (int i = 0; i < 3; i++)
        out[i] = d[i] * 16384 / length;
}

void smear_sun_make(struct smear_sun *sun, const smear_light *light)
{
    static const smear_light usual = SMEAR_LIGHT_DEFAULT;
    if (light == NULL)
        light = &usual;
    smear_unit_direction(sun->direction, light->direction);
    if (SMEAR_WITH_LIGHTS)
        sun->lights = NULL;
    sun->white = true;
    for (int i = 0; i < 3; i++) {
        sun->ambient[i] = light->ambient[i];
        sun->diffuse[i] = light->diffuse[i];
        sun->white = sun->white && light->ambient[i] == light->ambient[0] && light->diffuse[i] == light->diffuse[0];
    }
}

/* Whether the columns have one length and are at right angles, within 1/256: the matrix is a rotation times a scale. */
static bool keeps_lengths(int32_t column[3][3], int64_t length)
{
    for (int j = 0; j < 3; j++)
        for (int k = j; k < 3; k++) {
            const int64_t off = dot(column[j], column[k]) - (j == k ? length : 0);
            if (off > length >> 8 || off < -(length >> 8))
                return false;
        }
    return true;
}

/* Makes the matrix that takes normals of the object to the world: cofactors of the basis, without the sign of its determinant. */
static void make_normal_matrix(int32_t m[3][3], const int32_t basis[9])
{
    int32_t b[9];
    int64_t wide[9];
    uint64_t largest = 0;
    for (int i = 0; i < 9; i++) {
        wide[i] = basis[i];
        largest |= magnitude(basis[i]);
    }
    shift_to(b, wide, 9, largest, 28);
    largest = 0;
    for (int i = 0; i < 3; i++)
        largest |= cross_product(wide + 3 * i, b + (i == 2 ? 0 : 3 * i + 3), b + (i == 0 ? 6 : 3 * i - 3));
    const int32_t row[3] = { b[0] >> 8, b[1] >> 8, b[2] >> 8 };
    shift_to(b, wide, 9, largest, 15);
    const bool mirrored = dot(row, b) < 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] = mirrored ? -b[3 * i + j] : b[3 * i + j];
}

void smear_shading_make(struct smear_shading *s, const smear_transform *object,
                        const smear_material *m, bool has_normals, smear_transfer transfer, const struct smear_sun *sun)
{
    s->last = NULL;
    s->sun = sun;
    s->transfer = transfer;
    s->lit = !m->unlit;
    for (int i = 0; i < 3; i++)
        s->base[i] = m->color[3] == 0 ? 65535u : smear_srgb_decode[m->color[i]];
    s->base[3] = m->color[3] == 0 ? 65535u : (u16lin)(m->color[3] * 257u);
    s->white = s->base[0] == 65535u && s->base[1] == 65535u && s->base[2] == 65535u
            && s->base[3] == 65535u;
    s->even = true;
    if (!s->lit)
        return;

    make_normal_matrix(s->normal_matrix, object->basis);
    if (!has_normals)
        return;
    int32_t column[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            column[j][i] = s->normal_matrix[i][j];
    const int64_t square = dot(column[0], column[0]);
    s->even = keeps_lengths(column, square);
    if (s->even) {
        const int32_t length = (int32_t)max_u32(length_from((uint64_t)square), 1);
        for (int j = 0; j < 3; j++)
            s->direction[j] = (int32_t)dot(column[j], sun->direction) / length * 512 / 127;     /* q14 to q23 / 127 */
    }
}

/* Returns how far a normal in the world, of 24 bits, lies along the light, q6 times its length; and the square of that. */
static inline int32_t along_light(uint64_t *square, const int32_t world[3], const int32_t direction[3])
{
    if (SMEAR_ON_64 && SMEAR_HAS_MUL64) {
        *square = (uint64_t)dot(world, world);
        return (int32_t)(dot(world, direction) >> 8);
    }
    /* h 2^12 + l: sums of products of the halves fit into 32 bits. */
    int32_t along_high = 0, along_low = 0, high = 0, cross = 0, low = 0;
    for (int i = 0; i < 3; i++) {
        int32_t h = world[i] >> 12, l = world[i] & 4095;
        along_high += h * direction[i];
        along_low += l * direction[i];
        high += h * h;
        cross += h * l;
        low += l * l;
    }
    *square = ((uint64_t)(uint32_t)high << 24) + (uint64_t)((int64_t)cross * 8192) + (uint32_t)low;
    return along_high * 16 + (along_low >> 8);
}

/* Returns max(0, cosine) for an object-space normal of any length, components up to 2^14. */
static uint32_t cosine_of(const struct smear_shading *s, const int32_t normal[3])
{
    int32_t world[3];
    uint64_t square;
    for (int i = 0; i < 3; i++) {
        const int32_t *m = s->normal_matrix[i];
        world[i] = (m[0] * normal[0] + m[1] * normal[1] + m[2] * normal[2]) >> 7;       /* 31 bits to 24 */
    }
    int32_t along = along_light(&square, world, s->sun->direction);
    if (along <= 0)
        return 0;
    uint32_t length = length_from(square);
    if (length == 0)
        return 0;
    /* along 2^10 / length, by reciprocal */
    int zeros = count_leading_zeros(length);
    uint32_t q = mulh_u32((uint32_t)along, recip_norm(length << zeros));
    int shift = 61 - 32 - zeros - 8 - 2;
    q = shift >= 0 ? q >> shift : q << -shift;
    return min_u32(q, 65536u);
}

uint32_t smear_light_normal(const struct smear_shading *s, const int8_t normal[3])
{
    if (s->even) {
        int32_t sum = normal[0] * s->direction[0] + normal[1] * s->direction[1]
                    + normal[2] * s->direction[2];
        return (uint32_t)clamp_i32(sum >> 7, 0, 65536);
    }
    int32_t n[3] = { normal[0], normal[1], normal[2] };
    return cosine_of(s, n);
}

/* The same of a face, whose normal may be that of the face before. */
static inline uint32_t cosine_of_face(const struct smear_shading *s, const int32_t n[3])
{
    struct smear_lit *const last = SMEAR_LIGHT_IS_DEAR ? s->last : NULL;
    if (last != NULL && n[0] == last->normal[0] && n[1] == last->normal[1] && n[2] == last->normal[2])
        return last->cosine;
    const uint32_t cosine = cosine_of(s, n);
    if (last != NULL) {
        for (int i = 0; i < 3; i++)
            last->normal[i] = n[i];
        last->cosine = cosine;
    }
    return cosine;
}

SMEAR_NOINLINE void smear_face_normal(int32_t n[3], const int32_t u[3], const int32_t v[3])
{
    int64_t normal[3];
    const uint64_t largest = cross_product(normal, u, v);
    shift_to(n, normal, 3, largest, 14);
}

/* Returns the light of a face with edges of any length. */
static SMEAR_RARE uint32_t light_of_long(const struct smear_shading *s, const int32_t u[3], const int32_t v[3])
{
    int32_t n[3];
    smear_face_normal(n, u, v);
    return cosine_of_face(s, n);
}

uint32_t smear_light_face(const struct smear_shading *s, const int16_t a[3], const int16_t b[3],
                          const int16_t c[3])
{
    const int32_t u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] }, v[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
    const int32_t size = (u[0] ^ u[0] >> 31) | (u[1] ^ u[1] >> 31) | (u[2] ^ u[2] >> 31) | (v[0] ^ v[0] >> 31)
                       | (v[1] ^ v[1] >> 31) | (v[2] ^ v[2] >> 31);
    if (!SMEAR_SMALL_FILE && size < 1 << 15) {       /* cross products have 31 bits */
        int32_t n[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
        const uint32_t largest = 1u | (uint32_t)abs_i32(n[0]) | (uint32_t)abs_i32(n[1]) | (uint32_t)abs_i32(n[2]);
        const int shift = 32 - count_leading_zeros(largest) - 14;
        if (shift >= 0) {
            n[0] >>= shift;
            n[1] >>= shift;
            n[2] >>= shift;
        } else {
            n[0] *= 1 << -shift;
            n[1] *= 1 << -shift;
            n[2] *= 1 << -shift;
        }
        return cosine_of_face(s, n);
    }
    return light_of_long(s, u, v);
}

/* Returns the light of a channel, q16: not above one. */
static inline uint32_t light_of(const struct smear_shading *s, int channel, uint32_t cosine)
{
    const uint32_t diffuse = (uint32_t)s->sun->diffuse[channel] * cosine >> 16;
    return min_u32((uint32_t)s->sun->ambient[channel] + diffuse, 65536u);
}

void smear_shade(struct smear_color *out, const struct smear_shading *s, const uint8_t color[4],
                 const uint8_t face_color[4], uint32_t cosine)
{
    uint32_t light = s->lit ? light_of(s, 0, cosine) : 65536u;
    for (int i = 0; i < 3; i++) {
        if (s->lit && !s->sun->white)
            light = light_of(s, i, cosine);
        out->channel[i] = shading_value(s, shading_channel(s, i, color, face_color) * light >> 16);
    }
    out->channel[3] = shading_alpha(s, color, face_color);
}

uint32_t smear_color_pack(const struct smear_color *color, smear_transfer transfer)
{
    const uint16_t *c = color->channel;
    uint32_t packed = c[3] >> 8;
    for (int i = 0; i < 3; i++)
        packed = packed << 8 | code_of_channel((uint32_t)c[i] << 8, transfer);
    return packed;
}
