@ SPDX-License-Identifier: MIT
@ arithmetic.S - products and quotients that compilers call, as ARM code in fast memory: Thumb code
@ has no product of 64 bits, and no code has a division. Names: run-time ABI for the Arm architecture.
    .section .fast.arithmetic, "ax"
    .arm
    .syntax unified

@ int64_t r1:r0 x r3:r2
    .global __aeabi_lmul
    .type   __aeabi_lmul, %function
__aeabi_lmul:
    mul     r3, r0, r3
    mla     r1, r2, r1, r3
    umull   r12, r3, r0, r2
    add     r1, r1, r3
    mov     r0, r12
    bx      lr

@ uint32_t r0 / r1: quotient in r0, remainder in r1; of zero, 0 and r0
    .global __aeabi_uidiv
    .type   __aeabi_uidiv, %function
    .global __aeabi_uidivmod
    .type   __aeabi_uidivmod, %function
__aeabi_uidiv:
__aeabi_uidivmod:
    mov     r2, #0
    cmp     r1, #0
    beq     9f
    cmp     r1, r0, lsr #8          @ as many steps as the quotient can have bits
    bhi     8f
    cmp     r1, r0, lsr #16
    bhi     16f
    cmp     r1, r0, lsr #24
    bhi     24f
    .macro  step n
    rsbs    r3, r1, r0, lsr #\n     @ carry: r1 << n fits into what is left
    subcs   r0, r0, r1, lsl #\n
    adc     r2, r2, r2
    .endm
    .irp    n, 31, 30, 29, 28, 27, 26, 25, 24
    step    \n
    .endr
24: .irp    n, 23, 22, 21, 20, 19, 18, 17, 16
    step    \n
    .endr
16: .irp    n, 15, 14, 13, 12, 11, 10, 9, 8
    step    \n
    .endr
8:  .irp    n, 7, 6, 5, 4, 3, 2, 1
    step    \n
    .endr
    subs    r3, r0, r1
    movcs   r0, r3
    adc     r2, r2, r2
9:  mov     r1, r0
    mov     r0, r2
    bx      lr

@ int32_t r0 / r1, towards zero: quotient in r0, remainder in r1
    .global __aeabi_idiv
    .type   __aeabi_idiv, %function
    .global __aeabi_idivmod
    .type   __aeabi_idivmod, %function
__aeabi_idiv:
__aeabi_idivmod:
    eor     r12, r0, r1
    stmfd   sp!, {r0, r12, lr}
    cmp     r0, #0
    rsblt   r0, r0, #0
    cmp     r1, #0
    rsblt   r1, r1, #0
    bl      __aeabi_uidiv
    ldmfd   sp!, {r2, r12, lr}
    cmp     r12, #0
    rsblt   r0, r0, #0
    cmp     r2, #0
    rsblt   r1, r1, #0
    bx      lr
