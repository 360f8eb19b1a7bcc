/* SPDX-License-Identifier: MIT */
/* damage.h - how scenes are told apart, and which tiles change with them: see display/damage.h. */
#ifndef SMEAR_DAMAGE_DAMAGE_H
#define SMEAR_DAMAGE_DAMAGE_H

#include "display/damage.h"

/* Takes words into a hash of two lanes. */
void smear_damage_mix(uint32_t h[2], const int32_t *word, int count);

/* Words of a pointer. */
enum { POINTER_WORDS = sizeof(void *) > 4 ? 2 : 1 };

static inline void damage_put_pointer(int32_t *word, const void *p)
{
    word[0] = (int32_t)(uint32_t)(uintptr_t)p;
    if (POINTER_WORDS == 2)
        word[POINTER_WORDS - 1] = (int32_t)(uint32_t)((uint64_t)(uintptr_t)p >> 32);
}

static inline int32_t damage_bytes(int a, int b, int c, int d)
{
    return (int32_t)((uint32_t)a << 24 | (uint32_t)b << 16 | (uint32_t)c << 8 | (uint32_t)d);
}

/* Before anything is drawn: takes in the camera and what else a frame's picture of static draws depends on (`kind`: bits of
 * light space, edges, whether draws are compared, and reach), then each static draw, in order, then finds out whether it is the last
 * frame's scene (is_same). Of frames that compare, draws are none of it. */
void smear_damage_begin(struct smear_damage *d, const smear_camera *camera, uint32_t clear, uint16_t kind,
                        const struct smear_sun *sun);
void smear_damage_add(struct smear_damage *d, const smear_draw *draw);
void smear_damage_find(struct smear_damage *d, const struct smear_rows *rows, bool refresh);

/* Compares draw `i`; true where it changed, or something that all draws share. */
bool smear_damage_compare(struct smear_damage *d, const smear_draw *draw, uint32_t i);

/* It is seen in other tiles than in the last frame: these and those are damaged. */
void smear_damage_move(struct smear_damage *d, uint32_t i, const struct smear_tile_box *box, uint8_t age);

/* Draws from `first` on, which the last frame had and this one has not, are seen nowhere. */
void smear_damage_drop(struct smear_damage *d, uint32_t first, const smear_desc *desc);

/* Has tiles drawn over which something else lies than in the last frame. */
void smear_damage_find_overlay(struct smear_damage *d, const struct smear_rows *rows);

/* Ends a frame: all rows have been drawn or kept. `disturbed`: triangles that move by less than a step of their vertices were drawn
 * among what is static. */
void smear_damage_end(struct smear_damage *d, struct smear_rows *rows, bool disturbed);

#endif
