/* SPDX-License-Identifier: MIT */
/* test_still.c - smear_desc.cache_static and smear_desc.buffer_age: the pictures are those of a context that draws and
 * sends everything in every frame, to the bit, and what stands still is drawn, and sent, only where it must be.
 * Host only. */
#include "tests/rig.h"

#include "smear_overlay.h"

enum { WIDTH = 70, HEIGHT = 52, FLOOR = 0, POST, PANE, MOVER, DRAWS, BYTES = WIDTH * HEIGHT * 4 };

/* A floor and a post, which stand still, as does a pane of glass before them; a cube that goes by between them. */
struct set {
    smear_transform pose[DRAWS];
    smear_material material[DRAWS];
    smear_mesh mesh[DRAWS];
    smear_texture texture;
    smear_draw draw[DRAWS];
    smear_camera camera;
    smear_frame frame;
    uint8_t blurred;                /* a method that frames may have in turn with SMEAR_NONE */
    int count;
};

static void set_up(struct set *s, uint8_t method)
{
    make_checker();
    *s = (struct set){
        .pose = { pose_at(0, -1.2, -6, 0, -1.5), pose_at(-0.8, 0, -6, 0.5, 0), pose_at(0.6, 0.3, -3, 0, 0), { { 0 } } },
        .material = { { .texture = &s->texture }, { .color = { 90, 200, 60, 255 } },
                      { .color = { 255, 40, 40, 120 }, .alpha = SMEAR_BLEND, .unlit = 1 },
                      { .color = { 240, 220, 40, 255 } } },
        .mesh = { square, cube, square, cube }, .texture = checker_texture,
        .camera = camera_at(0, 0.2, 0, 0), .count = DRAWS
    };
    for (int i = 0; i < DRAWS; i++)
        s->draw[i] = (smear_draw){ .id = (uint32_t)i + 1, .mesh = &s->mesh[i], .material = &s->material[i],
                                   .now = &s->pose[i] };
    s->frame = (smear_frame){ .camera = &s->camera, .method = method, .clear = 0x305080 };
}

/* Sharp frames that are compared know what moved by these. */
static void find_bounds(struct set *s)
{
    for (int i = 0; i < DRAWS; i++)
        smear_mesh_find_bounds(&s->mesh[i]);
}

static void move_on(struct set *s, int frame)
{
    s->pose[MOVER] = pose_at(-2 + 0.4 * frame, 0.1, -4.5, 0.3 * frame, 0);
}

/* `sharp`: without a window. */
static smear_desc desc_of(uint32_t triangles, bool sharp)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .tile = 16, .reach = 10,
                         .methods = (uint16_t)(SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_ACCUMULATE)
                                               | (sharp ? 0u : SMEAR_SET(SMEAR_RECONSTRUCT))),
                         .strip = 128, .max_triangles = triangles };
}

/* The same frames in a context that keeps and in one that does not. */
struct pair {
    struct rig keeps, draws;
};

static bool pair_begin(struct pair *p, smear_desc desc)
{
    bool ok = rig_begin(&p->draws, &desc, false);
    desc.reuse.cache_static = 1;
    return rig_begin(&p->keeps, &desc, false) && ok;
}

static void pair_end(struct pair *p)
{
    CHECK(guards_intact(&p->keeps));
    rig_end(&p->keeps);
    rig_end(&p->draws);
}

/* True when what stands still was kept. Pictures must be the same. */
static bool kept(struct pair *p, const struct set *s)
{
    smear_stats stats, full;
    uint8_t *want = rig_copy(&p->draws, &s->frame, s->draw, s->count);
    rig_forget_output(&p->keeps);
    CHECK_EQ(rig_frame(&p->keeps, &s->frame, s->draw, s->count), SMEAR_OK);
    CHECK(want != NULL && same_picture(&p->keeps, want));
    free(want);
    smear_get_stats(p->keeps.ctx, &stats);
    smear_get_stats(p->draws.ctx, &full);
    CHECK_EQ(full.static_cached, 0);
    CHECK_EQ(stats.triangles_in, full.triangles_in);
    CHECK(memcmp(stats.tiles, full.tiles, sizeof full.tiles) == 0 && stats.tiles_complex == full.tiles_complex);
    CHECK(stats.parts_added != 0 || stats.samples == full.samples);
    CHECK(stats.parts_added != 0
          || (stats.static_cached ? stats.triangles_drawn <= full.triangles_drawn
                                  : stats.triangles_drawn == full.triangles_drawn));
    return stats.static_cached != 0;
}

static void test_pictures_are_the_same_and_the_still_layer_is_drawn_once(void)
{
    static const uint8_t methods[] = { SMEAR_SUBFRAMES, SMEAR_TIMEMASK, SMEAR_AUTO, SMEAR_SUBFRAMES, SMEAR_SUBFRAMES };
    for (unsigned m = 0; m < sizeof methods; m++)
        for (uint32_t triangles = 16; triangles <= 400; triangles += 384) {       /* in parts; at once */
            struct pair p OWNED(pair_end);
            struct set s;
            set_up(&s, methods[m]);
            s.frame.samples = m >= 3;           /* one instant, of which nothing is kept, but where edges are smooth */
            s.frame.edges = m == 4 ? SMEAR_EDGES_SMOOTH : SMEAR_EDGES_HARD;
            if (pair_begin(&p, desc_of(triangles, m != 1)))
                for (int i = 0; i < 8; i++) {
                    move_on(&s, i);
                    CHECK_EQ(kept(&p, &s), i >= 2 && m != 3);   /* the cube stands still where it is first seen */
                }
        }
}

/* Of what is as near the first wins; of more than one instant what stands still is before what moves. */
static void test_one_instant_shows_the_same_of_what_is_as_near(void)
{
    for (int samples = 1; samples <= 2; samples++) {
        struct pair p OWNED(pair_end);
        struct set s;
        set_up(&s, SMEAR_SUBFRAMES);
        s.frame.samples = (uint16_t)samples;
        s.pose[1] = pose_at(0, 0, -5, 0, 0);
        s.mesh[1] = square;
        if (pair_begin(&p, desc_of(400, true)))
            for (int i = 0; i < 4; i++) {
                s.pose[0] = pose_at(0.2 * i, 0.3, -5, 0, 0);
                kept(&p, &s);
            }
    }
}

/* A filter's window has rows that go round within a tile row: all that is looked at is looked at there, too. */
static void test_a_window_changes_no_picture(void)
{
    smear_desc desc[2] = { desc_of(400, true), desc_of(400, false) };
    for (int k = 0; k < 2; k++)
        desc[k].width = desc[k].height = 160;
    RIG(plain, &desc[0], false);
    RIG(windowed, &desc[1], false);
    for (int target = 64; target <= 512; target *= 2) {
        struct set s;
        set_up(&s, SMEAR_AUTO);
        s.frame.target = (uint16_t)target;
        for (int i = 0; i < 12; i++) {
            s.pose[MOVER] = pose_at(-1.5 + 0.25 * i, -0.5 + 0.15 * i, -3.5, 0.4 * i, 0.2 * i);
            uint8_t *want = rig_copy(&plain, &s.frame, s.draw, s.count);
            rig_forget_output(&windowed);
            CHECK_EQ(rig_frame(&windowed, &s.frame, s.draw, s.count), SMEAR_OK);
            CHECK(want != NULL && same_picture(&windowed, want));
            free(want);
        }
    }
}

/* What does not move by a step of a 256th of a pixel is drawn among what stands still. */
static void test_motion_too_small_to_be_seen_is_drawn_in_order(void)
{
    struct pair p OWNED(pair_end);
    struct set s;
    set_up(&s, SMEAR_AUTO);
    if (pair_begin(&p, desc_of(400, true)))
        for (int i = 0; i < 12; i++) {
            s.pose[MOVER] = i > 6 ? pose_at(0.3 * i, 0.1, -4.5, 0.2, 0) : pose_at(2, 0.1, -12, 0.2, 0);
            s.pose[MOVER].origin[0] += i;
            const bool is_kept = kept(&p, &s);
            if (i < 7)
                CHECK(!is_kept);
            else if (i > 9)
                CHECK(is_kept);
        }
}

/* ------------------------------------------------------------------ displays that keep their picture */

/* A context that sends only what its display does not show, into buffers that are shown in turn; and one that
 * sends all. */
struct display {
    struct rig sends;               /* must be first: what flush is given */
    struct rig all;
    uint8_t *buffer[3];
    int buffers, written;           /* the one that is written to */
    int x, y;                       /* where the next band may begin */
    uint32_t bytes;                 /* sent in the frame */
    bool in_order;
};

static int bits_of(uint8_t format)
{
    return format == SMEAR_XRGB8888                                ? 32
         : format >= SMEAR_RGB565 && format <= SMEAR_RGB555        ? 16
         : format == SMEAR_L4                                      ? 4
         : format == SMEAR_L1                                      ? 1
                                                            : 8;
}

static int put_band(void *user, const smear_band *band)
{
    struct display *d = user;
    const smear_desc *desc = &d->sends.desc;
    const int page = desc->format == SMEAR_L1_PAGES ? 8 : 1, bits = bits_of(desc->format);
    const size_t pitch = (size_t)(desc->width * bits + 7) / 8, at = (size_t)band->x * (size_t)bits / 8;
    const int rows = (band->height + page - 1) / page;
    d->in_order = d->in_order && (band->y > d->y || (band->y == d->y && band->x >= d->x)) && band->width > 0
               && band->x + band->width <= desc->width && band->y + band->height <= desc->height
               && band->size == band->stride * (uint32_t)rows;
    d->x = band->x + band->width;
    d->y = band->y;
    d->bytes += band->size;
    for (int i = 0; d->in_order && i < rows; i++)
        memcpy(d->buffer[d->written] + (size_t)(band->y / page + i) * pitch + at,
               (const uint8_t *)band->pixels + (size_t)i * band->stride, band->stride);
    return d->sends.bands++ == d->sends.fail_at ? d->sends.fail_with : 0;
}

static bool display_begin(struct display *d, smear_desc desc, int buffers)
{
    *d = (struct display){ .buffers = buffers };
    smear_desc alone = desc;
    alone.workers = 1;
    bool ok = rig_begin(&d->all, &alone, false);
    desc.flush = put_band;
    desc.reuse.buffer_age = (uint8_t)buffers;
    ok = rig_begin(&d->sends, &desc, false) && ok;
    for (int i = 0; i < buffers; i++)
        ok = CHECK((d->buffer[i] = calloc(1, BYTES)) != NULL) && ok;
    return ok;
}

static void display_end(struct display *d)
{
    rig_end(&d->sends);
    rig_end(&d->all);
    for (int i = 0; i < d->buffers; i++)
        free(d->buffer[i]);
}

static int write_frame(struct display *d, const struct set *s)
{
    d->x = d->y = 0;
    d->bytes = 0;
    d->in_order = true;
    d->sends.bands = 0;
    d->written = (d->written + 1) % d->buffers;
    int result = rig_frame(&d->sends, &s->frame, s->draw, s->count);
    CHECK(d->in_order);
    return result;
}

/* Draws a frame; what is shown must be what a context shows that sends all. The tiles that were not sent. */
static uint32_t shown(struct display *d, const struct set *s)
{
    smear_stats stats;
    uint8_t *want = rig_copy(&d->all, &s->frame, s->draw, s->count);
    CHECK_EQ(write_frame(d, s), SMEAR_OK);
    CHECK(want != NULL && memcmp(want, d->buffer[d->written], d->all.picture_size) == 0);
    free(want);
    smear_get_stats(d->sends.ctx, &stats);
    CHECK_EQ(d->bytes == d->all.picture_size, stats.tiles_kept == 0);
    return stats.tiles_kept;
}

/* Of 5 x 4 tiles. */
static void test_a_display_is_sent_what_it_does_not_show(void)
{
    static const uint8_t methods[] = { SMEAR_SUBFRAMES, SMEAR_TIMEMASK, SMEAR_AUTO };
    for (uint8_t format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++)
        for (int buffers = 1; buffers <= 3; buffers++)
            for (uint8_t keeps = 0; keeps < 2; keeps++) {
                struct display d OWNED(display_end);
                struct set s;
                set_up(&s, methods[(format + buffers) % 3]);
                for (int k = 0; k < 9 && keeps == 0; k++)
                    s.pose[FLOOR].basis[k] *= 8;        /* on beneath the camera: its triangles are cut */
                smear_desc desc = desc_of(buffers == 2 ? 16 : 400, keeps == 0);
                desc.format = format;
                desc.reuse.cache_static = keeps;
                desc.display.dither = format % 2 ? SMEAR_DITHER_BLUE : SMEAR_DITHER_ORDERED;
                if (display_begin(&d, desc, buffers))
                    for (int i = 0; i < 14; i++) {
                        move_on(&s, i < 10 ? i : 9);
                        const uint32_t kept = shown(&d, &s);
                        if (i < 1 + buffers || i == 10)
                            CHECK_EQ(kept, 0);      /* unknown yet, or the cube has stopped */
                        else if (i > 1 + buffers && i < 10)
                            CHECK(kept >= 8);
                        if (i >= 10 + buffers)
                            CHECK_EQ(kept, 20);
                    }
            }
}

/* Of one instant nothing is kept, before frames of which tiles are and after them. */
static void test_a_display_is_sent_all_of_one_instant(void)
{
    for (int buffers = 1; buffers <= 3; buffers++) {
        struct display d OWNED(display_end);
        struct set s;
        set_up(&s, SMEAR_SUBFRAMES);
        if (display_begin(&d, desc_of(buffers == 2 ? 16 : 400, buffers != 3), buffers))
            for (int i = 0; i < 24; i++) {
                s.frame.samples = i / 6 % 2 == 0 ? 1 : 4;
                move_on(&s, i);
                const uint32_t kept = shown(&d, &s);
                if (i % 12 <= 6 + buffers - 1)
                    CHECK_EQ(kept, 0);
                else
                    CHECK(kept != 0);
            }
    }
}

/* Of the floor, parts of a single tile, narrower than lanes, are drawn again below wide ones. */
static void test_narrow_parts_are_drawn_again_below_wide_ones(void)
{
    struct display d OWNED(display_end);
    struct set s;
    set_up(&s, SMEAR_SUBFRAMES);
    smear_desc desc = desc_of(400, true);
    desc.methods = SMEAR_SET_TEMPORAL;
    desc.tile = desc.reach = 8;
    s.draw[PANE] = s.draw[MOVER];
    s.count = PANE + 1;
    if (display_begin(&d, desc, 1))
        for (int i = 0; i < 96; i++) {
            const double down = 0.05 * (i / 8);     /* through the floor's rows */
            s.pose[POST] = pose_at(-0.8 + 0.15 * (i % 8), -0.35 - down, -4, 0, 0);
            s.pose[MOVER] = pose_at(0.3 + 0.004 * i, -0.55 - down, -3, 0, 0);
            for (int k = 0; k < 9; k++) {
                s.pose[POST].basis[k] /= 12;
                s.pose[MOVER].basis[k] /= 40;
            }
            shown(&d, &s);
        }
}

static void test_a_still_frame_sends_nothing_until_it_is_refreshed(void)
{
    struct display d OWNED(display_end);
    struct set s;
    set_up(&s, SMEAR_AUTO);
    s.count = 2;
    if (display_begin(&d, desc_of(400, true), 1)) {
        CHECK_EQ(shown(&d, &s), 0);
        for (int i = 0; i < 3; i++) {
            CHECK_EQ(shown(&d, &s), 20);
            CHECK_EQ(d.sends.bands, 0);
        }
        memset(d.buffer[0], 0, BYTES);
        s.frame.refresh = 1;
        CHECK_EQ(shown(&d, &s), 0);
        CHECK_EQ(d.sends.bands, 4);
        s.frame.refresh = 0;
        CHECK_EQ(shown(&d, &s), 20);
        s.material[FLOOR].texture = NULL;
        CHECK_EQ(shown(&d, &s), 0);
        CHECK_EQ(shown(&d, &s), 20);
    }
}

/* So slow that it never moves by a step of its vertices within an exposure, but from frame to frame. */
static void test_what_creeps_is_sent_all_the_same(void)
{
    struct display d OWNED(display_end);
    struct set s;
    set_up(&s, SMEAR_AUTO);
    s.frame.shutter.degrees = 1;
    if (display_begin(&d, desc_of(400, true), 2))
        for (int i = 0; i < 40; i++) {
            s.pose[MOVER] = pose_at(0.9 + 0.002 * i, 0.9, -9, 0.2, 0);
            const uint32_t kept = shown(&d, &s);
            if (i > 4)
                CHECK(kept >= 16 && kept < 20);
        }
}

/* Of two that are equally near the first is seen, though what creeps is assembled first. */
static void test_what_creeps_stays_behind_what_came_before_it(void)
{
    for (int buffers = 1; buffers <= 3; buffers++) {
        struct display d OWNED(display_end);
        struct set s;
        set_up(&s, SMEAR_AUTO);
        s.material[PANE].alpha = SMEAR_OPAQUE;
        s.mesh[MOVER] = square;
        if (display_begin(&d, desc_of(buffers == 2 ? 6 : 400, true), buffers))
            for (int i = 0; i < 8; i++) {
                s.pose[MOVER] = s.pose[PANE];
                s.pose[MOVER].origin[0] += i;
                shown(&d, &s);
                s.camera.pose.origin[0] += i == 5;      /* all is drawn again */
            }
    }
}

enum { SQUARES = 12, CORNERS = SQUARES + 1 };

/* Squares beside each other, of side 1 / SQUARES of the mesh that it stands for. */
static smear_mesh grid_of(smear_transform *pose)
{
    static int16_t corner[CORNERS * CORNERS * 3];
    static uint16_t side[SQUARES * SQUARES * 6];
    for (int y = 0; y < CORNERS; y++)
        for (int x = 0; x < CORNERS; x++) {
            corner[3 * (y * CORNERS + x)] = (int16_t)((2 * x - SQUARES) * 256);
            corner[3 * (y * CORNERS + x) + 1] = (int16_t)((2 * y - SQUARES) * 256);
        }
    for (int i = 0; i < SQUARES * SQUARES; i++) {
        const int from = i / SQUARES * CORNERS + i % SQUARES;
        const int four[6] = { from, from + 1, from + CORNERS + 1, from, from + CORNERS + 1, from + CORNERS };
        for (int k = 0; k < 6; k++)
            side[6 * i + k] = (uint16_t)four[k];
    }
    for (int k = 0; k < 9; k++)
        pose->basis[k] /= SQUARES;
    return (smear_mesh){ .position = corner, .vertex_count = CORNERS * CORNERS, .index = side,
                         .triangle_count = SQUARES * SQUARES * 2 };
}

/* ------------------------------------------------------------------ sharp frames alone */

static smear_desc sharp_desc(uint32_t triangles)
{
    smear_desc desc = desc_of(triangles, true);
    desc.methods = SMEAR_SET(SMEAR_NONE);
    desc.strip = desc.reach = 0;
    return desc;
}

static void test_a_display_is_sent_what_it_does_not_show_of_sharp_frames(void)
{
    for (uint8_t format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++)
        for (int buffers = 1; buffers <= 3; buffers++) {
            struct display d OWNED(display_end);
            struct set s;
            set_up(&s, SMEAR_NONE);
            for (int k = 0; k < 9 && format % 2 == 0; k++)
                s.pose[FLOOR].basis[k] *= 8;
            smear_desc desc = sharp_desc(buffers == 2 ? 16 : 400);
            desc.format = format;
            desc.display.dither = format == SMEAR_RGB565 ? SMEAR_DITHER_NONE : format % 2 ? SMEAR_DITHER_BLUE : SMEAR_DITHER_ORDERED;
            find_bounds(&s);
            if (display_begin(&d, desc, buffers))
                for (int i = 0; i < 14; i++) {
                    move_on(&s, i < 10 ? i : 9);
                    const uint32_t kept = shown(&d, &s);
                    if (i < buffers)
                        CHECK_EQ(kept, 0);
                    else if (i < 9 + buffers)
                        CHECK(kept >= 8 && kept < 20);
                    else
                        CHECK_EQ(kept, 20);
                }
        }
}

/* So many triangles that cores assemble parts of them; in the end some that moved stand still. */
static void test_cores_assemble_parts_of_what_a_display_is_sent(void)
{
    static const uint8_t methods[] = { SMEAR_AUTO, SMEAR_SUBFRAMES, SMEAR_NONE, SMEAR_NONE };
    for (int workers = 2; workers <= 5; workers++)
        for (int way = 0; way < 4; way++) {
            const int buffers = 1 + way % 2;
            struct display d OWNED(display_end);
            struct set s;
            set_up(&s, methods[way]);
            s.material[FLOOR].texture = NULL;
            s.mesh[FLOOR] = grid_of(&s.pose[FLOOR]);
            smear_desc desc = desc_of(workers == 5 ? 500 : 2000, true);
            desc.workers = (uint8_t)workers;
            if (methods[way] == SMEAR_NONE) {
                desc.methods = SMEAR_SET(SMEAR_NONE);
                find_bounds(&s);
            }
            if (display_begin(&d, desc, buffers)) {
                for (int i = 0; i < 14; i++) {
                    move_on(&s, i < 10 ? i : 9);
                    if (i == 12) {
                        s.mesh[MOVER] = grid_of(&s.pose[MOVER]);
                        find_bounds(&s);
                    }
                    const uint32_t kept = shown(&d, &s);
                    if (i > 1 + buffers && i < 10)
                        CHECK(kept >= 8);
                }
            }
        }
}

#include "build/suites/still.h"
