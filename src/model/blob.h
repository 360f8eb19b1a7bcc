/* SPDX-License-Identifier: MIT */
/* blob.h - how a .smr file is laid out, which tools/convert writes and model.c reads in place.
 *
 *     head, tables, data         little-endian; every table and array on a multiple of 4;
 *                                no padding is left undefined
 *
 * Tables of smear_model.h lie in it as they are. Meshes, textures and materials of smear.h hold pointers, so
 * they have records of their own here. Offsets are bytes from the start of the blob; 0: there is none. */
#ifndef SMEAR_BLOB_H
#define SMEAR_BLOB_H

#include "smear_model.h"

#include "base/base.h"

#define SMEAR_BLOB_MAGIC 0x31524d53u        /* "SMR1" */
#define SMEAR_BLOB_CRC_FROM 16u             /* the CRC is over everything from this byte on */

enum {
    BLOB_TEXTURE, BLOB_MATERIAL, BLOB_MESH, BLOB_DRAW, BLOB_NODE, BLOB_JOINT, BLOB_SKIN, BLOB_INFLUENCE,
    BLOB_TARGET, BLOB_DELTA, BLOB_DELTA_NORMAL, BLOB_WEIGHT, BLOB_CLIP, BLOB_CHANNEL, BLOB_KEY_TIME,
    BLOB_KEY_VALUE, BLOB_TEXT, BLOB_TABLES
};

struct smear_blob_table {
    uint32_t at, count;         /* elements; bytes for text and normals */
};

struct smear_blob_head {
    uint32_t magic;
    uint32_t format;            /* SMEAR_MODEL_FORMAT */
    uint32_t size;              /* bytes in all, a multiple of 4 */
    uint32_t crc32;
    uint16_t transform_count, deformed_count, joint_count, normals;
    uint32_t deformed_vertices;
    int32_t unit_shift;
    int32_t center[3], radius;
    struct smear_blob_table table[BLOB_TABLES];
};

struct smear_blob_mesh {
    uint32_t position, normal, uv, color, face_color, index;
    uint32_t triangle_count;
    uint16_t vertex_count;
    int8_t shift;
    uint8_t uv_shift;
    int32_t scale;
    int32_t offset[3];
};

struct smear_blob_texture {
    uint32_t texels, palette;
    uint16_t palette_count;     /* texels are below it */
    uint16_t width, height;
    uint8_t format, wrap_u, wrap_v, levels, zero[2];
};

struct smear_blob_material {
    uint16_t texture;           /* or SMEAR_MODEL_NONE */
    uint8_t color[4];
    uint8_t alpha, cutoff, unlit, double_sided;
    uint8_t bilinear;           /* and 16 x shine */
    uint8_t gloss;
};

SMEAR_STATIC_ASSERT(sizeof(struct smear_blob_head) == 48 + 8 * BLOB_TABLES, "no padding");
SMEAR_STATIC_ASSERT(sizeof(struct smear_blob_mesh) == 48, "no padding");
SMEAR_STATIC_ASSERT(sizeof(struct smear_blob_texture) == 20, "no padding");
SMEAR_STATIC_ASSERT(sizeof(struct smear_blob_material) == 12, "no padding");
SMEAR_STATIC_ASSERT(sizeof(smear_model_draw) == 28 && sizeof(smear_model_node) == 52
                        && sizeof(smear_model_joint) == 52 && sizeof(smear_model_skin) == 24
                        && sizeof(smear_model_target) == 16 && sizeof(smear_model_delta) == 8
               && sizeof(smear_model_clip) == 16 && sizeof(smear_model_channel) == 36, "no padding");

#if SMEAR_WITH_MODEL
/* How many bytes an element of each table has. */
static const uint8_t smear_blob_element[BLOB_TABLES] = {
    sizeof(struct smear_blob_texture), sizeof(struct smear_blob_material), sizeof(struct smear_blob_mesh),
    sizeof(smear_model_draw), sizeof(smear_model_node), sizeof(smear_model_joint), sizeof(smear_model_skin),
    1, sizeof(smear_model_target), sizeof(smear_model_delta), 1, 2, sizeof(smear_model_clip),
    sizeof(smear_model_channel), 2, 2, 1
};
#endif

#endif
