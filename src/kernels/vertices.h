/* SPDX-License-Identifier: MIT */
/* vertices.h - a vertex from mesh steps to the screen on cores without vectors: what its draw's vertices share is made ready
 * once. */
#ifndef SMEAR_KERNELS_VERTICES_H
#define SMEAR_KERNELS_VERTICES_H

#include "base/fixmath.h"
#include "kernels/places.h"

/* Homogeneous position in a projection's scale. */
struct smear_homogeneous {
    int32_t x, y, w;
    int32_t distance;       /* w for perspective */
};

/* A row of a projection (struct place_setup): its factors are high 2^16 + 4 low. */
struct vertex_row {
    int32_t high[3];
    int32_t offset;
    int32_t low[3];
};

#if SMEAR_ASM_ARMV7EM
/* The same for assembly, in the order in which it is read. */
struct vertex_words {
    struct {
        uint32_t high_xy, low_xy, z;    /* pairs of halves: y is the upper one of two, the high one of z */
        int32_t offset;
    } row[3];
    int32_t w_least;                    /* ready for this w and w_span more */
    uint32_t w_span;
    int32_t zeros;
    const uint16_t *seed;
    int32_t half, down, x, y;
    int32_t depth_half, depth_down, depth_least;
    uint32_t depth_span;                /* depths that need no limit, after their shift down: from the least one on */
    int32_t depth_mantissa, limit, up, least, most;
};
#endif

/* A projection with perspective, and a frame; then what holds for all w that have so many bits as the last one asked for. */
struct vertex_setup {
#if SMEAR_ASM_ARMV7EM
    struct vertex_words words;
#endif
    struct vertex_row row[3];           /* x, y, w; |row| < 2^30 */
    int32_t zeros;                      /* leading zeros of w */
    const uint16_t *seed;               /* smear_recip_seed */
    int32_t half, down;                 /* from a high product to q8 px: 1 to 20 bits down, rounded */
    int32_t x, y;                       /* the frame's centre, q8 px */
    int32_t depth_low, depth_high;      /* halves of the mantissa, which is in [2^29, 2^30] */
    int32_t depth_half, depth_down;     /* from a high product, at most the limit, to q11, rounded */
    int32_t depth_limit, depth_up;
    int32_t depth_least, depth_most;
    int32_t depth_shift;
    int32_t near_distance, far_distance;
    int32_t top;                        /* 31 - zeros, or 31: no w yet */
};

#if SMEAR_ASM_ARMV7EM
/* Words of what vertex_setup_make gives; they are ready for no w. */
static inline void vertex_words_make(struct vertex_setup *v)
{
    struct vertex_words *const words = &v->words;
    for (int r = 0; r < 3; r++) {
        const struct vertex_row *const row = &v->row[r];
        words->row[r].high_xy = ((uint32_t)row->high[0] & 0xffffu) | (uint32_t)row->high[1] << 16;
        words->row[r].low_xy = (uint32_t)row->low[0] | (uint32_t)row->low[1] << 16;
        words->row[r].z = (uint32_t)row->low[2] | (uint32_t)row->high[2] << 16;
        words->row[r].offset = row->offset;
    }
    words->w_least = INT32_MIN;
    words->w_span = 0;
    words->seed = v->seed;
    words->x = v->x;
    words->y = v->y;
    words->depth_mantissa = v->depth_high * 65536 + v->depth_low;
    words->least = v->depth_least;
    words->most = v->depth_most;
}

/* The same of vertex_setup_for. */
static inline void vertex_words_for(struct vertex_setup *v)
{
    struct vertex_words *const words = &v->words;
    const int32_t first = max_i32(v->near_distance, 1 << v->top), last = min_i32(v->far_distance, INT32_MAX >> (30 - v->top));
    words->w_least = first <= last ? first : INT32_MIN;
    words->w_span = first <= last ? (uint32_t)(last - first) : 0u;
    words->zeros = v->zeros;
    words->half = v->half;
    words->down = v->down;
    words->depth_half = v->depth_half;
    words->depth_down = v->depth_down;
    words->depth_least = v->depth_up == 0 ? v->depth_least : INT32_MIN;
    words->depth_span = v->depth_up == 0 ? (uint32_t)(v->depth_most - v->depth_least) : 0u;
    words->limit = v->depth_limit;
    words->up = v->depth_up;
}
#endif

static inline void vertex_setup_make(struct vertex_setup *v, const struct place_setup *s)
{
    for (int r = 0; r < 3; r++) {
        for (int j = 0; j < 3; j++) {
            v->row[r].high[j] = s->m[r][j] >> 16;
            v->row[r].low[j] = (int32_t)(((uint32_t)s->m[r][j] & 0xffffu) >> 2);
        }
        v->row[r].offset = s->m[r][3];
    }
    v->near_distance = s->near_distance;
    v->far_distance = s->far_distance;
    v->zeros = 0;
    v->top = 31;
    v->seed = smear_recip_seed;
    v->x = s->x;
    v->y = s->y;
    v->depth_high = s->depth_mantissa >> 16;
    v->depth_low = s->depth_mantissa & 0xffff;
    v->depth_least = s->depth_least;
    v->depth_most = s->depth_most;
    v->depth_shift = s->depth_shift;
#if SMEAR_ASM_ARMV7EM
    vertex_words_make(v);
#endif
}

/* Makes the setup ready for all that have as many bits as w > 0. Returns false where places are so near to the eye or so far
 * from it that shifts change their direction or grow: then it is ready for none. */
static inline bool vertex_setup_for(struct vertex_setup *v, int32_t w)
{
    const int zeros = count_leading_zeros((uint32_t)w), up = v->depth_shift + zeros;
    v->top = 31;
#if SMEAR_ASM_ARMV7EM
    v->words.w_least = INT32_MIN;
    v->words.w_span = 0;
#endif
    if (zeros >= 21 || up > PLACES_UP_MOST)
        return false;
    v->zeros = zeros;
    v->top = 31 - zeros;
    v->down = 21 - zeros;
    v->half = 1 << (20 - zeros);
    v->depth_up = max_i32(up, 0);
    v->depth_limit = INT32_MAX >> v->depth_up;
    v->depth_down = min_i32(max_i32(-up, 0), 31);
    v->depth_half = v->depth_down == 0 ? 0 : 1 << (v->depth_down - 1);
#if SMEAR_ASM_ARMV7EM
    vertex_words_for(v);
#endif
    return true;
}

static inline int32_t vertex_row_of(const struct vertex_row *r, const int16_t v[3])
{
    const int32_t high = add_wrap(add_wrap(v[0] * r->high[0], v[1] * r->high[1]), v[2] * r->high[2]);
    const int32_t low = v[0] * r->low[0] + v[1] * r->low[1] + v[2] * r->low[2];
    return add_wrap(add_wrap(high, low >> 14), r->offset);
}

/* Finds where a vertex of three coordinates is, before and after the division. Returns false where it lies before the near or
 * behind the far plane, or where the setup is not ready for its w: then `now` is known and `screen` undefined. */
static inline bool vertex_find_reference(struct smear_screen *screen, struct smear_homogeneous *now, const int16_t v[3],
                                         const struct vertex_setup *s)
{
    now->x = vertex_row_of(&s->row[0], v);
    now->y = vertex_row_of(&s->row[1], v);
    now->w = now->distance = vertex_row_of(&s->row[2], v);
    if (now->w < s->near_distance || now->w > s->far_distance || now->w >> s->top != 1)
        return false;
    const int32_t r = (int32_t)recip_norm((uint32_t)now->w << s->zeros);
    screen->x = ((mulh_i32(now->x, r) + s->half) >> s->down) + s->x;
    screen->y = ((mulh_i32(now->y, r) + s->half) >> s->down) + s->y;
    int32_t depth = min_i32(mulh_i32(s->depth_high * 65536 + s->depth_low, r), s->depth_limit);
    depth = ((depth + s->depth_half) >> s->depth_down) << s->depth_up;
    screen->depth = clamp_i32(depth, s->depth_least, s->depth_most);
    return true;
}

#if SMEAR_ASM_ARMV7EM
SMEAR_STATIC_ASSERT(offsetof(struct vertex_setup, words) == 0 && offsetof(struct vertex_words, w_least) == 48
                        && offsetof(struct vertex_words, half) == 64 && offsetof(struct vertex_words, depth_half) == 80
                        && offsetof(struct vertex_words, limit) == 100 && sizeof(struct vertex_words) == 116,
                    "the assembly takes struct vertex_words word by word");

/* The next row at r1 times the vertex, x and y in r0 and z in r2: into OUT. */
#define ARMV7EM_VERTEX_ROW(OUT) \
    "ldm r1!, {r3, r4, r5, r6}\n\t" \
    "smlad " OUT ", r0, r3, r6\n\t" \
    "smuad r3, r0, r4\n\t" \
    "smlabt " OUT ", r2, r5, " OUT "\n\t" \
    "smlabb r3, r2, r5, r3\n\t" \
    "add " OUT ", " OUT ", r3, asr #14\n\t"

/* Goes to 1 where words are not ready for w in r11. Else recip_norm of it into r8. */
#define ARMV7EM_VERTEX_RECIP \
    "ldm r1!, {r3, r4, r5, r6}\n\t" \
    "sub r7, r11, r3\n\t" \
    "cmp r7, r4\n\t" \
    "bhi 1f\n\t" \
    "lsl r3, r11, r5\n\t" \
    "ubfx r4, r3, #22, #9\n\t" \
    "ldrh r4, [r6, r4, lsl #1]\n\t" \
    "lsrs r3, r3, #11\n\t" \
    "mov r5, #0x80000000\n\t" \
    "mls r3, r3, r4, r5\n\t" \
    "asrs r3, r3, #4\n\t" \
    "mul r3, r3, r4\n\t" \
    "lsls r4, r4, #19\n\t" \
    "add r8, r4, r3, asr #8\n\t"

/* The place into r5 and r6, the depth into r7; those that need a limit at 2. */
#define ARMV7EM_VERTEX_PLACE \
    "ldm r1!, {r2, r3, r4, r7}\n\t" \
    "smmla r5, r9, r8, r2\n\t" \
    "smmla r6, r10, r8, r2\n\t" \
    "asrs r5, r3\n\t" \
    "asrs r6, r3\n\t" \
    "adds r5, r5, r4\n\t" \
    "adds r6, r6, r7\n\t" \
    "ldm r1!, {r0, r2, r3, r4, r7}\n\t" \
    "smmla r7, r7, r8, r0\n\t" \
    "asrs r7, r2\n\t" \
    "subs r0, r7, r3\n\t" \
    "cmp r0, r4\n\t" \
    "bhi 2f\n" \
    "3: "

#define ARMV7EM_VERTEX_LIMIT \
    "2: ldm r1, {r0, r1, r2, r3}\n\t" \
    "cmp r7, r0\n\t" \
    "it gt\n\t" \
    "movgt r7, r0\n\t" \
    "lsls r7, r1\n\t" \
    "cmp r7, r2\n\t" \
    "it lt\n\t" \
    "movlt r7, r2\n\t" \
    "cmp r7, r3\n\t" \
    "it gt\n\t" \
    "movgt r7, r3\n\t" \
    "b 3b\n"

/* The vertex at r0, by the words at r1: place and depth in r5, r6 and r7, rows in r9, r10 and r11; r12 and lr are kept. At 1 only the
 * rows are known. ARMV7EM_VERTEX_LIMIT stands beside its way. */
#define ARMV7EM_VERTEX \
    "ldrsh r2, [r0, #4]\n\t" \
    "ldr r0, [r0]\n\t" ARMV7EM_VERTEX_ROW("r9") ARMV7EM_VERTEX_ROW("r10") ARMV7EM_VERTEX_ROW("r11") ARMV7EM_VERTEX_RECIP \
        ARMV7EM_VERTEX_PLACE

/* 50 instructions, where compilers take 100. */
SMEAR_INLINE bool vertex_find_armv7em(struct smear_screen *screen, struct smear_homogeneous *now, const int16_t v[3],
                                      const struct vertex_setup *s)
{
    register const int16_t *r0 __asm__("r0") = v;
    register const struct vertex_setup *r1 __asm__("r1") = s;
    register struct smear_screen *r2 __asm__("r2") = screen;
    register struct smear_homogeneous *r3 __asm__("r3") = now;
    __asm__ volatile(
        ".syntax unified\n\t"
        "mov r12, r2\n\t"
        "mov lr, r3\n\t" ARMV7EM_VERTEX
        "stm r12, {r5, r6, r7}\n\t"
        "movs r0, #1\n\t"
        "b 4f\n" ARMV7EM_VERTEX_LIMIT
        "1: movs r0, #0\n"
        "4: mov r12, r11\n\t"
        "stm lr, {r9, r10, r11, r12}"
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)
        :
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
    return r0 != NULL;
}
#endif

SMEAR_INLINE bool vertex_find(struct smear_screen *screen, struct smear_homogeneous *now, const int16_t v[3],
                              const struct vertex_setup *s)
{
#if SMEAR_ASM_ARMV7EM
    return vertex_find_armv7em(screen, now, v, s);
#else
    return vertex_find_reference(screen, now, v, s);
#endif
}

#endif
