/* SPDX-License-Identifier: MIT */
/* skin.c - all products fit 32 bits, for cores without a wide multiply. */
#include "model/skin.h"

#include "base/fixmath.h"

#if SMEAR_WITH_MODEL

/* Clamps to int16; it takes two instructions where nothing is to be done. */
static inline int16_t clamp_step(int32_t x)
{
    return (int16_t)((int16_t)x == x ? x : x < 0 ? -32768 : 32767);
}

/* Returns the first weight: what the others lack to 256. */
static inline int32_t first_weight(const uint8_t *weight, uint32_t per_vertex)
{
    int32_t first = 256;
    for (uint32_t k = 1; k < per_vertex; k++)
        first -= weight[k - 1];
    return first;
}

/* Multiplies a vertex by a row of a joint: q4, below 2^23. The sum of products stays below 3 x 21845 x 32768 < 2^31. */
static inline int32_t by_row(const int32_t row[4], int32_t x, int32_t y, int32_t z)
{
    return ((row[0] * x + row[1] * y + row[2] * z) >> 10) + row[3];
}

void smear_skin_positions(int16_t *out, const int16_t *in, const struct smear_influences *influences,
                          const struct smear_joint_matrix *joint)
{
    const uint8_t *at = influences->at;
    const int16_t *end = in + 3 * influences->count;
    uint32_t n = influences->per_vertex;
    for (; in != end; in += 3, out += 3, at += 2 * n - 1) {
        int32_t x = in[0], y = in[1], z = in[2];
        const struct smear_joint_matrix *j = joint + at[0];
        int32_t px = by_row(j->row[0], x, y, z), py = by_row(j->row[1], x, y, z),
                pz = by_row(j->row[2], x, y, z);
        if (n == 1 || at[n] == 0) {
            out[0] = clamp_step((px + 8) >> 4);
            out[1] = clamp_step((py + 8) >> 4);
            out[2] = clamp_step((pz + 8) >> 4);
            continue;
        }
        int32_t w = first_weight(at + n, n);    /* of 256: weighted sums stay below 2^31 */
        px *= w;
        py *= w;
        pz *= w;
        for (uint32_t k = 1; k < n && (w = at[n + k - 1]) != 0; k++) {
            j = joint + at[k];
            px += w * by_row(j->row[0], x, y, z);
            py += w * by_row(j->row[1], x, y, z);
            pz += w * by_row(j->row[2], x, y, z);
        }
        out[0] = clamp_step((px + 2048) >> 12);
        out[1] = clamp_step((py + 2048) >> 12);
        out[2] = clamp_step((pz + 2048) >> 12);
    }
}

/* Scales to length 127. sqrt_q3 wants less than 2^20, so components get 9 bits; the result is right within 1. */
static void unit_normal(int8_t out[3], int32_t x, int32_t y, int32_t z)
{
    uint32_t size = (uint32_t)max_i32(abs_i32(x), max_i32(abs_i32(y), abs_i32(z)));
    out[0] = out[1] = out[2] = 0;
    if (size == 0)
        return;
    int shift = 23 - count_leading_zeros(size);
    x = scale_sat(x, -shift);
    y = scale_sat(y, -shift);
    z = scale_sat(z, -shift);
    uint32_t length = sqrt_q3((uint32_t)(x * x + y * y + z * z));       /* 8 x length, at least 2040 */
    int32_t factor = (int32_t)((127u * 8u << 12) / length);
    out[0] = (int8_t)clamp_i32((x * factor + 2048) >> 12, -127, 127);
    out[1] = (int8_t)clamp_i32((y * factor + 2048) >> 12, -127, 127);
    out[2] = (int8_t)clamp_i32((z * factor + 2048) >> 12, -127, 127);
}

void smear_skin_normals(int8_t *out, const int8_t *in, const struct smear_influences *influences,
                        const struct smear_joint_matrix *joint)
{
    const uint8_t *at = influences->at;
    uint32_t n = influences->per_vertex;
    for (uint32_t i = influences->count; i > 0; i--, in += 3, out += 3, at += 2 * n - 1) {
        int32_t x = in[0], y = in[1], z = in[2], sum[3] = { 0, 0, 0 };
        int32_t w = first_weight(at + n, n);
        for (uint32_t k = 0; k < n && w != 0; w = k + 1 < n ? at[n + k] : 0, k++) {
            for (int row = 0; row < 3; row++) {         /* at most 256 x 3 x 21845 x 128 < 2^31 */
                const int32_t *r = joint[at[k]].row[row];
                sum[row] += w * (r[0] * x + r[1] * y + r[2] * z);
            }
        }
        unit_normal(out, sum[0], sum[1], sum[2]);
    }
}

void smear_morph_positions(int16_t *position, const smear_model_target *target,
                           const smear_model_delta *delta, int16_t weight)
{
    int shift = 14 - (int)target->shift;
    int32_t half = 1 << (shift - 1);
    delta += target->delta_first;
    for (uint32_t i = target->delta_count; i > 0; i--, delta++) {
        int16_t *p = position + 3 * delta->vertex;
        for (int axis = 0; axis < 3; axis++)
            p[axis] = clamp_step(p[axis] + ((weight * delta->step[axis] + half) >> shift));
    }
}

void smear_morph_normals(int8_t *normal, const smear_model_target *target, const smear_model_delta *delta,
                         const int8_t *delta_normal, int16_t weight)
{
    delta += target->delta_first;
    delta_normal += target->normal_first;
    for (uint32_t i = target->delta_count; i > 0; i--, delta++, delta_normal += 3) {
        int8_t *n = normal + 3 * delta->vertex;
        for (int axis = 0; axis < 3; axis++)
            n[axis] = (int8_t)clamp_i32(n[axis] + ((weight * delta_normal[axis] + 4096) >> 13), -127, 127);
    }
}

void smear_unit_normals(int8_t *normal, uint32_t count)
{
    for (; count > 0; count--, normal += 3)
        unit_normal(normal, normal[0], normal[1], normal[2]);
}

#endif
