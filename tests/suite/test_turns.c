/* SPDX-License-Identifier: MIT */
/* test_turns.c - a textured box, card or disc that turns, tumbles or travels before a camera that stands still: sketches and drafts are
 * near the mean of exact instants. SMEAR_CASES=1000 draws as many; SMEAR_FIRST=17 begins with that one, and names those far off. */
#include "tests/rig.h"

enum { WIDTH = 160, ROWS = 120, BYTES = WIDTH * ROWS * 4, TEXELS = 32, SPOKES = 16, CASES_MAX = 20000 };

enum kind { TURN, TUMBLE, BOTH, TRAVEL, KINDS };
enum shape { BOX, CARD, DISC, SHAPES };

static const char *const kind_name[KINDS] = { "turns", "tumbles", "does both", "travels" },
                  *const shape_name[SHAPES] = { "box", "card", "disc" };

/* A case: an axis of length 1, an angle in radians and a way in units in the whole exposure. */
struct thing {
    enum kind kind;
    enum shape shape;
    double axis[3], angle, way[3], basis[9], at[3];
    int block;                  /* texels that are alike; 0: they change by little */
    bool wall;                  /* stands behind it */
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
            c[k] = (uint32_t)lrint(128 + 100 * sin(x * 0.2 * (k + 1) + t->angle) * cos(y * 0.4 - k));
        texels[i] = 0xff000000u | c[0] << 16 | c[1] << 8 | c[2];
    }
}

static struct thing random_thing(bool box)
{
    struct thing t = { .kind = (enum kind)(random_u32() % (box ? TRAVEL : KINDS)) };
    t.shape = box ? BOX : (enum shape)(random_u32() % SHAPES);
    int32_t basis[9];
    random_rotation(basis, 1);
    for (int i = 0; i < 9; i++)
        t.basis[i] = basis[i] / 16777216.0;
    for (int i = 0; i < 3; i++) {
        t.axis[i] = t.kind == TURN ? i == 1 : uniform(-1, 1);
        t.way[i] = t.kind < BOTH ? 0 : (i == 2 ? 1 : 0.5) * exp(uniform(-3, 0)) * (chance(2) ? -1 : 1);
        t.at[i] = i == 2 ? uniform(-3.6, -2.4) : uniform(-0.5, 0.5);
    }
    unit3(t.axis);
    t.angle = t.kind == TRAVEL ? 0 : exp(uniform(-3.5, -0.2));
    t.block = 1 << between(0, 4) >> 1;
    t.wall = chance(2);
    make_texels(&t);
    return t;
}

/* Its pose where `part` of its way is behind it: -0.5 at open, 0.5 at close. */
static smear_transform pose_of(const struct thing *t, double part)
{
    const double s = sin(t->angle * part), c = cos(t->angle * part), *a = t->axis;
    const double turned[9] = { c + a[0] * a[0] * (1 - c), a[0] * a[1] * (1 - c) - a[2] * s, a[0] * a[2] * (1 - c) + a[1] * s,
                               a[0] * a[1] * (1 - c) + a[2] * s, c + a[1] * a[1] * (1 - c), a[1] * a[2] * (1 - c) - a[0] * s,
                               a[0] * a[2] * (1 - c) - a[1] * s, a[1] * a[2] * (1 - c) + a[0] * s, c + a[2] * a[2] * (1 - c) };
    smear_transform pose;
    for (int i = 0; i < 9; i++)
        pose.basis[i] = q24(turned[i / 3 * 3] * t->basis[i % 3] + turned[i / 3 * 3 + 1] * t->basis[3 + i % 3]
                            + turned[i / 3 * 3 + 2] * t->basis[6 + i % 3]);
    for (int i = 0; i < 3; i++)
        pose.origin[i] = q16(t->at[i] + part * t->way[i]);
    return pose;
}

/* A box that has a texture on each side, and a fan of a disc. */
static int16_t box_position[6 * 12], box_uv[6 * 8], disc_position[3 * (SPOKES + 1)], disc_uv[2 * (SPOKES + 1)];
static uint16_t box_index[36], disc_index[3 * SPOKES];
static const smear_mesh box_mesh = { .position = box_position, .uv = box_uv, .vertex_count = 24, .index = box_index, .triangle_count = 12,
                                     .shift = STEP, .uv_shift = 10 },
                        disc_mesh = { .position = disc_position, .uv = disc_uv, .vertex_count = SPOKES + 1, .index = disc_index,
                                      .triangle_count = SPOKES, .shift = STEP, .uv_shift = 10 };

static void make_meshes(void)
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

static bool draw(struct rig *r, const struct thing *t, uint8_t method, uint16_t target, double part, uint8_t *out)
{
    static const smear_texture texture = { .texels = texels, .width = TEXELS, .height = TEXELS };
    static const smear_mesh *const mesh[SHAPES] = { &box_mesh, &square, &disc_mesh };
    const smear_material material = { .texture = &texture, .unlit = 1, .double_sided = t->shape != BOX };
    const bool sharp = method == SMEAR_NONE;
    const smear_transform now = pose_of(t, sharp ? part : 0), open = pose_of(t, -0.5), close = pose_of(t, 0.5);
    smear_transform wall = pose_at(0, 0, -12, 0.1, 0);
    for (int i = 0; i < 9; i++)
        wall.basis[i] *= 12;
    const smear_draw draws[2] = { { .id = 1, .mesh = mesh[t->shape], .material = &material, .now = &now, .open = sharp ? NULL : &open,
                                    .close = sharp ? NULL : &close },
                                  { .id = 2, .mesh = &square, .material = &material, .now = &wall } };
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_frame frame = { .camera = &camera, .method = method, .light_space = SMEAR_LIGHT_ENCODED, .cut = sharp,
                                .shutter = { .poses = 1 }, .target = target, .clear = 0x506070 };
    if (!CHECK_EQ(rig_frame(r, &frame, draws, 1 + t->wall), SMEAR_OK))
        return false;
    memcpy(out, r->picture, BYTES);
    return true;
}

/* Returns by how many codes a picture is off the mean of so many. */
static double error_of(const uint8_t *picture, const uint32_t *sum, int instants)
{
    double squares = 0;
    for (int k = 0; k < BYTES; k++) {
        const double off = picture[k] - (double)sum[k] / instants;
        squares += k % 4 == 3 ? 0 : off * off;
    }
    return sqrt(squares / (WIDTH * ROWS * 3));
}

enum { SHARP, SKETCH, DRAFT, PICTURES };

/* Finds by how many codes each picture is off the exact mean, and how many samples it took. */
static bool measure(double error[PICTURES], double samples[PICTURES], struct rig *r, const struct thing *t)
{
    enum { INSTANTS = 128 };
    static const uint16_t target[PICTURES] = { 0, SMEAR_SKETCH, SMEAR_DRAFT };
    static uint32_t sum[BYTES];
    static uint8_t picture[BYTES];
    memset(sum, 0, sizeof sum);
    for (int i = 0; i < INSTANTS; i++) {
        if (!draw(r, t, SMEAR_NONE, 0, (i + 0.5) / INSTANTS - 0.5, picture))
            return false;
        for (int k = 0; k < BYTES; k++)
            sum[k] += picture[k];
    }
    for (int p = 0; p < PICTURES; p++) {
        smear_stats stats;
        if (!draw(r, t, p == SHARP ? SMEAR_NONE : SMEAR_AUTO, target[p], 0, picture))
            return false;
        error[p] = error_of(picture, sum, INSTANTS);
        smear_get_stats(r->ctx, &stats);
        samples[p] += stats.samples;
    }
    return true;
}

/* Checks how far nine of ten are from the exact mean, and all. */
static void check_errors(double *error, uint32_t count, const char *what, double most_of_nine, double most)
{
    qsort(error, count, sizeof *error, by_value);
    printf("  %s: half are within %.2f codes of the exact mean, 9 of 10 within %.2f, all within %.2f\n", what, error[count / 2],
           error[count * 9 / 10], error[count - 1]);
    CHECK_CLOSE(error[count * 9 / 10], 0, most_of_nine);
    CHECK_CLOSE(error[count - 1], 0, most);
}

/* Of boxes that turn, or of all things. */
static void check_things(bool box)
{
    static double error[PICTURES][CASES_MAX];
    double samples[PICTURES] = { 0 };
    const uint32_t wanted = number_from("SMEAR_CASES", number_from("SMEAR_THOROUGH", 0) != 0 ? 1000 : 100);
    const uint32_t count = wanted < CASES_MAX ? wanted : CASES_MAX, first = number_from("SMEAR_FIRST", 1);
    smear_desc desc = small_desc(WIDTH, ROWS);
    desc.methods = SMEAR_SET(SMEAR_AUTO);
    make_meshes();
    RIG(r, &desc, false);
    for (uint32_t i = 0; i < count; i++) {
        random_state = (first + i) * 2654435761u + 77u;
        for (int k = 0; k < 4; k++)
            random_u32();
        const struct thing t = random_thing(box);
        double e[PICTURES];
        END_UNLESS(measure(e, samples, &r, &t));
        for (int p = 0; p < PICTURES; p++)
            error[p][i] = e[p];
        if (getenv("SMEAR_FIRST") != NULL)
            printf("  case %u: sharp %.2f, sketch %.2f, draft %.2f: a %s that %s by %.2f rad, way %.2f %.2f %.2f, %d texels alike%s\n",
                   (unsigned)(first + i), e[SHARP], e[SKETCH], e[DRAFT], shape_name[t.shape], kind_name[t.kind], t.angle, t.way[0],
                   t.way[1], t.way[2], t.block, t.wall ? ", a wall" : "");
    }
    printf("  %u %s: %.2f million samples for sketches, %.2f for drafts\n", (unsigned)count, box ? "boxes that turn" : "things that move",
           samples[SKETCH] / 1e6, samples[DRAFT] / 1e6);
    check_errors(error[SKETCH], count, "sketches", 8, 12);
    check_errors(error[DRAFT], count, "drafts", 5, 8);
}

static void test_nine_of_ten_boxes_that_turn_are_as_near_the_exact_mean_as_asked(void)
{
    check_things(true);
}
static void test_nine_of_ten_things_that_move_are_as_near_the_exact_mean_as_asked(void)
{
    check_things(false);
}

#include "build/suites/turns.h"
