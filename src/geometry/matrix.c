/* SPDX-License-Identifier: MIT */
/* matrix.c - composes transforms in 64-bit blocks and scales the result to 32-bit rows.
 *
 * Everything is kept as mantissas with a common exponent, chosen so that no vertex can overflow: wild
 * matrices give wild pictures, never wild memory. */
#include "geometry/matrix.h"

#include "base/fixmath.h"
#include "geometry/transform.h"

int smear_mesh_bits(const int16_t *number, uint32_t count)
{
    uint32_t all = 1;
    for (const int16_t *const end = number + count; number != end; number++) {
        const int32_t n = *number;
        all |= (uint32_t)(n ^ n >> 15);
        if (all >> 12 != 0)
            return 15;
    }
    return 32 - count_leading_zeros(all);
}

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

/* Returns the same where it has 31 bits: mostly without shifts of 64 bits, which are calls on small cores. */
static inline int32_t scale_narrow(int64_t a, int shift)
{
    if (SMEAR_HAS_MUL64 || SMEAR_SMALL_FILE || shift > -2 || shift < -32)
        return scale_to_i32(a, shift);
    const int32_t twice = (int32_t)((uint32_t)((uint64_t)a >> 32) << (33 + shift) | (uint32_t)a >> (-shift - 1));
    return (twice >> 1) + (twice & 1);
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
    for (int i = 0; i < 9; i++)
        out[i] = scale_narrow(in[i], shift);
    return -shift;
}

void smear_view_compose(struct smear_view *view, const smear_transform *object, const smear_mesh *mesh, const smear_transform *camera)
{
    /* Camera space: transpose of the camera's rotation times (world - eye). Its entries are at most 1 and a 64th in
     * magnitude (smear_begin checks), so a product of them and any 32 bits has 56 bits and three fit. */
    int64_t turned[9] = { 0 }, scaled[9];
    int64_t offset[3];
    int32_t unit[3][3];
    for (int k = 0; k < 9; k += 3)
        for (int j = 0; j < 3; j++) {       /* q48; most objects do not turn, or about one axis */
            const int32_t by = object->basis[k + j];
            for (int i = 0; i < 3 && by != 0; i++)
                turned[3 * i + j] += mul_wide(camera->basis[k + i], by);
        }
    for (int j = 0; j < 3; j++)
        offset[j] = (int64_t)object->origin[j] - camera->origin[j];
    for (int i = 0; i < 3; i++) {
        const int64_t x = camera->basis[i], y = camera->basis[3 + i], z = camera->basis[6 + i];
        view->origin[i] = (x * offset[0] + y * offset[1] + z * offset[2]) >> 8;     /* q40 to q32, of 51 bits */
    }
    const int exponent = normalize_block(unit, turned) - 48;
    int32_t scale = mesh->scale != 0 ? mesh->scale : 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            scaled[3 * i + j] = mul_wide(unit[i][j], scale);
    const int scaled_exponent = normalize_block(view->basis, scaled);
    view->basis_exp = scaled_exponent + exponent - mesh->shift;
    for (int i = 0; i < 3; i++) {
        const int64_t sum = dot_wide(view->basis[i], 1, mesh->offset, 1);
        if (sum != 0)
            view->origin[i] += scale_to_i52(sum, view->basis_exp + 32);
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
    uint32_t sum = 0;           /* each is at most 2^30 */
    for (int j = 0; j < 3; j++)
        sum += magnitude_i32(view->basis[row][j]);
    const int length = sum == 0 ? 0 : 32 - count_leading_zeros(sum);
    const int bits = max_i32(length + view->basis_exp + 15, bit_length(view->origin[row]) - 32);
    return bits + 1 + 30 + by.exponent;
}

/* Fills a row of the projection: the view's row times `by`, scaled by 2^scale, which keeps factors below 2^30. */
static void fill_row(int32_t m[4], const struct smear_view *view, int row, struct factor by, int sign, int scale)
{
    const int32_t factor = sign < 0 ? -by.mantissa : by.mantissa;
    const int shift = view->basis_exp + by.exponent + scale + 16;
    for (int j = 0; j < 3; j++)
        m[j] = scale_narrow(mul_wide(view->basis[row][j], factor), shift) & ~3;
    int cut = max_i32(0, bit_length(view->origin[row]) - 31);
    m[3] = scale_to_i32((view->origin[row] >> cut) * factor, cut - 32 + by.exponent + scale);
}

void smear_depths_make(struct smear_depths *d, const smear_camera *camera, int scale)
{
    d->orthographic = camera->half_height > 0;
    /* Rows stay below 2^30, so what lies farther is in front of a plane that is clamped there. */
    d->near_distance = clamp_i32(scale_to_i32(camera->near_plane, scale - 16), 1, 1 << 30);
    d->far_distance = camera->far_plane == 0 ? INT32_MAX : max_i32(d->near_distance + 1, scale_to_i32(camera->far_plane, scale - 16));
    if (depths_are_even(d)) {
        /* units q11 = (far - distance) NEAR 2^11 / (far - near) */
        uint32_t range = (uint32_t)(d->far_distance - d->near_distance);
        int zeros = count_leading_zeros(range);
        struct factor k = factor_from(mul_wide((int32_t)recip_norm_precise(range << zeros), SMEAR_DEPTH_NEAR), zeros - 61 + 11);
        d->depth_mantissa = k.mantissa;
        d->depth_shift = (int16_t)(k.exponent + 32);
    } else {
        /* units q11 = near NEAR 2^11 2^scale / W; matrix.c adds the exponent of 1 / W */
        struct factor k = factor_from(mul_wide(camera->near_plane, SMEAR_DEPTH_NEAR), -16 + 11 + scale);
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
    p->depths.up = 0;

    /* Pixels per unit (times distance): focal height / 2, or height / (2 half_height). */
    struct factor pixels;
    if (is_orthographic(p)) {
        struct factor half = factor_from(camera->half_height, -16);
        uint32_t r = recip_norm_precise((uint32_t)min_i32(half.mantissa, (1 << 30) - 1) << 2);
        pixels = factor_from(mul_wide((int32_t)r, height_px), -61 + 2 - 1 - half.exponent - coarse);
    } else {
        pixels = factor_from(mul_wide(camera->focal, height_px), -17 - coarse);
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
                int64_t term = mul_wide(in[i]->m[row][j], weight[i]) >> min_i32(down, 62);
                if (out[i] == out[0])
                    term = sum += term;
                const int32_t m = scale_narrow(term, -24 - room);
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

/* Returns a r 2^-down, r being 2^61 / w: a / w in q8 px, as far as it matters. */
static int32_t divided(int32_t a, uint32_t r, int down)
{
    const int32_t far_out = 1 << 24, high = mulh_i32(a, (int32_t)r);
    return down > 0 ? (high + (1 << (down - 1))) >> down : clamp_i32(scale_sat(high, -down), -far_out, far_out);
}

void smear_project(struct smear_screen *out, const struct smear_depths *d, const struct smear_homogeneous *in,
                   const struct smear_viewport *viewport)
{
    SMEAR_ASSERT(in->w > 0);
    int zeros = count_leading_zeros((uint32_t)in->w);
    uint32_t r = recip_norm((uint32_t)in->w << zeros);      /* 1/w = r 2^(zeros - 61) */

    /* x r / 2^32 = x/w 2^(29 - zeros); q8 wants 2^8. */
    const int down = 21 - zeros - d->coarse;
    out->x = (viewport->width << 7) + divided(in->x, r, down);
    out->y = (viewport->height << 7) + divided(in->y, r, down);
    const int32_t depth = depths_are_even(d) ? depth_even(d, in->distance) : times_recip(d->depth_mantissa, r, d->depth_shift + zeros);
    out->depth = clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
}

int smear_outcode_sides(const struct smear_screen *s, const struct smear_viewport *viewport) { return outcode_sides_inline(s, viewport); }

/* Returns 1 where a coordinate lies beyond its first border, 2 beyond its last one. */
static inline uint32_t beyond(int32_t at, int32_t w, int32_t size)
{
    const int64_t twice = (int64_t)at * 2, border = mul_wide(w, size);
    return (uint32_t)((uint64_t)(border + twice) >> 63) | (uint32_t)((uint64_t)(border - twice) >> 63) << 1;
}

int smear_outcode_behind(struct smear_homogeneous h, const struct smear_viewport *viewport)
{
    SMEAR_STATIC_ASSERT(OUT_LEFT == 1 && OUT_RIGHT == 2 && OUT_TOP == 4 && OUT_BOTTOM == 8, "sides");
    return (int)(beyond(h.x, h.w, viewport->width) | beyond(h.y, h.w, viewport->height) << 2);
}
