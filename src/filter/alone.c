/* SPDX-License-Identifier: MIT */
/* alone.c - the filter alone: smear_filter_begin() and smear_filter_row(), for pixels of another renderer. */
#include "filter/filtered.h"

#include "smear_overlay.h"
#include "validate.h"
#include "frame.h"

#if SMEAR_WITH_RECONSTRUCT
/* Returns the depth code of a distance in q16: near NEAR / distance in units, then the two slopes. */
static uint16_t depth_code(uint32_t distance, int32_t near_plane)
{
    if (distance == 0)
        return 0;
    if (distance <= (uint32_t)near_plane)
        return 65535;
    int zeros = count_leading_zeros(distance);
    uint64_t near_units = (uint64_t)(uint32_t)near_plane * SMEAR_DEPTH_NEAR;        /* 51 bits */
    uint32_t r = recip_norm(distance << zeros);                                     /* 2^(61 - zeros) / d */
    uint64_t units = ((near_units >> 20) * r) >> (41 - zeros);
    if (units < 32768u)
        return (uint16_t)max_u32((uint32_t)units, 2);
    return (uint16_t)min_u32(32768u + (((uint32_t)units - 32768u + 8u) >> 4), 65535u);
}

/* Makes half the exposure's displacement in 1/8 px, no longer than the reach, from 1/16 px per frame. */
static void pack_velocity(const struct smear_rows *rows, const int16_t in[2], int32_t out[2])
{
    int32_t scale = rows->raster.velocity_scale;       /* q16 */
    int32_t x = mul_shift(in[0], scale, 9), y = mul_shift(in[1], scale, 9);  /* q11 */
    uint64_t square = (uint64_t)(mul_wide(x, x) + mul_wide(y, y));
    uint32_t reach = (uint32_t)rows->window.reach << 11;
    if (square > (uint64_t)reach * reach) {
        uint32_t length = sqrt_floor_64(square);
        int32_t factor = ratio_q30(reach, length);
        x = mul_shift(x, factor, 30);
        y = mul_shift(y, factor, 30);
    }
    out[0] = (x + 128) >> 8;
    out[1] = (y + 128) >> 8;
}

/* Takes a row of pixels that another renderer drew: row y of the frame, as smear_filter_row says. */
static void take_row(struct smear_rows *rows, int32_t y, const uint32_t *color, const uint32_t *depth,
                     const int16_t *velocity, int32_t near_plane)
{
    struct smear_window *w = &rows->window;
    const int32_t at = window_ring_row(w, y) * w->width;
    if ((y & (w->tile - 1)) == 0)
        for (int32_t i = 0; i < w->columns; i++)
            w->moving[i] = 0;
    for (int32_t x = 0; x < w->width; x++) {
        int32_t v[2] = { 0, 0 };
        if ((velocity[2 * x] | velocity[2 * x + 1]) != 0)
            pack_velocity(rows, velocity + 2 * x, v);
        if ((v[0] | v[1]) != 0)
            w->moving[x >> w->tile_shift] = 1;
        w->color[at + x] = color[x] & 0xffffffu;
        w->depth[at + x] = depth_code(depth[x], near_plane);
        window_velocity_store(w, at + x, v[0], v[1]);
    }
}

static int filter_row(struct smear_context *c, const uint32_t *color, const uint32_t *depth, const int16_t *velocity)
{
    const struct smear_window *w = &c->rows.window;
    const int32_t y = c->filtered->row++;
    const int row = y >> w->tile_shift;
    take_row(&c->rows, y, color, depth, velocity, c->shot.camera[0].near_plane);
    if (y + 1 != row_bottom(&c->rows, row))
        return SMEAR_OK;
    const int result = smear_filtered_roll(c->filtered, &c->rows, row);
    if (row == w->rows - 1)
        smear_frame_sum_up(c);
    return result;
}
#else
#define filter_row(c, color, depth, velocity) SMEAR_ERR_ARG
#endif

int smear_filter_begin(smear_context *c, const smear_frame *frame)
{
    if (!SMEAR_WITH_RECONSTRUCT || c == NULL || frame == NULL)
        return SMEAR_ERR_ARG;
    if (c->state == STATE_DRAWING)
        return SMEAR_ERR_ORDER;
    smear_frame f = *frame;
    if (f.camera == NULL || f.camera->near_plane <= 0)
        return FAULT(FRAME_CAMERA);
    int result = smear_resolve_frame(&f, &c->desc);
    if (result == SMEAR_OK)
        result = smear_check_overlay(f.overlay);
    if (SMEAR_OVERLAY_MOST && result == SMEAR_OK && f.overlay != NULL && f.overlay->points != NULL)
        result = FAULT(FRAME_POINTS);           /* there is no camera that sees them */
    if (result != SMEAR_OK)
        return result;
    if (!smear_method_is_filter(f.method) || f.method == SMEAR_CAMERA)
        return FAULT(FRAME_METHOD);
    if (c->desc.workers > 1)
        return FAULT(DESC_WORKERS);
    f.shutter.poses = 0;
    c->shot.camera[0] = *f.camera;
    c->shot.camera[0].half_height = 0;
    c->shot.camera_moves = false;
    smear_shot_expose(&c->shot, &f);
    smear_frame_keep(c, &f);
    c->state = STATE_FILTER;
    c->draw_count = 0;
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    smear_frame_prepare(c, false);
    SMEAR_ENTER_STAGE(SMEAR_STAGE_DRAW);
    c->rows.opaque = c->rows.blend = SMEAR_NO_TRIANGLE;
    c->filtered->row = 0;
    return SMEAR_OK;
}

int smear_filter_row(smear_context *c, const uint32_t *color, const uint32_t *depth, const int16_t *velocity)
{
    if (!SMEAR_WITH_RECONSTRUCT || c == NULL || color == NULL || depth == NULL || velocity == NULL)
        return SMEAR_ERR_ARG;
    if (c->state != STATE_FILTER)
        return SMEAR_ERR_ORDER;
    c->state = STATE_DRAWING;
    const int result = filter_row(c, color, depth, velocity);
    c->state = result != SMEAR_OK || c->filtered->row == c->rows.window.height ? STATE_IDLE : STATE_FILTER;
    return result;
}
