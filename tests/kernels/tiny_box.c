/* SPDX-License-Identifier: MIT */
/* tiny_box.c - how check_kernels calls kernels/tiny_box.h and tiny_corners.h. */
#include "kernels/tiny_corners.h"

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
                            .color = narrow ? c->word[LIGHT] & 0xffffu : c->word[LIGHT], .shaded = shaded, .linear = linear,
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

/* Corners less than 8 px apart, anywhere; units and colours; then what the box's numbers are. */
static void corners_by(struct kernel_call *c, bool best)
{
    struct tiny_box b = { 0 };
    int32_t v[3][5];
    const int32_t x = (int32_t)(c->word[0] & 0xfffu) - 2048, y = (int32_t)(c->word[0] >> 12 & 0xfffu) - 2048;
    const uint32_t round = c->word[0] >> 31 << 21;
    for (int i = 0; i < 3; i++) {
        v[i][0] = x * 256 + (int32_t)(c->word[1 + i] & 2047u) - 1024;
        v[i][1] = y * 256 + (int32_t)(c->word[1 + i] >> 11 & 2047u) - 1024;
        v[i][2] = (int32_t)(c->word[4 + i] >> 5);
        v[i][3] = (int32_t)c->word[7 + i];
        v[i][4] = (int32_t)(c->word[1 + i] >> 16);
    }
    const int32_t area = (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
    const int second = area > 0 ? 1 : 2, third = 3 - second;
    if (area == 0)
        return;
    const uint32_t *const color[3] = { (const uint32_t *)v[0] + 3, (const uint32_t *)v[second] + 3, (const uint32_t *)v[third] + 3 };
    if (best) {
        tiny_corners(&b, v[0], v[second], v[third], x, y);
        tiny_colors(&b, color[0], color[1], color[2], round);
    } else {
        tiny_corners_reference(&b, v[0], v[second], v[third], x, y);
        tiny_colors_reference(&b, color[0], color[1], color[2], round);
    }
    uint32_t *const out = c->word;
    out[0] = (uint32_t)b.e1;
    out[1] = (uint32_t)b.e2;
    out[2] = (uint32_t)b.sum;
    out[3] = b.recip << 6 ^ (uint32_t)b.up;
    out[4] = (uint32_t)b.right1 ^ (uint32_t)b.right2 << 13;
    out[5] = (uint32_t)b.down1 ^ (uint32_t)b.down2 << 13;
    b.units = 0;
    out[6] = tiny_units_at(&b, 0xffffu, 0x5555u);
    out[7] = tiny_units_at(&b, 0x1234u, 0xffffu);
    for (int i = 0; i < 3; i++)
        out[8 + i] = ((uint32_t)b.channel[i].to1 * 31u + (uint32_t)b.channel[i].to2) * 31u + b.channel[i].base;
}

/* Corners anywhere, or near to each other. */
static void span_by(struct kernel_call *c, bool best)
{
    int32_t v[3][3];
    struct tiny_span s;
    for (int i = 0; i < 3; i++) {
        v[i][0] = (int32_t)c->word[i] >> (10 + (c->word[9] & 15u));
        v[i][1] = (int32_t)c->word[3 + i] >> (10 + (c->word[9] >> 4 & 15u));
        v[i][2] = (int32_t)(c->word[6 + i] >> (1 + (c->word[9] >> 8 & 15u)));
    }
    if (best)
        tiny_span(&s, v[0], v[1], v[2]);
    else
        tiny_span_reference(&s, v[0], v[1], v[2]);
    c->word[0] = (uint32_t)s.left;
    c->word[1] = (uint32_t)s.top;
    c->word[2] = (uint32_t)s.right;
    c->word[3] = (uint32_t)s.bottom;
    c->word[4] = (uint32_t)s.low;
    c->word[5] = (uint32_t)s.high;
}

static void span_reference(struct kernel_call *c) { span_by(c, false); }
static void span_best(struct kernel_call *c) { span_by(c, true); }
static void corners_reference(struct kernel_call *c) { corners_by(c, false); }
static void corners_best(struct kernel_call *c) { corners_by(c, true); }

#define FORMS(NAME) .form = { { "reference", NAME##_reference }, { "unrolled", NAME##_unrolled }, { "best", NAME##_best } }

extern const struct kernel kernels_tiny_box[];
const struct kernel kernels_tiny_box[] = {
    { .name = "tiny_box (one colour)", .most = 40, .size = { 2, 4 }, .timed = 40, FORMS(flat) },
    { .name = "tiny_box (one colour, narrow)", .most = 40, .size = { 2, 2 }, .timed = 40, FORMS(flat_narrow) },
    { .name = "tiny_box (shaded)", .most = 40, .size = { 2, 4 }, .timed = 40, FORMS(codes) },
    { .name = "tiny_box (shaded, narrow)", .most = 40, .size = { 2, 2 }, .timed = 40, FORMS(codes_narrow) },
    { .name = "tiny_box (linear light)", .most = 40, .size = { 2, 4 }, .timed = 40, FORMS(light) },
    { .name = "tiny_span", .most = 40, .size = { 1 }, .timed = 40, .form = { { "reference", span_reference }, { "best", span_best } } },
    { .name = "tiny_corners", .most = 40, .size = { 1 }, .timed = 40,
      .form = { { "reference", corners_reference }, { "best", corners_best } } },
    { .name = NULL }
};
