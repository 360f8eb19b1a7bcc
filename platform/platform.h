/* SPDX-License-Identifier: MIT */
/* platform.h - what the programs for targets (tests/target) need of a machine. The library
 * needs nothing of it and never includes this file. main() is an ordinary main: arguments and
 * status work. */
#ifndef SMEAR_PLATFORM_H
#define SMEAR_PLATFORM_H

#include <stddef.h>
#include <stdint.h>

/* Writes text to standard output. */
void platform_print(const char *text);

/* A large block of memory that nothing else uses, 8-byte aligned, the same at every call; all there
 * is on a small machine. Null on a host without memory. */
void *platform_arena(size_t *bytes);

/* The most stack used so far, in bytes; 0 where it is not known, UINT32_MAX when it overflowed. */
uint32_t platform_stack_used(void);

/* A clock that runs from platform_clock_start on. Ticks wrap; a difference of two readings becomes
 * a number of platform_clock_unit: instructions where the emulator counts them, else microseconds.
 *  */
void platform_clock_start(void);
uint32_t platform_clock(void);
uint32_t platform_clock_count(uint32_t ticks);
extern const char platform_clock_unit[];

#endif
