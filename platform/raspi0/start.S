/* SPDX-License-Identifier: MIT */
/* start.S - from the firmware's jump to board_main. */
    .section .init, "ax"
    .arm
    .global _start
_start:
    cpsid   aif, #0x13              /* supervisor mode, no interrupts */
    ldr     sp, =link_stack_top
    ldr     r0, =link_bss_start
    ldr     r1, =link_bss_end
    mov     r2, #0
    bl      fill
    ldr     r0, =link_stack_limit
    mov     r1, sp
    ldr     r2, =0x5ac35ac3         /* STACK_PAINT of stack.h */
    bl      fill
    mov     r0, #0
    ldr     r1, =vectors
    ldm     r1!, {r2 - r9}
    stm     r0!, {r2 - r9}
    ldm     r1, {r2 - r9}
    stm     r0, {r2 - r9}
    bl      board_main
1:  mcr     p15, 0, r0, c7, c0, 4   /* waits for an interrupt, and there are none */
    b       1b

fill:
    cmp     r0, r1
    strlo   r2, [r0], #4
    blo     fill
    bx      lr

/* Copied to address 0. */
vectors:
    ldr     pc, at_reset
    ldr     pc, at_undefined
    ldr     pc, at_call
    ldr     pc, at_prefetch
    ldr     pc, at_data
    ldr     pc, at_data
    ldr     pc, at_interrupt
    ldr     pc, at_interrupt
at_reset:       .word fault
at_undefined:   .word fault
at_call:        .word no_host
at_prefetch:    .word fault
at_data:        .word fault
                .word fault
at_interrupt:   .word fault
                .word fault

/* Nobody answers semihosting on a board: all calls fail. */
no_host:
    mvn     r0, #0
    movs    pc, lr

fault:
    ldr     sp, =link_stack_top
    sub     r0, lr, #8
    b       board_fault
