/* SPDX-License-Identifier: MIT */
/* test_alike.c - what moves before the clear colour and things that stand still, of the very same colours or texels: pictures are near
 * the mean of exact instants, and hardly other ones than where it is one code off. SMEAR_CASES=200 draws as many of each look;
 * SMEAR_FIRST=17 begins with that one, and tells of each. */
#include "tests/ref/sweep.h"

enum { WIDTH = 160, ROWS = 120, PIXELS = WIDTH * ROWS, BYTES = PIXELS * 4, TEXELS = 16, STILLS = 6, MOVERS = 2 };

/* How surfaces get their colours. */
enum look { FLAT, LIT, BETWEEN, TEXTURED, LIT_TEXTURED, LOOKS };

static const char *const look_name[LOOKS] = { "of one colour", "lit", "of vertices' colours", "textured", "textured and lit" };

struct thing {
    bool card;                  /* else a box */
    struct mover mover;
    int color;                  /* number of the palette's */
};

struct world {
    enum look look;
    struct thing thing[MOVERS + STILLS];
    int stills, movers, clear;
    uint32_t palette[3];
    bool linear;
};

static struct thing random_thing(bool moves)
{
    struct thing t = { .card = chance(2), .color = moves ? 0 : between(0, 2) };
    struct mover *m = &t.mover;
    if (chance(2))
        random_rotation(m->basis, 1);
    else
        memcpy(m->basis, pose_at(0, 0, 0, 0, 0).basis, sizeof m->basis);
    for (int i = 0; i < 3; i++) {
        m->axis[i] = uniform(-1, 1);
        m->way[i] = (i == 2 ? 0.7 : 1) * exp(uniform(-3.5, -0.3)) * (chance(2) ? -1 : 1);
        m->at[i] = i == 2 ? (moves ? uniform(-3.6, -2.4) : uniform(-8, -4)) : uniform(-0.6, 0.6) * (moves ? 1 : 3);
        m->size[i] = moves ? uniform(0.15, 0.7) : uniform(0.3, 1.5);
    }
    unit3(m->axis);
    m->angle = chance(2) ? 0 : exp(uniform(-3.5, -0.5));
    return t;
}

static struct world random_world(uint32_t number, enum look look)
{
    struct world w = { .look = look };
    sweep_seed(number);
    w.linear = chance(2);
    for (int i = 0; i < 3; i++)
        w.palette[i] = random_u32() & 0xffffffu;
    w.clear = between(0, 2);
    w.stills = between(1, STILLS);
    w.movers = between(1, MOVERS);
    for (int i = 0; i < w.movers + w.stills; i++)
        w.thing[i] = random_thing(i < w.movers);
    return w;
}

/* Texels in blocks of two colours, of which the first is that of the number, and those of what is `off` by a code. */
static void make_texels(uint32_t *texels, const struct world *w, int color, uint32_t off)
{
    for (int i = 0; i < TEXELS * TEXELS; i++)
        texels[i] = 0xff000000u | ((w->palette[(i >> 2 ^ i >> 6) & 1 ? color : (color + 1) % 3]) ^ off);
}

/* Bits by which colours of what moves are others than those of the palette: one code. */
enum { ONE_OFF = 0x010101 };

/* All that draws of a world point to. */
struct parts {
    uint32_t texels[MOVERS + STILLS][TEXELS * TEXELS];
    uint8_t colors[MOVERS + STILLS][24 * 4];
    smear_texture texture[MOVERS + STILLS];
    smear_mesh mesh[MOVERS + STILLS];
    smear_material material[MOVERS + STILLS];
    smear_transform now[MOVERS + STILLS], open[MOVERS + STILLS], close[MOVERS + STILLS];
};

static void put_color(uint8_t rgba[4], uint32_t c)
{
    for (int k = 0; k < 3; k++)
        rgba[k] = (uint8_t)(c >> (16 - 8 * k));
    rgba[3] = 255;
}

/* Makes what thing i looks like. */
static void make_look(struct parts *p, int i, const struct world *w, uint32_t off)
{
    const struct thing *t = &w->thing[i];
    make_texels(p->texels[i], w, t->color, off);
    p->texture[i] = (smear_texture){ .texels = p->texels[i], .width = TEXELS, .height = TEXELS };
    p->mesh[i] = t->card ? square : *textured_box();
    p->material[i] = (smear_material){ .unlit = w->look != LIT && w->look != LIT_TEXTURED, .double_sided = t->card };
    if (w->look >= TEXTURED)
        p->material[i].texture = &p->texture[i];
    else if (w->look != BETWEEN)
        put_color(p->material[i].color, w->palette[t->color] ^ off);
    for (int k = 0; k < 24 && w->look == BETWEEN; k++)
        put_color(p->colors[i] + 4 * k, w->palette[k % 4 < 2 ? t->color : (t->color + 1) % 3] ^ off);
    p->mesh[i].color = w->look == BETWEEN ? p->colors[i] : NULL;
}

/* A world whose movers are `off` by some bits. */
struct view {
    const struct world *world;
    uint32_t off;
};

static bool draw(struct rig *r, const void *scene, uint8_t method, uint16_t target, double part)
{
    const struct view *view = scene;
    const struct world *w = view->world;
    static struct parts p;
    const bool sharp = method == SMEAR_NONE;
    smear_draw draws[MOVERS + STILLS];
    for (int i = 0; i < w->movers + w->stills; i++) {
        const struct thing *t = &w->thing[i];
        const bool moves = i < w->movers;
        make_look(&p, i, w, moves ? view->off : 0);
        p.now[i] = mover_pose(&t->mover, moves && sharp ? part : 0);
        p.open[i] = mover_pose(&t->mover, -0.5);
        p.close[i] = mover_pose(&t->mover, 0.5);
        draws[i] = (smear_draw){ .id = (uint32_t)i + 1, .mesh = &p.mesh[i], .material = &p.material[i], .now = &p.now[i],
                                 .open = sharp || !moves ? NULL : &p.open[i], .close = sharp || !moves ? NULL : &p.close[i] };
    }
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_frame frame = { .camera = &camera, .method = method, .cut = sharp, .shutter = { .poses = 1 }, .target = target,
                                .light_space = w->linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED, .clear = w->palette[w->clear] };
    return CHECK_EQ(rig_frame(r, &frame, draws, w->movers + w->stills), SMEAR_OK);
}

enum { DRAFT, BALANCED, PICTURES };
enum { ERROR, APART, VALUES };

/* Finds by how many codes pictures are off the exact mean, and apart from those of movers that are one code off. */
static bool measure(double value[PICTURES][VALUES], struct rig *r, const struct world *w)
{
    static const uint16_t target[PICTURES] = { SMEAR_DRAFT, SMEAR_BALANCED };
    static uint8_t picture[BYTES];
    static double mean[BYTES];
    const struct view alike = { w, 0 }, other = { w, ONE_OFF };
    if (!sweep_mean(mean, r, draw, &alike, 64, w->linear))
        return false;
    for (int p = 0; p < PICTURES; p++) {
        if (!draw(r, &alike, SMEAR_AUTO, target[p], 0))
            return false;
        value[p][ERROR] = sweep_error(r, mean);
        memcpy(picture, r->picture, BYTES);
        if (!draw(r, &other, SMEAR_AUTO, target[p], 0))
            return false;
        value[p][APART] = rms_of(picture, r->picture, PIXELS);
    }
    return true;
}

static void check_look(enum look look)
{
    static double value[PICTURES][VALUES][SWEEP_MOST];
    const struct sweep sweep = sweep_of(100, 200);
    smear_desc desc = small_desc(WIDTH, ROWS);
    desc.methods = SMEAR_SET(SMEAR_AUTO);
    RIG(r, &desc, false);
    for (uint32_t i = 0; i < sweep.count; i++) {
        const struct world w = random_world(sweep.first + i, look);
        double v[PICTURES][VALUES];
        END_UNLESS(measure(v, &r, &w));
        for (int p = 0; p < PICTURES; p++)
            for (int k = 0; k < VALUES; k++)
                value[p][k][i] = v[p][k];
        if (sweep.tells)
            printf("  case %u: draft %.2f, apart %.2f, balanced %.2f, apart %.2f: %s%s\n", (unsigned)(sweep.first + i), v[DRAFT][ERROR],
                   v[DRAFT][APART], v[BALANCED][ERROR], v[BALANCED][APART], look_name[look], w.linear ? ", light" : "");
    }
    printf("  things %s before others\n", look_name[look]);
    sweep_check(value[DRAFT][ERROR], sweep.count, "drafts off the exact mean", 2.5, 7);
    sweep_check(value[BALANCED][ERROR], sweep.count, "balanced", 1.1, 2.2);
    sweep_check(value[DRAFT][APART], sweep.count, "drafts apart from those of what is one code off", 0.5, 2.2);
    sweep_check(value[BALANCED][APART], sweep.count, "balanced", 0.4, 1);
}

static void test_what_moves_before_its_own_colour_is_blurred_as_before_another(void)
{
    check_look(FLAT);
}

static void test_what_moves_in_light_before_what_is_lit_is_blurred_as_before_another(void)
{
    check_look(LIT);
}

static void test_what_moves_before_colours_between_vertices_is_blurred_as_before_others(void)
{
    check_look(BETWEEN);
}

static void test_what_moves_before_its_own_texels_is_blurred_as_before_others(void)
{
    check_look(TEXTURED);
}

static void test_what_moves_before_its_own_texels_in_light_is_blurred_as_before_others(void)
{
    check_look(LIT_TEXTURED);
}

#include "build/suites/alike.h"
