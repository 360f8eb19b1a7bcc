/* SPDX-License-Identifier: MIT */
/* stage.h - the library's SMEAR_CONFIG_FILE on a Game Boy Advance: what is hot and large is made small, and the functions of
 * the stage that comes next are copied into fast memory. */
#ifndef SMEAR_GBA_STAGE_H
#define SMEAR_GBA_STAGE_H

enum { GBA_STAGE_ASSEMBLE = 0, GBA_STAGE_DRAW = 1 };

/* Copies the functions of hot_assemble.ld or hot_draw.ld. */
void gba_enter_stage(int stage);

#define SMEAR_ENTER_STAGE(stage) gba_enter_stage(stage)

#endif
