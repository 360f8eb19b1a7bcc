/* SPDX-License-Identifier: MIT */
/* view.c - see view.h. The camera follows the player's car along the road, so that bends are seen before they come. */
#include "platform/game/view.h"

#include <smear_overlay.h>

/* ------------------------------------------------------------------ shapes of boxes */

enum { BOXES = 5, BOX_TRIANGLES = 10, STEPS = 5 };

struct box {
    int8_t x0, y0, z0, x1, y1, z1;  /* 1/8 metre */
    uint32_t rgb;
};

struct shape {
    int16_t position[BOXES * 8 * 3];
    uint16_t corner[BOXES * BOX_TRIANGLES * 3];
    uint8_t color[BOXES * BOX_TRIANGLES * 4];
    smear_mesh mesh;
};

static struct shape car, gate;

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

void view_make(void)
{
    /* Wheels in two pairs, the body, a cabin, a wing. Forward is -z. */
    static const struct box parts[] = {
        { -8, 0, -15, 8, 5, -9, 0x505058 }, { -9, 0, 8, 9, 5, 14, 0x505058 }, { -6, 2, -19, 6, 6, 17, 0xffffff },
        { -4, 6, -5, 4, 9, 7, 0x586070 }, { -9, 9, 14, 9, 11, 18, 0xf0f0f0 }
    };
    static const struct box posts[] = {
        { -52, 0, -2, -48, 48, 2, 0xe8e8e8 }, { 48, 0, -2, 52, 48, 2, 0xe8e8e8 }, { -52, 36, -1, 52, 48, 1, 0x2050c0 }
    };
    make_shape(&car, parts, 5);
    make_shape(&gate, posts, 3);
}

/* ------------------------------------------------------------------ poses */

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
    const int32_t back = 76000 + scaled(12000, c->speed);
    const smear_vec3 eye = course_place(c->along - back, c->right / 8 * 7, SMEAR_Q16(3.2));
    const smear_vec3 target = course_place(c->along + 90000, c->right / 8 * 7, SMEAR_Q16(0.6));
    smear_camera camera = smear_perspective(SMEAR_DEGREES(58), SMEAR_Q16(0.5), SMEAR_Q16(170));
    camera.pose = smear_look_at(eye, target, up);
    return camera;
}

/* ------------------------------------------------------------------ draws */

/* Numbers by which the library knows from frame to frame what is what. */
enum { ID_CHUNK = 1, ID_GATE = ID_CHUNK + COURSE_CHUNKS, ID_CAR };

static int submit_course(smear_context *ctx, const struct race_car *c)
{
    static const smear_material paint = { .unlit = 1 }, post = { .unlit = 1, .double_sided = 1 };
    const int first = (int)((c->along >> 16) - 2 + COURSE_SEGMENTS) / COURSE_CHUNK;
    int result = SMEAR_OK;
    for (int i = first; i < first + VIEW_CHUNKS && result == SMEAR_OK; i++) {
        const smear_draw draw = { .id = (uint32_t)(ID_CHUNK + i % COURSE_CHUNKS), .mesh = course_chunk(i), .material = &paint };
        result = smear_submit(ctx, &draw);
    }
    const smear_transform at = smear_look_at(course_place(0, 0, 0), course_place(65536, 0, 0), up);
    const smear_draw draw = { .id = ID_GATE, .mesh = &gate.mesh, .material = &post, .now = &at };
    return result == SMEAR_OK ? smear_submit(ctx, &draw) : result;
}

static int submit_cars(smear_context *ctx, const struct race *race)
{
    static const smear_material paint[RACE_CARS] = {
        { .color = { 255, 60, 40, 255 }, .unlit = 1 }, { .color = { 60, 120, 255, 255 }, .unlit = 1 },
        { .color = { 255, 200, 40, 255 }, .unlit = 1 }, { .color = { 190, 90, 230, 255 }, .unlit = 1 }
    };
    int result = SMEAR_OK;
    for (int i = 0; i < RACE_CARS && result == SMEAR_OK; i++) {
        const smear_transform pose = pose_of(&race->car[i]);
        const smear_draw draw = { .id = (uint32_t)(ID_CAR + i), .mesh = &car.mesh, .material = &paint[i], .now = &pose };
        result = smear_submit(ctx, &draw);
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

enum { ITEMS = 6, LETTERS = 16 };

static smear_overlay_item item[ITEMS];
static char text[3][LETTERS];

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

static void write_text(const struct race *race)
{
    static const char *const places[RACE_CARS] = { "1ST", "2ND", "3RD", "4TH" };
    const bool runs = race->lap > 0 && race->finished == 0;
    put_time(text[0], runs ? race->frame - race->lap_began : race->finished != 0 ? race->best : 0);
    put_text(text[1], "LAP 1/3 ");
    text[1][4] = (char)('0' + (race->lap < 1 ? 1 : race->lap > RACE_LAPS ? RACE_LAPS : race->lap));
    put_text(text[1] + 8, places[race->place - 1]);
    put_text(text[2], race->frame <= RACE_START ? "READY" : race->finished != 0 ? "FINISH" : race->frame < RACE_START + 30 ? "GO" : "");
}

/* A time and a place above, a word in the middle, the speed below. */
static const smear_overlay *overlay_of(const struct race *race, int16_t width, int16_t height)
{
    static const smear_overlay overlay = { .item = item, .count = ITEMS, .points = &sparks };
    const bool large = width >= 200;
    const int16_t letter = large ? 16 : 8, edge = large ? 6 : 2;
    const uint16_t bar = (uint16_t)(width / 3);
    write_text(race);
    show_sparks(race);
    int16_t middle = width;
    for (const char *c = text[2]; *c != '\0'; c++)
        middle = (int16_t)(middle - 2 * letter);
    const smear_font *clock = width < 128 ? &smear_font_6x8 : &smear_font_8x8;       /* beside the place */
    item[0] = (smear_overlay_item){ .x = edge, .y = edge, .text = text[0], .font = clock, .scale = (uint8_t)(letter / 8) };
    item[1] = (smear_overlay_item){ .x = (int16_t)(width - edge - 66), .y = edge, .text = text[1], .font = &smear_font_6x8,
                                    .color = { 255, 240, 150, 255 } };
    item[2] = (smear_overlay_item){ .x = (int16_t)(middle / 2), .y = (int16_t)(height / 3), .text = text[2],
                                    .font = &smear_font_8x8, .scale = (uint8_t)(letter / 4), .color = { 255, 225, 60, 255 } };
    item[3] = (smear_overlay_item){ .x = edge, .y = (int16_t)(height - edge - 5), .width = (uint16_t)(bar + 2), .height = 5,
                                    .color = { 0, 0, 0, 140 } };
    item[4] = (smear_overlay_item){ .x = (int16_t)(edge + 1), .y = (int16_t)(height - edge - 4), .height = 3,
                                    .width = (uint16_t)scaled(bar, race->car[0].speed), .color = { 90, 230, 90, 255 } };
    item[5] = (smear_overlay_item){ .width = 0 };
    return &overlay;
}

int view_submit(smear_context *ctx, const struct race *race, const smear_desc *desc)
{
    const smear_camera camera = camera_of(&race->car[0]);
    const smear_frame frame = { .camera = &camera, .clear = 0x86c5f0, .light_space = SMEAR_LIGHT_ENCODED, .cut = race->frame <= 1,
                                .target = (desc->methods & SMEAR_SET_SKETCH) != 0 ? SMEAR_SKETCH : SMEAR_DRAFT,
                                .overlay = overlay_of(race, desc->width, desc->height), .shutter.path = SMEAR_PATH_LINE };
    int result = smear_begin(ctx, &frame);
    if (result == SMEAR_OK)
        result = submit_course(ctx, &race->car[0]);
    return result == SMEAR_OK ? submit_cars(ctx, race) : result;
}
