@ SPDX-License-Identifier: MIT
@ start.S - cartridge header and the way to main on a Game Boy Advance.
@
@ The header's logo is left blank: emulators do not look at it, a console's BIOS does (cartridge.c puts it in). The command
@ line is zeros on a cartridge; gbarun.c writes one for tests.
    .section .header, "ax"
    .arm
    .global _start
_start:
    b       boot
    .fill   156, 1, 0               @ 0x04 logo
    .ascii  "SMEAR DEMO\0\0"        @ 0xa0 title
    .ascii  "SMRE"                  @ 0xac code
    .ascii  "00"                    @ 0xb0 maker
    .byte   0x96, 0, 0              @ 0xb2 fixed, unit, device
    .fill   7, 1, 0
    .byte   0                       @ 0xbc version
    .byte   HEADER_CHECKSUM         @ 0xbd of 0xa0 to 0xbc
    .hword  0
    b       _start                  @ 0xc0 entry of multiboot images; a branch back says that this
    .fill   12, 1, 0                @      is none: without it, libmgba guesses from the code
    .global gba_command_line
gba_command_line:
    .fill   128, 1, 0               @ 0xd0

    .text
    .arm
boot:
    mov     r0, #0x12               @ interrupts off, IRQ mode
    orr     r0, r0, #0x80
    msr     cpsr_c, r0
    ldr     sp, =link_irq_stack_top
    mov     r0, #0x1f               @ system mode, interrupts on
    msr     cpsr_c, r0
    ldr     sp, =link_stack_top
    mov     r0, #0x04000000
    str     r0, [r0, #0x208]        @ master enable off (bit 0 of the value is 0)
    ldr     r1, =0x4317             @ ROM 3 and 1 wait states, prefetch
    add     r0, r0, #0x200
    strh    r1, [r0, #4]

    ldr     r0, =link_fast_load
    ldr     r1, =link_fast_start
    ldr     r2, =link_fast_end
    bl      copy
    ldr     r0, =link_draw_load
    ldr     r1, =link_fast_end
    ldr     r2, =link_draw_size
    add     r2, r2, r1
    bl      copy
    ldr     r0, =link_warm_load
    ldr     r1, =link_warm_start
    ldr     r2, =link_warm_end
    bl      copy
    ldr     r1, =link_bss_start
    ldr     r2, =link_bss_end
    mov     r3, #0
    bl      fill
    ldr     r1, =link_stack_limit
    mov     r2, sp
    ldr     r3, =0x5ac35ac3         @ STACK_PAINT of stack.h
    bl      fill
    ldr     r3, =gba_main
    mov     lr, pc
    bx      r3
1:  b       1b

copy:
    cmp     r1, r2
    ldrlo   r3, [r0], #4
    strlo   r3, [r1], #4
    blo     copy
    bx      lr
fill:
    cmp     r1, r2
    strlo   r3, [r1], #4
    blo     fill
    bx      lr
    .pool
