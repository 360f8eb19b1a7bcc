# SPDX-License-Identifier: MIT
# start.S - from reset to riscv_main on one RISC-V core.
    .section .init, "ax"
    .global _start
_start:
    .option push
    .option norelax
    la      gp, link_global_pointer
    .option pop
    la      sp, link_stack_top
    la      t0, trap
    .option push
    .option arch, +zicsr            # gcc 12 wants it named
    csrw    mtvec, t0
    .option pop
    la      t0, link_bss_start
    la      t1, link_bss_end
    li      t2, 0
    call    fill
    la      t0, link_stack_limit
    mv      t1, sp
    li      t2, 0x5ac35ac3          # STACK_PAINT of stack.h
    call    fill
    call    riscv_main
1:  j       1b

fill:
    bgeu    t0, t1, 2f
    sw      t2, 0(t0)
    addi    t0, t0, 4
    j       fill
2:  ret

    .balign 4
trap:
    li      a0, 99
    call    semihost_exit
3:  j       3b
