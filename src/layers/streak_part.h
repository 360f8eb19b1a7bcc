/* SPDX-License-Identifier: MIT */
/* streak_part.h - what streak.c and streak_finish.c share: pixels as sums, and the part of an area that is merged. */
#ifndef SMEAR_STREAK_PART_H
#define SMEAR_STREAK_PART_H

#include "base/fixmath.h"
#include "base/pixel.h"
#include "layers/streak.h"

/* ------------------------------------------------------------------ pixels as sums */

/* Codes: blue, red, green and coverage (255 is one), 16 bits each. Sums wrap; their differences do not. */
typedef uint64_t lanes;

static const lanes lanes_codes = 0x00ff00ff00ff00ff, lanes_halves = 0x0080008000800080;

static inline lanes lanes_of(uint32_t p)
{
    return ((lanes)p << 24 | p) & lanes_codes;
}

static inline uint32_t lanes_pixel(lanes l)
{
    return (uint32_t)(l | l >> 24) & 0xffffffu;
}

/* Multiplies each lane; no product passes 16 bits. */
static inline lanes lanes_times(lanes l, uint32_t factor)
{
#if UINTPTR_MAX > 0xffffffffu
    return l * factor;
#else
    return (lanes)((uint32_t)(l >> 32) * factor) << 32 | (uint32_t)l * factor;
#endif
}

/* Divides a weighed sum by all weights (`over` is 2^22 / their sum), to nearest when half of them was added; the mean
 * of equal codes is exact. Products of two lanes at a time have 31 bits. */
static inline lanes lanes_mean(lanes weighed, uint32_t over)
{
    const lanes every_other = 0x0000ffff0000ffff, code = 0x000000ff000000ff;
    return (lanes_times(weighed & every_other, over) >> 22 & code)
         | (lanes_times(weighed >> 16 & every_other, over) >> 22 & code) << 16;
}

/* Linear light, 32 bits each; one is 65535. */
struct light {
    uint32_t r, g, b, a;
};

static inline struct light light_of_pixel(uint32_t p)
{
    return (struct light){ smear_srgb_decode[pixel_red(p)], smear_srgb_decode[pixel_green(p)],
                           smear_srgb_decode[pixel_blue(p)], 65535u };
}

static inline void light_add(struct light *to, const struct light *l, uint32_t part)
{
    to->r += l->r * part;
    to->g += l->g * part;
    to->b += l->b * part;
    to->a += l->a * part;
}

/* ------------------------------------------------------------------ a part of the area */

enum { STREAK_NEAR = 5 };       /* places where the depth of a mean is looked up */

/* The part of an area that is in work: steps [first, end) along the lines by places [low, high) across them. */
struct smear_streak_part {
    const struct smear_streak *s;
    const struct smear_streak_area *a;
    int32_t low, high;          /* places across */
    int32_t first, end;         /* steps; the first is a node */
    int32_t nodes;              /* along */
    int32_t along, across;      /* from a node to the next along, and to the next place across */
    uint32_t nearest, farthest; /* depth codes that are drawn */
    bool has_range;             /* they were found; else they are those that the group keeps to */
    int32_t step, side;         /* from a step or place across to the next in the group's planes */
    union {
        lanes *codes;
        struct light *light;
    } node;
    union {
        lanes *codes;           /* sums of all pixels before step line.base + i */
        struct light *light;
    } sums;
    /* The steps of each row that a mean reaches, where rows lie along the lines: mixed between nodes, means would go on
     * beyond them. */
    int16_t first_of[64], end_of[64];
    int16_t near_x[STREAK_NEAR], near_y[STREAK_NEAR];           /* from a pixel */
};

/* Finds the depth codes that are drawn and where to look up depths. It is called before the first part where groups
 * pass through each other: what is mixed must not depend on the pixels before. */
void smear_streak_find_depths(struct smear_streak_part *m);

/* Merges the means of a part's nodes, mixed for the pixels between them, over the background. */
void smear_streak_finish(struct smear_streak_part *m);

#endif
