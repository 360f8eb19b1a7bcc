/* SPDX-License-Identifier: MIT */
/* startup.c - from reset to main on any Cortex-M, without a C library. */
#include "platform/common/arguments.h"
#include "platform/common/semihost.h"
#include "platform/common/stack.h"
#include "platform/cortexm/interrupt.h"

#include <stdint.h>

/* From sections.ld. */
extern uint32_t link_data_load[], link_data_start[], link_data_end[];
extern uint32_t link_bss_start[], link_bss_end[];

enum { FAULT_STATUS = 99 };

int main(int argc, char **argv);

void reset_handler(void);
void fault_handler(void);

/* All of it that is not in use here. */
static void paint_stack(void)
{
    uint32_t *pointer;
    __asm volatile("mov %0, sp" : "=r"(pointer));
    for (uint32_t *to = link_stack_limit; to < pointer; to++)
        *to = STACK_PAINT;
}

void reset_handler(void)
{
    static char line[COMMAND_LINE_BYTES];
    static char *argument[MAX_ARGUMENTS + 1];
    const uint32_t *from = link_data_load;
    for (uint32_t *to = link_data_start; to < link_data_end; to++)
        *to = *from++;
    for (uint32_t *to = link_bss_start; to < link_bss_end; to++)
        *to = 0;
    paint_stack();
    int count = semihost_command_line(line, sizeof line) ? arguments_split(line, argument) : 0;
    semihost_exit(main(count, argument));
}

void fault_handler(void)
{
    semihost_print("fault\n");
    semihost_exit(FAULT_STATUS);
}

union vector {
    uint32_t *stack;
    void (*handler)(void);
};

/* An interrupt without a handler is a fault. */
#define WEAK_FAULT __attribute__((weak, alias("fault_handler")))
WEAK_FAULT void interrupt_0(void);
WEAK_FAULT void interrupt_1(void);
WEAK_FAULT void interrupt_2(void);
WEAK_FAULT void interrupt_3(void);
WEAK_FAULT void interrupt_4(void);
WEAK_FAULT void interrupt_5(void);
WEAK_FAULT void interrupt_6(void);
WEAK_FAULT void interrupt_7(void);

/* The first sixteen are the architecture's. */
__attribute__((section(".vectors"), used))
static const union vector vectors[16 + INTERRUPTS] = {
    { .stack = link_stack_top },
    { .handler = reset_handler },
    { .handler = fault_handler },       /* NMI */
    { .handler = fault_handler },       /* HardFault */
    { .handler = fault_handler },       /* MemManage */
    { .handler = fault_handler },       /* BusFault */
    { .handler = fault_handler },       /* UsageFault */
    { 0 }, { 0 }, { 0 }, { 0 },
    { .handler = fault_handler },       /* SVCall */
    { 0 }, { 0 },
    { .handler = fault_handler },       /* PendSV */
    { .handler = fault_handler },       /* SysTick */
    { .handler = interrupt_0 }, { .handler = interrupt_1 }, { .handler = interrupt_2 },
    { .handler = interrupt_3 }, { .handler = interrupt_4 }, { .handler = interrupt_5 },
    { .handler = interrupt_6 }, { .handler = interrupt_7 }
};
