/* SPDX-License-Identifier: MIT */
/* fuzz_blob.c - libFuzzer target: any bytes are a model that can be played and drawn, or are refused with a reason.
 *
 * The head's magic, version, size and checksum are set right first, so that mutations reach the tables; input whose
 * first byte is odd is left as it is. Everything lies in blocks of exactly its size. Seeds are in tests/fuzz/corpus/blob. */
#include "tests/fuzz/require.h"
#include "model/blob.h"
#include "base/base.h"

#include <smear.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { WIDTH = 40, HEIGHT = 24, MAX_DRAWS = 24 };

static int swallow(void *user, const smear_band *band)
{
    volatile uint8_t *sum = user;
    for (uint32_t i = 0; i < band->size; i++)
        *sum = (uint8_t)(*sum + ((const uint8_t *)band->pixels)[i]);
    return 0;
}

static void draw(smear_actor *actor, uint8_t method)
{
    static uint64_t memory[1 << 16];
    uint8_t sum = 0;
    const smear_desc desc = { .width = WIDTH, .height = HEIGHT, .max_triangles = 300, .max_draws = MAX_DRAWS, .reach = 8,
                              .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .format = SMEAR_RGB565, .flush = swallow, .user = &sum };
    const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 2 << 16, .near_plane = 1 << 12 };
    smear_context *ctx;
    require(smear_init(&ctx, &desc, memory, sizeof memory) == SMEAR_OK);
    require(smear_begin(ctx, &(smear_frame){ .camera = &camera, .method = method }) == SMEAR_OK);
    require(smear_actor_submit(actor, ctx) == SMEAR_OK);
    require(smear_render(ctx) == SMEAR_OK);
}

static void play(const smear_model *model, const uint8_t *tail)
{
    int poses = 1 + tail[0] % 3;
    size_t bytes = smear_actor_memory(model, poses);
    smear_transform place = SMEAR_IDENTITY;
    smear_actor *actor;
    if (bytes > 1u << 22)
        return;
    uint64_t *memory = malloc(bytes);
    require(memory != NULL);
    require(smear_actor_init(&actor, model, poses, memory, bytes) == SMEAR_OK);
    place.origin[2] = -4 * 65536;
    place.basis[tail[1] % 9] = (int32_t)((uint32_t)tail[2] << 24);
    for (int i = 0; i < 4; i++) {
        const smear_node_move move = { .node = tail[3], .local = place };
        smear_play p = { .clip = (uint16_t)(model->clip_count > 0 ? i % model->clip_count : 0), .loop = i % 2 == 0,
                         .time = (int32_t)((uint32_t)tail[4] << (i * 7)), .place = &place, .move = &move,
                         .move_count = (uint16_t)(tail[5] % 2), .rest = i == 3 };
        require(smear_actor_advance(actor, &p) == SMEAR_OK);
        if (poses == 3)
            require(smear_actor_set(actor, SMEAR_POSE_CLOSE, &p) == SMEAR_OK);
        if (model->draw_count <= MAX_DRAWS)
            draw(actor, i % 2 == 0 ? SMEAR_RECONSTRUCT : SMEAR_NONE);
    }
    (void)smear_model_find_clip(model, "run");
    free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const size_t tail = 6;
    if (size < tail + 1)
        return 0;
    size_t length = (size - tail - 1) & ~(size_t)3;
    uint8_t *blob = malloc(length);
    require(blob != NULL || length == 0);
    if (length > 0)
        memcpy(blob, data + tail + 1, length);
    if (data[0] % 2 == 0 && length >= sizeof(struct smear_blob_head)) {
        struct smear_blob_head *head = (struct smear_blob_head *)(void *)blob;
        head->magic = SMEAR_BLOB_MAGIC;
        head->format = SMEAR_MODEL_FORMAT;
        head->size = (uint32_t)length;
        head->crc32 = smear_crc32(0, blob + SMEAR_BLOB_CRC_FROM, (uint32_t)length - SMEAR_BLOB_CRC_FROM);
    }
    int error = smear_mesh_check(blob, length);
    size_t bytes = smear_model_memory(blob, length);
    if (error == SMEAR_OK) {
        smear_model model;
        uint64_t *memory = malloc(bytes + 1);
        require(memory != NULL);
        require(bytes < 8 || smear_model_open(&model, blob, length, memory, bytes - 1) == SMEAR_ERR_MEMORY);
        require(smear_model_open(&model, blob, length, memory, bytes) == SMEAR_OK);
        play(&model, data + 1);
        free(memory);
    } else {
        require(error < 0 && smear_mesh_reason(error)[0] != '\0' && bytes == 0);
    }
    free(blob);
    return 0;
}
