/* SPDX-License-Identifier: MIT */
/* test_anim.c - the animation module on models from tables: clips, nodes, skins, morph targets, actors, blobs. Needs
 * neither libc nor floating point. The last tests play what `smear convert` made of tests/data/arm.gltf, and the numbers
 * must be the same on every machine. */
#include "build/suites/arm.h"
#include "build/suites/arm_blob.h"

#include "base/base.h"
#include "model/skin.h"
#include "tests/test.h"

#include <smear.h>

#define ONE SMEAR_BASIS_ONE
#define NONE SMEAR_MODEL_NONE

static uint64_t actor_memory[512];
static uint64_t other_memory[512];

/* ------------------------------------------------------------------ a model by hand */

/* Node 0 moves at the root; node 1 stands 2 units along its x; node 2 moves on node 1. Meshes of one triangle. */
static const int16_t corner[9] = { 0, 0, 0, 1000, 0, 0, 0, 1000, 0 };
static const uint16_t corner_index[3] = { 0, 1, 2 };
static const smear_mesh hand_mesh[1] = {
    { .position = corner, .index = corner_index, .triangle_count = 1, .vertex_count = 3, .shift = 10 }
};
#define Q30 (1 << 30)
static const smear_model_node hand_node[3] = {
    { NONE, 1, { 0, 0, 0, ONE, ONE, ONE, 0, 0, 0, Q30, 0, 0 } },
    { 0, 0, { ONE, 0, 0, 0, ONE, 0, 0, 0, ONE, 2 << 16, 0, 0 } },
    { 1, 1, { 0, 1 << 16, 0, ONE, ONE, ONE, 0, 0, 0, Q30, 0, 0 } },
};
static const smear_model_draw hand_draw[2] = {
    { 0, NONE, NONE, NONE, 0, 0, 0, 0, NONE, 0, 0, 0 },
    { 0, NONE, 2, NONE, 0, 0, 0, 1, NONE, 0, 0, 0 },
};
/* Clip 0: node 0 turns by 180 degrees about z in two quarters of 1 s, node 2 moves along z from 0 to 4 and is held at
 * scale 2 from 1 s on. A tick is 2/65536 s. Clip 1 is empty. */
static const uint16_t hand_time[] = { 0, 32768, 65535, 32768 };
static const int16_t hand_value[] = {
    0, 0, 0, 32767,  0, 0, 23170, 23170,  0, 0, 32767, 0,
    0, 0, -32767,  0, 0, 0,  0, 0, 32767,
    0, 0, 0,  32767, 32767, 32767,
};
/* key x factor x 2^(shift - 18): 2 units for 32767; 1/2 for 32767 above 1.5 */
static const smear_model_channel hand_channel[] = {
    { 0, SMEAR_PATH_ROTATION, 0, 3, 4, 0, 0, { 0, 0, 0 }, 0, 0 },
    { 2, SMEAR_PATH_TRANSLATION, 0, 3, 3, 0, 12, { 0, 1 << 16, 2 << 16 }, 1 << 29, -9 },
    { 2, SMEAR_PATH_SCALE, 1, 2, 3, 0, 21, { ONE, ONE, ONE }, 1 << 29, -2 },
};
static const char hand_text[] = "go\0stay";
static const smear_model_clip hand_clip[2] = { { 0, 131070, 0, 3, 1 }, { 3, 0, 3, 0, 0 } };
static const smear_model hand_model = {
    .mesh = hand_mesh, .draw = hand_draw, .node = hand_node, .clip = hand_clip, .channel = hand_channel,
    .key_time = hand_time, .key_value = hand_value, .text = hand_text, .mesh_count = 1, .draw_count = 2,
    .node_count = 3, .clip_count = 2, .transform_count = 2
};

static smear_actor *make(const smear_model *model, int poses)
{
    smear_actor *actor;
    CHECK_EQ(smear_actor_init(&actor, model, poses, actor_memory, sizeof actor_memory), SMEAR_OK);
    return actor;
}

/* Draw `index` after the actor has advanced to `time`. */
static smear_draw pose_at(smear_actor *actor, int index, int32_t time, bool loop)
{
    smear_draw draw = { .id = 0 };
    const smear_play play = { .time = time, .loop = loop };
    CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, index, &draw), SMEAR_OK);
    return draw;
}

static void check_transform(const smear_transform *t, const int32_t want[12], int32_t slack)
{
    for (int i = 0; i < 9; i++)
        CHECK_NEAR(t->basis[i], want[i], slack);
    for (int i = 0; i < 3; i++)
        CHECK_NEAR(t->origin[i], want[9 + i], slack >> 6);
}

/* ------------------------------------------------------------------ clips and nodes */

enum { SLACK = 1024 };          /* keys have 15 bits: 2^-14 of Q8.24 */

static void test_at_its_start_a_clip_is_at_its_first_key(void)
{
    const int32_t want[12] = { ONE, 0, 0, 0, ONE, 0, 0, 0, ONE, 2 << 16, 1 << 16, 0 };
    smear_draw draw = pose_at(make(&hand_model, 1), 1, 0, false);
    check_transform(draw.now, want, SLACK);
    draw = pose_at(make(&hand_model, 1), 1, -70000, false);
    check_transform(draw.now, want, SLACK);
}

static void test_a_clip_stops_at_its_last_key(void)
{
    /* turned by 180 degrees, moved by 4 along z, twice as large */
    const int32_t want[12] = { -2 * ONE, 0, 0, 0, -2 * ONE, 0, 0, 0, 2 * ONE, -(2 << 16), -(1 << 16), 4 << 16 };
    smear_draw draw = pose_at(make(&hand_model, 1), 1, 131070, false);
    check_transform(draw.now, want, 2 * SLACK);
    draw = pose_at(make(&hand_model, 1), 1, 1 << 30, false);
    check_transform(draw.now, want, 2 * SLACK);
}

static void test_between_keys_values_are_mixed(void)
{
    /* 22.5 degrees (the mixture of two quaternions 90 degrees apart, at a quarter: 21.6), along z by 1/2 */
    const int32_t c = 15597680, s = 6180680;        /* cosine and sine of 21.62 degrees, Q8.24 */
    smear_draw draw = pose_at(make(&hand_model, 1), 1, 16384, false);
    CHECK_NEAR(draw.now->basis[0], c, 16384);
    CHECK_NEAR(draw.now->basis[3], s, 16384);
    CHECK_NEAR(draw.now->basis[1], -s, 16384);
    CHECK_NEAR(draw.now->origin[2], 1 << 15, 16);
    /* the origin turns with it: (2, 1) */
    CHECK_NEAR(draw.now->origin[0], (2 * c - s) >> 8, 128);
    CHECK_NEAR(draw.now->origin[1], (2 * s + c) >> 8, 128);
}

static void test_rotations_stay_rotations(void)
{
    smear_actor *actor = make(&hand_model, 1);
    for (int32_t time = 0; time < 65536; time += 1237) {
        const int32_t *b = pose_at(actor, 1, time, false).now->basis;
        for (int i = 0; i < 3; i++)
            for (int j = i; j < 3; j++) {
                int64_t dot = 0;
                for (int k = 0; k < 3; k++)
                    dot += (int64_t)b[3 * i + k] * b[3 * j + k];
                CHECK_NEAR(dot >> 24, i == j ? ONE : 0, 64);
            }
    }
}

static void test_held_keys_change_at_their_time(void)
{
    smear_actor *actor = make(&hand_model, 1);
    CHECK_NEAR(pose_at(actor, 1, 65535, false).now->basis[8], ONE, 64);
    CHECK_NEAR(pose_at(actor, 1, 65536, false).now->basis[8], 2 * ONE, 2 * SLACK);
}

static void test_a_looped_clip_starts_again(void)
{
    smear_actor *actor = make(&hand_model, 1);
    for (int32_t time = -300000; time < 300000; time += 45678) {
        int32_t within = time % 131070 < 0 ? time % 131070 + 131070 : time % 131070;
        smear_transform once = *pose_at(actor, 1, within, false).now, again = *pose_at(actor, 1, time, true).now;
        for (int i = 0; i < 9; i++)
            CHECK_EQ(again.basis[i], once.basis[i]);
        CHECK_EQ(again.origin[2], once.origin[2]);
    }
}

static void test_an_empty_clip_and_rest_are_the_pose_at_rest(void)
{
    const int32_t want[12] = { ONE, 0, 0, 0, ONE, 0, 0, 0, ONE, 2 << 16, 1 << 16, 0 };
    smear_actor *actor = make(&hand_model, 1);
    smear_draw draw;
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .clip = 1, .time = 99999 }), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    check_transform(draw.now, want, 16);
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .rest = 1, .time = 99999 }), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    check_transform(draw.now, want, 16);
    CHECK_EQ(smear_model_find_clip(&hand_model, "stay"), 1);
    CHECK_EQ(smear_model_find_clip(&hand_model, "go"), 0);
    CHECK_EQ(smear_model_find_clip(&hand_model, "g"), -1);
    CHECK_EQ(smear_model_find_clip(&hand_model, "gone"), -1);
}

static void test_a_model_stands_where_it_is_placed(void)
{
    /* a quarter turn about y, half as large, at (10, 20, 30) */
    const smear_transform place = { { 0, 0, ONE / 2, 0, ONE / 2, 0, -ONE / 2, 0, 0 },
                                    { 10 << 16, 20 << 16, 30 << 16 } };
    const int32_t want[12] = { 0, 0, ONE / 2, 0, ONE / 2, 0, -ONE / 2, 0, 0, 10 << 16, (20 << 16) + 32768, 29 << 16 };
    smear_actor *actor = make(&hand_model, 1);
    smear_draw draw;
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .rest = 1, .place = &place }), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 0, &draw), SMEAR_OK);
    for (int i = 0; i < 9; i++)
        CHECK_EQ(draw.now->basis[i], place.basis[i]);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    check_transform(draw.now, want, 64);
    /* model units of a quarter: places shrink, bases do not */
    smear_model quarter = hand_model;
    quarter.unit_shift = -2;
    actor = make(&quarter, 1);
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .rest = 1 }), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    const int32_t small[12] = { ONE, 0, 0, 0, ONE, 0, 0, 0, ONE, 1 << 15, 1 << 14, 0 };
    check_transform(draw.now, small, 64);
}

static void test_a_program_moves_a_node_and_what_hangs_on_it(void)
{
    const smear_node_move move[] = {
        { 2, { { ONE, 0, 0, 0, ONE, 0, 0, 0, ONE }, { 0, 0, 5 << 16 } } },
        { 1, { { 0, -ONE, 0, ONE, 0, 0, 0, 0, ONE }, { 0, 0, 0 } } },
    };
    const int32_t want[12] = { 0, -ONE, 0, ONE, 0, 0, 0, 0, ONE, 1 << 16, 0, 5 << 16 };
    smear_actor *actor = make(&hand_model, 1);
    smear_draw draw;
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .rest = 1, .move = move, .move_count = 2 }), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    check_transform(draw.now, want, 64);
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .rest = 1, .move_count = 1 }), SMEAR_ERR_ARG);
}

/* ------------------------------------------------------------------ poses of an actor */

static void test_an_actor_keeps_the_frame_before(void)
{
    smear_actor *actor = make(&hand_model, 2);
    smear_draw draw;
    CHECK_EQ(smear_actor_draw(actor, 0, &draw), SMEAR_ERR_ARG);         /* nothing has been set */
    draw = pose_at(actor, 1, 16384, false);
    CHECK(draw.open == NULL && draw.close == NULL);
    CHECK_EQ(draw.cut, 1);
    smear_transform first = *draw.now;
    draw = pose_at(actor, 1, 32768, false);
    CHECK_EQ(draw.cut, 0);
    if (CHECK(draw.open != NULL))
        for (int i = 0; i < 9; i++)
            CHECK_EQ(draw.open->basis[i], first.basis[i]);
    CHECK(draw.now->basis[0] != first.basis[0]);
    smear_actor_cut(actor);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    CHECK(draw.open == NULL);
    CHECK_EQ(draw.cut, 1);
    draw = pose_at(actor, 1, 40000, false);
    CHECK_EQ(draw.cut, 0);
    /* a single pose knows no other */
    draw = pose_at(make(&hand_model, 1), 1, 0, false);
    CHECK_EQ(draw.cut, 1);
}

static void test_open_and_close_are_set_alone(void)
{
    smear_actor *actor = make(&hand_model, 3);
    const smear_play early = { .time = 10000 }, late = { .time = 30000 }, now = { .time = 20000 };
    smear_draw draw;
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_OPEN, &early), SMEAR_OK);
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_CLOSE, &late), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_NOW, &now), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    if (CHECK(draw.open != NULL && draw.close != NULL)) {
        CHECK(draw.open->origin[2] < draw.now->origin[2]);
        CHECK(draw.now->origin[2] < draw.close->origin[2]);
    }
    CHECK_EQ(smear_actor_set(make(&hand_model, 2), SMEAR_POSE_CLOSE, &late), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_set(make(&hand_model, 1), SMEAR_POSE_OPEN, &late), SMEAR_ERR_ARG);
}

static void test_held_keys_jump_alone_and_what_moves_moves(void)
{
    smear_actor *actor = make(&hand_model, 3);
    pose_at(actor, 1, 61000, false);
    smear_draw draw = pose_at(actor, 1, 64000, false);
    CHECK_NEAR(draw.open->basis[8], ONE, 64);
    draw = pose_at(actor, 1, 67000, false);
    const smear_transform now = *draw.now;
    CHECK_NEAR(now.basis[8], 2 * ONE, 2 * SLACK);
    CHECK_EQ(draw.open->basis[8], now.basis[8]);
    CHECK_EQ(draw.close->basis[8], now.basis[8]);
    CHECK(draw.open->basis[0] > now.basis[0] && draw.close->basis[0] > draw.open->basis[0]);
    CHECK(draw.open->origin[2] < now.origin[2] && draw.close->origin[2] < draw.open->origin[2]);
    draw = pose_at(actor, 1, 70000, false);             /* the frame after that knows nothing of it */
    CHECK_EQ(draw.open->basis[0], now.basis[0]);
    CHECK_EQ(draw.close->basis[8], draw.now->basis[8]);
    draw = pose_at(actor, 1, 68000, false);             /* nor does one that is played backwards */
    CHECK(draw.open->origin[2] > draw.now->origin[2]);
    draw = pose_at(actor, 1, 64000, false);
    CHECK_EQ(draw.open->basis[8], draw.now->basis[8]);
    CHECK(draw.open->origin[2] > draw.now->origin[2]);
}

/* Clip 0 ends 4 units from where it starts: what it did at its end is no way to its start. */
static void test_an_end_that_does_not_meet_the_start_is_no_path(void)
{
    for (int counts_anew = 0; counts_anew < 3; counts_anew++) {
        smear_actor *actor = make(&hand_model, 3);
        const int32_t turn = counts_anew > 0 ? 0 : 131070, step = 3000;
        const bool loop = counts_anew < 2;
        pose_at(actor, 1, 131070 - 2 * step, loop);
        pose_at(actor, 1, 131070 - step, loop);
        const smear_draw draw = pose_at(actor, 1, turn, loop);
        const int32_t z = draw.now->origin[2];
        CHECK_NEAR(z, 0, 64);
        CHECK_NEAR(draw.open->origin[2] - z, -(step * 2), 64);
        CHECK_NEAR(draw.close->origin[2] - z, -(step * 4), 64);
    }
}

static void test_another_clip_starts_without_a_path_but_for_its_place(void)
{
    const smear_transform left = { { ONE, 0, 0, 0, ONE, 0, 0, 0, ONE }, { -(1 << 16), 0, 0 } };
    const smear_play walk = { .time = 40000, .place = &left }, stay = { .clip = 1, .time = 99 };
    smear_actor *actor = make(&hand_model, 2);
    smear_draw draw;
    CHECK_EQ(smear_actor_advance(actor, &walk), SMEAR_OK);
    CHECK_EQ(smear_actor_advance(actor, &stay), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    for (int i = 0; i < 9; i++)
        CHECK_EQ(draw.open->basis[i], draw.now->basis[i]);
    CHECK_EQ(draw.open->origin[0], draw.now->origin[0] - (1 << 16));
    CHECK_EQ(draw.open->origin[2], draw.now->origin[2]);
    /* which pose is set first makes no difference */
    actor = make(&hand_model, 2);
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_NOW, &walk), SMEAR_OK);
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_OPEN, &stay), SMEAR_OK);
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_NOW, &stay), SMEAR_OK);
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_OPEN, &walk), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    CHECK_EQ(draw.open->origin[0], draw.now->origin[0] - (1 << 16));
    CHECK_EQ(smear_actor_set(actor, SMEAR_POSE_NOW, &walk), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 1, &draw), SMEAR_OK);
    CHECK_EQ(draw.open->origin[0], draw.now->origin[0]);
}

static void test_wrong_arguments_are_refused(void)
{
    smear_actor *actor;
    size_t bytes = smear_actor_memory(&hand_model, 2);
    CHECK(bytes > 0 && bytes < sizeof actor_memory);
    CHECK_EQ((int64_t)bytes, (int64_t)SMEAR_ACTOR_MEMORY(3, 0, 0, 2, 0, 0, 0, 2));
    CHECK_EQ(smear_actor_init(&actor, &hand_model, 2, actor_memory, bytes - 1), SMEAR_ERR_MEMORY);
    CHECK_EQ(smear_actor_init(&actor, &hand_model, 2, NULL, bytes), SMEAR_ERR_MEMORY);
    CHECK_EQ(smear_actor_init(&actor, &hand_model, 2, (char *)actor_memory + 4, bytes), SMEAR_ERR_MEMORY);
    CHECK_EQ(smear_actor_init(&actor, &hand_model, 0, actor_memory, bytes), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_init(&actor, &hand_model, 4, actor_memory, sizeof actor_memory), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_init(&actor, NULL, 1, actor_memory, bytes), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_init(&actor, &hand_model, 2, actor_memory, bytes), SMEAR_OK);
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .clip = 2 }), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_advance(actor, NULL), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_advance(NULL, &(smear_play){ .clip = 0 }), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_submit(actor, NULL), SMEAR_ERR_ARG);
    smear_draw draw;
    CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .clip = 1 }), SMEAR_OK);
    CHECK_EQ(smear_actor_draw(actor, 2, &draw), SMEAR_ERR_ARG);
    CHECK_EQ(smear_actor_draw(actor, -1, &draw), SMEAR_ERR_ARG);
    CHECK_EQ((int64_t)smear_actor_memory(&hand_model, 4), 0);
}

/* ------------------------------------------------------------------ skins and morph targets */

static void test_one_joint_moves_a_vertex_rigidly(void)
{
    /* a quarter turn about z, then 1000.5 steps along x */
    const struct smear_joint_matrix joint[2] = {
        { { { 16384, 0, 0, 0 }, { 0, 16384, 0, 0 }, { 0, 0, 16384, 0 } } },
        { { { 0, -16384, 0, 16008 }, { 16384, 0, 0, 0 }, { 0, 0, 16384, 0 } } },
    };
    const int16_t in[6] = { 100, 200, 300, -32767, 32767, -5 };
    const uint8_t only[2] = { 0, 1 };
    int16_t out[6];
    struct smear_influences influences = { only, 1, 2 };
    smear_skin_positions(out, in, &influences, joint);
    CHECK_EQ(out[0], 100);
    CHECK_EQ(out[1], 200);
    CHECK_EQ(out[2], 300);
    CHECK_EQ(out[3], -32767 + 1001);
    CHECK_EQ(out[4], -32767);
    CHECK_EQ(out[5], -5);
    /* beyond int16: clamped, not wrapped */
    const int16_t far[6] = { 0, 0, 0, 0, -32767, 0 };
    smear_skin_positions(out, far, &influences, joint);
    CHECK_EQ(out[3], 32767);
}

/* (sum of weight x (row v / 2^10 + origin)) / 2^12, in 64 bits */
static int32_t skinned(const struct smear_joint_matrix *joint, const uint8_t *at, uint32_t n, int row,
                       const int16_t v[3])
{
    int64_t sum = 0;
    int32_t first = 256;
    for (uint32_t k = 1; k < n; k++)
        first -= at[n + k - 1];
    for (uint32_t k = 0; k < n; k++) {
        const struct smear_joint_matrix *j = joint + at[k];
        int64_t along = 0;
        for (int i = 0; i < 3; i++)
            along += (int64_t)j->row[row][i] * v[i];
        sum += (k == 0 ? first : at[n + k - 1]) * ((along >> 10) + j->row[row][3]);
    }
    sum = (sum + 2048) >> 12;
    return (int32_t)(sum > 32767 ? 32767 : sum < -32768 ? -32768 : sum);
}

static uint32_t state = 1;

static int32_t random_in(int32_t low, int32_t high)
{
    state = state * 1664525u + 1013904223u;
    return low + (int32_t)((state >> 8) % (uint32_t)(high - low + 1));
}

static void test_weighted_joints_agree_with_wide_arithmetic(void)
{
    struct smear_joint_matrix joint[5];
    for (int trial = 0; trial < 400; trial++) {
        int32_t limit = trial % 4 == 0 ? SMEAR_JOINT_LIMIT : 16384;
        int32_t origin = trial % 4 == 0 ? SMEAR_JOINT_ORIGIN_LIMIT : 60000;
        uint32_t n = (uint32_t)random_in(1, 4);
        uint8_t at[7];
        int16_t v[3], out[3];
        int32_t left = 255;
        for (int i = 0; i < 5; i++) {
            for (int k = 0; k < 9; k++)
                joint[i].row[k / 3][k % 3] = trial % 8 == 0 ? (random_in(0, 1) ? limit : -limit)
                                                            : random_in(-limit, limit);
            for (int k = 0; k < 3; k++)
                joint[i].row[k][3] = random_in(-origin, origin);
        }
        for (uint32_t k = 0; k < n; k++)
            at[k] = (uint8_t)random_in(0, 4);
        for (uint32_t k = 1; k < n; k++) {
            at[n + k - 1] = (uint8_t)(trial % 3 == 0 ? 0 : random_in(0, left));
            left -= at[n + k - 1];
            if (at[n + k - 1] == 0)         /* the rest has no weight either */
                left = 0;
        }
        for (int k = 0; k < 3; k++)
            v[k] = (int16_t)(trial % 8 == 0 ? -32768 : random_in(-32767, 32767));
        struct smear_influences influences = { at, n, 1 };
        smear_skin_positions(out, v, &influences, joint);
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(out[k], skinned(joint, at, n, k, v), 0);
    }
}

static void test_skinned_normals_turn_and_keep_their_length(void)
{
    const struct smear_joint_matrix joint[2] = {
        { { { 16384, 0, 0, 0 }, { 0, 16384, 0, 0 }, { 0, 0, 16384, 0 } } },
        { { { 0, -5000, 0, 0 }, { 5000, 0, 0, 0 }, { 0, 0, 5000, 0 } } },   /* smaller, a quarter about z */
    };
    const int8_t in[9] = { 127, 0, 0, 90, 90, 0, 0, 0, 0 };
    const uint8_t turned[3] = { 1, 1, 1 };
    int8_t out[9];
    struct smear_influences influences = { turned, 1, 3 };
    smear_skin_normals(out, in, &influences, joint);
    CHECK_NEAR(out[0], 0, 0);
    CHECK_NEAR(out[1], 127, 1);
    CHECK_NEAR(out[3], -90, 1);
    CHECK_NEAR(out[4], 90, 1);
    CHECK_EQ(out[6] | out[7] | out[8], 0);
    /* half and half of two joints of one size: half way */
    struct smear_joint_matrix same[2] = {
        joint[0], { { { 0, -16384, 0, 0 }, { 16384, 0, 0, 0 }, { 0, 0, 16384, 0 } } }
    };
    const uint8_t half[3] = { 0, 1, 128 };
    influences = (struct smear_influences){ half, 2, 1 };
    smear_skin_normals(out, in, &influences, same);
    CHECK_NEAR(out[0], 90, 1);
    CHECK_NEAR(out[1], 90, 1);
    for (int trial = 0; trial < 500; trial++) {
        int8_t n[3] = { (int8_t)random_in(-127, 127), (int8_t)random_in(-127, 127), (int8_t)random_in(-127, 127) };
        if ((n[0] | n[1] | n[2]) == 0)
            continue;
        smear_unit_normals(n, 1);
        int32_t square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        CHECK(square > 125 * 125 && square < 129 * 129);
    }
}

static void test_morph_targets_add_up(void)
{
    int16_t position[6] = { 100, 200, 300, 32000, -5, 6 };
    const smear_model_delta delta[3] = { { 0, { 1000, -1000, 1 } }, { 1, { 32767, 0, 10 } }, { 0, { 1, 1, 1 } } };
    const smear_model_target target = { 0, 2, SMEAR_MODEL_NO_NORMALS, 0 }, coarse = { 2, 1, SMEAR_MODEL_NO_NORMALS, 2 };
    smear_morph_positions(position, &target, delta, 8192);          /* half */
    CHECK_EQ(position[0], 600);
    CHECK_EQ(position[1], -300);
    CHECK_EQ(position[2], 301);
    CHECK_EQ(position[3], 32767);                                   /* clamped */
    CHECK_EQ(position[5], 11);
    smear_morph_positions(position, &coarse, delta, -16384);        /* minus four steps */
    CHECK_EQ(position[0], 596);
    CHECK_EQ(position[1], -304);
    int8_t normal[3] = { 127, 0, 0 };
    const int8_t turn[3] = { -64, 64, 0 };
    const smear_model_target turning = { 0, 1, 0, 0 };
    smear_morph_normals(normal, &turning, delta, turn, 16384);
    CHECK_NEAR(normal[0], -1, 1);
    CHECK_NEAR(normal[1], 127, 1);
}

/* ------------------------------------------------------------------ a converted model */

static uint32_t add_value(uint32_t crc, int32_t value)
{
    uint8_t bytes[4];
    for (int i = 0; i < 4; i++)
        bytes[i] = (uint8_t)((uint32_t)value >> 8 * i);
    return smear_crc32(crc, bytes, 4);
}

/* Everything of an actor's draws. */
static uint32_t crc_of(smear_actor *actor, const smear_model *model)
{
    uint32_t crc = 0;
    for (int i = 0; i < model->draw_count; i++) {
        smear_draw d;
        CHECK_EQ(smear_actor_draw(actor, i, &d), SMEAR_OK);
        /* What deforms says so, even where no other pose is known. */
        CHECK(d.open != NULL || d.open_position == NULL || d.open_position == d.mesh->position);
        for (int k = 0; k < 3 * d.mesh->vertex_count; k++) {
            crc = add_value(crc, d.mesh->position[k]);
            crc = add_value(crc, d.open != NULL && d.open_position != NULL ? d.open_position[k] : 0);
            crc = add_value(crc, d.mesh->normal != NULL ? d.mesh->normal[k] : 0);
        }
        for (int k = 0; k < 9; k++) {
            crc = add_value(crc, d.now->basis[k]);
            crc = add_value(crc, d.open != NULL ? d.open->basis[k] : 0);
        }
        for (int k = 0; k < 3; k++)
            crc = add_value(crc, d.now->origin[k]);
    }
    return crc;
}

static const uint32_t arm_crc[8] = {
    0x66ba07a4u, 0xa0caab9bu, 0xa388ac03u, 0xcc1c2948u,
    0xfcd8172eu, 0x7f8db16eu, 0xf5b02210u, 0xdce77ac4u
};

static void test_a_converted_model_plays_the_same_everywhere(void)
{
    const smear_transform place = { { ONE, 0, 0, 0, 0, -ONE, 0, ONE, 0 }, { 1 << 16, -(1 << 16), 12345 } };
    smear_actor *actor = make(&arm_model, 2);
    CHECK_EQ((int64_t)smear_actor_memory(&arm_model, 2), (int64_t)ARM_ACTOR_BYTES(2));
    CHECK_EQ((int64_t)smear_actor_memory(&arm_model, 3), (int64_t)ARM_ACTOR_BYTES(3));
    for (int i = 0; i < 8; i++) {
        const smear_play play = { .clip = (uint16_t)(i < 5 ? ARM_CLIP_WAVE : ARM_CLIP_TURN), .loop = 1,
                                  .time = 11111 * i, .place = i % 2 == 0 ? &place : NULL };
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        CHECK_EQ(crc_of(actor, &arm_model), arm_crc[i]);
    }
}

static int count_bytes(void *user, const smear_band *band)
{
    *(uint32_t *)user += band->size;
    return 0;
}

static uint64_t frame_memory[2817];        /* by `smear info --desc` */

static void test_a_converted_model_is_drawn(void)
{
    uint32_t bytes = 0;
    const smear_desc desc = { .width = 48, .height = 32, .max_triangles = 100, .max_draws = 8, .reach = 8, .format = SMEAR_L8,
                              .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .debug = { .crc = 1 }, .flush = count_bytes, .user = &bytes };
    const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 2 << 16, .near_plane = 1 << 15 };
    smear_transform place = SMEAR_IDENTITY;
    smear_context *ctx;
    smear_stats stats;
    smear_actor *actor = make(&arm_model, 2);
    place.origin[1] = -(1 << 16);
    place.origin[2] = -(5 << 16);
    REQUIRE_EQ(smear_init(&ctx, &desc, frame_memory, sizeof frame_memory), SMEAR_OK);
    for (int i = 0; i < 2; i++) {
        CHECK_EQ(smear_actor_advance(actor, &(smear_play){ .time = 20000 * i, .place = &place }), SMEAR_OK);
        CHECK_EQ(smear_begin(ctx, &(smear_frame){ .camera = &camera, .method = SMEAR_RECONSTRUCT }), SMEAR_OK);
        CHECK_EQ(smear_actor_submit(actor, ctx), SMEAR_OK);
        CHECK_EQ(smear_render(ctx), SMEAR_OK);
        smear_get_stats(ctx, &stats);
        CHECK_EQ(stats.triangles_in, ARM_TRIANGLES);
        CHECK(stats.triangles_drawn > 10);
        CHECK_EQ(stats.tiles_uniform + stats.tiles_complex > 0, i > 0);     /* the first frame has no motion */
    }
    CHECK_EQ(bytes, 2 * 48 * 32);
}

static bool is_little_endian(void)
{
    const uint16_t one = 1;
    return *(const uint8_t *)&one == 1;
}

static void test_a_blob_is_played_where_it_lies(void)
{
    static uint64_t tables[96];
    smear_model model;
    smear_actor *actor, *from_header;
    if (!is_little_endian()) {
        CHECK_EQ(smear_mesh_check(arm_blob, sizeof arm_blob), SMEAR_MODEL_ERR_ENDIAN);
        CHECK_EQ(smear_model_open(&model, arm_blob, sizeof arm_blob, tables, sizeof tables), SMEAR_MODEL_ERR_ENDIAN);
        CHECK(smear_mesh_reason(SMEAR_MODEL_ERR_ENDIAN)[0] != '\0');
        return;
    }
    CHECK_EQ(smear_mesh_check(arm_blob, sizeof arm_blob), SMEAR_OK);
    size_t bytes = smear_model_memory(arm_blob, sizeof arm_blob);
    CHECK(bytes > 0 && bytes <= sizeof tables);
    CHECK_EQ(smear_model_open(&model, arm_blob, sizeof arm_blob, tables, bytes - 8), SMEAR_ERR_MEMORY);
    CHECK_EQ(smear_model_open(&model, arm_blob, sizeof arm_blob, (char *)tables + 4, bytes), SMEAR_ERR_MEMORY);
    REQUIRE_EQ(smear_model_open(&model, arm_blob, sizeof arm_blob, tables, bytes), SMEAR_OK);
    CHECK((const uint8_t *)model.node > (const uint8_t *)arm_blob
          && (const uint8_t *)model.node < (const uint8_t *)arm_blob + sizeof arm_blob);
    CHECK_EQ(smear_actor_init(&actor, &model, 2, other_memory, sizeof other_memory), SMEAR_OK);
    from_header = make(&arm_model, 2);
    for (int i = 0; i < 4; i++) {
        const smear_play play = { .clip = (uint16_t)(i % 2), .time = 17000 * i };
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        CHECK_EQ(smear_actor_advance(from_header, &play), SMEAR_OK);
        CHECK_EQ(crc_of(actor, &model), crc_of(from_header, &arm_model));
    }
}

#include "build/suites/anim.h"
