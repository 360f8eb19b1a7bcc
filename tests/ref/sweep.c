/* SPDX-License-Identifier: MIT */
/* sweep.c - see sweep.h. */
#include "tests/ref/sweep.h"

struct sweep sweep_of(uint32_t usual, uint32_t thorough)
{
    const uint32_t count = number_from("SMEAR_CASES", number_from("SMEAR_THOROUGH", 0) != 0 ? thorough : usual);
    return (struct sweep){ count < SWEEP_MOST ? count : SWEEP_MOST, number_from("SMEAR_FIRST", 1), getenv("SMEAR_FIRST") != NULL };
}

void sweep_seed(uint32_t number)
{
    random_state = number * 2654435761u + 77u;
    for (int i = 0; i < 4; i++)
        random_u32();
}

bool sweep_mean(double *mean, struct rig *r, sweep_draw draw, const void *scene, int instants, bool linear)
{
    const int values = 4 * r->desc.width * r->desc.height;
    double light[256];
    for (int i = 0; i < 256; i++)
        light[i] = linear ? light_of(i) : i;
    for (int k = 0; k < values; k++)
        mean[k] = 0;
    for (int i = 0; i < instants; i++) {
        if (!draw(r, scene, SMEAR_NONE, 0, (i + 0.5) / instants - 0.5))
            return false;
        for (int k = 0; k < values; k++)
            mean[k] += light[r->picture[k]];
    }
    for (int k = 0; k < values; k++)
        mean[k] = linear ? code_of(mean[k] / instants) : mean[k] / instants;
    return true;
}

double sweep_error(const struct rig *r, const double *mean)
{
    const int pixels = r->desc.width * r->desc.height;
    double squares = 0;
    for (int k = 0; k < 4 * pixels; k++)
        squares += k % 4 == 3 ? 0 : (r->picture[k] - mean[k]) * (r->picture[k] - mean[k]);
    return sqrt(squares / (3 * pixels));
}

void sweep_check(double *error, uint32_t count, const char *what, double most_of_nine, double most)
{
    qsort(error, count, sizeof *error, by_value);
    printf("    %u %s: half %.2f, 9 of 10 %.2f, all %.2f codes\n", (unsigned)count, what, error[count / 2], error[count * 9 / 10],
           error[count - 1]);
    CHECK_CLOSE(error[count * 9 / 10], 0, most_of_nine);
    CHECK_CLOSE(error[count - 1], 0, most);
}

/* ------------------------------------------------------------------ what moves */

smear_transform mover_pose(const struct mover *m, double part)
{
    double turned[9], basis[9], out[9];
    smear_transform pose;
    for (int i = 0; i < 9; i++)
        basis[i] = m->basis[i] / 16777216.0;
    turn3(turned, m->axis, m->angle * part);
    product3(out, turned, basis);
    for (int i = 0; i < 9; i++)
        pose.basis[i] = q24(out[i] * m->size[i % 3]);
    for (int i = 0; i < 3; i++)
        pose.origin[i] = q16(m->at[i] + part * m->way[i]);
    return pose;
}

const smear_mesh *textured_box(void)
{
    static const int8_t around[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    static int16_t position[6 * 12], uv[6 * 8];
    static uint16_t index[36];
    static const smear_mesh box = { .position = position, .uv = uv, .vertex_count = 24, .index = index, .triangle_count = 12,
                                    .shift = STEP, .uv_shift = 10 };
    for (int i = 0; i < 24; i++) {
        const int axis = i / 8, out = i / 4 % 2 * 2 - 1;
        position[3 * i + axis] = (int16_t)(256 * out);
        position[3 * i + (axis + 1) % 3] = (int16_t)(256 * around[i % 4][0]);
        position[3 * i + (axis + 2) % 3] = (int16_t)(256 * out * around[i % 4][1]);
        for (int k = 0; k < 2; k++)
            uv[2 * i + k] = (int16_t)(512 + 512 * around[i % 4][k]);
    }
    for (int i = 0; i < 36; i++)
        index[i] = (uint16_t)(i / 6 * 4 + square_index[i % 6]);
    return &box;
}
