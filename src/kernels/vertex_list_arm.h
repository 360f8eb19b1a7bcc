/* SPDX-License-Identifier: MIT */
/* vertex_list_arm.h - vertex_list in assembly for ARM7TDMI: products whose short factor comes last take fewer cycles, and hardly a
 * value lies on the stack. Three quarters of the compiler's cycles. */
#ifndef SMEAR_KERNELS_VERTEX_LIST_ARM_H
#define SMEAR_KERNELS_VERTEX_LIST_ARM_H

#include "kernels/vertex_list.h"

#if SMEAR_ASM_ARM

SMEAR_STATIC_ASSERT(offsetof(struct place_setup, near_distance) == 4 && offsetof(struct place_setup, depth_shift) == 16
                        && offsetof(struct place_setup, depth_least) == 20 && offsetof(struct place_setup, depth_most) == 24
                        && offsetof(struct place_setup, x) == 28 && offsetof(struct place_setup, y) == 32,
                    "the assembly knows struct place_setup");
SMEAR_STATIC_ASSERT(sizeof(struct listed_vertex) == 24 && offsetof(struct listed_vertex, screen) == 8
                        && offsetof(struct listed_vertex, sides) == 20 && LISTED_GUARD_PX << 8 == 0x80000,
                    "the assembly knows struct listed_vertex");

/* The row at FROM, times the vertex in r4 to r6, into LOW; HIGH and r7 to r10 are lost. */
#define ARM_VERTEX_ROW(FROM, LOW, HIGH)                 \
    "ldm " FROM ", {r7, r8, r9, r10}\n\t"               \
    "smull " LOW ", " HIGH ", r7, r4\n\t"               \
    "smlal " LOW ", " HIGH ", r8, r5\n\t"               \
    "smlal " LOW ", " HIGH ", r9, r6\n\t"               \
    "mov " LOW ", " LOW ", lsr #16\n\t"                 \
    "orr " LOW ", " LOW ", " HIGH ", lsl #16\n\t"       \
    "add " LOW ", " LOW ", r10\n\t"

/* Shifts r11 up where it is below LIMIT, and counts that in r12. */
#define ARM_VERTEX_ZEROS(LIMIT, BITS)                   \
    "cmp r11, #" LIMIT "\n\t"                           \
    "movlo r11, r11, lsl #" BITS "\n\t"                 \
    "addlo r12, r12, #" BITS "\n\t"

/* recip_norm of r11 into lr; the seeds lie 1024 bytes behind what [sp, #4] says. */
#define ARM_VERTEX_RECIP                                \
    "ldr r8, [sp, #4]\n\t"                              \
    "mov r7, r11, lsr #21\n\t"                          \
    "bic r7, r7, #1\n\t"                                \
    "ldrh r7, [r8, r7]\n\t"                             \
    "mov r11, r11, lsr #11\n\t"                         \
    "mul r8, r11, r7\n\t"                               \
    "rsb r8, r8, #0x80000000\n\t"                       \
    "mov r8, r8, asr #4\n\t"                            \
    "mul r11, r8, r7\n\t"                               \
    "mov r7, r7, lsl #19\n\t"                           \
    "add lr, r7, r11, asr #8\n\t"

/* Depth by the mantissa in r9 and a shift in r10, which is not above 0: what is shifted out last is carried, and nothing where none is. */
#define ARM_VERTEX_DEPTH                                \
    "smull r7, r8, lr, r9\n\t"                          \
    "rsb r10, r10, #0\n\t"                              \
    "cmp r10, #31\n\t"                                  \
    "movhi r10, #31\n\t"                                \
    "movs r8, r8, asr r10\n\t"                          \
    "adc r8, r8, #0\n\t"                                \
    "ldr r7, [r2, #20]\n\t"                             \
    "ldr r10, [r2, #24]\n\t"                            \
    "cmp r8, r7\n\t"                                    \
    "movlt r8, r7\n\t"                                  \
    "cmp r8, r10\n\t"                                   \
    "movgt r8, r10\n\t"                                 \
    "str r8, [r0, #16]\n\t"

/* The place of r3 from a centre, which is then in r9, into r8. */
#define ARM_VERTEX_PLACE(CENTRE, OUT)                   \
    "smull r7, r8, lr, r3\n\t"                          \
    "ldr r9, [r2, #" CENTRE "]\n\t"                     \
    "movs r8, r8, asr r12\n\t"                          \
    "adc r8, r8, r9\n\t"                                \
    "str r8, [r0, #" OUT "]\n\t"

/* listed_sides of r7 and r8, whose centres are in r10 and r9. */
#define ARM_VERTEX_SIDES                                \
    "orr r11, r11, r7, lsr #31\n\t"                     \
    "cmp r7, r10, lsl #1\n\t"                           \
    "orrgt r11, r11, #2\n\t"                            \
    "mov r12, r8, lsr #31\n\t"                          \
    "orr r11, r11, r12, lsl #2\n\t"                     \
    "cmp r8, r9, lsl #1\n\t"                            \
    "orrgt r11, r11, #8\n\t"                            \
    "sub r7, r7, r10\n\t"                               \
    "add r7, r7, #0x80000\n\t"                          \
    "cmp r7, #0x100000\n\t"                             \
    "orrhi r11, r11, #64\n\t"                           \
    "sub r8, r8, r9\n\t"                                \
    "add r8, r8, #0x80000\n\t"                          \
    "cmp r8, #0x100000\n\t"                             \
    "orrhi r11, r11, #64\n\t"

/* Like vertex_list. r0 points to the vertex's record, r1 to its coordinates, r2 to the setup, r3 is its number, which is kept in the
 * record meanwhile. */
static inline uint32_t vertex_list_arm(struct listed_vertex *out, const int16_t *v, uint32_t tag, uint32_t end,
                                       const struct place_setup *s)
{
    register struct listed_vertex *r0 __asm__("r0") = out;
    register const int16_t *r1 __asm__("r1") = v;
    register const struct place_setup *r2 __asm__("r2") = s;
    register uint32_t r3 __asm__("r3") = tag;
    register uint32_t r4 __asm__("r4") = end;
    register uintptr_t r5 __asm__("r5") = (uintptr_t)smear_recip_seed - 1024;
    __asm__ volatile(".syntax unified\n\t"
                     "push {r4, r5}\n"
                     "1: ldrsh r4, [r1]\n\t"
                     "ldrsh r5, [r1, #2]\n\t"
                     "ldrsh r6, [r1, #4]\n\t"
                     "ldr r12, [r2]\n\t"
                     "add r12, r12, #32\n\t" ARM_VERTEX_ROW("r12", "r11", "r12")
                     "ldmib r2, {r7, r8, r9, r10}\n\t"
                     "cmp r11, r7\n\t"
                     "blt 9f\n\t"
                     "cmp r11, r8\n\t"
                     "bgt 9f\n\t"
                     "mov r12, #0\n\t"
                     ARM_VERTEX_ZEROS("0x10000", "16") ARM_VERTEX_ZEROS("0x1000000", "8") ARM_VERTEX_ZEROS("0x10000000", "4")
                     ARM_VERTEX_ZEROS("0x40000000", "2") ARM_VERTEX_ZEROS("0x80000000", "1")
                     "cmp r12, #21\n\t"
                     "bge 9f\n\t"
                     "adds r10, r10, r12\n\t"
                     "bgt 9f\n\t"
                     "str r3, [r0]\n\t" ARM_VERTEX_RECIP ARM_VERTEX_DEPTH
                     "rsb r12, r12, #21\n\t"
                     "ldr r11, [r2]\n\t" ARM_VERTEX_ROW("r11", "r3", "r11") ARM_VERTEX_PLACE("28", "8")
                     "ldr r11, [r2]\n\t"
                     "add r11, r11, #16\n\t" ARM_VERTEX_ROW("r11", "r3", "r11") ARM_VERTEX_PLACE("32", "12")
                     "ldr r7, [r0, #8]\n\t"
                     "ldr r10, [r2, #28]\n\t"
                     "mov r11, #0\n\t"
                     "cmp r7, r10, lsl #1\n\t"
                     "cmpls r8, r9, lsl #1\n\t"
                     "bhi 5f\n"
                     "4: mov r12, #0\n\t"
                     "str r12, [r0, #4]\n\t"
                     "str r11, [r0, #20]\n\t"
                     "ldr r3, [r0], #24\n\t"
                     "ldr r12, [sp]\n\t"
                     "add r1, r1, #6\n\t"
                     "add r3, r3, #1\n\t"
                     "cmp r3, r12\n\t"
                     "bne 1b\n\t"
                     "b 9f\n"
                     "5: " ARM_VERTEX_SIDES
                     "b 4b\n"
                     "9: add sp, sp, #8"
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3), "+r"(r4), "+r"(r5)
                     :
                     : "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
    return r3;
}

#endif

#endif
