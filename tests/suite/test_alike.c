/* SPDX-License-Identifier: MIT */
/* test_alike.c - what moves before the clear colour and things that stand still, of the very same colours or texels: pictures are near
 * the mean of exact instants, and hardly other ones than where it is one code off. SMEAR_CASES=200 draws as many of each look;
 * SMEAR_FIRST=17 begins with that one, and tells of each. */
#include "tests/rig.h"

enum { WIDTH = 160, ROWS = 120, PIXELS = WIDTH * ROWS, BYTES = PIXELS * 4, TEXELS = 16, STILLS = 6, MOVERS = 2, CASES_MAX = 20000 };

/* How surfaces get their colours. */
enum look { FLAT, LIT, BETWEEN, TEXTURED, LIT_TEXTURED, LOOKS };

static const char *const look_name[LOOKS] = { "of one colour", "lit", "of vertices' colours", "textured", "textured and lit" };

/* A card or box. What moves has an axis of length 1, an angle in radians and a way in units in the whole exposure. */
struct thing {
    bool card;
    double axis[3], angle, way[3], at[3], size[3];
    int32_t basis[9];
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
    if (chance(2))
        random_rotation(t.basis, 1);
    else
        memcpy(t.basis, pose_at(0, 0, 0, 0, 0).basis, sizeof t.basis);
    for (int i = 0; i < 3; i++) {
        t.axis[i] = uniform(-1, 1);
        t.way[i] = (i == 2 ? 0.7 : 1) * exp(uniform(-3.5, -0.3)) * (chance(2) ? -1 : 1);
        t.at[i] = i == 2 ? (moves ? uniform(-3.6, -2.4) : uniform(-8, -4)) : uniform(-0.6, 0.6) * (moves ? 1 : 3);
        t.size[i] = moves ? uniform(0.15, 0.7) : uniform(0.3, 1.5);
    }
    unit3(t.axis);
    t.angle = chance(2) ? 0 : exp(uniform(-3.5, -0.5));
    return t;
}

static struct world random_world(uint32_t number, enum look look)
{
    struct world w = { .look = look };
    random_state = number * 2654435761u + 77u;
    for (int k = 0; k < 4; k++)
        random_u32();
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

/* The same as in test_turns.c: where `part` of its way is behind it, -0.5 at open, 0.5 at close. */
static smear_transform pose_of(const struct thing *t, double part)
{
    const double s = sin(t->angle * part), c = cos(t->angle * part), *a = t->axis;
    const double turned[9] = { c + a[0] * a[0] * (1 - c), a[0] * a[1] * (1 - c) - a[2] * s, a[0] * a[2] * (1 - c) + a[1] * s,
                               a[0] * a[1] * (1 - c) + a[2] * s, c + a[1] * a[1] * (1 - c), a[1] * a[2] * (1 - c) - a[0] * s,
                               a[0] * a[2] * (1 - c) - a[1] * s, a[1] * a[2] * (1 - c) + a[0] * s, c + a[2] * a[2] * (1 - c) };
    smear_transform pose;
    for (int i = 0; i < 9; i++) {
        double sum = 0;
        for (int k = 0; k < 3; k++)
            sum += turned[i / 3 * 3 + k] * (t->basis[3 * k + i % 3] / 16777216.0);
        pose.basis[i] = q24(sum * t->size[i % 3]);
    }
    for (int i = 0; i < 3; i++)
        pose.origin[i] = q16(t->at[i] + part * t->way[i]);
    return pose;
}

/* A box that has its own vertices, and coordinates of texels, on each side. */
static int16_t box_position[6 * 12], box_uv[6 * 8];
static uint16_t box_index[36];

static void make_box(void)
{
    static const int8_t around[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    for (int i = 0; i < 24; i++) {
        const int axis = i / 8, out = i / 4 % 2 * 2 - 1;
        box_position[3 * i + axis] = (int16_t)(256 * out);
        box_position[3 * i + (axis + 1) % 3] = (int16_t)(256 * around[i % 4][0]);
        box_position[3 * i + (axis + 2) % 3] = (int16_t)(256 * out * around[i % 4][1]);
        for (int k = 0; k < 2; k++)
            box_uv[2 * i + k] = (int16_t)(512 + 512 * around[i % 4][k]);
    }
    for (int i = 0; i < 36; i++)
        box_index[i] = (uint16_t)(i / 6 * 4 + square_index[i % 6]);
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
    const smear_mesh box = { .position = box_position, .uv = box_uv, .vertex_count = 24, .index = box_index, .triangle_count = 12,
                             .shift = STEP, .uv_shift = 10 };
    make_texels(p->texels[i], w, t->color, off);
    p->texture[i] = (smear_texture){ .texels = p->texels[i], .width = TEXELS, .height = TEXELS };
    p->mesh[i] = t->card ? square : box;
    p->material[i] = (smear_material){ .unlit = w->look != LIT && w->look != LIT_TEXTURED, .double_sided = t->card };
    if (w->look >= TEXTURED)
        p->material[i].texture = &p->texture[i];
    else if (w->look != BETWEEN)
        put_color(p->material[i].color, w->palette[t->color] ^ off);
    for (int k = 0; k < 24 && w->look == BETWEEN; k++)
        put_color(p->colors[i] + 4 * k, w->palette[k % 4 < 2 ? t->color : (t->color + 1) % 3] ^ off);
    p->mesh[i].color = w->look == BETWEEN ? p->colors[i] : NULL;
}

/* Draws a world whose movers are `off` by some bits. A sharp one is that of `part` of the way. */
static bool draw(struct rig *r, const struct world *w, uint8_t method, uint16_t target, double part, uint32_t off, uint8_t *out)
{
    static struct parts p;
    const bool sharp = method == SMEAR_NONE;
    smear_draw draws[MOVERS + STILLS];
    for (int i = 0; i < w->movers + w->stills; i++) {
        const struct thing *t = &w->thing[i];
        const bool moves = i < w->movers;
        make_look(&p, i, w, moves ? off : 0);
        p.now[i] = pose_of(t, moves && sharp ? part : 0);
        p.open[i] = pose_of(t, -0.5);
        p.close[i] = pose_of(t, 0.5);
        draws[i] = (smear_draw){ .id = (uint32_t)i + 1, .mesh = &p.mesh[i], .material = &p.material[i], .now = &p.now[i],
                                 .open = sharp || !moves ? NULL : &p.open[i], .close = sharp || !moves ? NULL : &p.close[i] };
    }
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_frame frame = { .camera = &camera, .method = method, .cut = sharp, .shutter = { .poses = 1 }, .target = target,
                                .light_space = w->linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED, .clear = w->palette[w->clear] };
    if (!CHECK_EQ(rig_frame(r, &frame, draws, w->movers + w->stills), SMEAR_OK))
        return false;
    memcpy(out, r->picture, BYTES);
    return true;
}

enum { DRAFT, BALANCED, PICTURES };
enum { ERROR, APART, VALUES };

/* Returns by how many codes a picture is off the mean. */
static double error_of(const uint8_t *picture, const double *mean)
{
    double squares = 0;
    for (int k = 0; k < BYTES; k++)
        squares += k % 4 == 3 ? 0 : (picture[k] - mean[k]) * (picture[k] - mean[k]);
    return sqrt(squares / (PIXELS * 3));
}

/* Finds the mean of exact instants, in codes. */
static bool find_mean(double *mean, struct rig *r, const struct world *w)
{
    enum { INSTANTS = 64 };
    static uint8_t picture[BYTES];
    double light[256];
    for (int i = 0; i < 256; i++)
        light[i] = w->linear ? light_of(i) : i;
    memset(mean, 0, BYTES * sizeof *mean);
    for (int i = 0; i < INSTANTS; i++) {
        if (!draw(r, w, SMEAR_NONE, 0, (i + 0.5) / INSTANTS - 0.5, 0, picture))
            return false;
        for (int k = 0; k < BYTES; k++)
            mean[k] += light[picture[k]] / INSTANTS;
    }
    for (int k = 0; k < BYTES && w->linear; k++)
        mean[k] = code_of(mean[k]);
    return true;
}

/* Finds by how many codes pictures are off the exact mean, and apart from those of movers that are one code off. */
static bool measure(double value[PICTURES][VALUES], struct rig *r, const struct world *w)
{
    static const uint16_t target[PICTURES] = { SMEAR_DRAFT, SMEAR_BALANCED };
    static uint8_t picture[BYTES], other[BYTES];
    static double mean[BYTES];
    if (!find_mean(mean, r, w))
        return false;
    for (int p = 0; p < PICTURES; p++) {
        if (!draw(r, w, SMEAR_AUTO, target[p], 0, 0, picture) || !draw(r, w, SMEAR_AUTO, target[p], 0, ONE_OFF, other))
            return false;
        value[p][ERROR] = error_of(picture, mean);
        value[p][APART] = rms_of(picture, other, PIXELS);
    }
    return true;
}

/* Checks nine of ten values, and all. */
static void check_values(double *value, uint32_t count, const char *what, double most_of_nine, double most)
{
    qsort(value, count, sizeof *value, by_value);
    printf("    %s: half %.2f, 9 of 10 %.2f, all %.2f codes\n", what, value[count / 2], value[count * 9 / 10], value[count - 1]);
    CHECK_CLOSE(value[count * 9 / 10], 0, most_of_nine);
    CHECK_CLOSE(value[count - 1], 0, most);
}

static void check_look(enum look look)
{
    static double value[PICTURES][VALUES][CASES_MAX];
    const uint32_t wanted = number_from("SMEAR_CASES", number_from("SMEAR_THOROUGH", 0) != 0 ? 200 : 100);
    const uint32_t count = wanted < CASES_MAX ? wanted : CASES_MAX, first = number_from("SMEAR_FIRST", 1);
    smear_desc desc = small_desc(WIDTH, ROWS);
    desc.methods = SMEAR_SET(SMEAR_AUTO);
    make_box();
    RIG(r, &desc, false);
    for (uint32_t i = 0; i < count; i++) {
        const struct world w = random_world(first + i, look);
        double v[PICTURES][VALUES];
        END_UNLESS(measure(v, &r, &w));
        for (int p = 0; p < PICTURES; p++)
            for (int k = 0; k < VALUES; k++)
                value[p][k][i] = v[p][k];
        if (getenv("SMEAR_FIRST") != NULL)
            printf("  case %u: draft %.2f, apart %.2f, balanced %.2f, apart %.2f: %s%s\n", (unsigned)(first + i), v[DRAFT][ERROR],
                   v[DRAFT][APART], v[BALANCED][ERROR], v[BALANCED][APART], look_name[look], w.linear ? ", light" : "");
    }
    printf("  %u things %s before others\n", (unsigned)count, look_name[look]);
    check_values(value[DRAFT][ERROR], count, "drafts off the exact mean", 2.5, 7);
    check_values(value[BALANCED][ERROR], count, "balanced", 1.1, 2.2);
    check_values(value[DRAFT][APART], count, "drafts apart from those of what is one code off", 0.5, 2.2);
    check_values(value[BALANCED][APART], count, "balanced", 0.4, 1);
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
