/* SPDX-License-Identifier: MIT */
/* gba.h - the registers of a Game Boy Advance that we use. Reference: GBATEK, Martin Korth. */
#ifndef SMEAR_GBA_H
#define SMEAR_GBA_H

#include <stdint.h>

#define GBA_REG16(address) (*(volatile uint16_t *)(address))
#define GBA_REG32(address) (*(volatile uint32_t *)(address))

#define GBA_DISPLAY_CONTROL GBA_REG16(0x04000000u)
#define GBA_DISPLAY_STATUS GBA_REG16(0x04000004u)
#define GBA_LINE GBA_REG16(0x04000006u)
#define GBA_BG2_XX GBA_REG16(0x04000020u)       /* 1/256: steps through the picture per pixel */
#define GBA_BG2_YY GBA_REG16(0x04000026u)
#define GBA_BG2_X GBA_REG32(0x04000028u)        /* 1/256: the picture's column that the screen's first one shows */
#define GBA_DMA3_FROM GBA_REG32(0x040000d4u)
#define GBA_DMA3_TO GBA_REG32(0x040000d8u)
#define GBA_DMA3_CONTROL GBA_REG32(0x040000dcu) /* count below, flags above */
#define GBA_TIMER0 GBA_REG16(0x04000100u)
#define GBA_TIMER0_CONTROL GBA_REG16(0x04000102u)
#define GBA_TIMER1 GBA_REG16(0x04000104u)
#define GBA_TIMER1_CONTROL GBA_REG16(0x04000106u)
#define GBA_KEYS GBA_REG16(0x04000130u)         /* 0 is held */
#define GBA_INTERRUPT_ENABLE GBA_REG16(0x04000200u)
#define GBA_INTERRUPT_FLAGS GBA_REG16(0x04000202u)
#define GBA_INTERRUPT_MASTER GBA_REG16(0x04000208u)
#define GBA_BIOS_FLAGS GBA_REG16(0x03007ff8u)
#define GBA_HANDLER (*(void (*volatile *)(void))0x03007ffcu)

#define GBA_VIDEO_MEMORY 0x06000000u

/* In 32 kB of fast memory, as ARM code. */
#define GBA_FAST __attribute__((section(".fast"), target("arm"), noinline, long_call))

#endif
