# SPDX-License-Identifier: MIT
# start.S - from reset to xtensa_main on one lx106.
    .section .vectors, "ax"
    .macro fault at                 # ends the program with status 99
    .org    \at
    movi    a2, 1
    movi    a3, 99
    simcall
    .endm
    fault   0x10                    # debug
    fault   0x20                    # not maskable
    fault   0x30                    # kernel
    fault   0x50                    # user
    fault   0x70                    # double

    .section .reset, "ax"
    .global _start
_start:
    j       start

    .section .init, "ax"
    .align  4
start:
    movi    a1, link_stack_top
    movi    a2, link_bss_start
    movi    a3, link_bss_end
    movi    a4, 0
    call0   fill
    movi    a2, link_stack_limit
    mov     a3, a1
    movi    a4, 0x5ac35ac3          # STACK_PAINT of stack.h
    call0   fill
    call0   xtensa_main
1:  j       1b

    .align  4
fill:
    bgeu    a2, a3, 2f
    s32i    a4, a2, 0
    addi    a2, a2, 4
    j       fill
2:  ret
