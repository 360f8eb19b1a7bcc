/* SPDX-License-Identifier: MIT */
/* camera_velocity.c - one pass over the depth codes of a row, whatever is drawn there. */
#include "filter/filter.h"


static inline bool is_unknown(const struct smear_window *w, int32_t at)
{
    return w->velocity8 != NULL ? w->velocity8[2 * at] == SMEAR_VELOCITY_UNKNOWN8
                                : w->velocity16[2 * at] == SMEAR_VELOCITY_UNKNOWN16;
}

/* A velocity as it is stored: in 1/8 px, and in 1/256 px per frame for who inspects it. */
struct kept {
    int32_t x, y, wide_x, wide_y;
};

static struct kept velocity_of(const struct smear_reprojection *r, const struct smear_camera_store *store,
                               int32_t x2, int32_t y2, uint32_t code)
{
    int32_t displacement[2], stored[2];
    smear_reproject(r, x2, y2, smear_depth_units((uint16_t)code), displacement);
    smear_velocity_store(displacement, store->velocity_scale, store->reach_q3, stored);
    struct kept k = { (stored[0] + 0x1000) >> 13, (stored[1] + 0x1000) >> 13, 0, 0 };
    if (SMEAR_WITH_DEBUG && store->inspect != NULL) {
        k.wide_x = narrow_sat((int64_t)displacement[0] * store->inspect_scale >> 16);
        k.wide_y = narrow_sat((int64_t)displacement[1] * store->inspect_scale >> 16);
    }
    return k;
}

static inline void keep(const struct smear_window *w, const struct smear_camera_store *store, int32_t at,
                        struct kept k)
{
    window_velocity_store(w, at, k.x, k.y);
    if (SMEAR_WITH_DEBUG && store->inspect != NULL) {
        store->inspect[2 * at] = k.wide_x;
        store->inspect[2 * at + 1] = k.wide_y;
    }
}

/* Fills in the pixels of a block; at[j] is where row j of it begins in the window. */
static void fill_block(const struct smear_window *w, const struct smear_reprojection *r,
                       const struct smear_camera_store *store, const int32_t at[4], int32_t x, int32_t y,
                       int32_t columns, int32_t rows)
{
    int32_t nearest = -1;
    for (int32_t j = 0; j < rows; j++)
        for (int32_t i = x; i < x + columns; i++)
            if (is_unknown(w, at[j] + i))
                nearest = max_i32(nearest, w->depth[at[j] + i]);
    if (nearest < 0)
        return;
    struct kept k = velocity_of(r, store, 2 * x + columns, 2 * y + rows, (uint32_t)nearest);
    int32_t units = (int32_t)smear_depth_units((uint16_t)nearest), least = units - (units >> 4);
    bool moves = false;
    for (int32_t j = 0; j < rows; j++)
        for (int32_t i = x; i < x + columns; i++) {
            struct kept own = k;
            if (!is_unknown(w, at[j] + i))
                continue;
            uint16_t code = w->depth[at[j] + i];
            if ((int32_t)smear_depth_units(code) < least)
                own = velocity_of(r, store, 2 * i + 1, 2 * (y + j) + 1, code);
            keep(w, store, at[j] + i, own);
            moves = moves || (own.x | own.y) != 0;
        }
    if (moves)
        w->moving[x >> w->tile_shift] = 1;
}

void smear_camera_velocity(const struct smear_window *w, const struct smear_reprojection *r,
                           const struct smear_camera_store *store, int32_t step, int32_t x0, int32_t x1,
                           int32_t y0, int32_t y1)
{
    for (int32_t y = y0; y < y1; y += step) {
        int32_t at[4], rows = min_i32(step, y1 - y);
        for (int32_t j = 0; j < rows; j++)
            at[j] = window_ring_row(w, y + j) * w->width;
        for (int32_t x = x0; x < x1; x += step)
            fill_block(w, r, store, at, x, y, min_i32(step, x1 - x), rows);
    }
}
