/* SPDX-License-Identifier: MIT */
/* test_space.c - triangles with paths in space against floating point: where they are, what is seen of them, and how their planes
 * move from pixel to pixel. */
#include "geometry/shot.h"
#include "geometry/space.h"

#include "temporal/row_lists.h"

#include "tests/host.h"
#include "tests/unit/store.h"

enum { W = 70, H = 44, POOL_WORDS = 400, SCALE = 14, CORNERS = 4, KEYS = 3 };

static uint32_t words[POOL_WORDS];
static const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 65536, .far_plane = 500 * 65536 };
static struct smear_shot shot;
static struct smear_space space;

/* A parallelogram that goes along parabolas: its corners at open, in the middle and at close, as X Y W and distance, and their
 * records. */
struct sheet {
    struct smear_homogeneous place[CORNERS][KEYS];
    const int32_t *record[CORNERS];
    unsigned in_space;
};

static void begin(bool is_even)
{
    store_begin(words, POOL_WORDS, 1, W, H, false);
    shot.camera[0] = camera;
    shot.camera[0].half_height = is_even ? 65536 : 0;
    geometry.shot = &shot;
    set_path_layout(0, false, false, true, SHADE_FLAT);
    segment[0].flat_depth = is_even ? 13 : 0;
    segment[0].scale = SCALE;
    smear_space_make(&space, &geometry, &segment[0], W, H);
}

static bool is_even(void) { return segment[0].flat_depth; }

/* A place given by x and y in view and its distance, or of an orthographic camera x and y in pixels and its depth from far to near,
 * 0 .. 1. */
static struct smear_homogeneous place_of(const double at[3])
{
    const double unit = 1 << (is_even() ? 12 : SCALE), pixels = H / 2.0 / (1 << space.depths.coarse);
    if (is_even())
        return (struct smear_homogeneous){ (int32_t)lrint(at[0] * unit), (int32_t)lrint(at[1] * unit), (int32_t)unit,
                                           (int32_t)lrint((1 - at[2]) * space.depths.far_distance) };
    const int32_t w = (int32_t)lrint(at[2] * unit);
    return (struct smear_homogeneous){ (int32_t)lrint(at[0] * pixels * unit), (int32_t)lrint(at[1] * pixels * unit), w, w };
}

/* A place at a phase, -1 .. 1. */
static void exact_at(double out[4], const struct smear_homogeneous key[KEYS], double p)
{
    const double k[KEYS][4] = { { key[0].x, key[0].y, key[0].w, key[0].distance }, { key[1].x, key[1].y, key[1].w, key[1].distance },
                                { key[2].x, key[2].y, key[2].w, key[2].distance } };
    for (int i = 0; i < 4; i++)
        out[i] = k[1][i] + ((k[2][i] - k[0][i]) * p + (k[0][i] + k[2][i] - 2 * k[1][i]) * p * p) / 2;
}

/* Places on the way around an axis through the eye are exact, and the lines along it at its ends hold them between them. */
static void test_what_a_camera_turns_past_goes_around_it(void)
{
    begin(false);
    for (int n = 0; n < 2000; n++) {
        const double turn = uniform(0.2, 0.78), scale = 1 << 24;
        double axis[3], at[KEYS + 1][3], length = 0;
        struct smear_homogeneous h;
        uint32_t *const record = words;
        for (int i = 0; i < 3; i++) {
            axis[i] = uniform(-1, 1);
            at[1][i] = uniform(-1, 1);
            length += axis[i] * axis[i];
        }
        length = sqrt(length);
        space.turn = (uint32_t)lrint(turn / (2 * 3.14159265358979) * 4294967296.0);
        space.phase = INT32_MIN;
        const double phase = uniform(-1, 1), angle[KEYS + 1] = { -turn, 0, turn, phase * turn };
        for (int k = 0; k < KEYS + 1; k++) {        /* Rodrigues */
            double dot = 0;
            for (int i = 0; i < 3; i++)
                dot += axis[i] / length * at[1][i];
            for (int i = 0; i < 3 && k != 1; i++) {
                const int j = (i + 1) % 3, m = (i + 2) % 3;
                at[k][i] = at[1][i] * cos(angle[k]) + (axis[j] * at[1][m] - axis[m] * at[1][j]) / length * sin(angle[k])
                         + axis[i] / length * dot * (1 - cos(angle[k]));
            }
        }
        for (int i = 0; i < 3; i++) {
            record[i] = (uint32_t)(int32_t)lrint(at[1][i] * scale);
            record[segment[0].motion + i] = (uint32_t)(int32_t)lrint(at[0][i] * scale);
            record[segment[0].motion + PATH_POSE_WORDS + i] = (uint32_t)(int32_t)lrint(at[2][i] * scale);
        }
        smear_space_at(&h, &space, (const int32_t *)(const void *)record, (int32_t)lrint(phase * (1 << 30)));
        const int32_t found[3] = { h.x, h.y, h.w };
        for (int i = 0; i < 3; i++)     /* of a phase of 16 bits */
            if (!CHECK_CLOSE(found[i], at[3][i] * scale, 3 * scale / 32768))
                return;
        CHECK_CLOSE(smear_space_bulge(&space) / 16384.0, 1 / cos(turn), 0.001);
    }
}

/* Whether a vertex goes so evenly that its path on the screen is that in space. */
static bool goes_evenly(const struct smear_homogeneous key[KEYS])
{
    const double pixel = 1 << space.depths.coarse;
    /* Nothing of the path is cut. */
    const int32_t margin = is_even() ? space.depths.far_distance / 4 : space.depths.near_distance / 50;
    for (int k = 0; k < KEYS; k++)
        if (key[k].distance < space.depths.near_distance + margin || key[k].distance > space.depths.far_distance - margin
            || fabs((double)key[k].w - key[1].w) > key[1].w / 256.0 || fmax(abs(key[k].x), abs(key[k].y)) * pixel > 200.0 * key[k].w)
            return false;
    return true;
}

static void store_sheet(struct sheet *s)
{
    geometry.vertex_words = 0;
    s->in_space = 0;
    for (int i = 0; i < CORNERS; i++) {
        const uint16_t word = store_vertex(0);
        s->record[i] = (const int32_t *)(const void *)pool + word;
        smear_space_store(&pool[word], &segment[0], &s->place[i][0], &s->place[i][1], &s->place[i][2]);
        if (!goes_evenly(s->place[i])) {
            s->in_space |= 1u << i;
            continue;
        }
        static const int order[KEYS] = { 1, 0, 2 };
        for (int k = 0; k < KEYS; k++) {
            struct smear_screen screen;
            smear_project(&screen, &space.depths, &s->place[i][order[k]], &space.viewport);
            const int32_t at[PATH_POSE_WORDS] = { screen.x, screen.y, screen.depth };
            for (int j = 0; j < PATH_POSE_WORDS; j++)
                pool[geometry.vertex_words++] = (uint32_t)at[j];
        }
    }
}

/* X Y W of three places: above 0 where they are clockwise on the screen. */
static double volume(double h[3][4])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += h[i][2] * (h[(i + 1) % 3][0] * h[(i + 2) % 3][1] - h[(i + 2) % 3][0] * h[(i + 1) % 3][1]);
    return sum;
}

/* A sheet anywhere: most pass the near plane or the sides. */
static void random_sheet(struct sheet *s)
{
    double corner[3], edge[2][3], way[3], bend[3];
    for (int j = 0; j < 3; j++) {
        const double size = is_even() ? (j == 2 ? 0.3 : 60) : 1 << between(0, 5);
        corner[j] = uniform(-size, size);
        edge[0][j] = uniform(-size, size);
        edge[1][j] = uniform(-size, size);
        way[j] = uniform(-size, size) * (chance(3) ? 0.002 : 0.5);
        bend[j] = chance(2) ? 0 : uniform(-1, 1) * way[j];
    }
    corner[2] += is_even() ? 0.5 : 2;
    for (int i = 0; i < CORNERS; i++)
        for (int k = 0; k < KEYS; k++) {
            double at[3];
            for (int j = 0; j < 3; j++)
                at[j] = corner[j] + (i == 1 || i == 2 ? edge[0][j] : 0) + (i >= 2 ? edge[1][j] : 0) + way[j] * (k - 1)
                      + bend[j] * (k - 1) * (k - 1);
            s->place[i][k] = place_of(at);
        }
    store_sheet(s);
}

/* The corners' places at a phase, in the order in which they are clockwise: `order`. False where the sheet is seen from its edge. */
static bool sheet_at(double at[CORNERS][4], int order[CORNERS], const struct sheet *s, double p)
{
    double turned[CORNERS][4];
    for (int i = 0; i < CORNERS; i++)
        exact_at(turned[i], s->place[i], p);
    double whole = volume(turned), size = 0;
    for (int i = 0; i < 3; i++)
        size += fabs(turned[i][0]) + fabs(turned[i][1]) + fabs(turned[i][2]);
    for (int i = 0; i < CORNERS; i++) {
        order[i] = whole < 0 && i != 0 ? CORNERS - i : i;
        for (int j = 0; j < 4; j++)
            at[i][j] = turned[order[i]][j];
    }
    return fabs(whole) > size * size * size * 1e-5;
}

/* ------------------------------------------------------------------ what is seen */

/* How far inside of a sheet the middle of a pixel lies: of its sides in pixels, and of the near and far plane in parts of their
 * distance, the least. Below 0: outside. */
static double inside(double at[CORNERS][4], int x, int y)
{
    const double one = 1 << space.depths.coarse, p[3] = { (x + 0.5 - W / 2.0) / one, (y + 0.5 - H / 2.0) / one, 1 };
    double least = INFINITY, weight[3], whole = volume(at);
    for (int i = 0; i < CORNERS; i++) {
        const double *a = at[i], *b = at[(i + 1) % CORNERS];
        const double side[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
        const double value = side[0] * p[0] + side[1] * p[1] + side[2] * p[2], per_pixel = hypot(side[0], side[1]) / one;
        least = fmin(least, per_pixel > 0 ? value / per_pixel : value > 0 ? INFINITY : -INFINITY);
    }
    for (int i = 0; i < 3; i++) {
        const double *a = at[(i + 1) % 3], *b = at[(i + 2) % 3];
        weight[i] = ((a[1] * b[2] - a[2] * b[1]) * p[0] + (a[2] * b[0] - a[0] * b[2]) * p[1] + (a[0] * b[1] - a[1] * b[0])) / whole;
    }
    /* sum of weights: 1 / W */
    const double sum = weight[0] + weight[1] + weight[2];
    const double distance = (weight[0] * at[0][3] + weight[1] * at[1][3] + weight[2] * at[2][3]) / (is_even() ? sum : 1);
    const double here = is_even() ? distance : 1 / sum, near = space.depths.near_distance, far = space.depths.far_distance;
    const double unit = is_even() ? far / 64 : near / 8;
    if (sum <= 0)
        return -INFINITY;
    return fmin(least, fmin((here - near) / unit, (far - here) / unit));
}

/* ------------------------------------------------------------------ planes that move */

/* Where the point of a plane that pixel (x, y) shows in the middle is at a key, px from the frame's centre. Returns how far in front of
 * the eye that is, in parts of what it is the sum of. */
static double comes_from(double out[2], double *nearness, const struct sheet *s, const int order[CORNERS], int key, int x, int y)
{
    const double one = 1 << space.depths.coarse, p[3] = { (x + 0.5 - W / 2.0) / one, (y + 0.5 - H / 2.0) / one, 1 };
    double sum[3] = { 0, 0, 0 }, size = 0, at[3][4];
    *nearness = 0;
    for (int i = 0; i < 3; i++)
        exact_at(at[i], s->place[order[i]], 0);
    const double whole = volume(at);
    for (int i = 0; i < 3; i++) {
        const double *a = at[(i + 1) % 3], *b = at[(i + 2) % 3];
        const double weight = (a[1] * b[2] - a[2] * b[1]) * p[0] + (a[2] * b[0] - a[0] * b[2]) * p[1] + (a[0] * b[1] - a[1] * b[0]);
        const struct smear_homogeneous *h = &s->place[order[i]][key];
        sum[0] += weight * h->x;
        sum[1] += weight * h->y;
        sum[2] += weight * h->w;
        size += fabs(weight * h->w);
        *nearness += weight / whole;
    }
    out[0] = sum[0] / sum[2] * one;
    out[1] = sum[1] / sum[2] * one;
    return sum[2] / size;
}

static void test_planes_go_where_floating_point_has_them(void)
{
    random_state = 3;
    int seen = 0, refused = 0;
    double worst = 0;
    for (int n = 0; n < 12000; n++) {
        struct sheet s;
        struct smear_plane_motion m;
        double at[CORNERS][4];
        int order[CORNERS];
        begin(n % 4 == 3);
        random_sheet(&s);
        if (!sheet_at(at, order, &s, 0))
            continue;
        const int32_t *const record[3] = { s.record[order[0]], s.record[order[1]], s.record[order[2]] };
        const int right = between(0, 3), down = between(0, 3), step = between(1, 4);
        int x = between(0, W - 1), y = between(0, H - 1);
        for (int tries = 0; tries < 40 && inside(at, x + right * step, y + down * step) < 1; tries++) {
            x = between(0, W - 1);
            y = between(0, H - 1);
        }
        REQUIRE(smear_plane_motion_make(&m, &space, record, x, y, step));
        for (int i = 0; i < right; i++)
            smear_plane_motion_go(&m, false);
        for (int i = 0; i < down; i++)
            smear_plane_motion_go(&m, true);
        const int px = x + right * step, py = y + down * step;
        struct smear_place_motion motion;
        double open[2], close[2], nearness;
        const bool is_seen = smear_plane_motion_at(&motion, &m, px, py);
        const double from = comes_from(open, &nearness, &s, order, 0, px, py), to = comes_from(close, &nearness, &s, order, 2, px, py);
        if (!is_seen || motion.bend == PLACE_UNKNOWN) {
            refused++;
            continue;
        }
        if (!CHECK(from > -1e-3 && to > -1e-3) || !CHECK(is_even() || inside(at, px, py) > -1))
            return;
        if (from < 1e-3 || to < 1e-3 || fabs(open[0]) + fabs(open[1]) + fabs(close[0]) + fabs(close[1]) > 4000)
            continue;
        seen++;
        const double error = fmax(fabs(motion.x - 16 * (close[0] - open[0])), fabs(motion.y - 16 * (close[1] - open[1])));
        const double size = 16 * (fabs(close[0]) + fabs(open[0]) + fabs(close[1]) + fabs(open[1]));
        worst = fmax(worst, error - size / 1024);
        if (!CHECK(error <= 2 + size / 1024)) {
            CHECK_EQ(motion.x, (int64_t)(16 * (close[0] - open[0])));
            CHECK_EQ(motion.y, (int64_t)(16 * (close[1] - open[1])));
            CHECK_EQ(n, -1);
            return;
        }
        if (is_even())
            continue;
        const double depth = SMEAR_DEPTH_MAX / 16384.0 * space.depths.near_distance * nearness;
        if (depth < 65535 && !CHECK_CLOSE(motion.depth, depth, 2 + depth / 256))
            return;
    }
    CHECK(seen > 1000);
    CHECK(refused > 1000);
}

/* Where a picture shows a part of 2^19 of a scene before an orthographic camera, its places have fewer bits than a unit. */
static void test_sums_of_four_places_fit_however_large_the_scene(void)
{
    for (int n = 0; n < 20000; n++) {
        struct smear_homogeneous h = { (int32_t)lrint(uniform(-1, 1) * (1 << 30)), (int32_t)lrint(uniform(-1, 1) * (1 << 30)), 1,
                                       (int32_t)lrint(uniform(-1, 1) * (1 << 29)) };
        smear_space_scale(&h, (int)lrint(uniform(-31, 31)), (int)lrint(uniform(-31, 0)));
        if (!CHECK(abs(h.x) <= 1 << 29 && abs(h.y) <= 1 << 29 && abs(h.distance) <= 1 << 29))
            return;
    }
}

#include "build/suites/space.h"
