/* SPDX-License-Identifier: MIT */
/* test_turns.c - a textured box, card or disc that turns, tumbles or travels before a camera that stands still or moves, or thin bars that
 * a camera passes: sketches and drafts are near the mean of exact instants. SMEAR_CASES=1000 draws as many; SMEAR_FIRST=17 begins with
 * that one, and names those far off. */
#include "tests/ref/sweep.h"

enum { WIDTH = 160, ROWS = 120, BYTES = WIDTH * ROWS * 4, TEXELS = 32, SPOKES = 16, BARS = 10 };

enum kind { TURN, TUMBLE, BOTH, TRAVEL, KINDS };
enum shape { BOX, CARD, DISC, SHAPES };

static const char *const kind_name[KINDS] = { "turns", "tumbles", "does both", "travels" },
                  *const shape_name[SHAPES] = { "box", "card", "disc" };

struct thing {
    enum kind kind;
    enum shape shape;
    struct mover mover;
    int block;                  /* texels that are alike; 0: they change by little */
    bool wall;                  /* stands behind it */
    double pan, past;           /* of the camera, radians and units in the whole exposure */
    int bars;                   /* in its place, so thick: */
    double thick;
};

static uint32_t texels[TEXELS * TEXELS];

static void make_texels(const struct thing *t)
{
    uint32_t c[3] = { 0, 0, 0 };
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        const int x = i % TEXELS, y = i / TEXELS;
        if (t->block != 0) {
            texels[i] = x % t->block == 0 && y % t->block == 0 ? 0xff000000u | random_u32()
                                                               : texels[i - (y % t->block != 0 ? TEXELS : 1)];
            continue;
        }
        for (int k = 0; k < 3; k++)
            c[k] = (uint32_t)lrint(128 + 100 * sin(x * 0.2 * (k + 1) + t->mover.angle) * cos(y * 0.4 - k));
        texels[i] = 0xff000000u | c[0] << 16 | c[1] << 8 | c[2];
    }
}

static struct thing random_thing(bool box)
{
    struct thing t = { .kind = (enum kind)(random_u32() % (box ? TRAVEL : KINDS)) };
    t.shape = box ? BOX : (enum shape)(random_u32() % SHAPES);
    struct mover *m = &t.mover;
    random_rotation(m->basis, 1);
    for (int i = 0; i < 3; i++) {
        m->axis[i] = t.kind == TURN ? i == 1 : uniform(-1, 1);
        m->way[i] = t.kind < BOTH ? 0 : (i == 2 ? 1 : 0.5) * exp(uniform(-3, 0)) * (chance(2) ? -1 : 1);
        m->at[i] = i == 2 ? uniform(-3.6, -2.4) : uniform(-0.5, 0.5);
        m->size[i] = 1;
    }
    unit3(m->axis);
    m->angle = t.kind == TRAVEL ? 0 : exp(uniform(-3.5, -0.2));
    t.block = 1 << between(0, 4) >> 1;
    t.wall = chance(2);
    make_texels(&t);
    return t;
}

/* A thing that travels, far or near, before a camera that moves. */
static struct thing random_passing(void)
{
    struct thing t = random_thing(false);
    t.kind = TRAVEL;
    t.mover.angle = 0;
    for (int i = 0; i < 3; i++)
        t.mover.way[i] = uniform(-1, 1) * (i == 2 ? 2 : 1);
    t.mover.at[2] = uniform(-4, -1.2);
    t.pan = uniform(-0.2, 0.2);
    t.past = uniform(-0.3, 0.3);
    return t;
}

/* Thin bars that stand, or lie, before a clear colour. */
static struct thing random_bars(void)
{
    struct thing t = random_thing(false);
    t.wall = false;
    t.bars = between(3, BARS);
    t.thick = exp(uniform(-5, -3));
    t.pan = uniform(0.03, 0.2) * (chance(2) ? -1 : 1);
    t.past = uniform(-0.3, 0.3);
    return t;
}

/* A fan. */
static int16_t disc_position[3 * (SPOKES + 1)], disc_uv[2 * (SPOKES + 1)];
static uint16_t disc_index[3 * SPOKES];
static const smear_mesh disc = { .position = disc_position, .uv = disc_uv, .vertex_count = SPOKES + 1, .index = disc_index,
                                 .triangle_count = SPOKES, .shift = STEP, .uv_shift = 10 };

static void make_disc(void)
{
    disc_uv[0] = disc_uv[1] = 512;
    for (int i = 0; i < SPOKES; i++) {
        const double angle = 6.283185307 * i / SPOKES;
        disc_position[3 * i + 3] = (int16_t)lrint(320 * cos(angle));
        disc_position[3 * i + 4] = (int16_t)lrint(320 * sin(angle));
        disc_uv[2 * i + 2] = (int16_t)lrint(512 + 512 * cos(angle));
        disc_uv[2 * i + 3] = (int16_t)lrint(512 + 512 * sin(angle));
        disc_index[3 * i + 1] = (uint16_t)(i + 1);
        disc_index[3 * i + 2] = (uint16_t)((i + 1) % SPOKES + 1);
    }
}

/* Bar k of a fence: every third lies. */
static smear_transform bar_pose(const struct thing *t, int k)
{
    smear_transform m = pose_at(k % 3 == 2 ? 0 : 0.6 * (k - t->bars / 2), k % 3 == 2 ? 0.3 * (k - t->bars / 2) : 0, -3, 0, 0);
    m.basis[k % 3 == 2 ? 4 : 0] = (int32_t)lrint(16777216 * t->thick);
    m.basis[k % 3 == 2 ? 0 : 4] = 16777216 * 2;
    return m;
}

static bool draw(struct rig *r, const void *scene, uint8_t method, uint16_t target, double part)
{
    static const smear_texture texture = { .texels = texels, .width = TEXELS, .height = TEXELS };
    const struct thing *t = scene;
    const smear_mesh *const mesh[SHAPES] = { textured_box(), &square, &disc };
    const smear_material material = { .texture = &texture, .unlit = 1, .double_sided = t->shape != BOX || t->bars != 0 };
    const bool sharp = method == SMEAR_NONE;
    const smear_transform now = mover_pose(&t->mover, sharp ? part : 0), open = mover_pose(&t->mover, -0.5),
                          close = mover_pose(&t->mover, 0.5);
    smear_transform wall = pose_at(0, 0, -12, 0.1, 0), bar[BARS];
    smear_draw draws[BARS] = { { .id = 1, .mesh = mesh[t->shape], .material = &material, .now = &now, .open = sharp ? NULL : &open,
                                 .close = sharp ? NULL : &close },
                               { .id = 2, .mesh = &square, .material = &material, .now = &wall } };
    for (int i = 0; i < 9; i++)
        wall.basis[i] *= 12;
    for (int k = 0; k < t->bars; k++) {
        bar[k] = bar_pose(t, k);
        draws[k] = (smear_draw){ .id = 1 + (uint32_t)k, .mesh = &square, .material = &material, .now = &bar[k] };
    }
    smear_camera camera[3];
    for (int k = 0; k < 3; k++) {
        const double at = k > 0 ? k - 1.5 : sharp ? part : 0;
        camera[k] = camera_at(t->past * at, 0, 0, 0);
        camera[k].pose = pose_at(t->past * at, 0, 0, t->pan * at, 0);
    }
    const bool moves = !sharp && (t->pan != 0 || t->past != 0);
    const smear_frame frame = { .camera = camera, .open = moves ? &camera[1] : NULL, .close = moves ? &camera[2] : NULL, .method = method,
                                .light_space = SMEAR_LIGHT_ENCODED, .cut = sharp, .shutter = { .poses = 1 }, .target = target,
                                .clear = 0x506070 };
    return CHECK_EQ(rig_frame(r, &frame, draws, t->bars != 0 ? t->bars : 1 + t->wall), SMEAR_OK);
}

enum { SHARP, SKETCH, DRAFT, PICTURES };

/* Finds by how many codes each picture is off the exact mean, and how many samples it took. */
static bool measure(double error[PICTURES], double samples[PICTURES], struct rig *r, const struct thing *t)
{
    static const uint16_t target[PICTURES] = { 0, SMEAR_SKETCH, SMEAR_DRAFT };
    static double mean[BYTES];
    if (!sweep_mean(mean, r, draw, t, 128, false))
        return false;
    for (int p = 0; p < PICTURES; p++) {
        smear_stats stats;
        if (!draw(r, t, p == SHARP ? SMEAR_NONE : SMEAR_AUTO, target[p], 0))
            return false;
        error[p] = sweep_error(r, mean);
        smear_get_stats(r->ctx, &stats);
        samples[p] += stats.samples;
    }
    return true;
}

enum { BOXES, THINGS, PASSING, FENCES };

/* Of boxes that turn, of all things, of what moves before a camera that does, or of bars: at most so many codes of nine of ten, of all. */
static void check_things(int which, double sketches, double all_sketches, double drafts, double all_drafts)
{
    static const char *const name[] = { "boxes that turn", "things that move", "things before a camera that moves", "thin bars" };
    static double error[PICTURES][SWEEP_MOST];
    double samples[PICTURES] = { 0 };
    const struct sweep sweep = sweep_of(100, 1000);
    smear_desc desc = small_desc(WIDTH, ROWS);
    desc.methods = SMEAR_SET(SMEAR_AUTO) | (which >= PASSING ? SMEAR_SET_SKETCH : 0);
    desc.max_draws = BARS;
    make_disc();
    RIG(r, &desc, false);
    for (uint32_t i = 0; i < sweep.count; i++) {
        sweep_seed(sweep.first + i);
        const struct thing t = which == FENCES ? random_bars() : which == PASSING ? random_passing() : random_thing(which == BOXES);
        double e[PICTURES];
        END_UNLESS(measure(e, samples, &r, &t));
        for (int p = 0; p < PICTURES; p++)
            error[p][i] = e[p];
        if (sweep.tells)
            printf("  case %u: sharp %.2f, sketch %.2f, draft %.2f: a %s that %s by %.2f rad, way %.2f %.2f %.2f, %d texels alike%s; "
                   "%d bars of %.3f, camera %.2f rad, %.2f\n",
                   (unsigned)(sweep.first + i), e[SHARP], e[SKETCH], e[DRAFT], shape_name[t.shape], kind_name[t.kind], t.mover.angle,
                   t.mover.way[0], t.mover.way[1], t.mover.way[2], t.block, t.wall ? ", a wall" : "", t.bars, t.thick, t.pan, t.past);
    }
    printf("  %s: %.2f million samples for sketches, %.2f for drafts\n", name[which], samples[SKETCH] / 1e6, samples[DRAFT] / 1e6);
    sweep_check(error[SKETCH], sweep.count, "sketches off the exact mean", sketches, all_sketches);
    sweep_check(error[DRAFT], sweep.count, "drafts", drafts, all_drafts);
}

static void test_nine_of_ten_boxes_that_turn_are_as_near_the_exact_mean_as_asked(void)
{
    check_things(BOXES, 8, 12, 5, 8);
}
static void test_nine_of_ten_things_that_move_are_as_near_the_exact_mean_as_asked(void)
{
    check_things(THINGS, 8, 12, 5, 8);
}
static void test_nine_of_ten_things_before_a_camera_that_moves_are_near_the_exact_mean(void)
{
    check_things(PASSING, 16, 32, 9, 22);
}
static void test_nine_of_ten_fences_of_thin_bars_are_near_the_exact_mean(void)
{
    check_things(FENCES, 8.8, 22, 7, 14);
}

#include "build/suites/turns.h"
