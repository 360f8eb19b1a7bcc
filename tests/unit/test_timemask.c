/* SPDX-License-Identifier: MIT */
/* test_timemask.c - the time mask against what it stands for: the same triangles drawn at the middle of every sample by exact
 * integer arithmetic, and averaged. Needs neither libc nor floating point. */
#include "temporal/timemask.h"

#include "base/pixel.h"
#include "raster/raster.h"
#include "geometry/transform.h"
#include "tests/host.h"
#include "tests/unit/store.h"

enum {
    W = 48, H = 40, POOL_WORDS = 9000, SEGMENTS = 4, MOVERS = 480, TILE_MAX = 64, CANARY = 64, WORK_WORDS = 2048,
    FLAT = 0, GOURAUD = 1, TEXTURED = 2, LIT = 3            /* segments */
};

static uint32_t store[POOL_WORDS];
static struct smear_moving_triangle mover[MOVERS];
static uint32_t mover_count, list_last;

static uint32_t still_color[W * H], result[W * H];
static uint16_t still_depth[W * H];
static uint32_t out[TILE_MAX * TILE_MAX];
static uint32_t work[CANARY + WORK_WORDS + CANARY];

static uint32_t sum[W * H][3], instant_color[W * H];
static int32_t instant_depth[W * H];

static uint32_t texels[32 * 32];

/* ------------------------------------------------------------------ scenes made by hand */

/* A vertex at three times: x, y in q8 px, depth in units q11. */
struct place { int32_t x, y, depth; };
struct path { struct place open, middle, close; };

static void scene_begin(bool linear)
{
    store_begin(store, POOL_WORDS, SEGMENTS, W, H, linear);
    for (int i = 0; i < SEGMENTS; i++) {
        bool color = i == GOURAUD || i == LIT;
        set_path_layout(i, i >= TEXTURED, color, true, i == TEXTURED ? SHADE_NONE : color ? SHADE_GOURAUD : SHADE_FLAT);
    }
    mover_count = 0;
    list_last = SMEAR_NO_TRIANGLE;
    for (int i = 0; i < W * H; i++) {
        still_color[i] = 0x204060u + (uint32_t)(i % 7) * 0x10101u;
        still_depth[i] = 0;
    }
}

static void set_texture(bool bilinear, uint32_t width, uint32_t height)
{
    for (uint32_t i = 0; i < width * height; i++)
        texels[i] = 0xff000000u | (random_u32() & 0xffffffu);
    const smear_texture t = {
        .texels = texels, .width = (uint16_t)width, .height = (uint16_t)height, .format = SMEAR_TEXEL_8888
    };
    for (int i = TEXTURED; i <= LIT; i++)
        smear_sampler_make(&draw[i].sampler, &t, 12, bilinear, frame.linear);
}

static uint16_t add_vertex(int at, const struct path *p)
{
    const struct smear_segment *s = &segment[at];
    uint16_t word = store_vertex(at);
    int32_t *r = (int32_t *)pool + word;
    r[VERTEX_X] = p->middle.x;
    r[VERTEX_Y] = p->middle.y;
    r[VERTEX_DEPTH] = p->middle.depth;
    const struct place pose[2] = { p->open, p->close };
    for (int i = 0; i < 2; i++) {
        int32_t *m = r + s->motion + i * PATH_POSE_WORDS;
        m[PATH_X] = pose[i].x;
        m[PATH_Y] = pose[i].y;
        m[PATH_DEPTH] = pose[i].depth;
    }
    return word;
}

static uint32_t *vertex_words(uint16_t v) { return pool + v; }

static void set_vertex_color(int at, uint16_t v, uint32_t rgb)
{
    uint32_t *c = vertex_words(v) + segment[at].color;
    uint32_t channel[3];
    for (int i = 0; i < 3; i++) {
        uint32_t code = rgb >> (16 - 8 * i) & 255u;
        channel[i] = frame.linear ? smear_srgb_decode[code] : code << 8;
    }
    c[0] = channel[0] | channel[1] << 16;
    c[1] = channel[2] | 0xffff0000u;
}

static void set_vertex_uv(int at, uint16_t v, int32_t u, int32_t w)
{
    vertex_words(v)[segment[at].uv] = ((uint32_t)u & 0xffffu) | (uint32_t)w << 16;
}

/* As assemble_path.c has them. */
static struct smear_path_bounds bounds_of(int at, const int32_t *const v[3])
{
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y0 = INT32_MAX, y1 = INT32_MIN, travel = 0, bend = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *pose[3] = { v[i], v[i] + segment[at].motion, v[i] + segment[at].motion + PATH_POSE_WORDS };
        for (int k = 0; k < 3; k++) {
            x0 = min_i32(x0, pose[k][PATH_X]);
            x1 = max_i32(x1, pose[k][PATH_X]);
            y0 = min_i32(y0, pose[k][PATH_Y]);
            y1 = max_i32(y1, pose[k][PATH_Y]);
        }
        int32_t dx = abs_i32(pose[2][PATH_X] - pose[1][PATH_X]), dy = abs_i32(pose[2][PATH_Y] - pose[1][PATH_Y]);
        travel = max_i32(travel, max_i32(dx, dy) + (min_i32(dx, dy) >> 1));
        bend = max_i32(bend, path_curvature(v[i], &segment[at]));
    }
    int32_t margin = bend >> 3;
    return (struct smear_path_bounds){
        .x0 = (int16_t)((x0 - margin + 127) >> 8), .y0 = (int16_t)((y0 - margin + 127) >> 8),
        .x1 = (int16_t)((x1 + margin + 255) >> 8), .y1 = (int16_t)((y1 + margin + 255) >> 8),
        .travel = (uint16_t)min_i32((travel + 15) >> 4, 65535), .curvature = (uint16_t)min_i32((bend + 15) >> 4, 65535),
        .nearest = 65535
    };
}

/* Clockwise on the screen in the middle of the exposure, whatever the order given. */
static void add_mover(int at, uint16_t a, uint16_t b, uint16_t c, uint32_t color)
{
    const int32_t *v[3] = { (int32_t *)pool + a, (int32_t *)pool + b, (int32_t *)pool + c };
    int64_t area = edge_value(v[0], v[1], v[2][0], v[2][1]);
    const struct smear_path_bounds bounds = bounds_of(at, v);
    struct smear_triangle *t = bins_add_path(&geometry, &list_last, &bounds);
    t->vertex[0] = a;
    t->vertex[1] = area < 0 ? c : b;
    t->vertex[2] = area < 0 ? b : c;
    t->segment = (uint16_t)at;
    t->color = 0xff000000u | color;
    mover[mover_count++] = (struct smear_moving_triangle){ list_last, 0, 255, bounds.nearest };
}

static struct path path_moved(struct place p, int32_t dx, int32_t dy, int32_t depth)
{
    return (struct path){ { p.x - dx / 2, p.y - dy / 2, p.depth - depth / 2 }, p,
                          { p.x - dx / 2 + dx, p.y - dy / 2 + dy, p.depth - depth / 2 + depth } };
}

/* ------------------------------------------------------------------ the time mask */

/* Whether the memory around the work area is as it was. */
static bool draw_movers(int32_t samples, int32_t tile, int32_t bend, int32_t tap)
{
    const struct smear_timemask_settings settings = { samples, bend, 10, tap };
    const size_t words = (smear_timemask_work(tile) + 3) / 4;
    const struct smear_plane_rows rows = { W, 0, H, 0 };
    bool intact = CHECK(words <= WORK_WORDS);
    for (int i = 0; i < CANARY + WORK_WORDS + CANARY; i++)
        work[i] = 0xdeadbeefu;
    for (int32_t y = 0; y < H; y += tile)
        for (int32_t x = 0; x < W; x += tile) {
            struct smear_tile_run t = {
                .frame = &frame, .shutter = &shutter, .moving = mover, .moving_count = mover_count, .column = x / tile,
                .last_column = x / tile, .blend = SMEAR_NO_TRIANGLE, .out = out, .pitch = tile, .tile = tile, .work = work + CANARY
            };
            t.background = (struct smear_raster_target){
                .x0 = x, .y0 = y, .x1 = min_i32(x + tile, W), .y1 = min_i32(y + tile, H), .color = still_color,
                .color_rows = rows, .depth = still_depth, .window_rows = rows
            };
            /* The target's first row is that of y0. */
            t.background.color_rows.ring_row = t.background.window_rows.ring_row = y;
            for (int i = 0; i < TILE_MAX * TILE_MAX; i++)
                out[i] = 0xabababu;
            smear_timemask_tile(&t, &settings);
            for (int32_t i = 0; i < TILE_MAX * TILE_MAX; i++) {
                int32_t px = x + i % tile, py = y + i / tile;
                if (i < tile * tile && px < W && py < H)
                    result[py * W + px] = out[i];
                else
                    intact = intact && out[i] == 0xabababu;
            }
        }
    for (size_t i = 0; i < CANARY; i++)
        intact = intact && work[i] == 0xdeadbeefu && work[CANARY + words + i] == 0xdeadbeefu;
    return CHECK(intact);
}

/* ------------------------------------------------------------------ the truth */

/* The top-left rule at q8 px; edge functions opposite to the vertices. Only triangles that face the eye. */
static bool covers(int32_t (*p)[3], int32_t x, int32_t y, int64_t e[3])
{
    for (int i = 0; i < 3; i++) {
        const int32_t *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
        e[i] = edge_value(a, b, x, y);
        bool counts = b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
        if (e[i] < 0 || (e[i] == 0 && !counts))
            return false;
    }
    return e[0] + e[1] + e[2] > 0;
}

/* a weighed by e, perspective-correct when q is given; scaled down so that products fit. */
static int64_t weighed(const int32_t a[3], const int64_t e[3], const int32_t *q)
{
    int64_t top = 0, bottom = 0;
    for (int i = 0; i < 3; i++) {
        int64_t w = q != NULL ? (e[i] >> 2) * (q[i] >> 16) : e[i];
        top += w * a[i];
        bottom += w;
    }
    return bottom == 0 ? a[0] : (top + bottom / 2) / bottom;
}

static uint32_t truth_texel(const struct smear_sampler *m, int64_t u, int64_t v)
{
    /* mesh units: 4096 are the texture */
    int64_t tu = u * m->width >> 12, tv = v * m->height >> 12;
    int32_t x = (int32_t)(tu % m->width), y = (int32_t)(tv % m->height);
    x += x < 0 ? m->width : 0;
    y += y < 0 ? m->height : 0;
    return texels[y * m->width + x] & 0xffffffu;
}

static uint32_t truth_color(const struct smear_triangle *t, const int64_t e[3], const int32_t depth[3])
{
    const struct smear_segment *s = &segment[t->segment];
    if (s->shade == SHADE_FLAT && s->uv == 0)
        return t->color & 0xffffffu;
    const int32_t *q = s->flat_depth ? NULL : depth;
    uint32_t texel = 0xffffffu, code[3];
    if (s->uv != 0) {
        int32_t u[3], v[3];
        for (int i = 0; i < 3; i++) {
            uint32_t word = pool[t->vertex[i] + s->uv];
            u[i] = (int16_t)(word & 0xffffu);
            v[i] = (int16_t)(word >> 16);
        }
        texel = truth_texel(&draw[s->draw].sampler, weighed(u, e, q), weighed(v, e, q));
        if (s->shade == SHADE_NONE)
            return texel;
    }
    for (int c = 0; c < 3; c++) {
        int32_t value[3];
        for (int i = 0; i < 3; i++)
            value[i] = (int32_t)(pool[t->vertex[i] + s->color + (c >> 1)] >> (c & 1 ? 16 : 0) & 0xffffu);
        uint32_t light = (uint32_t)weighed(value, e, q);
        uint32_t tc = texel >> (16 - 8 * c) & 255u;
        if (s->uv != 0)
            code[c] = frame.linear ? code_times_linear(tc, light) : code_times(tc, (light + 128) >> 8);
        else
            code[c] = frame.linear ? smear_srgb_encode[light >> 4] : (light + 128) >> 8;
    }
    return pixel_make(0, code[0], code[1], code[2]);
}

static void truth_draw(const struct smear_triangle *t, int32_t time)
{
    const struct smear_segment *s = &segment[t->segment];
    int32_t p[3][3], depth[3], low[2] = { INT32_MAX, INT32_MAX }, high[2] = { INT32_MIN, INT32_MIN };
    for (int i = 0; i < 3; i++) {
        path_at(p[i], bins_vertex(&geometry, s, t->vertex[i]), s, time);
        depth[i] = p[i][2];
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = min_i32(low[axis], p[i][axis]);
            high[axis] = max_i32(high[axis], p[i][axis]);
        }
    }
    for (int32_t y = max_i32(low[1] >> 8, 0); y < min_i32((high[1] >> 8) + 1, H); y++)
        for (int32_t x = max_i32(low[0] >> 8, 0); x < min_i32((high[0] >> 8) + 1, W); x++) {
            int64_t e[3];
            if (!covers(p, x * 256 + 128, y * 256 + 128, e))
                continue;
            for (int i = 0; i < 3; i++)
                e[i] = (e[i] >> 8) + 1;         /* so that products fit, and no sum is zero */
            int32_t z = (int32_t)weighed(depth, e, NULL);
            if (z > instant_depth[y * W + x]) {
                instant_depth[y * W + x] = z;
                instant_color[y * W + x] = truth_color(t, e, depth);
            }
        }
}

/* The mean of the instants of all samples, into `sum`: codes times 256. */
static void truth(int32_t samples)
{
    for (int i = 0; i < W * H; i++)
        sum[i][0] = sum[i][1] = sum[i][2] = 0;
    for (int32_t k = 0; k < samples; k++) {
        int32_t step = SHUTTER_SAMPLES / samples;
        int32_t time = (shutter.time[k * step] + shutter.time[(k + 1) * step]) / 2;
        for (int i = 0; i < W * H; i++) {
            instant_color[i] = still_color[i];
            instant_depth[i] = still_depth[i] == 0 ? 0 : (int32_t)(smear_depth_units(still_depth[i]) << 11);
        }
        for (uint32_t i = 0; i < mover_count; i++)
            truth_draw(bins_triangle(&geometry, mover[i].triangle), time);
        for (int i = 0; i < W * H; i++)
            for (int c = 0; c < 3; c++) {
                uint32_t code = instant_color[i] >> (16 - 8 * c) & 255u;
                sum[i][c] += frame.linear ? smear_srgb_decode[code] : code;
            }
    }
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++) {
            uint32_t mean = (sum[i][c] + (uint32_t)samples / 2) / (uint32_t)samples;
            sum[i][c] = frame.linear ? smear_srgb_encode[mean >> 4] : mean;
        }
}

/* ------------------------------------------------------------------ comparing */

struct difference {
    int32_t most;               /* of a channel, codes */
    int32_t unequal;            /* pixels off by more than 1 */
    int32_t touched;            /* pixels that are not the still scene's in the truth */
    int64_t squares;            /* of channels */
};

static struct difference compare(void)
{
    struct difference d = { 0, 0, 0, 0 };
    for (int i = 0; i < W * H; i++) {
        int32_t worst = 0, touched = 0;
        for (int c = 0; c < 3; c++) {
            int32_t got = (int32_t)(result[i] >> (16 - 8 * c) & 255u), want = (int32_t)sum[i][c];
            touched |= want != (int32_t)(still_color[i] >> (16 - 8 * c) & 255u);
            int32_t off = got > want ? got - want : want - got;
            d.squares += (int64_t)off * off;
            worst = max_i32(worst, off);
        }
        CHECK_EQ(result[i] >> 24, 0);
        d.most = max_i32(d.most, worst);
        d.unequal += worst > 1;
        d.touched += touched != 0;
    }
    return d;
}

/* Mean square over the touched pixels, codes^2 times 100. */
static int32_t mean_square(const struct difference *d)
{
    return d->touched == 0 ? 0 : (int32_t)(d->squares * 100 / (3 * d->touched));
}

/* A channel's step, as a code, when `n` of the samples are wrong: dark ones are large in linear light. */
static int32_t step_of(int32_t n, int32_t samples)
{
    return frame.linear ? smear_srgb_encode[4095 * n / samples] : 255 * n / samples + 1;
}

/* ------------------------------------------------------------------ scenes */

static const int32_t depth_middle = 20000 << 11;

static struct place place_of(int32_t x, int32_t y, int32_t depth)
{
    return (struct place){ x, y, depth };
}

static uint16_t random_vertex(int at, int32_t x, int32_t y, int32_t size, int32_t dx, int32_t dy)
{
    struct path path = path_moved(place_of(x + between(-size, size), y + between(-size, size),
                                           depth_middle + between(-2000000, 2000000)), dx, dy, 0);
    return add_vertex(at, &path);
}

/* How a mesh moves during the exposure: by (dx, dy); about its middle it turns by 2 turn / 256 radians, and grows by
 * 2 grow / 256. */
struct motion { int32_t dx, dy, turn, grow; };

/* Where p goes at a time -1 .. 1. cos a = 1 - a^2/2, sin a = a - a^3/6 do for a below 1/2. */
static struct place moved(struct place p, const struct motion *m, int32_t time)
{
    int64_t a = m->turn * time, g = 65536 + (int64_t)m->grow * time * 256;
    int64_t cosine = 65536 - (a * a >> 1), sine = a * 256 - a * a * a / 6 / 256;
    int64_t x = (p.x * cosine - p.y * sine) >> 16, y = (p.x * sine + p.y * cosine) >> 16;
    return place_of((int32_t)(x * g >> 16) + m->dx * time / 2, (int32_t)(y * g >> 16) + m->dy * time / 2, p.depth);
}

enum { GRID_MOST = 8 };

/* A mesh of n x n cells of `cell` q8 px about (x, y), inner vertices shaken, diagonals at random. Colours: one, or one each
 * when rgb is 0. Depth falls by `slope` per cell to the right. */
static void add_mesh(int at, int32_t n, int32_t cell, int32_t x, int32_t y, int32_t depth, int32_t slope,
                     const struct motion *m, uint32_t rgb)
{
    uint16_t v[GRID_MOST + 1][GRID_MOST + 1];
    for (int32_t j = 0; j <= n; j++)
        for (int32_t i = 0; i <= n; i++) {
            bool inner = i > 0 && j > 0 && i < n && j < n;
            struct place p = place_of((2 * i - n) * cell / 2, (2 * j - n) * cell / 2, depth - slope * i);
            if (inner) {
                p.x += between(-cell / 4, cell / 4);
                p.y += between(-cell / 4, cell / 4);
            }
            struct path path = { moved(p, m, -1), moved(p, m, 0), moved(p, m, 1) };
            struct place *places[3] = { &path.open, &path.middle, &path.close };
            for (int k = 0; k < 3; k++) {
                places[k]->x += x;
                places[k]->y += y;
            }
            v[j][i] = add_vertex(at, &path);
            if (segment[at].color != 0)
                set_vertex_color(at, v[j][i], random_u32() & 0xffffffu);
            if (segment[at].uv != 0)
                set_vertex_uv(at, v[j][i], i * 2048, j * 2048);
        }
    for (int32_t j = 0; j < n; j++)
        for (int32_t i = 0; i < n; i++) {
            uint16_t a = v[j][i], b = v[j][i + 1], c = v[j + 1][i + 1], d = v[j + 1][i];
            uint32_t c0 = rgb != 0 ? rgb : random_u32() & 0xffffffu, c1 = rgb != 0 ? rgb : random_u32() & 0xffffffu;
            bool falls = random_u32() & 1u;
            add_mover(at, a, b, falls ? c : d, c0);
            add_mover(at, falls ? a : b, c, d, c1);
        }
}

/* A rectangle of two triangles, all of whose corners have their own places. */
static void add_quad(int at, const struct path corner[4], uint32_t rgb)
{
    uint16_t v[4];
    for (int i = 0; i < 4; i++) {
        v[i] = add_vertex(at, &corner[i]);
        if (segment[at].color != 0)
            set_vertex_color(at, v[i], random_u32() & 0xffffffu);
        if (segment[at].uv != 0)
            set_vertex_uv(at, v[i], i == 1 || i == 2 ? 4096 : 0, i >= 2 ? 4096 : 0);
    }
    add_mover(at, v[0], v[1], v[2], rgb);
    add_mover(at, v[0], v[2], v[3], rgb);
}

static void still_noise(void)
{
    for (int i = 0; i < W * H; i++)
        still_color[i] = random_u32() & 0xffffffu;
}

/* The time mask and the truth; prints what came out when it is not as it should be. `square`: mean of squares, x 100. */
static bool check_against_truth(int32_t samples, int32_t bend, int32_t wrong_samples, int32_t square)
{
    truth(samples);
    bool ok = draw_movers(samples, 16, bend, 256);
    struct difference d = compare();
    ok = CHECK_NEAR(d.most, 0, step_of(wrong_samples, samples)) && ok;
    return CHECK_NEAR(mean_square(&d), 0, square) && ok;
}

/* ------------------------------------------------------------------ coverage */

static void test_a_triangle_that_translates_covers_every_sample_that_it_should(void)
{
    random_state = 1;
    int32_t unequal = 0, touched = 0;
    for (int n = 0; n < 120; n++) {
        int32_t samples = 8 << n % 3, size = 200 << n % 6;
        scene_begin(n & 1);
        int32_t dx = between(-6000, 6000), dy = n % 5 == 0 ? 0 : between(-6000, 6000);
        if (n % 7 == 0)
            dx = 0;
        int32_t x = between(0, W * 256), y = between(0, H * 256);
        uint16_t a = random_vertex(FLAT, x, y, size, dx, dy), b = random_vertex(FLAT, x, y, size, dx, dy);
        uint16_t c = random_vertex(FLAT, x, y, size, dx, dy);
        add_mover(FLAT, a, b, c, 0xffe0c0u);
        truth(samples);
        draw_movers(samples, 16, 64, 256);
        struct difference d = compare();
        REQUIRE_NEAR(d.most, 0, step_of(max_i32(samples / 4, 1), samples));
        unequal += d.unequal;
        touched += d.touched;
    }
    CHECK(touched > 10000);
    CHECK_NEAR(unequal, 0, touched / 100);      /* the truth's places are rounded at every instant */
}

static void test_triangles_that_do_not_move_are_drawn_as_the_raster_draws_them(void)
{
    random_state = 2;
    for (int n = 0; n < 60; n++) {
        scene_begin(n & 1);
        add_mesh(n % 3 == 0 ? GOURAUD : FLAT, between(1, 6), between(60, 2000), between(0, W * 256),
                 between(0, H * 256), depth_middle, between(0, 1) * between(300000, 600000),      /* level, or not */
                 &(struct motion){ 0, 0, 0, 0 }, 0);
        for (int i = 0; i < W * H; i++)
            still_depth[i] = (uint16_t)between(19000, 21000);
        draw_movers(8 << n % 3, 16, 64, 256);
        /* The raster into the still planes. */
        const struct smear_plane_rows rows = { W, 0, H, 0 };
        const struct smear_raster_target target = {
            .x0 = 0, .y0 = 0, .x1 = W, .y1 = H, .color = still_color, .color_rows = rows, .depth = still_depth,
            .window_rows = rows
        };
        struct smear_raster_pass pass;
        smear_raster_begin(&pass, &frame, &target);
        for (uint32_t i = 0; i < mover_count; i++) {
            const struct smear_triangle *t = bins_triangle(&geometry, mover[i].triangle);
            const struct smear_segment *s = &segment[t->segment];
            const int32_t *v[3];
            for (int k = 0; k < 3; k++)
                v[k] = bins_vertex(&geometry, s, t->vertex[k]);
            int64_t area = (int64_t)(v[1][0] - v[0][0]) * (v[2][1] - v[0][1])
                         - (int64_t)(v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
            struct bounds box = { v[0][0], v[0][1], v[0][0], v[0][1] };
            for (int k = 1; k < 3; k++)
                box = (struct bounds){ min_i32(box.x0, v[k][0]), min_i32(box.y0, v[k][1]), max_i32(box.x1, v[k][0]),
                                       max_i32(box.y1, v[k][1]) };
            if (area > 0)
                smear_raster_triangle(&pass, s, t->color, v, &box);
        }
        int32_t unequal = 0;
        for (int i = 0; i < W * H; i++)
            for (int c = 0; c < 3; c++) {
                int32_t got = (int32_t)(result[i] >> (16 - 8 * c) & 255u);
                int32_t want = (int32_t)(still_color[i] >> (16 - 8 * c) & 255u);
                unequal += got > want + 1 || got < want - 1;
            }
        if (!CHECK_NEAR(unequal, 0, 6))         /* depths that differ by one */
            return;
    }
}

/* Whether the pixel and all around it are covered throughout by the colour of a mesh. */
static bool is_core(int32_t at, uint32_t rgb, int32_t rim)
{
    for (int32_t k = -rim; k <= rim; k++)
        for (int32_t l = -rim; l <= rim; l++) {
            int32_t x = at % W + k, y = at / W + l;
            if (x < 0 || y < 0 || x >= W || y >= H)
                continue;
            const uint32_t *c = sum[y * W + x];
            if (pixel_make(0, c[0], c[1], c[2]) != rgb)
                return false;
        }
    return true;
}

static void test_a_closed_mesh_that_translates_leaks_nothing(void)
{
    random_state = 3;
    int32_t core = 0, off = 0;
    for (int n = 0; n < 60; n++) {
        scene_begin(n & 1);
        still_noise();
        int32_t samples = 8 << n % 3, cells = between(2, 8);
        struct motion m = { between(-3000, 3000), between(-3000, 3000), 0, 0 };
        add_mesh(FLAT, cells, 7000 / cells, W * 128, H * 128, depth_middle, between(-100000, 100000), &m, 0x80c040u);
        truth(samples);
        draw_movers(samples, 16 << n % 2, 64, 256);
        for (int i = 0; i < W * H; i++)
            if (is_core(i, 0x80c040u, 0)) {
                core++;
                off += result[i] != 0x80c040u;
            }
    }
    /* Where a vertex passes a centre by less than 1/256 px, a sample may fall between the edges that meet there. */
    CHECK(core > 10000);
    CHECK_NEAR(off, 0, core / 400);
}

static void test_a_closed_mesh_that_turns_leaks_next_to_nothing(void)
{
    random_state = 4;
    int32_t core = 0, off = 0;
    for (int n = 0; n < 60; n++) {
        scene_begin(n & 1);
        still_noise();
        int32_t samples = 8 << n % 3, cells = between(2, 8);
        struct motion m = { between(-2000, 2000), between(-2000, 2000), between(-60, 60), between(-40, 40) };
        add_mesh(FLAT, cells, 7000 / cells, W * 128, H * 128, depth_middle, 0, &m, 0x80c040u);
        truth(samples);
        draw_movers(samples, 16, 32, 256);
        for (int i = 0; i < W * H; i++)
            if (is_core(i, 0x80c040u, 1)) {
                core++;
                off += result[i] != 0x80c040u;
            }
    }
    CHECK(core > 4000);
    CHECK_NEAR(off, 0, core / 100);
}

static void test_meshes_that_turn_and_grow_come_near_the_truth_as_segments_get_shorter(void)
{
    random_state = 5;
    for (int n = 0; n < 40; n++) {
        scene_begin(false);
        struct motion m = { between(-2500, 2500), between(-2500, 2500), between(-60, 60), between(-40, 40) };
        add_mesh(FLAT, between(1, 4), between(600, 2000), W * 128, H * 128, depth_middle, 0, &m, n & 2 ? 0 : 0xffe0c0u);
        truth(32);
        draw_movers(32, 16, 8192, 256);
        struct difference chord = compare();
        END_UNLESS(check_against_truth(32, 2, 5, 500));
        struct difference d = compare();
        REQUIRE(d.squares <= chord.squares + 200);
    }
}

/* ------------------------------------------------------------------ depth */

static struct path quad_corner(int32_t x, int32_t y, int32_t depth, const struct motion *m, int32_t deeper)
{
    return path_moved(place_of(x, y, depth), m->dx, m->dy, deeper);
}

/* A rectangle with its own depth at the left and at the right side. */
static void add_slab(int at, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t left, int32_t right,
                     const struct motion *m, int32_t deeper, uint32_t rgb)
{
    const struct path corner[4] = {
        quad_corner(x0, y0, left, m, deeper), quad_corner(x1, y0, right, m, deeper),
        quad_corner(x1, y1, right, m, deeper), quad_corner(x0, y1, left, m, deeper)
    };
    add_quad(at, corner, rgb);
}

static void test_a_mover_passes_before_and_behind_still_surfaces(void)
{
    random_state = 6;
    for (int n = 0; n < 20; n++) {
        scene_begin(n & 1);
        still_noise();
        for (int i = 0; i < W * H; i++)      /* posts nearer than the mover, a wall behind */
            still_depth[i] = (uint16_t)(i % W % 8 < 3 ? 24000 : 15000);
        struct motion m = { between(-3000, 3000), between(-3000, 3000), 0, 0 };
        add_slab(FLAT, 3000, 2000, 9000, 8000, depth_middle, depth_middle, &m, 0, 0xffe0c0u);
        END_UNLESS(check_against_truth(32, 64, 2, 200));
        for (int i = 0; i < W * H; i++)
            if (still_depth[i] == 24000 && !CHECK_EQ(result[i], still_color[i]))
                return;
    }
}

static void test_two_movers_that_cross_hide_each_other_by_depth(void)
{
    random_state = 7;
    for (int n = 0; n < 20; n++) {
        scene_begin(n & 1);
        struct motion right = { 4000, between(-500, 500), 0, 0 }, left = { -4000, between(-500, 500), 0, 0 };
        add_slab(FLAT, 2000, 2000, 7000, 8000, depth_middle, depth_middle, &right, 0, 0xffe0c0u);
        add_slab(FLAT, 5000, 3000, 10000, 9000, depth_middle + (n & 2 ? 3000000 : -3000000), depth_middle, &left, 0,
                 0x4080ffu);
        END_UNLESS(check_against_truth(32, 64, 2, 200));
    }
}

static void test_surfaces_that_run_through_each_other_part_where_they_meet(void)
{
    random_state = 8;
    for (int n = 0; n < 20; n++) {
        scene_begin(n & 1);
        for (int i = 0; i < W * H; i++)     /* a still wall that the mover cuts at its middle */
            still_depth[i] = 20000;
        struct motion m = { between(1000, 4000), between(-500, 500), 0, 0 };
        add_slab(FLAT, 1000, 1000, 11000, 9000, depth_middle - 6000000, depth_middle + 6000000, &m, 0, 0xffe0c0u);
        add_slab(FLAT, 1000, 2000, 11000, 8000, depth_middle + 7000000, depth_middle - 5000000, &m, 0, 0x4080ffu);
        /* A run takes one side: the middle decides. */
        END_UNLESS(check_against_truth(32, 64, 16, 80000));
    }
}

static void test_a_mover_that_comes_nearer_uncovers_what_it_was_behind(void)
{
    scene_begin(false);
    for (int i = 0; i < W * H; i++)
        still_depth[i] = 20000;
    struct motion none = { 0, 0, 0, 0 };
    add_slab(FLAT, 2000, 2000, 8000, 8000, depth_middle - (1 << 20), depth_middle - (1 << 20), &none, 0, 0xffe0c0u);
    add_slab(FLAT, 2000, 2000, 8000, 8000, depth_middle + (1 << 20), depth_middle + (1 << 20), &none, 0, 0x4080ffu);
    check_against_truth(32, 64, 0, 0);
    CHECK_EQ(result[20 * W + 20], 0x4080ffu);
}

/* ------------------------------------------------------------------ many at a time */

static void test_more_surfaces_than_entries_still_add_up(void)
{
    random_state = 9;
    for (int n = 0; n < 20; n++) {
        scene_begin(n & 1);
        still_noise();
        /* Splinters of less than a sample's travel, at many depths. */
        for (int i = 0; i < 100; i++) {
            int32_t x = between(-1000, W * 256 + 1000), y = between(-1000, H * 256 + 1000), size = between(200, 700);
            int32_t dx = between(2000, 6000), dy = between(-1000, 1000);
            uint16_t a = random_vertex(FLAT, x, y, size, dx, dy), b = random_vertex(FLAT, x, y, size, dx, dy);
            add_mover(FLAT, a, b, random_vertex(FLAT, x, y, size, dx, dy), random_u32() & 0xffffffu);
        }
        END_UNLESS(check_against_truth(32, 64, 16, 400));
    }
    /* Of one colour, whatever is merged. */
    scene_begin(true);
    for (int i = 0; i < W * H; i++)
        still_color[i] = 0x336699u;
    for (int i = 0; i < 120; i++) {
        int32_t x = between(0, W * 256), y = between(0, H * 256), dx = between(2000, 6000);
        uint16_t a = random_vertex(FLAT, x, y, 700, dx, 0), b = random_vertex(FLAT, x, y, 700, dx, 0);
        add_mover(FLAT, a, b, random_vertex(FLAT, x, y, 700, dx, 0), 0x336699u);
    }
    draw_movers(32, 16, 64, 256);
    for (int i = 0; i < W * H; i++)
        REQUIRE_EQ(result[i], 0x336699u);
}

static void test_the_order_of_movers_does_not_matter_while_there_are_entries(void)
{
    static uint32_t before[W * H];
    random_state = 10;
    for (int n = 0; n < 20; n++) {
        scene_begin(n & 1);
        for (int i = 0; i < 3; i++) {
            struct motion m = { between(-4000, 4000), between(-4000, 4000), 0, 0 };
            int32_t x = between(0, 6000), y = between(0, 5000), depth = depth_middle + (i << 22);
            const struct path corner[3] = {
                quad_corner(x, y, depth, &m, 0), quad_corner(x + 5000, y + 300, depth, &m, 0),
                quad_corner(x + 2000, y + 4000, depth, &m, 0)
            };
            add_mover(FLAT, add_vertex(FLAT, &corner[0]), add_vertex(FLAT, &corner[1]), add_vertex(FLAT, &corner[2]),
                      random_u32() & 0xffffffu);
        }
        for (int turn = 0; turn < 6; turn++) {
            draw_movers(32, 16, 64, 256);
            for (int i = 0; i < W * H; i++) {
                if (turn > 0 && !CHECK_EQ(result[i], before[i]))
                    return;
                before[i] = result[i];
            }
            struct smear_moving_triangle swap = mover[turn & 1];
            mover[turn & 1] = mover[1 + (turn & 1)];
            mover[1 + (turn & 1)] = swap;
        }
    }
}

static void test_the_size_of_tiles_does_not_matter_for_what_translates(void)
{
    static uint32_t before[W * H];
    random_state = 11;
    for (int n = 0; n < 12; n++) {
        scene_begin(n & 1);
        struct motion m = { between(-4000, 4000), between(-4000, 4000), 0, 0 };
        add_mesh(n % 3 == 0 ? GOURAUD : FLAT, 6, 1500, W * 128, H * 128, depth_middle, 100000, &m, 0);
        for (int32_t tile = 16; tile <= 64; tile *= 2) {
            draw_movers(8 << n % 3, tile, 64, 256);
            for (int i = 0; i < W * H; i++) {
                if (tile > 16 && !CHECK_EQ(result[i], before[i]))
                    return;
                before[i] = result[i];
            }
        }
        draw_movers(8 << n % 3, 8, 64, 256);     /* of 8 px: planes begin elsewhere, and are rounded so */
        int32_t unequal = 0;
        for (int i = 0; i < W * H; i++)
            unequal += result[i] != before[i];
        REQUIRE_NEAR(unequal, 0, W * H / 40);
    }
}

/* ------------------------------------------------------------------ limits */

static void test_what_enters_and_leaves_the_frame_is_blurred_as_if_there_were_more(void)
{
    random_state = 12;
    for (int n = 0; n < 24; n++) {
        scene_begin(n & 1);
        struct motion m = { n & 2 ? 12000 : -12000, n & 4 ? 6000 : -2000, 0, 0 };
        add_mesh(FLAT, 2, 3000, n & 2 ? 0 : W * 256, between(0, H * 256), depth_middle, 0, &m, n & 1 ? 0 : 0xffe0c0u);
        END_UNLESS(check_against_truth(8 << n % 3, 64, 2, 200));
    }
}

static void test_coordinates_of_the_guard_band_are_exact_enough(void)
{
    random_state = 13;
    const int32_t far = 2048 << 8;
    for (int n = 0; n < 24; n++) {
        scene_begin(n & 1);
        struct motion m = { between(-200000, 200000), between(-200000, 200000), 0, 0 };
        if (n & 2)
            m.dx = between(-3000, 3000);
        if (n & 4)
            m.dy = between(-3000, 3000);
        const struct path corner[3] = {
            quad_corner(-far / 2, between(-far / 2, 0), depth_middle, &m, 0),
            quad_corner(far / 2, between(-far / 2, far / 2), depth_middle + 8000000, &m, 0),
            quad_corner(between(-far / 2, far / 2), far / 2, depth_middle - 8000000, &m, 0)
        };
        add_mover(FLAT, add_vertex(FLAT, &corner[0]), add_vertex(FLAT, &corner[1]), add_vertex(FLAT, &corner[2]), 0xffe0c0u);
        END_UNLESS(check_against_truth(32, 64, 3, 300));
    }
}

static void test_anything_at_all_gives_a_picture_between_its_colours(void)
{
    random_state = 14;
    const int32_t far = 2048 << 8;
    for (int n = 0; n < 40; n++) {
        scene_begin(n & 1);
        set_texture(n & 2, 16, 16);
        for (int i = 0; i < W * H; i++)
            still_color[i] = 0x406080u;
        for (int i = 0; i < 1024; i++)
            texels[i] = 0xff406080u;
        for (int k = 0; k < 40; k++) {
            uint16_t v[3];
            int at = between(0, 2);
            for (int i = 0; i < 3; i++) {
                struct path path;
                struct place *p[3] = { &path.open, &path.middle, &path.close };
                int32_t size = between(0, 3) == 0 ? far : 8000;
                for (int j = 0; j < 3; j++)
                    *p[j] = place_of(between(-size, size) + W * 128, between(-size, size) + H * 128,
                                     between(SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX));
                if (between(0, 4) == 0)         /* thin, or nothing at all */
                    path.middle = path.open = path.close;
                v[i] = i == 2 && between(0, 6) == 0 ? v[0] : add_vertex(at, &path);
                if (segment[at].color != 0)
                    set_vertex_color(at, v[i], 0x406080u);
                if (segment[at].uv != 0)
                    set_vertex_uv(at, v[i], between(-32768, 32767), between(-32768, 32767));
            }
            add_mover(at, v[0], v[1], v[2], 0x406080u);
        }
        draw_movers(8 << n % 3, 16, between(1, 500), between(1, 500));
        for (int i = 0; i < W * H; i++)
            REQUIRE_EQ(result[i], 0x406080u);
    }
}

static void test_slivers_keep_to_the_colours_of_their_vertices(void)
{
    random_state = 15;
    for (int n = 0; n < 60; n++) {
        scene_begin(n & 1);
        for (int i = 0; i < W * H; i++)
            still_color[i] = 0x808080u;
        for (int k = 0; k < 20; k++) {
            int32_t x = between(0, 12000), y = between(0, 10000), dx = between(-3000, 3000), dy = between(-3000, 3000);
            int32_t lx = between(-9000, 9000), ly = between(-9000, 9000), depth = depth_middle;
            const struct path path[3] = {
                path_moved(place_of(x, y, depth), dx, dy, 0),
                path_moved(place_of(x + lx, y + ly, depth), dx + between(-9, 9), dy, 0),
                path_moved(place_of(x + lx / 2 + between(-6, 6), y + ly / 2 + between(-6, 6), depth), dx, dy, 0)
            };
            uint16_t v[3];
            for (int i = 0; i < 3; i++) {
                v[i] = add_vertex(GOURAUD, &path[i]);
                set_vertex_color(GOURAUD, v[i], pixel_make(0, (uint32_t)between(100, 156), (uint32_t)between(100, 156),
                                                          (uint32_t)between(100, 156)));
            }
            add_mover(GOURAUD, v[0], v[1], v[2], 0);
        }
        draw_movers(8 << n % 3, 16, 64, 256);
        for (int i = 0; i < W * H; i++)
            for (int c = 0; c < 24; c += 8)
                REQUIRE_NEAR(result[i] >> c & 255u, 128, 29);
    }
}

static void test_what_turns_over_is_seen_while_it_faces(void)
{
    for (int n = 0; n < 4; n++) {
        scene_begin(n & 1);
        /* The right side swings through to the left, or back. */
        struct path corner[3] = {
            path_moved(place_of(6000, 2000, depth_middle), 0, 0, 0),
            path_moved(place_of(6300, 5000, depth_middle), n & 2 ? 9000 : -9000, 0, 0),
            path_moved(place_of(6000, 8000, depth_middle), 0, 0, 0)
        };
        corner[1].middle.x = (corner[1].open.x + corner[1].close.x) / 2;
        add_mover(FLAT, add_vertex(FLAT, &corner[0]), add_vertex(FLAT, &corner[1]), add_vertex(FLAT, &corner[2]), 0xffe0c0u);
        END_UNLESS(check_against_truth(32, 64, 3, 300));
        CHECK_EQ(result[20 * W + 20], still_color[20 * W + 20]);       /* behind it, where only its back would be */
    }
}

static void test_a_shutter_that_is_not_a_box_weighs_time(void)
{
    random_state = 16;
    for (int n = 0; n < 20; n++) {
        scene_begin(n & 1);
        /* Open in the middle: half the samples in a quarter of the time. */
        for (int i = 0; i <= SHUTTER_SAMPLES; i++) {
            int32_t u = i * 4096 - 65536;                               /* -1 .. 1 */
            shutter.time[i] = 32768 + ((u >> 1) + (int32_t)((int64_t)u * u / 65536 * u / 65536 >> 1)) / 2;
        }
        struct motion m = { between(-4000, 4000), between(-4000, 4000), 0, 0 };
        add_mesh(FLAT, between(1, 4), 1500, W * 128, H * 128, depth_middle, 0, &m, 0xffe0c0u);
        END_UNLESS(check_against_truth(32, 16, 3, 4000));
    }
}

/* ------------------------------------------------------------------ colours */

static void test_colours_between_vertices_follow_the_surface(void)
{
    random_state = 17;
    for (int n = 0; n < 40; n++) {
        scene_begin(n & 1);
        struct motion m = { between(-4000, 4000), between(-4000, 4000), n & 2 ? 30 : 0, 0 };
        segment[GOURAUD].flat_depth = (n & 4) != 0;
        add_mesh(GOURAUD, between(1, 4), between(1500, 4000), W * 128, H * 128, depth_middle, n & 8 ? 9000000 : 0, &m, 0);
        END_UNLESS(check_against_truth(32, 16, 8, 700));
    }
}

static void test_textures_are_taken_along_the_motion(void)
{
    random_state = 18;
    for (int n = 0; n < 40; n++) {
        int at = n & 1 ? LIT : TEXTURED;
        scene_begin(n & 2);
        set_texture(false, n % 3 == 0 ? 24 : 32, 16);
        segment[at].flat_depth = (n & 4) != 0;
        struct motion m = { between(-2000, 2000), between(-2000, 2000), 0, 0 };
        add_mesh(at, 3, 3000, W * 128, H * 128, depth_middle, n & 8 ? 8000000 : 0, &m, 0);
        truth(32);
        draw_movers(32, 16, 32, 128);
        struct difference fine = compare();
        draw_movers(32, 16, 32, 4096);
        struct difference coarse = compare();
        REQUIRE_NEAR(mean_square(&fine), 0, 15000);
        if (m.dx > 600 || m.dx < -600)
            CHECK(fine.squares < coarse.squares / 3);
    }
}

#include "build/suites/timemask.h"
