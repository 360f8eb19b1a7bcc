/* SPDX-License-Identifier: MIT */
/* play.h - recorded calls of the library, and the player that makes them again.
 *
 * A tape holds some frames of a scene as the integers that go into smear_init, smear_begin and
 * smear_submit. tape.c (host) writes tapes as C source, so targets without floating point or files
 * draw exactly what the host drew. Needs nothing but the library. */
#ifndef SMEAR_PLATFORM_PLAY_H
#define SMEAR_PLATFORM_PLAY_H

#include <smear.h>
#include <stddef.h>
#include <stdint.h>

struct tape_frame {
    const smear_frame *frame;
    const smear_draw *draw;
    int draw_count;
};

struct tape {
    const char *name;
    const smear_desc *desc;         /* without callbacks */
    const struct tape_frame *frame;
    int frame_count;
    const uint32_t *crc;            /* what stats.crc32 must be in each frame; null: not known */
};

/* What a tape file defines. */
extern const struct tape *const tape_list[];
extern const int tape_count;

struct player {
    const struct tape *tape;
    smear_context *ctx;
    uint32_t bytes_seen;            /* handed to flush in the last frame */
};

/* Bytes of memory the tape needs; 0 when the library does not accept its desc. */
size_t play_memory(const struct tape *tape);

/* Starts the library in `memory`. `clock` may be null. The library holds the player's address.
 * Returns a smear_result. */
int play_start(struct player *player, const struct tape *tape, void *memory, size_t bytes,
               uint32_t (*clock)(void *user));

/* Draws frame `index`; frames that rely on kept poses must be played in order. Returns a
 * smear_result, SMEAR_ERR_ARG also when the bands did not hold as many bytes as the format needs.
 *  */
int play_frame(struct player *player, int index, smear_stats *stats);

/* Bytes of a whole picture in the tape's format. */
uint32_t play_picture_bytes(const smear_desc *desc);

#endif
