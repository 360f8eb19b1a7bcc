/* SPDX-License-Identifier: MIT */
/* play.c - plays tapes; see play.h. */
#include "platform/play.h"

static int take_band(void *user, const smear_band *band)
{
    struct player *player = user;
    player->bytes_seen += band->size;
    return 0;
}

static smear_desc full_desc(const struct tape *tape, struct player *player,
                            uint32_t (*clock)(void *user))
{
    smear_desc desc = *tape->desc;
    desc.flush = take_band;
    desc.user = player;
    desc.debug.clock = clock;
    return desc;
}

size_t play_memory(const struct tape *tape)
{
    smear_desc desc = full_desc(tape, NULL, NULL);
    return smear_memory_size(&desc);
}

int play_start(struct player *player, const struct tape *tape, void *memory, size_t bytes,
               uint32_t (*clock)(void *user))
{
    smear_desc desc = full_desc(tape, player, clock);
    player->tape = tape;
    return smear_init(&player->ctx, &desc, memory, bytes);
}

uint32_t play_picture_bytes(const smear_desc *desc)
{
    uint32_t width = (uint32_t)desc->width, height = (uint32_t)desc->height;
    switch (desc->format) {
    case SMEAR_XRGB8888:
        return width * height * 4;
    case SMEAR_RGB565:
    case SMEAR_RGB565_SWAPPED:
    case SMEAR_RGB555:
        return width * height * 2;
    case SMEAR_L4:
        return (width + 1) / 2 * height;
    case SMEAR_L1:
        return (width + 7) / 8 * height;
    case SMEAR_L1_PAGES:
        return width * ((height + 7) / 8);
    default:
        return width * height;
    }
}

int play_frame(struct player *player, int index, smear_stats *stats)
{
    const struct tape_frame *frame = &player->tape->frame[index];
    player->bytes_seen = 0;
    int result = smear_begin(player->ctx, frame->frame);
    for (int i = 0; i < frame->draw_count && result == SMEAR_OK; i++)
        result = smear_submit(player->ctx, &frame->draw[i]);
    if (result == SMEAR_OK)
        result = smear_render(player->ctx);
    if (result != SMEAR_OK)
        return result;
    smear_get_stats(player->ctx, stats);
    return player->bytes_seen == play_picture_bytes(player->tape->desc) ? SMEAR_OK : SMEAR_ERR_ARG;
}
