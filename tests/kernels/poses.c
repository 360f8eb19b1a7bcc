/* SPDX-License-Identifier: MIT */
/* poses.c - how check_kernels calls kernels/poses.h: eights of random triangles on their paths, and one after the other by
 * geometry/path.h, which is what defines the result. Each call makes many from one number. */
#include "kernels/poses.h"

#include "geometry/path.h"
#include "geometry/transform.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { EIGHTS = 40, SEED = 0, STRIDE = VERTEX_BASE_WORDS + 3 + PATH_WORDS, WIDTH = 320, HEIGHT = 240 };

struct take {
    int32_t record[24 * STRIDE];
    uint16_t vertex[8][4];
    struct poses_setup setup;
    int count, time;
};

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8 ^ *seed << 24;
}

static int32_t between(uint32_t *seed, int32_t low, int32_t high)
{
    return low + (int32_t)(next(seed) % (uint32_t)(high - low + 1));
}

/* Places near those of before, or anywhere in the guard band. */
static void make_place(int32_t *out, const int32_t *before, const struct poses_setup *s, int32_t reach, uint32_t *seed)
{
    for (int axis = 0; axis < 2; axis++) {
        out[axis] = between(seed, s->low[axis], s->high[axis]);
        if (before != NULL)
            out[axis] = clamp_i32(before[axis] + between(seed, -reach, reach), s->low[axis], s->high[axis]);
    }
    out[VERTEX_DEPTH] = before != NULL && between(seed, 0, 3) != 0 ? before[VERTEX_DEPTH]
                                                                   : between(seed, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
}

static void make_setup(struct poses_setup *s, const int32_t *record, int time, uint32_t *seed)
{
    const int32_t guard = SMEAR_GUARD_PX << 8, x = WIDTH << 7, y = HEIGHT << 7;
    const int32_t x0 = between(seed, 0, 9) * 32, y0 = between(seed, 0, 6) * 32;
    *s = (struct poses_setup){ .vertex = record, .motion = between(seed, VERTEX_BASE_WORDS, VERTEX_BASE_WORDS + 3),
                               .phase = path_phase(time), .low = { x - guard, y - guard }, .high = { x + guard, y + guard },
                               .depth_least = SMEAR_DEPTH_MIN, .depth_most = SMEAR_DEPTH_MAX, .x0 = x0, .y0 = y0,
                               .x1 = x0 + between(seed, 1, 320), .y1 = y0 + between(seed, 1, 64), .tiny = between(seed, 0, 16),
                               .tiny_box = 32 };
}

static void make(struct take *t, uint32_t *seed)
{
    t->count = between(seed, 1, 8);
    t->time = between(seed, 0, 4) * (SHUTTER_CLOSE / 4) + (next(seed) & 1u ? between(seed, 0, 99) : 0);
    t->time = min_i32(t->time, SHUTTER_CLOSE);
    make_setup(&t->setup, t->record, t->time, seed);
    const int stride = t->setup.motion + PATH_WORDS;
    t->setup.words = between(seed, VERTEX_BASE_WORDS, t->setup.motion);
    for (int k = 0; k < 24; k++) {
        int32_t *const v = t->record + k * stride, *const first = k % 3 == 0 ? NULL : v - k % 3 * stride;
        const int32_t reach = 1 << between(seed, 4, 17), far = 1 << between(seed, 0, 20);
        make_place(v, first, &t->setup, reach, seed);
        if (k % 3 == 0 && between(seed, 0, 7) != 0) {
            v[VERTEX_X] = between(seed, t->setup.x0, t->setup.x1) << 8;
            v[VERTEX_Y] = between(seed, t->setup.y0, t->setup.y1) << 8;
        }
        for (int i = VERTEX_BASE_WORDS; i < t->setup.motion; i++)
            v[i] = (int32_t)next(seed);
        make_place(v + t->setup.motion, v, &t->setup, far, seed);
        make_place(v + t->setup.motion + PATH_POSE_WORDS, v, &t->setup, far, seed);
        t->vertex[k / 3][k % 3] = (uint16_t)(k * stride);
    }
}

static struct poses poses_one_by_one(const struct take *t)
{
    const struct poses_setup *s = &t->setup;
    const struct smear_segment segment = { .motion = (uint8_t)s->motion };
    struct poses out = { .seen = 0, .tiny = 0, .box = { INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN } };
    for (int k = 0; k < t->count; k++) {
        int32_t bounds[4] = { INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN };
        for (int i = 0; i < 3; i++) {
            int32_t *const r = out.record[k][i];
            const int32_t *const v = s->vertex + t->vertex[k][i];
            for (int j = VERTEX_BASE_WORDS; j < s->words; j++)
                r[j] = v[j];
            path_at(r, v, &segment, t->time);
            for (int axis = 0; axis < 2; axis++) {
                r[axis] = clamp_i32(r[axis], s->low[axis], s->high[axis]);
                bounds[axis] = min_i32(bounds[axis], r[axis]);
                bounds[2 + axis] = max_i32(bounds[2 + axis], r[axis]);
            }
            r[VERTEX_DEPTH] = clamp_i32(r[VERTEX_DEPTH], s->depth_least, s->depth_most);
        }
        int32_t (*const r)[POSES_RECORD] = out.record[k];
        const int64_t area = (int64_t)(r[1][0] - r[0][0]) * (r[2][1] - r[0][1]) - (int64_t)(r[2][0] - r[0][0]) * (r[1][1] - r[0][1]);
        int32_t pixel[4];
        for (int i = 0; i < 4; i++) {
            out.bounds[i][k] = bounds[i];
            pixel[i] = (bounds[i] + 127) >> 8;
        }
        const int32_t width = pixel[2] - pixel[0], height = pixel[3] - pixel[1];
        const int32_t box[4] = { max_i32(pixel[0], s->x0), max_i32(pixel[1], s->y0), min_i32(pixel[2], s->x1), min_i32(pixel[3], s->y1) };
        if (box[0] >= box[2] || box[1] >= box[3] || area <= 0)
            continue;
        out.seen |= 1u << k;
        out.tiny |= (uint32_t)(width <= s->tiny && height <= s->tiny && width * height <= s->tiny_box) << k;
        for (int axis = 0; axis < 2; axis++) {
            out.box[axis] = min_i32(out.box[axis], box[axis]);
            out.box[2 + axis] = max_i32(out.box[2 + axis], box[2 + axis]);
        }
    }
    return out;
}

static struct poses poses_by_eights(const struct take *t)
{
    struct poses out;
    struct poses_courses courses;
    smear_poses_courses_avx2(&courses, &t->setup, t->vertex);
    smear_poses_avx2(&out, &t->setup, &courses, t->count);
    if (out.seen != 0)
        smear_poses_records_avx2(&out);
    return out;
}

static uint32_t sum_up(uint32_t sum, const struct poses *p, const struct take *t)
{
    sum = (sum * 31u + p->seen) * 31u + p->tiny;
    for (int i = 0; i < 4 && p->seen != 0; i++)
        sum = sum * 31u + (uint32_t)p->box[i];
    for (int k = 0; k < 8; k++) {
        if ((p->seen >> k & 1u) == 0)
            continue;
        for (int i = 0; i < 4; i++)
            sum = sum * 31u + (uint32_t)p->bounds[i][k];
        for (int i = 0; i < 3 * t->setup.words; i++)
            sum = sum * 31u + (uint32_t)p->record[k][i % 3][i / 3];
    }
    return sum;
}

static void many(struct kernel_call *c, struct poses (*find)(const struct take *))
{
    struct take t;
    uint32_t seed = c->word[SEED], sum = 0;
    for (int i = 0; i < EIGHTS; i++) {
        make(&t, &seed);
        const struct poses poses = find(&t);
        sum = sum_up(sum, &poses, &t);
    }
    c->word[1] = sum;
}

static void reference(struct kernel_call *c) { many(c, poses_one_by_one); }
static void by_eights(struct kernel_call *c) { many(c, poses_by_eights); }
#endif

extern const struct kernel kernels_poses[];
const struct kernel kernels_poses[] = {
#if SMEAR_AVX2
    /* Each length is another call, whose data are other triangles. */
    { .name = "poses (made, found, summed up)", .least = 24 * EIGHTS - 60, .most = 24 * EIGHTS, .size = { 1 }, .timed = 24 * EIGHTS,
      .form = { { "one by one", reference }, { "eights", by_eights } } },
#endif
    { .name = NULL }
};
