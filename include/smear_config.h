/* SPDX-License-Identifier: MIT */
/* smear_config.h - what is decided when the library is compiled. Each choice can be given with -D, or a
 * whole set with -DSMEAR_CONFIG_FILE='"my_config.h"'. No choice changes a pixel: it only leaves code out. */
#ifndef SMEAR_CONFIG_H
#define SMEAR_CONFIG_H

#ifdef SMEAR_CONFIG_FILE
#include SMEAR_CONFIG_FILE
#endif

/* 1: every fixed-point operation that must not overflow is checked, and a broken promise stops the
 * program (SMEAR_ASSERT). 0: no checks, no cost. `make CHECK=1` sets it. */
#ifndef SMEAR_CHECK
#define SMEAR_CHECK 0
#endif

/* 1 when the core multiplies 32 x 32 to 64 bits in an instruction. 0 builds high products from 16-bit
 * halves instead of calling the compiler's 64-bit multiply; the bits are the same. */
#ifndef SMEAR_HAS_MUL64
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__) || (defined(__thumb__) && !defined(__thumb2__))
#define SMEAR_HAS_MUL64 0
#else
#define SMEAR_HAS_MUL64 1
#endif
#endif

/* 1 when the core counts leading zeros in an instruction. */
#ifndef SMEAR_HAS_CLZ
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__) || defined(__ARM_ARCH_4T__)
#define SMEAR_HAS_CLZ 0
#else
#define SMEAR_HAS_CLZ 1
#endif
#endif

#endif
