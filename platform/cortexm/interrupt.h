/* SPDX-License-Identifier: MIT */
/* interrupt.h - interrupts of devices on M-profile cores. A function called interrupt_N is the
 * handler of interrupt N; startup.c has room for the first INTERRUPTS. */
#ifndef SMEAR_CORTEXM_INTERRUPT_H
#define SMEAR_CORTEXM_INTERRUPT_H

#include <stdint.h>

enum { INTERRUPTS = 8 };

void interrupt_0(void);
void interrupt_1(void);
void interrupt_2(void);
void interrupt_3(void);
void interrupt_4(void);
void interrupt_5(void);
void interrupt_6(void);
void interrupt_7(void);

static inline void interrupt_enable(uint32_t number)
{
    *(volatile uint32_t *)0xe000e100u = 1u << number;
}

/* Holds all of them back; returns what interrupts_restore wants. */
static inline uint32_t interrupts_off(void)
{
    uint32_t state;
    __asm volatile("mrs %0, primask\n\tcpsid i" : "=r"(state) : : "memory");
    return state;
}

static inline void interrupts_restore(uint32_t state)
{
    __asm volatile("msr primask, %0" : : "r"(state) : "memory");
}

#endif
