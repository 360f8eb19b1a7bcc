/* SPDX-License-Identifier: MIT */
/* reproject.c - maps between cameras.
 *
 * Camera space is taken with x right, y down and z into the screen, so that a perspective place is f x / z. A
 * point P that the camera of now sees is at A P + a for that of a pose: a rotation (times the zoom) and a
 * translation. The drawn instant is a sum of such maps, B P + b, linear in clip space as everywhere else. What it
 * shows at s w, s = (x / f, y / f, 1), is P = B' (s w - b), so that the pose sees it at w (A B' s + (a - A B'
 * b) / w): linear in x, y and 1 / w, which is what depth codes tell. */
#include "geometry/reproject.h"

#include "base/fixmath.h"
#include "geometry/pose.h"

/* ------------------------------------------------------------------ numbers of any size, once per frame */

/* The number m 2^e, |m| < 2^31: m in the lower word, e in the upper one. Structs would be returned in memory. */
typedef uint64_t big_number;

static inline big_number number_make(int32_t m, int e) { return (uint64_t)(uint32_t)e << 32 | (uint32_t)m; }
static inline int32_t mantissa_of(big_number a) { return (int32_t)(uint32_t)a; }
static inline int exponent_of(big_number a) { return (int)(int32_t)(uint32_t)(a >> 32); }

static SMEAR_NOINLINE big_number number_of(int64_t value, int e)
{
    if (value == 0)
        return 0;
    const int shift = 33 - count_leading_zeros_64(magnitude(value));
    return number_make((int32_t)(shift < 0 ? value * ((int64_t)1 << -shift) : value >> shift), e + shift);
}

static SMEAR_NOINLINE big_number times(big_number a, big_number b)
{
    return number_of(mul_wide(mantissa_of(a), mantissa_of(b)), exponent_of(a) + exponent_of(b));
}

/* Returns a / b for b > 0. */
static SMEAR_NOINLINE big_number over(big_number a, big_number b)
{
    const int zeros = count_leading_zeros((uint32_t)mantissa_of(b));
    return times(a, number_make((int32_t)recip_norm_precise((uint32_t)mantissa_of(b) << zeros), zeros - 61 - exponent_of(b)));
}

/* Returns a 2^q to nearest, less than 2^bits in magnitude. */
static SMEAR_NOINLINE int32_t fixed_of(big_number a, int q, int bits)
{
    const int64_t limit = ((int64_t)1 << bits) - 1;
    int shift = exponent_of(a) + q;
    int64_t value = mantissa_of(a);
    if (shift < 0)
        value = shift < -40 ? 0 : (value + ((int64_t)1 << (-shift - 1))) >> -shift;
    else if (value != 0 && (shift > 31 || magnitude(value) > (uint64_t)limit >> shift))
        value = value < 0 ? -limit : limit;
    else
        value *= (int64_t)1 << min_i32(shift, 31);
    return (int32_t)(value > limit ? limit : value < -limit ? -limit : value);
}

/* Lets *shift grow by as many bits as a 2^q must lose to fit: several values share it. */
static SMEAR_NOINLINE void keep_room(int *shift, big_number a, int q)
{
    const int bits = mantissa_of(a) == 0 ? 0 : 32 - count_leading_zeros(magnitude_i32(mantissa_of(a))) + exponent_of(a) + q;
    *shift = max_i32(*shift, bits - 30);
}

/* ------------------------------------------------------------------ maps, once per frame */

/* The map of p to A p + a. */
struct map {
    int64_t turn[3][3];         /* A, q27 */
    int64_t offset[3];          /* a, q40 world units */
};

static SMEAR_NOINLINE int32_t clamp_narrow(int64_t a, int32_t limit) { return clamp_i32(narrow_sat(a), -limit, limit); }

static SMEAR_PRODUCT_CALL int64_t clamp_i64(int64_t a, int64_t limit)
{
    return a > limit ? limit : a < -limit ? -limit : a;
}

/* Makes the map by which `camera` sees at A p + a what the camera of now sees at p. */
static void map_make(struct map *m, const smear_camera *now, const smear_camera *camera)
{
    const int32_t *to = camera->pose.basis, *from = now->pose.basis;
    __builtin_memset(m, 0, sizeof *m);
    for (int i = 0; i < 3; i++)
        m->turn[i][i] = 1 << 27;
    if (!smear_transform_is_same(&camera->pose, &now->pose)) {
        for (int i = 0; i < 3; i++) {
            int64_t offset = 0;
            for (int j = 0; j < 3; j++) {
                const int64_t sum = dot_wide(to + i, 3, from + j, 3);
                offset += (int64_t)to[3 * j + i] * ((int64_t)now->pose.origin[j] - camera->pose.origin[j]);
                m->turn[i][j] = ((i == 0) != (j == 0) ? -sum : sum) >> 21;
            }
            m->offset[i] = i == 0 ? offset : -offset;
        }
    }
    bool flat = now->half_height > 0;
    int32_t a = flat ? now->half_height : camera->focal, b = flat ? camera->half_height : now->focal;
    if (a == b)
        return;
    big_number zoom = over(number_of(a, 0), number_of(b, 0));
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 3; j++)
            m->turn[i][j] = fixed_of(times(number_of(m->turn[i][j], 0), zoom), 0, 31);
        big_number offset = times(number_of(m->offset[i], 0), zoom);
        const int up = exponent_of(offset);
        m->offset[i] = up > 30 || up < -31 ? 0
                     : up < 0 ? mantissa_of(offset) >> -up : (int64_t)mantissa_of(offset) * ((int64_t)1 << up);
        m->offset[i] = clamp_i64(m->offset[i], (int64_t)1 << 58);      /* as without a zoom */
    }
}

static void map_add(struct map *sum, const struct map *m, int32_t weight)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            sum->turn[i][j] += m->turn[i][j] * weight >> 24;
        sum->offset[i] += (m->offset[i] >> 24) * weight;            /* 34 and 27 bits */
    }
}

/* Inverts a turn, q27; returns false where it has no inverse to speak of. */
static bool invert(int32_t out[3][3], const int64_t in[3][3])
{
    int64_t minor[3][3];
    int32_t m[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] = clamp_narrow(in[i][j], 8 << 27) >> 2;                      /* q25 */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            minor[i][j] = cross_wide(m[a][c], m[a][d], m[b][c], m[b][d]) >> 23;               /* q27 */
        }
    int64_t determinant = 0;
    for (int j = 0; j < 3; j++)
        determinant += m[0][j] * (clamp_i64(minor[0][j], (int64_t)1 << 33)) >> 25;     /* q27 */
    if (determinant < 1 << 20)
        return false;
    big_number d = number_of(determinant, -27);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = fixed_of(over(number_of(minor[j][i], -27), d), 27, 31);
    return true;
}

/* Makes m start from the drawn instant: A B' and a - A B' b. */
static void map_from_drawn(struct map *m, const int32_t inverse[3][3], const int64_t offset[3])
{
    for (int i = 0; i < 3; i++) {
        int32_t turn[3];
        for (int j = 0; j < 3; j++)
            turn[j] = clamp_narrow(m->turn[i][j], 1 << 30);
        for (int j = 0; j < 3; j++) {
            m->turn[i][j] = 0;
            for (int k = 0; k < 3; k++)
                m->turn[i][j] += mul_wide(turn[k], inverse[k][j]) >> 27;
        }
        for (int j = 0; j < 3; j++)
            m->offset[i] -= (clamp_narrow(m->turn[i][j], 1 << 30) >> 10)
                       * (clamp_i64(offset[j], (int64_t)1 << 55) >> 14) >> 3;
    }
}

/* ------------------------------------------------------------------ what pixels need */

static void pose_perspective(struct smear_reprojection_pose *p, const struct map *m, const smear_camera *now,
                             int32_t height)
{
    big_number focal = number_of(mul_wide(now->focal, height), -17);
    big_number near_units = times(number_of(now->near_plane, -16), number_of(SMEAR_DEPTH_NEAR, 0)), u[3];
    int u_shift = 0, w_shift = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = over(number_of(m->offset[i], -40), near_units);
        if (i < 2)
            u[i] = times(u[i], focal);
        keep_room(i < 2 ? &u_shift : &w_shift, u[i], i < 2 ? 37 : 48);
    }
    for (int i = 0; i < 2; i++) {
        p->one[i] = fixed_of(times(number_of(m->turn[i][2], -27), focal), 16, 30);
        p->u[i] = fixed_of(u[i], 37 - u_shift, 31);
    }
    p->w_x = fixed_of(over(number_of(m->turn[2][0], -27), focal), 30, 31);
    p->w_y = fixed_of(over(number_of(m->turn[2][1], -27), focal), 30, 31);
    p->w_1 = clamp_narrow(m->turn[2][2], 1 << 29);
    p->w_u = fixed_of(u[2], 48 - w_shift, 31);
    p->u_shift = (uint8_t)min_i32(u_shift, 31);
    p->w_shift = (uint8_t)min_i32(w_shift, 31);
}

static void pose_orthographic(struct smear_reprojection_pose *p, const struct map *m, const smear_camera *now,
                              int32_t height)
{
    /* Distance is far less range times units over NEAR. */
    big_number unit_px = over(number_of(height, 0), number_of(now->half_height, -15));
    big_number far_plane = number_of(now->far_plane, -16);
    big_number step = over(number_of((int64_t)now->far_plane - now->near_plane, -16),
                           number_of(SMEAR_DEPTH_NEAR, 0));
    big_number u[2];
    int u_shift = 0;
    for (int i = 0; i < 2; i++) {
        big_number across = times(number_of(-m->turn[i][2], -27), unit_px);
        int64_t one = fixed_of(times(number_of(m->offset[i], -40), unit_px), 16, 30);
        p->one[i] = (int32_t)(one - fixed_of(times(across, far_plane), 16, 30));
        u[i] = times(across, step);
        keep_room(&u_shift, u[i], 37);
    }
    for (int i = 0; i < 2; i++)
        p->u[i] = fixed_of(u[i], 37 - u_shift, 31);
    p->w_1 = 1 << 27;
    p->u_shift = (uint8_t)min_i32(u_shift, 31);
}

void smear_reproject_make(struct smear_reprojection *r, const smear_camera *now, const smear_camera *open,
                          const smear_camera *close, const int32_t weight[3], bool to_close, int32_t width,
                          int32_t height)
{
    const smear_camera *camera[3] = { now, open, close };
    bool drawn_is_now = weight[0] == 1 << 24;
    struct map map[3], drawn = { { { 0 } }, { 0 } };
    int32_t inverse[3][3];
    for (int i = 0; i < 3; i++) {
        map_make(&map[i], now, camera[i]);
        map_add(&drawn, &map[i], weight[i]);
    }
    if (!drawn_is_now && invert(inverse, (const int64_t(*)[3])drawn.turn))
        for (int i = 0; i < 3; i++)
            map_from_drawn(&map[i], (const int32_t(*)[3])inverse, drawn.offset);
    *r = (struct smear_reprojection){ .width = width, .height = height };
    r->poses = to_close || !drawn_is_now ? 2 : 1;
    for (int i = 0; i < r->poses; i++) {
        const struct map *m = &map[i == 0 ? 1 : to_close ? 2 : 0];
        struct smear_reprojection_pose *p = &r->pose[i];
        for (int j = 0; j < 2; j++) {
            p->x[j] = clamp_narrow(m->turn[0][j], 1 << 30);
            p->y[j] = clamp_narrow(m->turn[1][j], 1 << 30);
        }
        if (now->half_height > 0)
            pose_orthographic(p, m, now, height);
        else
            pose_perspective(p, m, now, height);
    }
}

/* ------------------------------------------------------------------ a pixel */

static inline int32_t within(int32_t a, int32_t limit)
{
    return clamp_i32(a, -limit, limit);
}

/* Finds a pose's displacement at a place, in q21 px for products by mulh_i32. */
static void pose_displacement(const struct smear_reprojection_pose *p, int32_t x, int32_t y, int32_t u,
                              int32_t out[2])
{
    const int32_t quarter = 1 << 29, wide = 1 << 21;
    int32_t turn = within(mulh_i32(x, p->w_x), wide) * 256 + within(mulh_i32(y, p->w_y), wide) * 256;
    int32_t toward = within(scale_sat(mulh_i32(u, p->w_u), p->w_shift), quarter);
    /* A point that was at or behind the eye has no place: the least w sends it far out, to the side it comes from. */
    int32_t w = max_i32(narrow_sat((int64_t)p->w_1 + turn + toward), 1 << 12);
    w = min_i32(w, (1 << 30) - 1);
    int zeros = count_leading_zeros((uint32_t)w);
    int32_t r = (int32_t)recip_norm((uint32_t)w << zeros);
    for (int i = 0; i < 2; i++) {
        int32_t along_x = mulh_i32(x, i == 0 ? p->x[0] - w : p->y[0]);
        int32_t along_y = mulh_i32(y, i == 0 ? p->x[1] : p->y[1] - w);
        int32_t aside = scale_sat(mulh_i32(u, p->u[i]), p->u_shift);
        int32_t n = narrow_sat((int64_t)along_x + along_y + p->one[i] + aside);
        /* q16 over q27, times 2^(29 - zeros): n / w in q8 is that times 2^(zeros - 10). */
        out[i] = within(scale_sat(mulh_i32(n, r), zeros - 10), quarter);
    }
}

void smear_reproject(const struct smear_reprojection *r, int32_t x2, int32_t y2, uint32_t units,
                     int32_t out[2])
{
    int32_t px = (x2 - r->width) * (1 << 20), py = (y2 - r->height) * (1 << 20);
    int32_t u = (int32_t)(units << 11);
    out[0] = out[1] = 0;
    for (int i = 0; i < r->poses; i++) {
        int32_t displacement[2];
        pose_displacement(&r->pose[i], px, py, u, displacement);
        out[0] = displacement[0] - out[0];
        out[1] = displacement[1] - out[1];
    }
    if (r->poses == 1) {
        out[0] = -out[0];
        out[1] = -out[1];
    }
}

/* ------------------------------------------------------------------ of first order */

static int64_t scale_up(int32_t a, int shift) { return (int64_t)((uint64_t)(int64_t)a << shift); }

/* How a term changes from the first pose to the second, over the exposure. */
struct change {
    const struct smear_reprojection *r;
    big_number exposure;
};

/* Returns the change of a term 2^-q; without a second pose it ends where nothing moves. */
static big_number change_of(const struct change *c, int64_t first, int64_t second, int q)
{
    return times(number_of((c->r->poses == 2 ? second : 0) - first, -q), c->exposure);
}

/* Returns the same of a term of 32 bits, times 2^up, less than 2^bits in magnitude. */
static SMEAR_NOINLINE int32_t fixed_change(const struct change *c, int32_t first, int32_t second, int up, int bits)
{
    return fixed_of(change_of(c, first, second, -up), 0, bits);
}

/* Makes terms per unit of 11 bits. Returns by how many they are to be shifted down. */
static uint8_t take_units(int32_t out[], const big_number term[], int count)
{
    enum { BITS = 11 };
    int up = 47;
    for (int i = 0; i < count; i++)
        if (mantissa_of(term[i]) != 0)
            up = min_i32(up, BITS - (32 - count_leading_zeros(magnitude_i32(mantissa_of(term[i])))) - exponent_of(term[i]));
    up = clamp_i32(up, 16, 47);
    for (int i = 0; i < count; i++)
        out[i] = fixed_of(term[i], up, BITS);
    return (uint8_t)(up - 16);
}

void smear_flow_make(struct smear_flow *f, const struct smear_reprojection *r, int32_t exposure)
{
    enum { MOST = 28 };         /* bits of a sum's terms: 4096 px */
    const struct smear_reprojection_pose *p = &r->pose[0], *q = &r->pose[1];
    const struct change c = { r, number_of(exposure, -16) };
    const big_number turn = change_of(&c, -scale_up(p->w_u, p->w_shift), -scale_up(q->w_u, q->w_shift), 48);
    big_number aside[2];
    *f = (struct smear_flow){ .width = r->width, .height = r->height };
    f->turn_x = fixed_change(&c, -p->w_x, -q->w_x, -8, 19);
    f->turn_y = fixed_change(&c, -p->w_y, -q->w_y, -8, 19);
    for (int i = 0; i < 2; i++) {
        const int32_t *from = i == 0 ? p->x : p->y, *to = i == 0 ? q->x : q->y;
        f->along[i] = fixed_change(&c, from[i] - p->w_1, to[i] - q->w_1, -11, 17);
        f->across[i] = fixed_change(&c, from[1 - i], to[1 - i], -11, 17);
        f->one[i] = fixed_change(&c, p->one[i], q->one[i], 0, MOST);
        aside[i] = change_of(&c, scale_up(p->u[i], p->u_shift), scale_up(q->u[i], q->u_shift), 37);
    }
    f->turn_down = take_units(&f->turn_u, &turn, 1);
    if (f->turn_down == 0)              /* the sum has room; so near the camera's path the turn is the most anyway */
        f->turn_u = clamp_i32(f->turn_u, -(1 << 10), 1 << 10);
    f->aside_down = take_units(f->aside, aside, 2);
    const uint32_t length = (uint32_t)max_i32(max_i32(abs_i32(f->aside[0]), abs_i32(f->aside[1])), 1), units = (1u << 20) - 1;
    f->units_most = f->aside_down >= 31 - MOST ? units : min_u32((1u << (MOST + f->aside_down)) / length, units);
}

void smear_flow_at(const struct smear_flow *f, int32_t x, int32_t y, uint32_t units, int32_t out[2])
{
    enum { TURN_MOST = 1 << 17 };
    const int32_t from_x = x - (f->width >> 1), from_y = y - (f->height >> 1), u = (int32_t)min_u32(units, f->units_most);
    const int32_t turn = clamp_i32(((from_x * f->turn_x + from_y * f->turn_y) >> 6) + (u * f->turn_u >> f->turn_down),
                                   -TURN_MOST, TURN_MOST);
    out[0] = (from_x * (f->along[0] + turn) + from_y * f->across[0] + f->one[0] + (u * f->aside[0] >> f->aside_down)) >> 8;
    out[1] = (from_y * (f->along[1] + turn) + from_x * f->across[1] + f->one[1] + (u * f->aside[1] >> f->aside_down)) >> 8;
}
