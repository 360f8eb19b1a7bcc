/* SPDX-License-Identifier: MIT */
/* stage.h - the library's SMEAR_CONFIG_FILE on a Game Boy Advance: what is hot and large is made small, and the functions of
 * the stage that comes next are copied into fast memory; what is read and written most lies in video memory. */
#ifndef SMEAR_GBA_STAGE_H
#define SMEAR_GBA_STAGE_H

#include <stdint.h>

/* Copies the functions of hot_assemble.ld or hot_draw.ld. */
void gba_enter_stage(int stage);

#define SMEAR_ENTER_STAGE(stage) gba_enter_stage(stage)

/* Where a part of a context's memory lies: of frames of 120x80 some lie in video memory that the screen does not show (display.c).
 * There is one such context at a time. */
void *gba_place(int is_half, int part, void *address, uint32_t bytes);

#define SMEAR_PLACE(desc, part, address, bytes) \
    gba_place((desc)->width == 120 && (desc)->height == 80 && (desc)->format == SMEAR_RGB555, part, address, (uint32_t)(bytes))

#endif
