/* SPDX-License-Identifier: MIT */
/* smear_model.h - models made by `smear convert`, and their animation on the device.
 * Optional: what a firmware does not call is not linked.
 *
 * What it does. It plays the clips of a model (moving nodes, skins, morph targets) in integers, and hands
 * smear_submit the meshes with the transforms and positions of this frame and of the one before. What it does
 * not: no malloc, no floating point, no 64-bit division, no blending of clips.
 *
 *     smear convert Fox.glb --clip Run -o fox.h          typed arrays, for any machine
 *
 *     #include "fox.h"
 *     static uint64_t fox_memory[FOX_ACTOR_BYTES(2) / 8];
 *
 *     smear_actor *fox;
 *     smear_actor_init(&fox, &fox_model, 2, fox_memory, sizeof fox_memory);
 *     for (uint32_t time = 0;; time += 65536 / 30) {
 *         smear_play play = { .clip = FOX_CLIP_RUN, .loop = 1, .time = (int32_t)(time & INT32_MAX),
 *                             .place = &place };
 *         smear_actor_advance(fox, &play);
 *         smear_begin(ctx, &frame);
 *         smear_actor_submit(fox, ctx);
 *         smear_render(ctx);
 *     }
 *
 * A model that does not move needs none of this: its meshes may be
 * submitted as they are (fox_mesh, fox_material).
 *
 *     smear convert Fox.glb --clip Run -o fox.smr        one block of bytes, read where it lies
 *
 *     smear_model model;
 *     static uint64_t tables[FOX_TABLES / 8];             the size is printed by smear convert
 *     int error = smear_model_open(&model, flash, size, tables, sizeof tables);
 *     if (error != SMEAR_OK)
 *         log(smear_mesh_reason(error));
 *
 * A blob is little-endian and wants to lie on a multiple of 4. Cores with the other byte order refuse it:
 * they take the header, which is C and has no byte order. */
#ifndef SMEAR_MODEL_H
#define SMEAR_MODEL_H

#include "smear.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The version of the tables below and of blobs; a header made for another version does not compile. */
#define SMEAR_MODEL_FORMAT 1

/* ------------------------------------------------------------------ tables */

/* Written by `smear convert`; all constant, all may stay in flash. Places are in model units: 2^unit_shift
 * world units each, chosen so that the whole model lies within +-2047 of them.
 *
 * The structs have no padding and the same layout on every machine. */
#define SMEAR_MODEL_NONE 0xffffu
#define SMEAR_MODEL_NO_NORMALS 0xffffffffu

typedef struct smear_model_draw {
    uint16_t mesh, material;    /* material may be SMEAR_MODEL_NONE */
    uint16_t node;              /* that carries it; SMEAR_MODEL_NONE: it stands where the model is placed */
    uint16_t skin;              /* SMEAR_MODEL_NONE: rigid or morphed only */
    uint16_t target_first, target_count;        /* morph targets */
    uint16_t weight_first;      /* of the targets' weights */
    uint16_t transform;         /* of an actor's transforms; 0 is the place of the model */
    uint16_t deformed;          /* skinned or morphed: index of the actor's mesh, else SMEAR_MODEL_NONE */
    uint16_t influences;        /* joints per vertex, 1..4; 0: no skin */
    uint32_t influence_first;   /* byte: per vertex `influences` joints of the skin, heaviest first, then all
                                 * weights but the first, which is what they lack to 256 */
    uint32_t vertex_first;      /* of the actor's positions */
} smear_model_draw;

/* A node comes after its parent. */
typedef struct smear_model_node {
    uint16_t parent;            /* SMEAR_MODEL_NONE: the model itself */
    uint16_t moves;             /* 0: rest is a basis Q8.24, row by row, and an origin Q16.16;
                                 * 1: translation Q16.16, scale Q8.24, rotation x y z w Q2.30, 0, 0 */
    int32_t rest[12];
} smear_model_node;

/* From the steps of the mesh at rest to the joint, in steps of the posed mesh. */
typedef struct smear_model_joint {
    uint16_t node, zero;
    int32_t basis[9];           /* Q8.24 */
    int32_t origin[3];          /* Q16.16 model units */
} smear_model_joint;

/* Steps of a skin's posed meshes: q4 = origin x steps / 2^32 x 2^shift - offset. */
typedef struct smear_model_skin {
    uint16_t joint_first, joint_count;          /* at most 256 */
    int32_t steps;
    int32_t offset[3];          /* in 1/16 step */
    int32_t shift;
} smear_model_skin;

typedef struct smear_model_target {
    uint32_t delta_first, delta_count;
    uint32_t normal_first;      /* of delta_normal; SMEAR_MODEL_NO_NORMALS */
    uint32_t shift;             /* deltas are in 2^shift steps of the mesh; 0..2 */
} smear_model_target;

typedef struct smear_model_delta {
    uint16_t vertex;
    int16_t step[3];
} smear_model_delta;

/* Channels are sorted by node; those of weights come last. */
typedef struct smear_model_clip {
    uint32_t name;              /* of text, ends with 0 */
    uint32_t duration;          /* Q16.16 seconds: the last key of the longest channel */
    uint16_t channel_first, channel_count;
    uint32_t tick_shift;        /* a tick is 2^tick_shift / 65536 s */
} smear_model_clip;

enum { SMEAR_PATH_TRANSLATION, SMEAR_PATH_ROTATION, SMEAR_PATH_SCALE, SMEAR_PATH_WEIGHTS };

/* Key k is at key_time[time_first + k] ticks and has `width` values from key_value[value_first + k width] on. Held keys jump, and
 * so do two at the same time: no path leads from one to the other.
 * Rotations: x y z w in 1/32767, mixed and normalised. Else:
 * key x factor / 2^32 x 2^(shift + 14) + offset. */
typedef struct smear_model_channel {
    uint16_t target;            /* a node, or the first weight */
    uint8_t path, step;         /* step 1: keys are held; 0: mixed */
    uint16_t key_count, width;
    uint32_t time_first, value_first;
    int32_t offset[3];          /* weights: the first serves all */
    int32_t factor;
    int32_t shift;
} smear_model_channel;

typedef struct smear_model {
    const smear_mesh *mesh;
    const smear_material *material;
    const smear_model_draw *draw;
    const smear_model_node *node;
    const smear_model_joint *joint;
    const smear_model_skin *skin;
    const uint8_t *influence;
    const smear_model_target *target;
    const smear_model_delta *delta;
    const int8_t *delta_normal;         /* x y z of each delta of a target that has them, in 2/127 */
    const int16_t *weight;              /* at rest, Q2.14 */
    const smear_model_clip *clip;
    const smear_model_channel *channel;
    const uint16_t *key_time;
    const int16_t *key_value;
    const char *text;                   /* names */
    uint16_t mesh_count, material_count, draw_count, node_count, clip_count, weight_count;
    uint16_t transform_count, deformed_count;   /* what an actor needs: see SMEAR_ACTOR_MEMORY */
    uint16_t joint_count;                       /* of the largest skin */
    uint16_t normals;                           /* 1: some deformed mesh has normals */
    uint32_t deformed_vertices;
    int32_t unit_shift;
    int32_t center[3], radius;                  /* Q16.16 world units: a ball around all poses of all clips */
} smear_model;

/* ------------------------------------------------------------------ blobs */

/* Why a blob is refused. */
enum {
    SMEAR_MODEL_ERR_ENDIAN   = -16,     /* this core reads the high byte first */
    SMEAR_MODEL_ERR_ALIGN    = -17,     /* it does not lie on a multiple of 4 */
    SMEAR_MODEL_ERR_MAGIC    = -18,     /* it is something else */
    SMEAR_MODEL_ERR_FORMAT   = -19,     /* made for another version */
    SMEAR_MODEL_ERR_SIZE     = -20,     /* cut short */
    SMEAR_MODEL_ERR_CRC      = -21,     /* changed on the way */
    SMEAR_MODEL_ERR_TABLE    = -22,     /* a table does not lie within it */
    SMEAR_MODEL_ERR_MESH     = -23,     /* and so on: a record points or counts outside of what there is */
    SMEAR_MODEL_ERR_TEXTURE  = -24,
    SMEAR_MODEL_ERR_MATERIAL = -25,
    SMEAR_MODEL_ERR_DRAW     = -26,
    SMEAR_MODEL_ERR_NODE     = -27,
    SMEAR_MODEL_ERR_SKIN     = -28,
    SMEAR_MODEL_ERR_MORPH    = -29,
    SMEAR_MODEL_ERR_CLIP     = -30,
    SMEAR_MODEL_ERR_SHARED   = -31      /* records share arrays so often that to check them takes more than 8 looks at
                                         * each byte */
};

/* Looks at every byte of a blob once, at every index, texel and record: what passes can be drawn and played
 * without reading or writing outside of it. SMEAR_OK or why not. */
int smear_mesh_check(const void *blob, size_t bytes);

/* Returns the result in words, in English; "" for SMEAR_OK. */
const char *smear_mesh_reason(int error);

/* Bytes of the tables with pointers that smear_model_open builds; 0 for what smear_mesh_check refuses. */
size_t smear_model_memory(const void *blob, size_t bytes);

/* Checks the blob and fills `model`, which points into it and into `memory` (8-byte aligned). All three must
 * stay. SMEAR_OK, a reason, SMEAR_ERR_MEMORY, or SMEAR_ERR_ARG (no `model`). */
int smear_model_open(smear_model *model, const void *blob, size_t bytes, void *memory, size_t memory_bytes);

/* Index of a clip by its name, or -1. */
int smear_model_find_clip(const smear_model *model, const char *name);

/* ------------------------------------------------------------------ actors */

/* One model in one place, in `poses` poses: 1 for sharp frames; 2 keep the frame before; 3 that before it, too, which
 * tells along which curves things move, or are for smear_frame.shutter.poses. Several actors may share a model. */
typedef struct smear_actor smear_actor;

typedef enum smear_pose { SMEAR_POSE_NOW, SMEAR_POSE_OPEN, SMEAR_POSE_CLOSE } smear_pose;

/* Moves a node by program: world = what the clip says x local. */
typedef struct smear_node_move {
    uint16_t node;
    smear_transform local;      /* its basis within +-7, its origin in model units */
} smear_node_move;

typedef struct smear_play {
    uint16_t clip;
    uint8_t rest;               /* 1: no clip, the pose at rest */
    uint8_t loop;               /* 1: starts again at the end of its longest channel; 0: stops */
    int32_t time;               /* Q16.16 seconds, nine hours at most; before 0 it is the start or, looped, the end */
    const smear_transform *place;       /* null: identity; its basis within +-7 */
    const smear_node_move *move;        /* null: none; read during the call only */
    uint16_t move_count;
} smear_play;

/* Bytes smear_actor_init needs; 0 where `poses` is not 1 to 3. */
size_t smear_actor_memory(const smear_model *model, int poses);

/* Cuts `memory` (8-byte aligned, at least smear_actor_memory() bytes) into what the actor needs. The model is
 * trusted: it comes from a header or from smear_model_open. SMEAR_OK, SMEAR_ERR_ARG or SMEAR_ERR_MEMORY. */
int smear_actor_init(smear_actor **actor, const smear_model *model, int poses, void *memory, size_t bytes);

/* Now becomes a frame ago (with 2 poses or more), what was a frame ago (SMEAR_POSE_OPEN) two frames ago (with 3:
 * SMEAR_POSE_CLOSE), and `play` is now. SMEAR_ERR_ARG, and nothing has changed,
 * when the model has clips, but not this one. Not between smear_actor_submit and smear_render.
 *
 * No blur joins what has jumped since: held keys, two keys at one time, the end of a clip that starts again and does not meet its
 * start, another clip. Then the other poses are made anew, as if it had not jumped: what is held is as it is now, other channels
 * go on before the jump as they do behind it, another clip has not moved yet. The place is what it was; nodes that the program
 * moves are in all of them where `play` has them. A clip starts again by `loop`, or when time goes back by more than half of it. */
int smear_actor_advance(smear_actor *actor, const smear_play *play);

/* Sets one pose alone; what jumps between it and now is seen to as above. SMEAR_ERR_ARG also when the actor has no room for
 * that pose. */
int smear_actor_set(smear_actor *actor, smear_pose pose, const smear_play *play);

/* All poses but the one now are forgotten: in this frame the actor has no motion of its own. */
void smear_actor_cut(smear_actor *actor);

/* Draw `index` of the model in the actor's poses, 0 .. model->draw_count - 1; for a motion mode or a
 * material of yours. It points into the actor. SMEAR_ERR_ARG when there is no such draw, or no pose yet. */
int smear_actor_draw(smear_actor *actor, int index, smear_draw *draw);

/* Submits every draw. SMEAR_OK, or the first error of smear_actor_draw or smear_submit. */
int smear_actor_submit(smear_actor *actor, smear_context *ctx);

/* smear_actor_memory() as a constant. Headers define NAME_ACTOR_BYTES(poses) by it. */
#define SMEAR_ACTOR_HEAD_BYTES 128u
#define SMEAR_ACTOR_ALIGN8(bytes) (((size_t)(bytes) + 7u) & ~(size_t)7u)
#define SMEAR_ACTOR_MEMORY(nodes, joints, weights, transforms, deformed, vertices, normals, poses) \
    (SMEAR_ACTOR_HEAD_BYTES \
     + SMEAR_ACTOR_ALIGN8((size_t)(nodes) * sizeof(smear_transform)) \
     + SMEAR_ACTOR_ALIGN8((size_t)(joints) * 48u) \
     + SMEAR_ACTOR_ALIGN8((size_t)(weights) * 2u) \
     + SMEAR_ACTOR_ALIGN8((size_t)(deformed) * sizeof(smear_mesh)) \
     + SMEAR_ACTOR_ALIGN8((normals) ? (size_t)(vertices) * 3u : 0u) \
     + (size_t)(poses) * (SMEAR_ACTOR_ALIGN8((size_t)(transforms) * sizeof(smear_transform)) \
                          + SMEAR_ACTOR_ALIGN8((size_t)(vertices) * 6u)))

#ifdef __cplusplus
}
#endif

#endif
