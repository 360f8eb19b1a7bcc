/* SPDX-License-Identifier: MIT */
/* test_subframes.c - tiles of moving triangles against the plain way: every instant drawn over the whole frame from a
 * list of its own, summed, divided. Bit for bit. Needs neither libc nor floating point. */
#include "temporal/subframes.h"

#include "temporal/tile_method.h"

#include "base/pixel.h"
#include "geometry/shot.h"
#include "geometry/space.h"
#include "raster/raster.h"
#include "geometry/transform.h"
#include "tests/host.h"
#include "tests/unit/store.h"

enum { W = 70, H = 44, RING = 51, POOL_WORDS = 16000, SEGMENTS = 10, MOVERS = 400, TILE_MAX = 64 };

/* A scene: what is still, what moves, what is blended, in lists of one pool. */
static uint32_t store[POOL_WORDS];
static struct smear_moving_triangle mover[MOVERS];
static uint32_t mover_count, still_head, still_last, blend_head, blend_last;
static uint32_t texels[32 * 16];
static uint8_t in_space;        /* vertices of the next triangle with a path that have it in space, a bit for each */
static const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 65536, .far_plane = 20 * 65536 };
enum { SPACE_SCALE = 12 };      /* log2 of W per unit */

/* Its still surfaces, in a ring of rows like the window's. */
static uint32_t still_color[W * RING];
static uint16_t still_depth[W * RING];

/* An instant as a scene of its own. */
static uint32_t posed_pool[POOL_WORDS];
static struct smear_bins posed;
static uint32_t instant_color[W * H], want[W * H];
static uint16_t instant_depth[W * H];
static uint32_t sum[W * H * 3];

/* ------------------------------------------------------------------ scenes */

static struct smear_shot shot;

static void scene_begin(bool linear)
{
    store_begin(store, POOL_WORDS, SEGMENTS, W, H, linear);
    mover_count = 0;
    in_space = 0;
    shot.camera[0] = camera;
    geometry.shot = &shot;
    still_head = still_last = blend_head = blend_last = SMEAR_NO_TRIANGLE;
    for (int i = 0; i < 32 * 16; i++)
        texels[i] = random_u32();
}

static void set_texture(int at, bool bilinear)
{
    const smear_texture texture = { .texels = texels, .width = 32, .height = 16 };
    smear_sampler_make(&draw[at].sampler, &texture, 14, bilinear, frame.linear);
}

/* Three places (open, middle, close: x, y, depth each) of three vertices. */
struct corners {
    int32_t at[3][3][3];
};

static int64_t area_at(const struct corners *c, int pose)
{
    const int32_t (*p)[3] = c->at[pose];
    return edge_value(p[0], p[1], p[2][0], p[2][1]);
}

static bool has_room(void)
{
    return bins_has_room(&geometry, 3 * (16 + SCREEN_PATH_WORDS), 2) && mover_count < MOVERS;
}

/* Pixels near its way; of what moves in space, all. */
static struct smear_path_bounds bounds_of(const struct corners *c)
{
    if (in_space != 0)
        return (struct smear_path_bounds){ .x1 = W, .y1 = H, .flags = PATH_SPACE, .space = in_space };
    int32_t low[2] = { INT32_MAX, INT32_MAX }, high[2] = { INT32_MIN, INT32_MIN };
    for (int32_t time = 0; time <= SHUTTER_CLOSE; time += 64)
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 2; j++) {
                int32_t at = path_coordinate(c->at[0][k][j], c->at[1][k][j], c->at[2][k][j], path_phase(time));
                low[j] = at < low[j] ? at : low[j];
                high[j] = at > high[j] ? at : high[j];
            }
    return (struct smear_path_bounds){
        .x0 = (int16_t)((low[0] + 125) >> 8), .y0 = (int16_t)((low[1] + 125) >> 8),
        .x1 = (int16_t)((high[0] + 129) >> 8), .y1 = (int16_t)((high[1] + 129) >> 8)
    };
}

/* A place about the near plane, mostly in view or beside it. */
static struct smear_homogeneous random_place(const struct smear_segment *s)
{
    const int32_t w = chance(8) ? between(-(100 << SPACE_SCALE), 100 << SPACE_SCALE) : between(-(1 << SPACE_SCALE), 6 << SPACE_SCALE);
    const int32_t part = chance(8) ? 100 : 1;
    if (s->flat_depth)
        return (struct smear_homogeneous){ between(-W, W) * 2048 * part, between(-H, H) * 2048 * part, 4096,
                                           between(-(1 << 29), SMEAR_DEPTH_MAX) };
    return (struct smear_homogeneous){ w / 16 * between(-20, 20) * part, w / 16 * between(-16, 16) * part, w, w };
}

/* Fills in a vertex of a path in space; one that has a path on the screen besides has that behind its record. */
static void store_in_space(uint32_t word, const struct smear_segment *s, const struct corners *c, int k)
{
    struct smear_homogeneous place[3] = { random_place(s), random_place(s), random_place(s) };
    if (chance(2))
        place[0] = place[2] = place[1];
    smear_space_store(&pool[word], s, &place[0], &place[1], &place[2]);
    if (((unsigned)in_space >> k & 1u) != 0)
        return;
    static const uint8_t order[3] = { 1, 0, 2 };
    for (int pose = 0; pose < 3; pose++)
        for (int j = 0; j < PATH_POSE_WORDS; j++)
            pool[geometry.vertex_words++] = (uint32_t)c->at[order[pose]][k][j];
}

/* Stores a triangle; of a still segment the middle alone. */
static uint32_t add_triangle(int at, const struct corners *c, uint32_t color)
{
    const struct smear_segment *s = &segment[at];
    if (s->path) {
        void *entry = bins_triangle(&geometry, geometry.triangle_count++);
        *(struct smear_path_bounds *)entry = bounds_of(c);
    }
    uint32_t i = geometry.triangle_count++;
    struct smear_triangle *t = bins_triangle(&geometry, i);
    *t = (struct smear_triangle){ .segment = (uint16_t)at, .next = SMEAR_NO_TRIANGLE, .color = color };
    for (int k = 0; k < 3; k++) {
        uint32_t word = store_vertex(at);
        t->vertex[k] = (uint16_t)word;
        for (int j = 0; j < 3; j++) {
            pool[word + (uint32_t)j] = (uint32_t)c->at[1][k][j];
            if (s->path) {
                pool[word + s->motion + (uint32_t)j] = (uint32_t)c->at[0][k][j];
                pool[word + s->motion + PATH_POSE_WORDS + (uint32_t)j] = (uint32_t)c->at[2][k][j];
            }
        }
        if (s->path && in_space != 0)
            store_in_space(word, s, c, k);
        if (s->uv != 0)
            pool[word + s->uv] = random_u32();
        for (uint32_t j = 0; j < 2 && s->color != 0; j++)
            pool[word + s->color + j] = random_u32();
    }
    return i;
}

/* Columns are counted in tiles of 8 px here; check_tiles() makes them those of its tile. */
static void add_mover(int at, const struct corners *c, uint32_t color)
{
    const struct smear_path_bounds b = bounds_of(c);
    int32_t first = b.x0 >> 3, last = (b.x1 - 1) >> 3;
    if (last < 0 || first > W / 8)
        return;
    mover[mover_count++] = (struct smear_moving_triangle){
        .triangle = add_triangle(at, c, color), .first = (uint8_t)(first < 0 ? 0 : first),
        .last = (uint8_t)(last > W / 8 ? W / 8 : last), .nearest = UINT16_MAX
    };
}

/* ------------------------------------------------------------------ the plain way */

/* The time of instant k of n: where (k + 1/2) / n of the light has come in. */
static int32_t time_of(int32_t k, int32_t n)
{
    int64_t place = ((int64_t)(2 * k + 1) * SHUTTER_SAMPLES << 15) / n;
    int32_t slot = (int32_t)(place >> 16);
    int64_t step = shutter.time[slot + 1] - shutter.time[slot];
    return shutter.time[slot] + (int32_t)(step * (place & 0xffff) >> 16);
}

/* Appends a triangle of so many words a vertex to the instant's list, where it is seen from the front. */
static void append_posed(const struct smear_triangle *from, const struct smear_segment *s, const int32_t *const record[3], int words)
{
    if (edge_value(record[0], record[1], record[2][0], record[2][1]) <= 0)
        return;
    uint32_t n = posed.triangle_count++;
    struct smear_triangle *t = bins_triangle(&posed, n);
    *t = *from;
    t->next = SMEAR_NO_TRIANGLE;
    for (int k = 0; k < 3; k++) {
        uint32_t word = posed.vertex_words;
        posed.vertex_words += s->stride;
        t->vertex[k] = (uint16_t)word;
        for (int j = 0; j < s->stride; j++)
            posed_pool[word + (uint32_t)j] = j < words ? (uint32_t)record[k][j] : 0;
    }
    if (n > 0)
        bins_triangle(&posed, n - 1)->next = n;
}

/* What is seen of a triangle in space, as test_space.c has it. */
static void pose_in_space(const struct smear_triangle *from, const struct smear_segment *s, unsigned bits, int32_t time)
{
    static const int32_t no_shift[2];
    const int32_t *const v[3] = { bins_vertex(&geometry, s, from->vertex[0]), bins_vertex(&geometry, s, from->vertex[1]),
                                  bins_vertex(&geometry, s, from->vertex[2]) };
    struct smear_space space;
    struct path_record corner[SMEAR_CLIP_MAX];
    smear_space_make(&space, &geometry, s, W, H);
    const int count = smear_space_pose(corner, &space, v, bits, path_phase(time), no_shift);
    for (int i = 2; i < count; i++) {
        const int32_t *const record[3] = { corner[0].word, corner[i - 1].word, corner[i].word };
        append_posed(from, s, record, s->motion);
    }
}

/* A triangle of the scene at a time, at the end of the instant's list. */
static void pose_triangle(uint32_t i, int32_t time)
{
    const struct smear_triangle *from = bins_triangle(&geometry, i);
    const struct smear_segment *s = &segment[from->segment];
    if (s->path && bins_bounds(&geometry, i)->space != 0) {
        pose_in_space(from, s, bins_bounds(&geometry, i)->space, time);
        return;
    }
    const int32_t guard = SMEAR_GUARD_PX << 8;
    int32_t corner[3][16];
    const int32_t *const record[3] = { corner[0], corner[1], corner[2] };
    for (int k = 0; k < 3; k++) {
        const int32_t *v = bins_vertex(&geometry, s, from->vertex[k]);
        for (int j = 0; j < s->stride; j++)
            corner[k][j] = v[j];
        if (s->path)
            path_at(corner[k], v, s, time);
        corner[k][0] = clamp_i32(corner[k][0], W * 128 - guard, W * 128 + guard);
        corner[k][1] = clamp_i32(corner[k][1], H * 128 - guard, H * 128 + guard);
        corner[k][2] = clamp_i32(corner[k][2], SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
    }
    append_posed(from, s, record, s->stride);
}

static void draw_posed(void)
{
    struct smear_raster_frame f = frame;
    const struct smear_plane_rows rows = { W, 0, H, 0 };
    const struct smear_raster_target target = {
        .x1 = W, .y1 = H, .color = instant_color, .color_rows = rows, .depth = instant_depth, .window_rows = rows
    };
    f.bins = &posed;
    if (posed.triangle_count != 0)
        smear_raster_list(&f, &target, 0);
}

static void posed_begin(void)
{
    posed = geometry;
    posed.pool = posed_pool;
    posed.vertex_words = posed.triangle_count = 0;
}

static bool want_is_high[W * H * 3];       /* one code more is right, too */
static bool want_is_rounded;               /* of light in 12 bits: any code beside is right, too */

static bool is_wanted(uint32_t pixel, int32_t i)
{
    for (int c = 0; c < 3; c++) {
        uint32_t code = pixel >> (16 - 8 * c) & 255u, mean = want[i] >> (16 - 8 * c) & 255u;
        const bool is_beside = code + 1 == mean || code == mean + 1;
        if (code != mean && !(want_is_high[3 * i + c] && code == mean + 1) && !(want_is_rounded && is_beside))
            return false;
    }
    return true;
}

static void draw_want(int32_t instants)
{
    for (int i = 0; i < W * H * 3; i++)
        sum[i] = 0;
    for (int32_t k = 0; k < instants; k++) {
        int32_t time = time_of(k, instants);
        for (int i = 0; i < W * H; i++) {
            instant_color[i] = 0x305070u;
            instant_depth[i] = 0;
        }
        posed_begin();
        for (uint32_t i = still_head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(&geometry, i)->next)
            pose_triangle(i, time);
        for (uint32_t i = 0; i < mover_count; i++)
            pose_triangle(mover[i].triangle, time);
        draw_posed();
        posed_begin();
        for (uint32_t i = blend_head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(&geometry, i)->next)
            pose_triangle(i, time);
        draw_posed();
        for (int i = 0; i < W * H; i++)
            for (int c = 0; c < 3; c++) {
                uint32_t code = instant_color[i] >> (16 - 8 * c) & 255u;
                sum[3 * i + c] += frame.linear ? smear_srgb_decode[code] : code;
            }
    }
    uint32_t n = (uint32_t)instants;
    want_is_rounded = frame.linear || instants > SMEAR_PACKED_INSTANTS;
    for (int i = 0; i < W * H; i++) {
        want[i] = 0;
        for (int c = 0; c < 3; c++) {
            uint32_t mean = (sum[3 * i + c] + n / 2) / n;
            want[i] = want[i] << 8 | (frame.linear ? smear_srgb_encode[mean >> 4] : mean);
            /* Means of codes in 16 bits go up a little early. */
            want_is_high[3 * i + c] = !frame.linear && instants <= 256
                                   && 128 * ((sum[3 * i + c] + n / 2) % n) >= 127 * n;
        }
    }
}

/* ------------------------------------------------------------------ tiles */

enum { CANARY = 16, WORK_WORDS = TILE_MAX * TILE_MAX * 9 / 2 + 512 };

static struct {
    uint32_t before[CANARY], out[TILE_MAX * TILE_MAX], between[CANARY], work[WORK_WORDS + CANARY];
} memory;

static uint32_t still_color_before[W * RING];
static uint16_t still_depth_before[W * RING];

/* A target for rows [y0, y1) of the ring. */
static struct smear_raster_target ring_target(int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    const struct smear_plane_rows rows = { W, (y0 + 20) % RING, RING, 0 };
    return (struct smear_raster_target){
        .x0 = x0, .y0 = y0, .x1 = x1 < W ? x1 : W, .y1 = y1 < H ? y1 : H, .color = still_color, .color_rows = rows,
        .depth = still_depth, .window_rows = rows
    };
}

static void draw_still(void)
{
    for (int i = 0; i < W * RING; i++) {
        still_color[i] = 0x305070u;
        still_depth[i] = 0;
    }
    const struct smear_raster_target target = ring_target(0, 0, W, H);
    if (still_head != SMEAR_NO_TRIANGLE)
        smear_raster_list(&frame, &target, still_head);
    for (int i = 0; i < W * RING; i++) {
        still_color_before[i] = still_color[i];
        still_depth_before[i] = still_depth[i];
    }
}

static uint32_t samples;

static struct smear_tile_run tiles_at(int32_t tile, int32_t column, int32_t tiles, int32_t row, const struct smear_moving_triangle *movers)
{
    return (struct smear_tile_run){
        .frame = &frame, .shutter = &shutter,
        .background = ring_target(column * tile, row * tile, (column + tiles) * tile, (row + 1) * tile),
        .x0 = column * tile, .x1 = (column + tiles) * tile,
        .moving = movers, .moving_count = mover_count, .column = column, .last_column = column + tiles - 1,
        .blend = blend_head, .out = memory.out, .pitch = tiles * tile, .tile = tile, .work = memory.work
    };
}

/* Tiles beside each other against `want`. */
static bool check_tiles(int32_t tile, int32_t column, int32_t tiles, int32_t row, int32_t instants)
{
    static struct smear_moving_triangle movers[MOVERS];
    for (uint32_t i = 0; i < mover_count; i++) {
        movers[i] = mover[i];
        movers[i].first = (uint8_t)(mover[i].first * 8 / tile);
        movers[i].last = (uint8_t)(mover[i].last * 8 / tile);
    }
    size_t words = smear_subframes_work(tiles * tile, tile) / 4;
    for (size_t i = 0; i < sizeof memory / 4; i++)
        ((uint32_t *)&memory)[i] = 0xabcd0000u + (uint32_t)i;
    const struct smear_tile_run t = tiles_at(tile, column, tiles, row, movers);
    samples += smear_subframes_tiles(&t, instants, NULL);
    for (int32_t y = t.background.y0; y < t.background.y1; y++)
        for (int32_t x = t.background.x0; x < t.background.x1; x++)
            if (!CHECK(is_wanted(memory.out[(y - t.background.y0) * t.pitch + x - t.background.x0], y * W + x))) {
                CHECK_EQ(memory.out[(y - t.background.y0) * t.pitch + x - t.background.x0] & 0xffffffu, want[y * W + x]);
                CHECK_EQ(x, -1);
                CHECK_EQ(y, -1);
                CHECK_EQ(tile, -1);
                return false;
            }
    /* Nothing else was written. */
    const uint32_t *first = (const uint32_t *)&memory;
    for (size_t i = 0; i < sizeof memory / 4; i++) {
        bool out = i >= CANARY && i < CANARY + (size_t)(tiles * tile * tile);
        bool work = i >= 2 * CANARY + TILE_MAX * TILE_MAX && i < 2 * CANARY + TILE_MAX * TILE_MAX + words;
        if (!out && !work && !CHECK_EQ(first[i], 0xabcd0000u + (uint32_t)i))
            return false;
    }
    for (int i = 0; i < W * RING; i++)
        if (!CHECK_EQ(still_color[i], still_color_before[i]) || !CHECK_EQ(still_depth[i], still_depth_before[i]))
            return false;
    return true;
}

/* All tiles of the scene, one by one or some together. */
static bool check_wide(int32_t tile, int32_t tiles, int32_t instants)
{
    draw_still();
    draw_want(instants);
    samples = 0;
    for (int32_t row = 0; row * tile < H; row++)
        for (int32_t column = 0; column * tile < W; column += tiles)
            if (!check_tiles(tile, column, tiles, row, instants))
                return false;
    return true;
}

static bool check_scene(int32_t tile, int32_t instants)
{
    return check_wide(tile, 1, instants);
}

/* ------------------------------------------------------------------ random scenes */

static void random_corners(struct corners *c, int32_t size, int32_t travel)
{
    int32_t x = between(-1000, W * 256 + 1000), y = between(-1000, H * 256 + 1000);
    int32_t level = between(0, 8);
    for (int k = 0; k < 3; k++) {
        int32_t depth = SMEAR_DEPTH_MIN + between(0, SMEAR_DEPTH_MAX - SMEAR_DEPTH_MIN) / (1 << level);
        int32_t from[3] = { x + between(-size, size), y + between(-size, size), depth };
        for (int pose = 0; pose < 3; pose++) {
            c->at[pose][k][0] = from[0] + (pose == 1 ? 0 : between(-travel, travel));
            c->at[pose][k][1] = from[1] + (pose == 1 ? 0 : between(-travel, travel));
            c->at[pose][k][2] = chance(4) ? SMEAR_DEPTH_MIN + between(0, SMEAR_DEPTH_MAX - SMEAR_DEPTH_MIN) / (1 << level)
                                          : depth;
        }
    }
    if (chance(2)) {        /* in one piece */
        for (int pose = 0; pose < 3; pose += 2) {
            int32_t dx = between(-travel, travel), dy = between(-travel, travel);
            for (int k = 0; k < 3; k++) {
                c->at[pose][k][0] = c->at[1][k][0] + dx;
                c->at[pose][k][1] = c->at[1][k][1] + dy;
            }
        }
    }
    if (area_at(c, 1) < 0) {        /* clockwise in the middle */
        for (int pose = 0; pose < 3; pose++)
            for (int j = 0; j < 3; j++) {
                int32_t keep = c->at[pose][1][j];
                c->at[pose][1][j] = c->at[pose][2][j];
                c->at[pose][2][j] = keep;
            }
    }
}

enum { STILL_SEGMENTS = 3, MOVER_SEGMENTS = 7 };        /* the last of each list is blended */

/* Everything there is: kinds of vertices, textures, alpha, sizes, travel. */
static void random_scene(bool blends)
{
    scene_begin(chance(2));
    for (int i = 0; i < SEGMENTS; i++) {
        bool uv = random_u32() & 1u, color = random_u32() & 1u, path = i >= STILL_SEGMENTS;
        set_path_layout(i, uv, color, path, color ? SHADE_GOURAUD : uv && chance(2) ? SHADE_NONE : SHADE_FLAT);
        segment[i].flat_depth = chance(4);
        segment[i].scale = SPACE_SCALE;
        draw[i].alpha = (uint8_t)(i == 2 || i == 9 ? SMEAR_BLEND : chance(3) ? SMEAR_CUTOUT : SMEAR_OPAQUE);
        draw[i].cutoff = (uint8_t)between(1, 255);
        set_texture(i, chance(3));
    }
    int32_t travel = 256 << between(0, 5);
    for (int n = between(1, 30); n > 0 && has_room(); n--) {
        struct corners c;
        int kind = between(0, blends ? SEGMENTS - 1 : SEGMENTS - 2), size = 256 << between(0, 6);
        if (!blends && kind == 2)
            kind = 0;
        random_corners(&c, size, travel);
        if (area_at(&c, 1) == 0)
            continue;
        uint32_t color = random_u32();
        in_space = (uint8_t)(chance(3) && segment[kind].path ? between(1, 7) : 0);
        if (kind == 2 || kind == 9) {
            uint32_t i = add_triangle(kind, &c, color);
            link_in(&blend_head, &blend_last, i);
        } else if (kind < STILL_SEGMENTS) {
            uint32_t i = add_triangle(kind, &c, color);
            link_in(&still_head, &still_last, i);
        } else {
            add_mover(kind, &c, color);
        }
        in_space = 0;
    }
}

static void test_tiles_are_the_mean_of_whole_frames(void)
{
    random_state = 1;
    uint32_t seen = 0;
    for (int n = 0; n < 240; n++) {
        random_scene(n & 1);
        END_UNLESS(check_scene(8 << (n & 3), between(1, 12)));
        seen += samples != 0;
    }
    CHECK(seen > 200);
}

/* A white square that travels over black and grey, `px` pixels; its first row is `row`, of ten. */
static void square_scene_at(bool linear, int32_t px, int32_t row)
{
    scene_begin(linear);
    set_path_layout(3, false, false, true, SHADE_FLAT);
    for (int half = 0; half < 2; half++) {
        struct corners c;
        for (int pose = 0; pose < 3; pose++) {
            int32_t x = 20 * 256 + (pose - 1) * px * 128, y = row * 256 + 77;
            const int32_t corner[4][2] = { { x, y }, { x + 2560, y }, { x + 2560, y + 2560 }, { x, y + 2560 } };
            for (int k = 0; k < 3; k++) {
                int at = k == 0 ? 0 : half + k;
                c.at[pose][k][0] = corner[at][0];
                c.at[pose][k][1] = corner[at][1];
                c.at[pose][k][2] = 1 << 28;
            }
        }
        add_mover(3, &c, 0xffffffffu);
    }
}

static void square_scene(bool linear, int32_t px) { square_scene_at(linear, px, 10); }

static void test_every_number_of_instants_divides_exactly(void)
{
    static const int16_t many[] = { 127, 128, 129, 255, 256, 257, 258, 300, 511, 512, 513, 1000, 1023, 1024 };
    random_state = 2;
    for (int linear = 0; linear < 2; linear++) {
        square_scene(linear, 9);
        for (int32_t n = 1; n <= 66; n++)
            END_UNLESS(check_scene(16, n));
        for (int i = 0; i < (int)(sizeof many / sizeof *many); i++)
            END_UNLESS(check_scene(16, many[i]));
    }
}

static void test_a_moving_edge_is_a_ramp(void)
{
    /* 32 instants, 8 px: the square's sides are ramps of 8 px, 4 instants per pixel. */
    square_scene(false, 8);
    CHECK(check_scene(16, 32));
    for (int32_t i = 0; i < 8; i++) {
        uint32_t code = (uint32_t)(255 * (4 * i + 2) + 16) / 32;
        uint32_t still = (0x30u * (uint32_t)(32 - 4 * i - 2) + 16u) / 32u;
        CHECK_NEAR(want[15 * W + 16 + i] >> 16 & 255u, code + still, 2);
    }
    CHECK_EQ(want[15 * W + 15], 0x305070u);
    CHECK_EQ(want[15 * W + 25], 0xffffffu);
}

static void test_tiles_together_are_what_they_are_alone(void)
{
    random_state = 12;
    for (int n = 0; n < 30; n++) {
        random_scene(n & 1);
        END_UNLESS(check_wide(n % 3 == 0 ? 8 : 16, 2 + n % 4, between(2, 12)));
    }
}

/* A plan by which all that is seen goes on by (x, y) from one of so many instants to the next, 1/16 px. */
static const struct smear_tile_plan *plan_of(int32_t x, int32_t y, int32_t instants)
{
    static struct smear_block block[(W / BLOCK_PX) * (TILE_MAX / BLOCK_PX)];
    static struct smear_row_blocks blocks = { block, W / BLOCK_PX };
    static const struct smear_tile_plan plan = { .blocks = &blocks };
    for (size_t i = 0; i < sizeof block / sizeof *block; i++)
        block[i] = (struct smear_block){ (int16_t)(x * instants), (int16_t)(y * instants), 1, 0, BLOCK_INSTANTS_MAX };
    return &plan;
}

/* The middle row of tiles with `instants`, and what lies between them closed: the largest distance from 64 instants. */
static int32_t closed_error(int32_t instants, const struct smear_tile_plan *plan)
{
    static struct smear_moving_triangle movers[MOVERS];
    int32_t worst = 0;
    for (uint32_t i = 0; i < mover_count; i++) {
        movers[i] = mover[i];
        movers[i].first = (uint8_t)(mover[i].first / 2);
        movers[i].last = (uint8_t)(mover[i].last / 2);
    }
    draw_still();
    draw_want(64);
    struct smear_tile_run t = tiles_at(16, 0, 4, 0, movers);
    smear_subframes_tiles(&t, instants, plan);
    for (int32_t y = 12; y < 16; y++)
        for (int32_t x = 0; x < 60; x++)
            for (int c = 0; c < 24; c += 8) {
                int32_t is = (int32_t)(memory.out[y * t.pitch + x] >> c & 255u), right = (int32_t)(want[y * W + x] >> c & 255u);
                worst = is - right > worst ? is - right : right - is > worst ? right - is : worst;
            }
    return worst;
}

static void test_a_step_closes_the_gap_between_instants(void)
{
    /* A white square goes 24 px: a ramp of 24 px, of which 4 instants are stairs 6 px long. */
    for (int linear = 0; linear < 2; linear++) {
        square_scene(linear, 24);
        CHECK(closed_error(4, NULL) >= 25);
        CHECK(closed_error(4, plan_of(96, 0, 4)) <= (linear ? 12 : 9));
        for (int32_t n = 1; n <= BLOCK_INSTANTS_MAX; n++)
            if (!CHECK(closed_error(n, plan_of(24 * 16 / n, 0, n)) <= (n < 3 ? 90 : 16)))
                CHECK_EQ(n, closed_error(n, plan_of(24 * 16 / n, 0, n)));
    }
}

static void test_gaps_along_a_curve_close_for_fewer_instants(void)
{
    /* 28 px along, alone, and with a path of which the middle lies up to 31 px off the chord. */
    struct smear_block block = { 28 * 16, 0, 1, 0, 0 };
    const struct smear_row_blocks blocks = { &block, 1 };
    struct smear_closing before = smear_block_closing(&blocks, 0, 0, 1);
    CHECK(before.last > 14 && before.left < 16);
    for (int32_t curvature = 8; curvature < 256; curvature += 8) {
        block.curvature = (uint8_t)curvature;
        const struct smear_closing closing = smear_block_closing(&blocks, 0, 0, 1);
        CHECK(closing.last <= before.last && closing.left >= before.left);
        before = closing;
    }
    CHECK_EQ(before.last, 0);
}

static void test_light_of_one_colour_stays_that_colour(void)
{
    /* At all instants, and at none before a background of it, with and without taps beside the pixel. More than 16
     * instants have less than 16 bits to round in. */
    static const int32_t offset[] = { 0, 0, 0, 0, 0, 0, 0, 0 };
    const uint16_t depth = 0;
    for (uint32_t n = 1; n <= 1024; n += n < 40 ? 1 : 123)
        for (int32_t pairs = 0; pairs <= 8; pairs += 4)
            for (uint32_t code = 0; code < 256; code++) {
                uint32_t memory_of_sum[2] = { 0, 0 }, color = code * 0x10101u, background = ~color & 0xffffffu;
                const struct packed_sums sums = packed_sums_in(memory_of_sum, 1);
                const struct light_mean mean = smear_light_mean(smear_light_full(n), pairs, 16, 7, true);
                const struct gap_planes planes = { &color, &depth, sums, UINT16_MAX };
                const struct gap_pairs taps = { offset, pairs, smear_light_most(n) };
                smear_light_means(&planes, 0, 1, &taps, &mean, COVER_NONE);
                REQUIRE_EQ(color, code * 0x10101u);
                for (uint32_t k = 0; k < n; k++) {
                    const struct light_instant instant = smear_light_instant(k, n, true);
                    uint32_t pixel = color;
                    smear_light_add(&pixel, &background, sums, 1, &instant, true);
                }
                uint32_t mixed = background;
                const struct gap_planes before = { &mixed, &depth, sums, UINT16_MAX };
                smear_light_means(&before, 0, 1, &taps, &mean, COVER_NONE);
                REQUIRE_NEAR(mixed & 0xffu, code, n <= 16 ? 0 : 1);
            }
}

static void test_wide_gaps_of_many_instants_keep_white(void)
{
    /* White all over: sums of linear light are the largest there are. Of steps beyond 17 px, 17 are closed. */
    static const int16_t steps[] = { 256, 272, 280, 400 };
    const struct corners all = { { { { -9000, -9000, 1 << 28 }, { 60000, -9000, 1 << 28 }, { -9000, 60000, 1 << 28 } },
                                   { { -9000, -9000, 1 << 28 }, { 60000, -9000, 1 << 28 }, { -9000, 60000, 1 << 28 } },
                                   { { -9000, -9000, 1 << 28 }, { 60000, -9000, 1 << 28 }, { -9000, 60000, 1 << 28 } } } };
    for (int i = 0; i < 8; i++)
        for (int32_t n = 1; n <= BLOCK_INSTANTS_MAX; n++) {
            scene_begin(i & 1);
            set_path_layout(3, false, false, true, SHADE_FLAT);
            add_mover(3, &all, 0xffffffu);
            mover[0].first = 0;
            mover[0].last = 3;
            draw_still();
            const struct smear_tile_run t = tiles_at(16, 0, 4, 0, mover);
            smear_subframes_tiles(&t, n, plan_of(steps[i >> 1], 0, n));
            for (int32_t at = 0; at < 64 * 16; at++)
                REQUIRE_EQ(memory.out[at] & 0xffffffu, 0xffffffu);
        }
}

static void test_gaps_at_a_border_close_with_what_lies_beyond_it(void)
{
    uint32_t wide[32], unlike[2] = { 0, 0 };
    square_scene(false, 24);
    for (uint32_t i = 0; i < mover_count; i++) {
        mover[i].first = 0;
        mover[i].last = 3;
    }
    draw_still();
    struct smear_tile_run t = tiles_at(16, 0, 4, 0, mover);
    smear_subframes_tiles(&t, 4, plan_of(96, 0, 4));
    for (int32_t x = 0; x < 32; x++)
        wide[x] = memory.out[14 * t.pitch + x];
    for (int32_t margin = 0; margin <= 3; margin += 3) {
        draw_still();
        t = tiles_at(16, 0, 2, 0, mover);
        t.pitch = 64;
        t.background.x1 += margin;
        t.last_column += margin != 0;
        smear_subframes_tiles(&t, 4, plan_of(96, 0, 4));
        for (int32_t x = 0; x < 32; x++)
            unlike[margin != 0] += memory.out[14 * t.pitch + x] != wide[x];
    }
    CHECK_EQ(unlike[1], 0);
    CHECK(unlike[0] > 0);
}

static void test_what_hides_movers_stays_as_it_is_beside_closed_gaps(void)
{
    square_scene(false, 24);
    for (uint32_t i = 0; i < mover_count; i++)
        mover[i].nearest = 20000;
    draw_still();
    struct smear_tile_run t = tiles_at(16, 0, 4, 0, mover);
    for (int32_t y = 0; y < 16; y++)        /* a post */
        for (int32_t x = 24; x < 27; x++) {
            int32_t at = (y + 20) % RING * W + x;
            still_color[at] = 0x102030u;
            still_depth[at] = 60000;
        }
    for (uint32_t i = 0; i < mover_count; i++) {
        mover[i].first = 0;
        mover[i].last = 3;
    }
    smear_subframes_tiles(&t, 4, plan_of(96, 0, 4));
    for (int32_t x = 24; x < 27; x++)
        CHECK_EQ(memory.out[14 * t.pitch + x] & 0xffffffu, 0x102030u);
    /* Beside it the square is as white as where there is no post. */
    CHECK((memory.out[14 * t.pitch + 23] & 255u) > 150u && (memory.out[14 * t.pitch + 27] & 255u) > 150u);
}

static void test_a_still_surface_between_movers_keeps_its_edges_beside_closed_gaps(void)
{
    /* A post before the square's way, but not before what it might come to: nothing tells but where it is seen. */
    uint32_t alone[64], post[64];
    for (int linear = 0; linear < 2; linear++) {
        square_scene(linear, 24);
        for (int with = 0; with < 2; with++) {
            draw_still();
            struct smear_tile_run t = tiles_at(16, 0, 4, 0, mover);
            for (uint32_t i = 0; i < mover_count; i++) {
                mover[i].first = 0;
                mover[i].last = 3;
                mover[i].nearest = UINT16_MAX;
            }
            for (int32_t y = 0; with && y < 16; y++)
                for (int32_t x = 24; x < 27; x++) {
                    int32_t at = (y + 20) % RING * W + x;
                    still_color[at] = 0x102030u;
                    still_depth[at] = 60000;
                }
            smear_subframes_tiles(&t, 4, plan_of(96, 0, 4));
            for (int32_t x = 0; x < 64; x++)
                (with ? post : alone)[x] = memory.out[14 * t.pitch + x] & 255u;
        }
        for (int32_t x = 24; x < 27; x++)
            CHECK_EQ(post[x], 0x30);
        for (int32_t x = 20; x < 31; x++)
            if ((x < 24 || x >= 27) && !CHECK(post[x] + 32 >= alone[x] && post[x] <= alone[x] + 32))
                CHECK_EQ(post[x], alone[x]);
    }
}

static void test_shutters_weigh_by_their_slots(void)
{
    random_state = 3;
    for (int n = 0; n < 40; n++) {
        random_scene(n & 1);
        shutter.time[0] = between(0, 3000);
        for (int i = 1; i <= SHUTTER_SAMPLES; i++)
            shutter.time[i] = shutter.time[i - 1] + between(0, (SHUTTER_CLOSE - shutter.time[i - 1]) / 4);
        END_UNLESS(check_scene(16, between(1, 40)));
    }
}

static void test_paths_that_stand_turn_over_or_vanish(void)
{
    random_state = 4;
    for (int n = 0; n < 60; n++) {
        random_scene(n & 1);
        mover_count = 0;
        for (int i = 0; i < 12 && has_room(); i++) {
            struct corners c;
            random_corners(&c, 256 << between(0, 5), 0);
            int kind = between(0, 3);
            for (int pose = 0; pose < 3; pose += 2)
                for (int k = 0; k < 3; k++)
                    for (int j = 0; j < 2; j++) {
                        int32_t middle = c.at[1][0][j], off = c.at[1][k][j] - middle;
                        c.at[pose][k][j] = kind == 0 ? c.at[1][k][j]                        /* stands */
                                         : kind == 1 ? middle                               /* vanishes */
                                         : kind == 2 ? middle + (j == 0 ? -off : off)       /* turns over */
                                         : j == 0 ? middle + off * (pose - 1) : c.at[1][k][j];
                    }
            if (kind == 3)      /* an edge in the middle */
                for (int k = 0; k < 3; k++)
                    c.at[1][k][0] = c.at[1][0][0];
            add_mover(between(STILL_SEGMENTS, SEGMENTS - 2), &c, random_u32());
        }
        END_UNLESS(check_scene(16, between(1, 9)));
    }
}

static void test_paths_that_leave_the_guard_band(void)
{
    const int32_t guard = SMEAR_GUARD_PX << 8;
    random_state = 5;
    for (int n = 0; n < 60; n++) {
        random_scene(n & 1);
        for (int i = 0; i < 8 && has_room(); i++) {
            struct corners c;
            for (int pose = 0; pose < 3; pose++)
                for (int k = 0; k < 3; k++) {
                    /* Corners of the band, so that parabolas between leave it; and depth beyond its ends. */
                    c.at[pose][k][0] = W * 128 + (chance(2) ? guard : -guard) * (chance(4) ? 0 : 1) + between(-3, 3);
                    c.at[pose][k][1] = H * 128 + (chance(2) ? guard : -guard) * (chance(4) ? 0 : 1) + between(-3, 3);
                    for (int j = 0; j < 2; j++)
                        c.at[pose][k][j] = clamp_i32(c.at[pose][k][j], (j == 0 ? W : H) * 128 - guard,
                                                     (j == 0 ? W : H) * 128 + guard);
                    c.at[pose][k][2] = chance(2) ? SMEAR_DEPTH_MIN : SMEAR_DEPTH_MAX;
                }
            if (area_at(&c, 1) <= 0)
                continue;
            if (n & 1 && chance(2)) {
                uint32_t at = add_triangle(9, &c, random_u32());
                link_in(&blend_head, &blend_last, at);
            } else {
                add_mover(between(STILL_SEGMENTS, SEGMENTS - 2), &c, random_u32());
            }
        }
        END_UNLESS(check_scene(16, between(1, 9)));
    }
}

static void test_more_movers_than_a_tile_remembers(void)
{
    random_state = 6;
    for (int n = 0; n < 6; n++) {
        random_scene(true);
        int still = 0;
        while (has_room() && still < 500) {
            struct corners c;
            random_corners(&c, 900, 1024);
            for (int pose = 0; pose < 3; pose++)
                for (int k = 0; k < 3; k++) {
                    c.at[pose][k][0] = 16 * 256 + (c.at[pose][k][0] & 4095);
                    c.at[pose][k][1] = 16 * 256 + (c.at[pose][k][1] & 4095);
                }
            if (area_at(&c, 1) <= 0)
                continue;
            if (n < 3 && chance(n + 1)) {
                bool moves = chance(2);
                uint32_t at = add_triangle(moves ? 9 : 2, &c, random_u32());
                link_in(&blend_head, &blend_last, at);
                still++;
            } else {
                add_mover(between(STILL_SEGMENTS, SEGMENTS - 2), &c, random_u32());
            }
        }
        CHECK(n < 3 || mover_count > 200);
        draw_still();
        draw_want(4);
        for (int32_t column = 0; column < 4; column++)
            END_UNLESS(check_tiles(16, column, 1, 1, 4));
    }
}

/* A triangle over the whole frame, at one depth. */
static struct corners sheet(int32_t depth)
{
    struct corners c;
    for (int pose = 0; pose < 3; pose++)
        for (int k = 0; k < 3; k++) {
            c.at[pose][k][0] = k == 1 ? 2 * W * 256 : 0;
            c.at[pose][k][1] = k == 2 ? 2 * H * 256 : 0;
            c.at[pose][k][2] = depth;
        }
    return c;
}

static void test_more_panes_than_a_tile_remembers(void)
{
    /* What moves comes last, and is all that moves. */
    scene_begin(false);
    set_path_layout(9, false, false, true, SHADE_FLAT);
    draw[2].alpha = draw[9].alpha = SMEAR_BLEND;
    const struct corners pane = sheet(1 << 28);
    for (int i = 0; i < 140; i++) {
        uint32_t at = add_triangle(2, &pane, 0x04ffffffu * (uint32_t)(i & 1) + 0x04000000u);
        link_in(&blend_head, &blend_last, at);
    }
    struct corners moving = sheet(1 << 29);
    for (int k = 0; k < 3; k++) {
        moving.at[0][k][0] += 30 * 256;
        moving.at[2][k][0] += 10 * 256;
    }
    uint32_t at = add_triangle(9, &moving, 0x80ff0000u);
    link_in(&blend_head, &blend_last, at);
    CHECK(check_scene(16, 4));
    CHECK(samples != 0);
}

static void test_movers_of_the_background_s_colour_hide_panes(void)
{
    for (int linear = 0; linear < 2; linear++) {
        square_scene(linear, 9);
        for (uint32_t m = 0; m < mover_count; m++)
            bins_triangle(&geometry, mover[m].triangle)->color = 0xff305070u;
        draw[2].alpha = SMEAR_BLEND;
        const struct corners pane = sheet(1 << 27);
        uint32_t at = add_triangle(2, &pane, 0x80ff8000u);
        link_in(&blend_head, &blend_last, at);
        CHECK(check_scene(16, 6));
        CHECK_EQ(want[15 * W + 25], 0x305070u);
        CHECK(want[15 * W + 5] != 0x305070u);
    }
}

static void test_movers_that_are_hidden_cost_nothing(void)
{
    square_scene(false, 9);
    const struct corners wall = sheet(1 << 29);
    uint32_t i = add_triangle(0, &wall, 0xff00ff00u);
    link_in(&still_head, &still_last, i);
    draw_still();
    for (uint32_t m = 0; m < mover_count; m++)
        mover[m].nearest = still_depth[20 * W];      /* as near as the wall: hidden */
    check_scene(16, 5);
    CHECK_EQ(samples, 0);
    CHECK_EQ(want[15 * W + 20], 0x00ff00u);
    for (uint32_t m = 0; m < mover_count; m++)
        mover[m].nearest = UINT16_MAX;
    check_scene(16, 5);
    CHECK(samples != 0);
}

/* Returns how many instants a row of tiles is given where SMEAR_AUTO says so, of a square that goes 9 px. */
static int32_t planned(int32_t tile, int32_t row)
{
    static struct smear_moving_triangle movers[MOVERS];
    static const struct smear_chooser chooser = { .method = SMEAR_AUTO, .target = SMEAR_BALANCED };
    struct smear_tile_travel travel[W / 8 + 1];
    struct smear_shares before = { 0, 0 }, own = { 0, 0 };
    const int32_t tiles = 64 / tile;
    struct smear_tile_plan plan = *plan_of(9, 0, 16);
    plan.chooser = &chooser;
    plan.travel = travel;
    plan.before = &before;
    plan.own = &own;
    for (int i = 0; i < tiles; i++)
        travel[i] = (struct smear_tile_travel){ 9 * 16, 9 * 16, 0, 0, 9 * 16, 0, 1, 0, 0, TILE_MOVES };
    for (uint32_t i = 0; i < mover_count; i++) {
        movers[i] = mover[i];
        movers[i].first = (uint8_t)(mover[i].first * 8 / tile);
        movers[i].last = (uint8_t)(mover[i].last * 8 / tile);
    }
    draw_still();
    const struct smear_tile_run t = tiles_at(tile, 0, tiles, row, movers);
    smear_subframes_tiles(&t, 1, &plan);
    return travel[0].instants;
}

static void test_an_edge_in_any_one_row_of_a_tile_is_given_instants(void)
{
    /* The square ends in the first row of the second row of tiles, or begins in its last. */
    for (int32_t tile = 8; tile <= 16; tile *= 2) {
        mover_count = 0;
        const int32_t nothing = planned(tile, 1);
        square_scene_at(false, 9, tile - 9);
        const int32_t upper = planned(tile, 1);
        square_scene_at(false, 9, 2 * tile - 1);
        CHECK_EQ(nothing, 0);
        CHECK(upper > 3);
        CHECK_EQ(planned(tile, 1), upper);
    }
}

static void test_samples_are_the_pixels_near_movers(void)
{
    /* 10 x 10 px: boxes of 10 or 11 pixels each way. */
    square_scene(false, 9);
    check_scene(64, 10);
    CHECK(samples >= 10 * 100 && samples <= 10 * 121);
    mover_count = 0;
    check_scene(64, 10);
    CHECK_EQ(samples, 0);
}

static void test_work_memory_of_small_tiles_is_small(void)
{
    CHECK(smear_subframes_work(16, 16) <= 6 * 1024);
    CHECK(smear_subframes_work(8, 8) <= 2 * 1024);
    CHECK(smear_subframes_work(64, 16) <= 19 * 1024);
    CHECK(smear_subframes_work(TILE_MAX, TILE_MAX) <= WORK_WORDS * sizeof(uint32_t));
}

#include "build/suites/subframes.h"
