/* SPDX-License-Identifier: MIT */
/* planes8.c - how check_kernels calls kernels/planes8.h: eights of random triangles, or of values at the corners of one, and one
 * after the other by raster/setup.h, which is what defines the result. Each call makes many from one number. */
#include "kernels/planes8.h"

#include "tests/kernels/eights.h"
#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { EIGHTS = 40, SEED = 0 };

static void one_by_one(struct planes8 *out, const struct poses *p)
{
    const struct smear_segment segment = { .shade = SHADE_FLAT };
    const struct smear_raster_draw draw = { .alpha = SMEAR_OPAQUE };
    const struct smear_raster_frame frame = { .width = 320, .height = 240 };
    out->far = out->near = 0;
    for (int k = 0; k < 8; k++) {
        if ((p->seen >> k & 1u) == 0)
            continue;
        struct setup s = { .frame = &frame, .segment = &segment, .draw = &draw,
                           .v = { p->record[k][0], p->record[k][1], p->record[k][2] } };
        smear_setup(&s, setup_edges(&s));
        out->far |= (uint32_t)(s.slope == SLOPE_FAR) << k;
        out->near |= (uint32_t)(s.slope == SLOPE_NEAR) << k;
        out->x1[k] = s.x1;
        out->y1[k] = s.y1;
        out->x2[k] = s.x2;
        out->y2[k] = s.y2;
        out->area_recip[k] = s.area_recip;
        out->area_zeros[k] = s.area_zeros;
        out->at[k] = s.depth.at;
        out->dx[k] = s.depth.dx;
        out->dy[k] = s.depth.dy;
    }
}

static void by_eight(struct planes8 *out, const struct poses *p) { smear_planes8_avx2(out, p, SLOPE_BREAK); }

static void many(struct kernel_call *c, void (*find)(struct planes8 *, const struct poses *))
{
    struct poses poses;
    struct planes8 p;
    uint32_t seed = c->word[SEED], sum = 0;
    for (int i = 0; i < EIGHTS; i++) {
        eight_make(&poses, &seed);
        find(&p, &poses);
        sum = (sum * 31u + (p.far & poses.seen)) * 31u + (p.near & poses.seen);
        for (int k = 0; k < 8; k++) {
            const uint32_t of[9] = { (uint32_t)p.x1[k], (uint32_t)p.y1[k], (uint32_t)p.x2[k], (uint32_t)p.y2[k], p.area_recip[k],
                                     (uint32_t)p.area_zeros[k], (uint32_t)p.at[k], (uint32_t)p.dx[k], (uint32_t)p.dy[k] };
            for (int j = 0; j < 9 && (poses.seen >> k & 1u) != 0; j++)
                sum = sum * 31u + of[j];
        }
    }
    c->word[1] = sum;
}

/* Values at the corners, of all sizes whose differences have 32 bits. */
static void make_values(struct plane_values *v, uint32_t *seed)
{
    for (int i = 0; i < 8; i++)
        for (int corner = 0; corner < 3; corner++) {
            const int32_t most = (1 << (seed[0] >> 9 & 15u) << 15) - 1;
            v->of[corner][i] = eight_between(seed, -most, most);
        }
}

static void values_one_by_one(struct plane_eight *out, const struct setup *s, const struct plane_values *v)
{
    for (int i = 0; i < 8; i++) {
        struct plane p;
        smear_plane_make(s, &p, v->of[0][i], v->of[1][i], v->of[2][i]);
        out->at[i] = p.at;
        out->dx[i] = p.dx;
        out->dy[i] = p.dy;
    }
}

static void values_by_eight(struct plane_eight *out, const struct setup *s, const struct plane_values *v)
{
    const struct plane_triangle t = { s->v[0][0], s->v[0][1], s->x1, s->y1, s->x2, s->y2, s->area_recip, s->area_zeros };
    smear_plane_eight_avx2(out, &t, v);
}

static void many_values(struct kernel_call *c, void (*find)(struct plane_eight *, const struct setup *, const struct plane_values *))
{
    const struct smear_segment segment = { .shade = SHADE_FLAT };
    const struct smear_raster_draw draw = { .alpha = SMEAR_OPAQUE };
    const struct smear_raster_frame frame = { .width = 320, .height = 240 };
    uint32_t seed = c->word[SEED], sum = 0;
    struct poses poses;
    for (int i = 0; i < EIGHTS / 8; i++) {
        eight_make(&poses, &seed);
        for (int k = 0; k < 8; k++) {
            struct plane_values values;
            struct plane_eight planes;
            make_values(&values, &seed);
            if ((poses.seen >> k & 1u) == 0)
                continue;
            struct setup s = { .frame = &frame, .segment = &segment, .draw = &draw,
                               .v = { poses.record[k][0], poses.record[k][1], poses.record[k][2] } };
            smear_setup(&s, setup_edges(&s));
            find(&planes, &s, &values);
            for (int j = 0; j < 8; j++)
                sum = ((sum * 31u + (uint32_t)planes.at[j]) * 31u + (uint32_t)planes.dx[j]) * 31u + (uint32_t)planes.dy[j];
        }
    }
    c->word[1] = sum;
}

static void values_reference(struct kernel_call *c) { many_values(c, values_one_by_one); }
static void values_by_eights(struct kernel_call *c) { many_values(c, smear_has_avx2() ? values_by_eight : values_one_by_one); }

static void reference(struct kernel_call *c) { many(c, one_by_one); }
static void by_eights(struct kernel_call *c) { many(c, smear_has_avx2() ? by_eight : one_by_one); }
#endif

extern const struct kernel kernels_planes8[];
const struct kernel kernels_planes8[] = {
#if SMEAR_AVX2
    /* Each length is another call, whose data are other triangles. */
    { .name = "planes8 (made, found, summed up)", .least = 8 * EIGHTS - 60, .most = 8 * EIGHTS, .size = { 1 }, .timed = 8 * EIGHTS,
      .form = { { "one by one", reference }, { "eights", by_eights } } },
    { .name = "plane_eight (made, found, summed up)", .least = 8 * EIGHTS - 60, .most = 8 * EIGHTS, .size = { 1 }, .timed = 8 * EIGHTS,
      .form = { { "one by one", values_reference }, { "eights", values_by_eights } } },
#endif
    { .name = NULL }
};
