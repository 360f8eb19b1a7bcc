/* SPDX-License-Identifier: MIT */
/* race.c - see race.h. */
#include "platform/game/race.h"

#include "platform/display.h"

enum {
    TOP = 16800,                    /* segments per frame, q16: 55 metres a second */
    THRUST = 150, BRAKE = 500, DRAG_ON_GRASS = 420, SLOW = 6000,
    GRIP = 23000,                   /* metres per frame that steering moves a car, q16 */
    EDGE = 6 << 16, WALL = 13 << 16,
    LONG = 42000, WIDE = 2 << 16,   /* a car: segments, metres */
    SIDE = 2 << 16                  /* where cars stand before the start */
};

int32_t race_top_speed(void) { return TOP; }

static int32_t limited(int32_t x, int32_t least, int32_t most)
{
    return x < least ? least : x > most ? most : x;
}

void race_begin(struct race *r)
{
    static const struct race race = {
        .car = { { -30000, SIDE, 0, 0 }, { 20000, -SIDE, 0, 0 }, { 90000, SIDE, 0, 0 }, { 160000, -SIDE, 0, 0 } },
        .noise = 1, .place = RACE_CARS
    };
    *r = race;
}

/* A number of -32768 .. 32767. */
static int32_t random(struct race *r)
{
    r->noise = r->noise * 1664525u + 1013904223u;
    return (int32_t)(r->noise >> 16) - 32768;
}

/* A spark flies up where the player's car touches something, in place of the oldest. */
static void strike(struct race *r, int32_t side)
{
    const struct race_car *c = &r->car[0];
    struct race_spark *oldest = &r->spark[0];
    r->struck = true;
    for (int i = 0; i < RACE_SPARKS; i++)
        if (r->spark[i].age == 0 || (oldest->age != 0 && r->spark[i].age > oldest->age))
            oldest = &r->spark[i];
    const smear_vec3 at = course_place(c->along, c->right + side, SMEAR_Q16(0.2));
    const smear_vec3 next = course_place(c->along + c->speed, c->right + side, SMEAR_Q16(0.2));
    *oldest = (struct race_spark){ .at = at, .before = at, .age = 1 };
    const int32_t x = random(r) / 3, y = random(r) & 0x1fff, z = random(r) / 3;
    oldest->step = smear_vec((next.x - at.x) / 4 * 3 + x, SMEAR_Q16(0.2) + y, (next.z - at.z) / 4 * 3 + z);
}

static void move_sparks(struct race *r, bool seen)
{
    enum { GRAVITY = 1400, LIFE = 14 };
    for (int i = 0; i < RACE_SPARKS; i++) {
        struct race_spark *s = &r->spark[i];
        if (s->age == 0)
            continue;
        if (seen)
            s->before = s->at;
        s->at = smear_vec(s->at.x + s->step.x, s->at.y + s->step.y, s->at.z + s->step.z);
        s->step.y -= GRAVITY;
        s->age = s->age == LIFE ? 0 : s->age + 1;
    }
}

/* Bends push outwards, by the square of the speed. */
static void drive(struct race *r, unsigned keys)
{
    struct race_car *c = &r->car[0];
    const int32_t turn = ((keys & KEY_RIGHT) != 0) - ((keys & KEY_LEFT) != 0);
    const int32_t push = (int32_t)((int64_t)course_bend(c->along) * c->speed / TOP * c->speed / TOP) * 5 / 2;
    c->speed += (keys & KEY_DOWN) != 0 ? -BRAKE : THRUST;
    c->slide += (turn * (int32_t)((int64_t)GRIP * (c->speed + TOP / 4) / TOP) - push - c->slide) / 4;
    c->right += c->slide;
    if (c->right > EDGE || c->right < -EDGE) {
        c->speed -= c->speed > SLOW ? DRAG_ON_GRASS : 0;
        if ((r->frame & 1) == 0)
            strike(r, 0);
    }
    if (c->right > WALL || c->right < -WALL)
        c->speed = c->speed * 3 / 4;
    c->right = limited(c->right, -WALL, WALL);
    c->speed = limited(c->speed, 0, TOP);
    c->along += c->speed;
}

/* Rivals follow a line of their own, and none is as fast as the player may be. */
static void drive_rival(struct race *r, int i)
{
    struct race_car *c = &r->car[i];
    const int32_t top = TOP - TOP / 10 - TOP / 30 * i, line = smear_sin((uint32_t)c->along * 5000u + (uint32_t)i * SMEAR_DEGREES(100)) >> 7;
    c->speed += c->speed < top ? THRUST - 10 * i : 0;
    c->slide = limited((line - c->right) / 16, -6000, 6000);
    c->right += c->slide;
    c->along += c->speed;
}

static int32_t magnitude(int32_t x) { return x < 0 ? -x : x; }

/* Cars that touch push each other aside; the one behind loses speed. */
static void collide(struct race *r, int i)
{
    struct race_car *a = &r->car[0], *b = &r->car[i];
    const int32_t ahead = (b->along - a->along) % COURSE_LAP, beside = b->right - a->right;
    if (magnitude(ahead) > LONG || magnitude(beside) > WIDE)
        return;
    const int32_t side = beside > 0 ? 1 : -1;
    a->right -= side * SMEAR_Q16(0.3);
    b->right += side * SMEAR_Q16(0.3);
    if (magnitude(beside) < WIDE * 2 / 3) {
        struct race_car *behind = ahead > 0 ? a : b, *before = ahead > 0 ? b : a;
        const int32_t speed = behind->speed;
        behind->speed = before->speed * 7 / 8;
        before->speed = limited(speed, before->speed, TOP);
    }
    strike(r, side * SMEAR_Q16(0.9));
}

static void count_laps(struct race *r)
{
    const int lap = r->car[0].along < 0 ? 0 : r->car[0].along / COURSE_LAP + 1;
    if (lap == r->lap)
        return;
    if (r->lap > 0) {
        const uint32_t time = r->frame - r->lap_began;
        r->best = r->best == 0 || time < r->best ? time : r->best;
    }
    r->lap = lap;
    r->lap_began = r->frame;
    if (lap > RACE_LAPS)
        r->finished = r->frame;
}

void race_step(struct race *r, unsigned keys, bool seen)
{
    r->frame++;
    r->struck = false;
    move_sparks(r, seen);
    if (r->frame <= RACE_START)
        return;
    /* Who has finished rolls out. */
    drive(r, r->finished != 0 ? (unsigned)KEY_DOWN : keys);
    for (int i = 1; i < RACE_CARS; i++) {
        drive_rival(r, i);
        collide(r, i);
    }
    if (r->finished != 0)
        return;
    count_laps(r);
    r->place = 1;
    for (int i = 1; i < RACE_CARS; i++)
        r->place += r->car[i].along > r->car[0].along;
}
