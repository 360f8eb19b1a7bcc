/* SPDX-License-Identifier: MIT */
/* matrix.c - composes transforms in 64-bit blocks and scales the result to 32-bit rows.
 *
 * Everything is kept as mantissas with a common exponent, chosen so that no vertex can overflow: wild
 * matrices give wild pictures, never wild memory. */
#include "geometry/matrix.h"

#include "base/fixmath.h"
#include "geometry/transform.h"

/* Returns how many bits |a| has; 0 for 0. */
static int bit_length(int64_t a)
{
    return a == 0 ? 0 : 64 - count_leading_zeros_64(magnitude(a));
}

/* Returns a 2^-down to nearest, down 1 .. 62. */
static inline int64_t scale_down(int64_t a, int down)
{
    return ((a >> (down - 1)) + 1) >> 1;
}

/* Returns a 2^shift, rounded to nearest and clamped to +-(2^31 - 1). */
static int32_t scale_to_i32(int64_t a, int shift)
{
    if (shift < 0)
        return shift < -62 ? 0 : narrow_sat(scale_down(a, -shift));
    if (bit_length(a) + shift > 31)
        return a < 0 ? -INT32_MAX : INT32_MAX;
    return narrow_sat((int64_t)((uint64_t)a << shift));
}

/* Does what scale_to_i32 does, without a call where the number shrinks, as it mostly does. */
static inline int32_t scale_inline(int64_t a, int shift)
{
    if (!SMEAR_SMALL_FILE && shift < 0 && shift >= -62)
        return narrow_sat(scale_down(a, -shift));
    return scale_to_i32(a, shift);
}

/* Returns a 2^shift, clamped to +-2^52 so that sums of a few stay exact. */
static int64_t scale_to_i52(int64_t a, int shift)
{
    const int up = clamp_i32(shift, 0, 53);
    const int64_t limit = ((int64_t)1 << 52) >> up;
    if (shift < 0)
        a = shift < -62 ? 0 : a >> -shift;
    return (a > limit ? limit : a < -limit ? -limit : a) * ((int64_t)1 << up);
}

/* Brings the largest of nine values to 31 bits; returns the exponent: value = out 2^exponent. */
static int normalize_block(int32_t block[3][3], const int64_t in[9])
{
    int32_t *out = &block[0][0];
    uint64_t all = 0;
    for (int i = 0; i < 9; i++)
        all |= magnitude(in[i]);
    const int bits = bit_length((int64_t)all), shift = bits == 0 ? 0 : 30 - bits;
    if (shift < 0)
        for (int i = 0; i < 9; i++)
            out[i] = (int32_t)scale_down(in[i], -shift);
    else
        for (int i = 0; i < 9; i++)
            out[i] = (int32_t)((uint32_t)in[i] << shift);
    return -shift;
}

/* Where products of 64 bits are calls, or shifts of them take many instructions, and size does not count, much is found without them. */
#define PRODUCTS_ARE_DEAR (!(SMEAR_HAS_MUL64 && SMEAR_HAS_CLZ) && !SMEAR_ONE_COPY)

/* Returns a b 2^-down to nearest, down 2 .. 32, where it has 32 bits. */
static inline int32_t product_down(int32_t a, int32_t b, int down)
{
    const int32_t twice = mul_shift(a, b, down - 1);
    return (twice >> 1) + (twice & 1);
}

/* Finds the camera's basis, transposed, as normalize_block would that times the object's, where the latter does not turn. Returns
 * false where it does. */
static bool take_block(int32_t unit[3][3], int *exponent, const int32_t camera[9], const int32_t object[9])
{
    uint32_t all = 0;
    for (int i = 0; i < 9; i++) {
        if (object[i] != (i % 4 == 0 ? 1 << 24 : 0))
            return false;
        all |= (uint32_t)abs_i32(camera[i]);
    }
    const int bits = bit_length(all);
    if (bits < 8 || bits > 30)
        return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            unit[i][j] = camera[3 * j + i] * (1 << (30 - bits));
    *exponent = bits - 54;
    return true;
}

/* Finds what normalize_block would of a block times `scale`. Returns false where products are short. */
static bool scale_block(int32_t out[3][3], int *exponent, int32_t unit[3][3], int32_t scale)
{
    const int32_t *in = &unit[0][0];
    int32_t *to = &out[0][0], largest = 0;
    for (int i = 0; i < 9; i++)
        largest = max_i32(largest, abs_i32(in[i]));
    const int down = bit_length((int64_t)largest * scale) - 30;
    if (down < 2 || down > 32)
        return false;
    for (int i = 0; i < 9; i++)
        to[i] = product_down(in[i], scale, down);
    *exponent = down;
    return true;
}

void smear_view_compose(struct smear_view *view, const smear_transform *object,
                        const smear_mesh *mesh, const smear_transform *camera)
{
    /* Camera space: transpose of the camera's rotation times (world - eye). Its entries are at most 1 and a 64th in
     * magnitude (smear_begin checks), so a product of them and any 32 bits has 56 bits and three fit. */
    int64_t turned[9], scaled[9];
    int64_t offset[3];
    int32_t unit[3][3];
    int exponent = 0, scaled_exponent = 0;
    const bool is_straight = PRODUCTS_ARE_DEAR && take_block(unit, &exponent, camera->basis, object->basis);
    for (int j = 0; j < 3; j++)
        offset[j] = (int64_t)object->origin[j] - camera->origin[j];
    for (int i = 0; i < 3; i++) {
        const int64_t x = camera->basis[i], y = camera->basis[3 + i], z = camera->basis[6 + i];
        for (int j = 0; j < 3 && !is_straight; j++)     /* q48 */
            turned[3 * i + j] = x * object->basis[j] + y * object->basis[3 + j] + z * object->basis[6 + j];
        view->origin[i] = (x * offset[0] + y * offset[1] + z * offset[2]) >> 8;     /* q40 to q32 */
    }
    if (!is_straight)
        exponent = normalize_block(unit, turned) - 48;
    int32_t scale = mesh->scale != 0 ? mesh->scale : 1;
    if (!PRODUCTS_ARE_DEAR || !scale_block(view->basis, &scaled_exponent, unit, scale)) {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                scaled[3 * i + j] = (int64_t)unit[i][j] * scale;
        scaled_exponent = normalize_block(view->basis, scaled);
    }
    view->basis_exp = scaled_exponent + exponent - mesh->shift;
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0;
        for (int j = 0; j < 3; j++)
            if (!PRODUCTS_ARE_DEAR || mesh->offset[j] != 0)
                sum += (int64_t)view->basis[i][j] * mesh->offset[j];
        view->origin[i] = scale_to_i52(view->origin[i], 0)
                        + (PRODUCTS_ARE_DEAR && sum == 0 ? 0 : scale_to_i52(sum, view->basis_exp + 32));
    }
}

/* A positive number as mantissa in [2^29, 2^30] and exponent. */
struct factor { int32_t mantissa; int exponent; };

static struct factor factor_from(int64_t value, int exponent)
{
    int shift = 30 - bit_length(value);
    return (struct factor){ scale_to_i32(value, shift), exponent - shift };
}

/* Returns the log2 of a bound on |row| for every int16 vertex, where the row is the view's times `by`. */
static int row_bits(const struct smear_view *view, int row, struct factor by)
{
    uint64_t sum = 0;
    for (int j = 0; j < 3; j++)
        sum += magnitude(view->basis[row][j]);
    int bits = max_i32(bit_length((int64_t)sum) + view->basis_exp + 15,
                       bit_length(view->origin[row]) - 32);
    return bits + 1 + 30 + by.exponent;
}

/* Returns a b 2^shift to nearest, where it has 31 bits. */
static inline int32_t product_scaled(int32_t a, int32_t b, int shift)
{
    if (PRODUCTS_ARE_DEAR && shift <= -2 && shift >= -32)
        return product_down(a, b, -shift);
    return scale_inline((int64_t)a * b, shift);
}

/* Fills a row of the projection: the view's row times `by`, scaled by 2^scale, which keeps factors below 2^30. */
static void fill_row(int32_t m[4], const struct smear_view *view, int row, struct factor by, int sign,
                     int scale)
{
    const int32_t factor = sign < 0 ? -by.mantissa : by.mantissa;
    const int shift = view->basis_exp + by.exponent + scale + 16;
    for (int j = 0; j < 3; j++)
        m[j] = product_scaled(view->basis[row][j], factor, shift) & ~3;
    int cut = max_i32(0, bit_length(view->origin[row]) - 31);
    m[3] = scale_to_i32((view->origin[row] >> cut) * factor, cut - 32 + by.exponent + scale);
}

void smear_depths_make(struct smear_depths *d, const smear_camera *camera, int scale)
{
    d->orthographic = camera->half_height > 0;
    /* Rows stay below 2^30, so what lies farther is in front of a plane that is clamped there. */
    d->near_distance = clamp_i32(scale_to_i32(camera->near_plane, scale - 16), 1, 1 << 30);
    d->far_distance = camera->far_plane == 0 ? INT32_MAX
                                             : max_i32(d->near_distance + 1, scale_to_i32(camera->far_plane, scale - 16));
    if (depths_are_even(d)) {
        /* units q11 = (far - distance) NEAR 2^11 / (far - near) */
        uint32_t range = (uint32_t)(d->far_distance - d->near_distance);
        int zeros = count_leading_zeros(range);
        struct factor k = factor_from((int64_t)recip_norm_precise(range << zeros) * SMEAR_DEPTH_NEAR,
                                      zeros - 61 + 11);
        d->depth_mantissa = k.mantissa;
        d->depth_shift = (int16_t)(k.exponent + 32);
    } else {
        /* units q11 = near NEAR 2^11 2^scale / W; matrix.c adds the exponent of 1 / W */
        struct factor k = factor_from((int64_t)camera->near_plane * SMEAR_DEPTH_NEAR, -16 + 11 + scale);
        d->depth_mantissa = k.mantissa;
        d->depth_shift = (int16_t)(k.exponent - 29);
    }
}

/* Bits that are left for sums of poses: at any instant, and in sharp frames, too, so that what stands still on the screen is rounded
 * alike in all. */
enum { FINE_ROOM = 1 };

void smear_projection_make(struct smear_projection *p, const struct smear_view *view,
                           const smear_camera *camera, int height_px, int coarse)
{
    const struct factor one = { 1 << 29, -29 };
    p->depths.orthographic = camera->half_height > 0;
    p->depths.coarse = (uint8_t)coarse;

    /* Pixels per unit (times distance): focal height / 2, or height / (2 half_height). */
    struct factor pixels;
    if (is_orthographic(p)) {
        struct factor half = factor_from(camera->half_height, -16);
        uint32_t r = recip_norm_precise((uint32_t)min_i32(half.mantissa, (1 << 30) - 1) << 2);
        pixels = factor_from((int64_t)r * height_px, -61 + 2 - 1 - half.exponent - coarse);
    } else {
        pixels = factor_from((int64_t)camera->focal * height_px, -17 - coarse);
    }

    /* The largest row decides the scale; the unit W of an orthographic camera must fit as well. */
    int bits = max_i32(row_bits(view, 0, pixels), row_bits(view, 1, pixels));
    int bits_z = row_bits(view, 2, one);
    bits = is_orthographic(p) ? max_i32(bits, 1) : max_i32(bits, bits_z);
    int scale = min_i32(30 - bits, 48);
    if (coarse != 0)
        scale -= FINE_ROOM;
    p->scale = (int16_t)scale;
    fill_row(p->m[0], view, 0, pixels, 1, scale);
    fill_row(p->m[1], view, 1, pixels, -1, scale);          /* the screen's y points down */

    int32_t *distance = p->m[is_orthographic(p) ? 3 : 2];
    if (is_orthographic(p)) {
        for (int j = 0; j < 3; j++)
            p->m[2][j] = 0;
        p->m[2][3] = max_i32(1, scale_to_i32(1, scale));
        int bits_far = bit_length(camera->far_plane) - 16;
        scale = min_i32(29 - max_i32(bits_z, bits_far), 48);
    }
    fill_row(distance, view, 2, one, -1, scale);            /* the camera looks along -z */

    p->distance_scale = (int16_t)scale;
    smear_depths_make(&p->depths, camera, scale);
}

/* Returns how many rows count: a perspective has no use for the last one. */
static int rows_of(const struct smear_projection *p)
{
    return is_orthographic(p) ? 4 : 3;
}

void smear_projection_weigh(struct smear_projection *const out[], const struct smear_projection *const in[], const int32_t weight[],
                            int count, const smear_camera *camera)
{
    int scale = in[0]->scale, distance_scale = in[0]->distance_scale;
    const int have = in[0]->depths.coarse != 0 ? FINE_ROOM : 0;
    int room = 1 - have;
    uint32_t all = 0;           /* q20: each is below 2^7 */
    for (int i = 0; i < count; i++) {
        all += (uint32_t)abs_i32(weight[i]) >> 4;
        scale = min_i32(scale, in[i]->scale);
        distance_scale = min_i32(distance_scale, in[i]->distance_scale);
    }
    while (all > 1u << (20 + room + have))      /* rows stay below 2^30 */
        room++;
    for (int row = 0; row < rows_of(in[0]); row++)
        for (int j = 0; j < 4; j++) {
            int64_t sum = 0;
            for (int i = count - 1; i >= 0; i--) {
                const int down = row == 3 ? in[i]->distance_scale - distance_scale : in[i]->scale - scale;
                int64_t term = (int64_t)in[i]->m[row][j] * weight[i] >> min_i32(down, 62);
                if (out[i] == out[0])
                    term = sum += term;
                const int32_t m = scale_inline(term, -24 - room);
                out[i]->m[row][j] = j < 3 ? m & ~3 : m;
            }
        }
    const bool orthographic = is_orthographic(in[0]);
    for (int i = count - 1; i >= 0; i--) {
        out[i]->depths = in[0]->depths;
        out[i]->scale = (int16_t)(scale - room);
        out[i]->distance_scale = (int16_t)(distance_scale - room);
        /* Orthographic: W is one in every pose, and so is its mean; rounded sums might not be. */
        if (orthographic)
            out[i]->m[2][3] = i == 0 ? max_i32(1, scale_to_i32(1, scale - room)) : 0;
    }
    smear_depths_make(&out[0]->depths, camera, out[0]->distance_scale);
}

/* ------------------------------------------------------------------ the perspective division */

void smear_transform_vertex(struct smear_homogeneous *out, const struct smear_projection *p, const int16_t v[3])
{
    transform_inline(out, p, v);
}

void smear_project(struct smear_screen *out, const struct smear_depths *d, const struct smear_homogeneous *in,
                   const struct smear_viewport *viewport)
{
    SMEAR_ASSERT(in->w > 0);
    int zeros = count_leading_zeros((uint32_t)in->w);
    uint32_t r = recip_norm((uint32_t)in->w << zeros);      /* 1/w = r 2^(zeros - 61) */

    /* x r / 2^32 = x/w 2^(29 - zeros); q8 wants 2^8. */
    int32_t x = mulh_i32(in->x, (int32_t)r), y = mulh_i32(in->y, (int32_t)r);
    int down = 21 - zeros - d->coarse;
    if (down > 0) {
        int32_t half = 1 << (down - 1);
        x = (x + half) >> down;
        y = (y + half) >> down;
    } else {
        const int32_t far_out = 1 << 24;
        x = clamp_i32(scale_sat(x, -down), -far_out, far_out);
        y = clamp_i32(scale_sat(y, -down), -far_out, far_out);
    }
    out->x = (viewport->width << 7) + x;
    out->y = (viewport->height << 7) + y;

    const int32_t depth = depths_are_even(d) ? depth_even(d, in->distance)
                                             : times_recip(d->depth_mantissa, r, d->depth_shift + zeros);
    out->depth = clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
}

int smear_outcode_behind(const struct smear_homogeneous *h, const struct smear_viewport *viewport)
{
    int64_t x = (int64_t)h->x * 2, y = (int64_t)h->y * 2;
    int64_t right = (int64_t)h->w * viewport->width, bottom = (int64_t)h->w * viewport->height;
    return (x < -right ? OUT_LEFT : 0) | (x > right ? OUT_RIGHT : 0) | (y < -bottom ? OUT_TOP : 0)
         | (y > bottom ? OUT_BOTTOM : 0);
}
