/* SPDX-License-Identifier: MIT */
/* tiny_box.c - how check_kernels calls kernels/tiny_box.h. */
#include "kernels/tiny_box.h"

#include "tests/kernels/kernels.h"

enum { PLACE,
       UNITS,
       TO,
       LIGHT = TO + 2,
       LOOK = LIGHT + 6 }; /* words */
enum { STRIDE = 9,
       LEAST_AREA = 200 };

/* A triangle around the box: corners are up to 4 px from its first pixel. */
static bool make(struct tiny_box *b, struct kernel_call *c, bool shaded, bool linear, bool narrow)
{
    const uint32_t place = c->word[PLACE];
    const int32_t cx = (int32_t)(place >> 22 & 511u), cy = (int32_t)(place >> 23 & 511u);
    int32_t x1 = (int32_t)(place & 2047u) - 1024, y1 = (int32_t)(place >> 11 & 2047u) - 1024;
    int32_t x2 = (int32_t)(place * 2654435761u >> 21) - 1024, y2 = (int32_t)(place * 40503u >> 20 & 2047u) - 1024;
    int32_t area = x1 * y2 - x2 * y1;
    if (area < 0) {
        const int32_t x = x1, y = y1;
        area = -area;
        x1 = x2;
        y1 = y2;
        x2 = x;
        y2 = y;
    }
    if (c->n == 0 || area < LEAST_AREA)
        return false;
    const struct tiny_scale scale = tiny_scale_make(area);
    const int32_t q0 = (int32_t)(c->word[UNITS] >> 5), shift = (int32_t)(c->word[LOOK] & 15u);
    const int32_t q1 = clamp_i32(q0 + ((int32_t)c->word[TO] >> (5 + shift)), 1, (1 << 27) - 1);
    const int32_t q2 = clamp_i32(q0 + ((int32_t)c->word[TO + 1] >> (5 + shift)), 1, (1 << 27) - 1);
    *b = (struct tiny_box){ .e1 = y2 * cx - x2 * cy, .e2 = x1 * cy - y1 * cx, .down1 = -x2 * 256, .down2 = x1 * 256,
                            .right1 = y2 * 256, .right2 = -y1 * 256, .sum = area - (int32_t)(c->word[LOOK] >> 4 & 1u),
                            .up = scale.up, .recip = scale.recip, .stride = STRIDE, .depth = c->plane[0], .pixels = c->plane[1],
                            .columns = min_i32(c->n, 8), .rows = c->n < STRIDE ? 1 : c->n / STRIDE,
                            .color = narrow ? c->word[LIGHT] & 0xffffu : c->word[LIGHT], .shaded = shaded, .transfer = linear,
                            .narrow = narrow };
    for (int i = 0; i < 3; i++) {
        const uint32_t one = c->word[LIGHT + 2 * i], two = c->word[LIGHT + 2 * i + 1], most = linear ? 0xffffu : 0xff00u;
        const int32_t from = (int32_t)min_u32(one & 0xffffu, most);
        b->channel[i] = (struct tiny_channel){ (int32_t)min_u32(one >> 16, most) - from, (int32_t)min_u32(two >> 16, most) - from,
                                               ((uint32_t)from << 14) + (linear ? 0 : 1u << 21) };
    }
    tiny_units(b, q1 - q0, q2 - q0);
    tiny_codes(b, q0, min_i32(q0, min_i32(q1, q2)), max_i32(q0, max_i32(q1, q2)));
    return true;
}

#define CALLS(NAME, SHADED, LINEAR, NARROW)             \
    static void NAME##_reference(struct kernel_call *c) \
    {                                                   \
        struct tiny_box b;                              \
        if (make(&b, c, SHADED, LINEAR, NARROW))        \
            tiny_box_reference(&b);                     \
    }                                                   \
    static void NAME##_unrolled(struct kernel_call *c)  \
    {                                                   \
        struct tiny_box b;                              \
        if (make(&b, c, SHADED, LINEAR, NARROW))        \
            b.code_shift == 0 ? tiny_box_reference(&b) : tiny_box_unrolled(&b);                      \
    }                                                   \
    static void NAME##_best(struct kernel_call *c)      \
    {                                                   \
        struct tiny_box b;                              \
        if (make(&b, c, SHADED, LINEAR, NARROW))        \
            tiny_box(&b, b.narrow);                               \
    }

CALLS(flat, false, false, false)
CALLS(flat_narrow, false, false, true)
CALLS(codes, true, false, false)
CALLS(codes_narrow, true, false, true)
CALLS(light, true, true, false)

#define FORMS(NAME) .form = { { "reference", NAME##_reference }, { "unrolled", NAME##_unrolled }, { "best", NAME##_best } }

KERNELS(tiny_box) = {
    { .name = "tiny_box (one colour)", .most = 40, .size = { 2, 4 }, .timed = 40, FORMS(flat) },
    { .name = "tiny_box (one colour, narrow)", .most = 40, .size = { 2, 2 }, .timed = 40, FORMS(flat_narrow) },
    { .name = "tiny_box (shaded)", .most = 40, .size = { 2, 4 }, .timed = 40, FORMS(codes) },
    { .name = "tiny_box (shaded, narrow)", .most = 40, .size = { 2, 2 }, .timed = 40, FORMS(codes_narrow) },
    { .name = "tiny_box (linear light)", .most = 40, .size = { 2, 4 }, .timed = 40, FORMS(light) },
    { .name = NULL }
};
