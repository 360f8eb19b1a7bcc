/* SPDX-License-Identifier: MIT */
/* view.c - see view.h. The camera follows the player's car along the road, so that bends are seen before they come. */
#include "platform/game/view.h"

#include <smear_math.h>
#include <smear_overlay.h>
#include <smear_scene.h>

/* ------------------------------------------------------------------ shapes of boxes */

enum { BOXES = 5, BOX_TRIANGLES = 10, STEPS = 5 };

struct box {
    int8_t x0, y0, z0, x1, y1, z1;  /* 1/8 metre */
    uint32_t rgb;
};

struct shape {
    int16_t position[(BOXES * 8 + 4) * 3];
    uint16_t corner[(BOXES * BOX_TRIANGLES + 2) * 3];
    uint8_t color[(BOXES * BOX_TRIANGLES + 2) * 4];
    uint32_t boxes;                 /* triangles without a shadow's, which are the last two */
    smear_mesh mesh;
};

static struct shape car, small_car, gate;

/* Front, right, back, left and top; what lies on the ground is not seen from below. */
static void add_box(struct shape *s, const struct box *b)
{
    static const uint8_t face[5][4] = { { 0, 1, 5, 4 }, { 1, 3, 7, 5 }, { 3, 2, 6, 7 }, { 2, 0, 4, 6 }, { 4, 5, 7, 6 } };
    static const uint8_t light[5] = { 170, 140, 110, 200, 255 };
    smear_mesh *m = &s->mesh;
    for (int i = 0; i < 8; i++) {
        int16_t *to = &s->position[3 * (m->vertex_count + i)];
        to[0] = (int16_t)((i & 1) != 0 ? b->x1 : b->x0);
        to[1] = (int16_t)((i & 4) != 0 ? b->y1 : b->y0);
        to[2] = (int16_t)((i & 2) != 0 ? b->z0 : b->z1);
    }
    for (int i = 0; i < BOX_TRIANGLES; i++) {
        const uint8_t *f = face[i / 2];
        uint16_t *to = &s->corner[3 * m->triangle_count];
        uint8_t *paint = &s->color[4 * m->triangle_count];
        to[0] = (uint16_t)(m->vertex_count + f[0]);
        to[1] = (uint16_t)(m->vertex_count + f[1 + i % 2]);
        to[2] = (uint16_t)(m->vertex_count + f[2 + i % 2]);
        for (int k = 0; k < 3; k++)
            paint[k] = (uint8_t)((b->rgb >> (16 - 8 * k) & 255u) * light[i / 2] / 255u);
        paint[3] = 255;
        m->triangle_count++;
    }
    m->vertex_count = (uint16_t)(m->vertex_count + 8);
}

static void make_shape(struct shape *s, const struct box *box, int count)
{
    s->mesh = (smear_mesh){ .position = s->position, .index = s->corner, .face_color = s->color, .shift = 3 };
    for (int i = 0; i < count; i++)
        add_box(s, &box[i]);
    smear_mesh_find_bounds(&s->mesh);
}

/* A dark patch below a car: the shadow of machines on which a soft one is too dear. */
static void add_shade(struct shape *s)
{
    static const int8_t at[4][3] = { { -9, 1, 16 }, { 9, 1, 16 }, { 9, 1, -17 }, { -9, 1, -17 } };
    static const uint8_t side[6] = { 0, 1, 2, 0, 2, 3 };
    smear_mesh *m = &s->mesh;
    s->boxes = m->triangle_count;
    for (int i = 0; i < 12; i++)
        s->position[3 * m->vertex_count + i] = at[i / 3][i % 3];
    for (int i = 0; i < 6; i++)
        s->corner[3 * m->triangle_count + (uint32_t)i] = (uint16_t)(m->vertex_count + side[i]);
    for (int i = 0; i < 8; i++)
        s->color[4 * m->triangle_count + (uint32_t)i] = i % 4 == 3 ? 255 : 28;
    m->vertex_count = (uint16_t)(m->vertex_count + 4);
    m->triangle_count += 2;
}

void view_make(void)
{
    /* Wheels in two pairs, the body, a cabin, a wing. Forward is -z. */
    static const struct box parts[] = {
        { -8, 0, -15, 8, 5, -9, 0x505058 }, { -9, 0, 8, 9, 5, 14, 0x505058 }, { -6, 2, -19, 6, 6, 17, 0xffffff },
        { -4, 6, -5, 4, 9, 7, 0x586070 }, { -9, 9, 14, 9, 11, 18, 0xf0f0f0 }
    };
    static const struct box far_parts[] = { { -8, 0, -17, 8, 6, 15, 0xd8d8d8 }, { -9, 6, 14, 9, 11, 17, 0xf0f0f0 } };
    static const struct box posts[] = {
        { -52, 0, -2, -48, 48, 2, 0xe8e8e8 }, { 48, 0, -2, 52, 48, 2, 0xe8e8e8 }, { -52, 36, -1, 52, 48, 1, 0x2050c0 }
    };
    make_shape(&car, parts, 5);
    make_shape(&small_car, far_parts, 2);
    add_shade(&car);
    add_shade(&small_car);
    make_shape(&gate, posts, 3);
}

/* ------------------------------------------------------------------ poses */

enum { CAMERA_BACK = 88000 };       /* segments behind the car, q16, at most */

static const smear_vec3 up = { 0, 65536, 0 };

static int32_t scaled(int32_t x, int32_t speed)
{
    return (int32_t)((int64_t)x * speed / race_top_speed());
}

/* A car looks where it goes. */
static smear_transform pose_of(const struct race_car *c)
{
    const smear_vec3 at = course_place(c->along, c->right, 0);
    const smear_vec3 ahead = course_place(c->along + 40000, c->right + 4 * c->slide, 0);
    return smear_look_at(at, ahead, up);
}

static smear_camera camera_of(const struct race_car *c)
{
    const int32_t back = CAMERA_BACK - scaled(12000, race_top_speed() - c->speed);
    const smear_vec3 eye = course_place(c->along - back, c->right / 8 * 7, SMEAR_Q16(3.2));
    const smear_vec3 target = course_place(c->along + 90000, c->right / 8 * 7, SMEAR_Q16(0.6));
    smear_camera camera = smear_perspective(SMEAR_DEGREES(58), SMEAR_Q16(0.5), SMEAR_Q16(170));
    camera.pose = smear_look_at(eye, target, up);
    return camera;
}

/* ------------------------------------------------------------------ draws */

/* Numbers by which the library knows from frame to frame what is what. */
enum { ID_COURSE = 1, ID_GATE, ID_CAR, ID_SHADOW = ID_CAR + RACE_CARS };

/* Segments, q16: those from which cars are eight pixels wide or less in a picture of 80 rows, and those from which things are not seen. */
enum { SMALL = 3 << 16, FAR = COURSE_SEEN << 16 };

/* Segments that a place lies ahead of where a car's camera is, q16. */
static int32_t ahead_of(const struct race_car *c, int32_t along)
{
    const int32_t ahead = (along - c->along + CAMERA_BACK) % COURSE_LAP;
    return ahead < 0 ? ahead + COURSE_LAP : ahead;
}

static int submit_course(smear_context *ctx, const struct race_car *c)
{
    static const smear_material paint = { .unlit = 1 }, post = { .unlit = 1, .double_sided = 1 };
    const smear_draw course = { .id = ID_COURSE, .mesh = course_ahead(c->along - CAMERA_BACK), .material = &paint };
    const int result = smear_submit(ctx, &course);
    if (ahead_of(c, 0) > FAR)
        return result;
    const smear_transform at = smear_look_at(course_place(0, 0, 0), course_place(65536, 0, 0), up);
    const smear_draw draw = { .id = ID_GATE, .mesh = &gate.mesh, .material = &post, .now = &at };
    return result == SMEAR_OK ? smear_submit(ctx, &draw) : result;
}

/* What turns and grows with the ground below a car: the blob, as long and as wide as the car. */
static smear_transform shadow_of(const smear_transform *pose)
{
    const smear_transform size = smear_scale(SMEAR_Q24(1.6), SMEAR_BASIS_ONE, SMEAR_Q24(2.9));
    return smear_compose(*pose, smear_compose(smear_move(0, SMEAR_Q16(0.02), 0), size));
}

static int submit_cars(smear_context *ctx, const struct race *race, int height, bool soft)
{
    static const smear_material paint[RACE_CARS] = {
        { .color = { 255, 60, 40, 255 }, .unlit = 1 }, { .color = { 60, 120, 255, 255 }, .unlit = 1 },
        { .color = { 255, 200, 40, 255 }, .unlit = 1 }, { .color = { 190, 90, 230, 255 }, .unlit = 1 }
    };
    const int32_t small = SMALL / 80 * (height < 240 ? height : 240);
    int result = SMEAR_OK;
    for (int i = 0; i < RACE_CARS && result == SMEAR_OK; i++) {
        const int32_t ahead = ahead_of(&race->car[0], race->car[i].along);
        if (ahead > FAR)
            continue;
        const smear_transform pose = pose_of(&race->car[i]);
        struct shape *const seen = ahead < small ? &car : &small_car;
        seen->mesh.triangle_count = seen->boxes + (soft ? 0u : 2u);
        const smear_draw draw = { .id = (uint32_t)(ID_CAR + i), .mesh = &seen->mesh, .material = &paint[i], .now = &pose };
        const smear_transform under = shadow_of(&pose);
        const smear_draw shadow = { .id = (uint32_t)(ID_SHADOW + i), .mesh = &smear_blob, .material = &smear_blob_material, .now = &under };
        result = smear_submit(ctx, &draw);
        if (result == SMEAR_OK && soft)
            result = smear_submit(ctx, &shadow);
    }
    return result;
}

static smear_point spark[RACE_SPARKS];
static smear_points sparks = { spark, 0 };

/* Sparks are points of light, which fade. */
static void show_sparks(const struct race *race)
{
    sparks.count = 0;
    for (int i = 0; i < RACE_SPARKS; i++) {
        const struct race_spark *s = &race->spark[i];
        if (s->age != 0)
            spark[sparks.count++] = (smear_point){ .now = { s->at.x, s->at.y, s->at.z }, .size = SMEAR_Q16(0.16),
                                                   .before = { s->before.x, s->before.y, s->before.z },
                                                   .color = { 255, 210, 90 }, .fade = (uint8_t)(9 * s->age) };
    }
}

/* ------------------------------------------------------------------ over the picture */

enum { CLOCK, PLACE, WORD, BAR, SPEED, RATE, LEFT, RIGHT, ITEMS, LETTERS = 16 };

static smear_overlay_item item[ITEMS];
static char text[4][LETTERS];

static char *put_number(char *to, uint32_t value, int digits)
{
    for (int i = digits - 1; i >= 0; i--, value /= 10)
        to[i] = (char)('0' + value % 10);
    return to + digits;
}

/* Minutes, seconds and hundredths of a number of frames. */
static void put_time(char *to, uint32_t frames)
{
    const uint32_t hundredths = frames * 10 / 3;
    to = put_number(to, hundredths / 6000, 1);
    *to++ = ':';
    to = put_number(to, hundredths / 100 % 60, 2);
    *to++ = '.';
    *put_number(to, hundredths % 100, 2) = '\0';
}

static void put_text(char *to, const char *from)
{
    while ((*to++ = *from++) != '\0')
        ;
}

static const char *word_of(const struct race *race, const struct view_way *way)
{
    if (way->waits)
        return race->frame % 32 < 22 ? "PRESS START" : "";
    return race->frame <= RACE_START ? "READY" : race->finished != 0 ? "FINISH" : race->frame < RACE_START + 30 ? "GO" : "";
}

static void write_text(const struct race *race, const struct view_way *way)
{
    static const char *const places[RACE_CARS] = { "1ST", "2ND", "3RD", "4TH" };
    const bool runs = race->lap > 0 && race->finished == 0;
    put_time(text[0], runs ? race->frame - race->lap_began : race->finished != 0 ? race->best : 0);
    put_text(text[1], "LAP 1/3 ");
    text[1][4] = (char)('0' + (race->lap < 1 ? 1 : race->lap > RACE_LAPS ? RACE_LAPS : race->lap));
    put_text(text[1] + 8, places[race->place - 1]);
    put_text(text[2], word_of(race, way));
    put_text(way->rate == 0 ? text[3] : put_number(text[3], way->rate, way->rate < 100 ? 2 : 3), "");
}

static smear_overlay_item letters(int x, int y, const char *words, const smear_font *font, int scale)
{
    return (smear_overlay_item){ .x = (int16_t)x, .y = (int16_t)y, .text = words, .font = font, .scale = (uint8_t)scale };
}

static void set_color(smear_overlay_item *to, uint32_t rgba)
{
    for (int i = 0; i < 4; i++)
        to->color[i] = (uint8_t)(rgba >> (24 - 8 * i));
}

static smear_overlay_item box(int x, int y, int width, int height, uint32_t rgba)
{
    smear_overlay_item made = { .x = (int16_t)x, .y = (int16_t)y, .width = (uint16_t)width, .height = (uint16_t)height };
    set_color(&made, rgba);
    return made;
}

/* A time and a place above, a word in the middle, the speed below, and frames per second. */
static const smear_overlay *overlay_of(const struct race *race, const struct view_way *way, int width, int height)
{
    static smear_overlay overlay = { .item = item, .points = &sparks };
    const smear_font *const bold = &smear_font_8x8, *const small = &smear_font_6x8;
    const int letter = width >= 200 ? 16 : 8, edge = width >= 200 ? 6 : 2, bar = width / 3, low = height - edge - 8;
    write_text(race, way);
    show_sparks(race);
    int middle = 0;
    for (const char *c = text[2]; *c != '\0'; c++)
        middle++;
    const int large = middle * 2 * letter <= width ? letter / 4 : letter / 8;
    item[CLOCK] = letters(edge, edge, text[0], width < 128 ? small : bold, letter / 8);      /* beside the place */
    item[PLACE] = letters(width - edge - 66, edge, text[1], small, 1);
    item[WORD] = letters((width - middle * 8 * large) / 2, height / 3, text[2], bold, large);
    item[BAR] = box(edge, height - edge - 5, bar + 2, 5, 0x0000008c);
    item[SPEED] = box(edge + 1, height - edge - 4, scaled(bar, race->car[0].speed), 3, 0x5ae65aff);
    item[RATE] = letters(width - edge - 18, low, text[3], small, 1);
    item[LEFT] = letters(width / 2 - 34, low, "SHARP", small, 1);
    item[RIGHT] = letters(width / 2 + 4, low, "BLUR", small, 1);
    set_color(&item[PLACE], 0xfff096ff);
    set_color(&item[WORD], 0xffe13cff);
    overlay.count = way->split ? ITEMS : way->rate != 0 ? LEFT : RATE;
    return &overlay;
}

int view_submit(smear_context *ctx, const struct race *race, const smear_desc *desc, const struct view_way *way, uint32_t frames)
{
    static smear_sky sky = SMEAR_SKY(0x3a78c8, 0xb8dcf4, 0x8fb08c, 0x4c8044);
    static const smear_scene scene = { .sky = &sky };
    const bool rich = desc->width >= 128;       /* on a Game Boy a sky takes an eighth of a frame */
    const bool soft = desc->max_draws >= VIEW_DRAWS + VIEW_SHADOWS;
    const smear_camera camera = camera_of(&race->car[0]);
    /* Streaks are as long on slow machines as on fast ones. */
    const smear_frame frame = {
        .camera = &camera, .clear = 0x86c5f0, .scene = rich ? &scene : NULL,
        .light_space = SMEAR_LIGHT_ENCODED, .cut = race->frame <= 1 || frames == 0,
        .method = way->method, .target = way->target, .samples = way->samples, .budget = way->budget,
        .overlay = way->bare ? NULL : overlay_of(race, way, desc->width, desc->height),
        .shutter = { .degrees = (uint16_t)(180 / (frames != 0 ? frames : 1)), .path = SMEAR_PATH_LINE }
    };
    int result = smear_begin(ctx, &frame);
    if (result == SMEAR_OK)
        result = submit_course(ctx, &race->car[0]);
    return result == SMEAR_OK ? submit_cars(ctx, race, desc->height, soft) : result;
}
