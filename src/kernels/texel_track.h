/* SPDX-License-Identifier: MIT */
/* texel_track.h - along a row of textured pixels from block to block, whose ends are exact. */
#ifndef SMEAR_KERNELS_TEXEL_TRACK_H
#define SMEAR_KERNELS_TEXEL_TRACK_H

#include "kernels/texel_run.h"

/* A run, and planes and place where its block ends; how planes change over a whole block of 2^log2 pixels, and what else a triangle's
 * places are made by (struct texel_planes). */
struct texel_track {
    struct texel_run run;
    int32_t q, u, v;            /* the order in which the assembly loads and stores them */
    struct place place;
    int32_t dq, du, dv;
    int32_t log2, up, slope;
    const uint16_t *seed;       /* smear_recip_seed */
    bool parabolic;
    int32_t part, n;            /* of a block that is not whole: 2^16 / n */
    int32_t qx, ux, vx;         /* how planes change from pixel to pixel */
#if SMEAR_ASM_ARMV7EM
    int32_t last, counter;      /* of a whole block: its last pixel's number; 256 less its pixels */
#endif
};

/* Goes on by a whole block: finds the place at its end, and the run's coordinates. The changes of changes are 0 before where blocks
 * are not parabolic. log2 is 2 .. 6. */
static inline void texel_track_next_reference(struct texel_track *k)
{
    const struct place from = k->place;
    k->q = add_wrap(k->q, k->dq);
    k->u = add_wrap(k->u, k->du);
    k->v = add_wrap(k->v, k->dv);
    k->place = place_divided(k->q, k->u, k->v, k->slope, k->parabolic);
    texcoord_run(&k->run, places_between(from, k->place, 1 << k->log2, k->up, k->parabolic, true));
}

/* The same of n pixels, as block_next returns them. */
static inline void texel_track_part_reference(struct texel_track *k, int32_t n)
{
    const struct place from = k->place;
    k->q = add_wrap(k->q, mul_wrap(k->qx, n));
    k->u = add_wrap(k->u, mul_wrap(k->ux, n));
    k->v = add_wrap(k->v, mul_wrap(k->vx, n));
    k->place = place_divided(k->q, k->u, k->v, k->slope, k->parabolic);
    texcoord_run(&k->run, places_between(from, k->place, n, k->up, k->parabolic, true));
}

#if SMEAR_ASM_ARMV6M
SMEAR_STATIC_ASSERT(sizeof(struct texel_run) == 52 && offsetof(struct texel_track, q) == 52
                        && offsetof(struct texel_track, place) == 64 && offsetof(struct texel_track, dq) == 76
                        && offsetof(struct texel_track, log2) == 88 && offsetof(struct texel_track, seed) == 100
                        && offsetof(struct texel_track, parabolic) == 104
                        && offsetof(struct texel_track, part) == 108 && offsetof(struct texel_track, qx) == 116,
                    "the assembly knows struct texel_track");
SMEAR_STATIC_ASSERT(offsetof(struct texel_run, du) == 4 && offsetof(struct texel_run, dv) == 8 && offsetof(struct texel_run, ddu) == 12
                        && offsetof(struct texel_run, ddv) == 16 && offsetof(struct texel_run, u) == 36
                        && offsetof(struct texel_run, v) == 40, "the assembly knows struct texel_run");

/* r3 = floor(r3 recip / 2^32), where recip, 2^30 at most, has its halves in r6 and r5. The sum of the middle products passes 2^31
 * where it is positive alone. Takes r1 and r2. */
#define ARMV6M_TIMES_RECIP \
        "uxth r1, r3\n\t" \
        "asrs r3, r3, #16\n\t" \
        "movs r2, r1\n\t" \
        "muls r2, r5\n\t" \
        "lsrs r2, r2, #16\n\t" \
        "muls r1, r6\n\t" \
        "adds r1, r1, r2\n\t" \
        "movs r2, r3\n\t" \
        "muls r2, r5\n\t" \
        "muls r3, r6\n\t" \
        "adds r2, r2, r1\n\t" \
        "bvc 1f\n\t" \
        "lsrs r2, r2, #16\n\t" \
        "b 2f\n" \
        "1: asrs r2, r2, #16\n" \
        "2: adds r3, r3, r2\n\t"

/* A coordinate's quotient, of the plane's value in r3. */
#define ARMV6M_QUOTIENT \
        "asrs r3, r3, #1\n\t" \
        "lsls r3, r4\n\t" \
        ARMV6M_TIMES_RECIP

/* One coordinate, whose plane lies AT bytes behind the track's start, its place PLACE, its change over a block CHANGE, and what the run
 * has of it START and STEP. ROUND is what turns_start and turns_step do, or nothing; CURVE is ARMV6M_CURVE or nothing. */
#define ARMV6M_COORDINATE(AT, PLACE, CHANGE, START, STEP, ROUND, CURVE, TIMES, SLOPE) \
        "ldr r1, [r0, #" CHANGE "]\n\t" \
        TIMES \
        "ldr r3, [r0, #" AT "]\n\t" \
        "adds r3, r3, r1\n\t" \
        "str r3, [r0, #" AT "]\n\t" \
        ARMV6M_QUOTIENT \
        "ldr r7, [r0, #" PLACE "]\n\t" \
        "str r3, [r0, #" PLACE "]\n\t" \
        "subs r3, r3, r7\n\t" \
        SLOPE \
        CURVE \
        "ldr r1, [r0, #92]\n\t" \
        "lsls r3, r1\n\t" \
        "lsls r7, r1\n\t" \
        ROUND \
        "str r3, [r0, #" STEP "]\n\t" \
        "str r7, [r0, #" START "]\n\t"

/* Of whole blocks: a change is one; the chord's step in r3; r3 = r2 (n - 1), log2 being in r1 from there on. Of others likewise. */
#define ARMV6M_WHOLE_SLOPE \
        "ldr r1, [r0, #88]\n\t" \
        "asrs r3, r1\n\t"

#define ARMV6M_WHOLE_LESS \
        "movs r3, r2\n\t" \
        "lsls r3, r1\n\t" \
        "subs r3, r3, r2\n\t"

#define ARMV6M_PART_TIMES \
        "ldr r2, [r0, #112]\n\t" \
        "muls r1, r2\n\t"

#define ARMV6M_PART_SLOPE \
        "uxth r1, r3\n\t" \
        "asrs r3, r3, #16\n\t" \
        "ldr r2, [r0, #108]\n\t" \
        "muls r1, r2\n\t" \
        "lsrs r1, r1, #16\n\t" \
        "muls r3, r2\n\t" \
        "adds r3, r3, r1\n\t"

#define ARMV6M_PART_LESS \
        "ldr r3, [r0, #112]\n\t" \
        "subs r3, r3, #1\n\t" \
        "muls r3, r2\n\t"

/* The chord's step is in r3, the rate at which q changes in r12: twice b, then the parabola's first step into r3. */
#define ARMV6M_CURVE(BEND, MASK, LESS) \
        "asrs r2, r3, #10\n\t" \
        "mov lr, r3\n\t" \
        "mov r3, r12\n\t" \
        "muls r2, r3\n\t" \
        "asrs r2, r2, #5\n\t" \
        LESS \
        "asrs r3, r3, #1\n\t" \
        "add r3, lr\n\t" \
        "ldr r1, [r0, #92]\n\t" \
        "lsls r2, r1\n\t" \
        MASK \
        "negs r2, r2\n\t" \
        "str r2, [r0, #" BEND "]\n\t"

#define ARMV6M_MASK "movs r1, #255\n\tbics r2, r1\n\t"

/* The rate into r3. */
#define ARMV6M_NEARNESS \
        "ldr r3, [r0, #96]\n\t" \
        ARMV6M_TIMES_RECIP \
        "movs r1, #19\n\t" \
        "subs r1, r1, r4\n\t" \
        "asrs r3, r1\n\t"

/* The rate at the block's end, and the mean of both into r12. */
#define ARMV6M_RATE \
        ARMV6M_NEARNESS \
        "ldr r1, [r0, #72]\n\t" \
        "str r3, [r0, #72]\n\t" \
        "adds r3, r3, r1\n\t" \
        "adds r3, r3, #2\n\t" \
        "asrs r3, r3, #1\n\t" \
        "mov r12, r3\n\t"

/* Of q in r3 the leading zeros less one into r4, and its reciprocal (recip_norm) into r6 and r5. The pointer to seeds lies SEED bytes
 * behind r0. */
#define ARMV6M_RECIP(SEED) \
        "movs r1, #1\n\t" \
        "lsls r1, r1, #11\n\t" \
        "cmp r3, r1\n\t" \
        "bge 3f\n\t" \
        "movs r3, r1\n" \
        "3: movs r4, #0\n\t" \
        "lsls r3, r3, #1\n\t" \
        "lsrs r1, r3, #24\n\t" \
        "bne 4f\n" \
        "3: adds r4, #8\n\t" \
        "lsls r3, r3, #8\n\t" \
        "lsrs r1, r3, #24\n\t" \
        "beq 3b\n" \
        "4: cmp r1, #16\n\t" \
        "bhs 4f\n\t" \
        "adds r4, #4\n\t" \
        "lsls r3, r3, #4\n" \
        "4: lsrs r1, r3, #30\n\t" \
        "bne 4f\n\t" \
        "adds r4, #2\n\t" \
        "lsls r3, r3, #2\n" \
        "4: cmp r3, #0\n\t" \
        "bmi 4f\n\t" \
        "adds r4, #1\n\t" \
        "lsls r3, r3, #1\n" \
        "4: lsls r1, r3, #1\n\t" \
        "lsrs r1, r1, #23\n\t" \
        "lsls r1, r1, #1\n\t" \
        "ldr r2, [r0, #" SEED "]\n\t" \
        "ldrh r1, [r2, r1]\n\t" \
        "lsrs r3, r3, #11\n\t" \
        "muls r3, r1\n\t" \
        "lsls r3, r3, #1\n\t" \
        "negs r3, r3\n\t" \
        "asrs r3, r3, #5\n\t" \
        "muls r3, r1\n\t" \
        "asrs r3, r3, #8\n\t" \
        "lsls r5, r1, #19\n\t" \
        "adds r5, r5, r3\n\t" \
        "lsrs r6, r5, #16\n\t" \
        "uxth r5, r5\n\t"

/* q, its reciprocal, and both coordinates. */
#define ARMV6M_TRACK(Q, U, V, RATE, CURVE_U, CURVE_V, TIMES, SLOPE) \
    __asm__ volatile( \
        ".syntax unified\n\t" \
        "ldr r1, [r0, #" Q "]\n\t" \
        TIMES \
        "ldr r3, [r0, #52]\n\t" \
        "adds r3, r3, r1\n\t" \
        "str r3, [r0, #52]\n\t" \
        ARMV6M_RECIP("100") \
        RATE \
        ARMV6M_COORDINATE("56", "64", U, "36", "4", "", CURVE_U, TIMES, SLOPE) \
        ARMV6M_COORDINATE("60", "68", V, "40", "8", \
                          "movs r1, #255\n\tbics r3, r1\n\tbics r7, r1\n\tadds r7, #128\n\t", CURVE_V, TIMES, SLOPE) \
        : \
        : "r"(r0) \
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r12", "lr", "cc", "memory")

/* 115 instructions, and 150 where blocks are bent: half of the compiler's. */
SMEAR_CALLED void texel_track_next_armv6m(struct texel_track *k)
{
    register struct texel_track *r0 __asm__("r0") = k;
    if (k->parabolic)
        ARMV6M_TRACK("76", "80", "84", ARMV6M_RATE, ARMV6M_CURVE("12", "", ARMV6M_WHOLE_LESS),
                     ARMV6M_CURVE("16", ARMV6M_MASK, ARMV6M_WHOLE_LESS), "", ARMV6M_WHOLE_SLOPE);
    else
        ARMV6M_TRACK("76", "80", "84", "", "", "", "", ARMV6M_WHOLE_SLOPE);
}

SMEAR_CALLED void texel_track_part_armv6m(struct texel_track *k, int32_t n)
{
    register struct texel_track *r0 __asm__("r0") = k;
    k->n = n;
    k->part = inverse_of(n);
    if (k->parabolic)
        ARMV6M_TRACK("116", "120", "124", ARMV6M_RATE, ARMV6M_CURVE("12", "", ARMV6M_PART_LESS),
                     ARMV6M_CURVE("16", ARMV6M_MASK, ARMV6M_PART_LESS), ARMV6M_PART_TIMES, ARMV6M_PART_SLOPE);
    else
        ARMV6M_TRACK("116", "120", "124", "", "", "", ARMV6M_PART_TIMES, ARMV6M_PART_SLOPE);
}
#define texel_track_next texel_track_next_armv6m
#define texel_track_part texel_track_part_armv6m
#else
#define texel_track_next texel_track_next_reference
#define texel_track_part texel_track_part_reference
#endif

/* Functions of their own where registers are few: the loops over pixels take them all. The assembly is a function. */
#if SMEAR_ON_64
#define TRACK_FUNCTION SMEAR_INLINE
#else
#define TRACK_FUNCTION static SMEAR_NOINLINE
#endif
#if SMEAR_ASM_ARMV6M
#define TRACK_BLOCK static inline
#else
#define TRACK_BLOCK TRACK_FUNCTION
#endif

/* Takes the length of whole blocks, 2^log2 pixels. */
static inline void texel_track_length(struct texel_track *k, int log2)
{
    k->log2 = log2;
#if SMEAR_ASM_ARMV7EM
    k->last = (1 << log2) - 1;
    k->counter = 256 - (1 << log2);
#endif
}

#endif
