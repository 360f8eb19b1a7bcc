/* SPDX-License-Identifier: MIT */
/* flat_row_armv6m.h - a row of flat_rows and flat_lines in assembly for Cortex-M0 and M0+, whose sides are known. */
#ifndef SMEAR_KERNELS_FLAT_ROW_ARMV6M_H
#define SMEAR_KERNELS_FLAT_ROW_ARMV6M_H

/* The pixel AT bytes of depth and PLACE bytes of colours further on. LABEL is behind it. */
#define FLAT_ROW_PUT(STORE, AT, PLACE, LABEL) \
    "ldrh r5, [r1, #" AT "]\n\t"              \
    "adds r0, r0, r3\n\t"                     \
    "cmp r5, r4\n\t"                          \
    "bhs " LABEL "f\n\t"                      \
    "strh r4, [r1, #" AT "]\n\t" STORE " r7, [r2, #" PLACE "]\n" LABEL ": "
#define FLAT_ROW_PIXEL(STORE, AT, PLACE, LABEL) \
    "lsrs r4, r0, #16\n\t" FLAT_ROW_PUT(STORE, AT, PLACE, LABEL)

/* Pixels from r5 to before r6, where r7 points to columns, what changes from row to row, z, depth, and what pixels take; then goes on at
 * 1 with the next of so many rows as r9 says. In a row: z r0, depth r1, pixels r2, dz r3, how many r6, the colour r7. DOUBLE is an
 * instruction where pixels are wide; of them SINGLE, TWICE, THRICE and FOUR are bytes. */
#define FLAT_ROW_ARMV6M(PIXEL, STORE, DOUBLE, SINGLE, TWICE, THRICE, FOUR) \
    "ldm r7!, {r0, r1, r2, r3}\n\t" \
    "cmp r5, r0\n\t" \
    "bge 4f\n\t" \
    "movs r5, r0\n" \
    "4: cmp r6, r1\n\t" \
    "ble 5f\n\t" \
    "movs r6, r1\n" \
    "5: ldr r0, [r7]\n\t" \
    "ldr r1, [r7, #4]\n\t" \
    "adds r2, r2, r0\n\t" \
    "adds r3, r3, r1\n\t" \
    "stm r7!, {r2, r3}\n\t" \
    "subs r6, r6, r5\n\t" \
    "ble 9f\n\t" \
    "ldm r7, {r2, r3, r7}\n\t" \
    "movs r4, r3\n\t" \
    "muls r4, r5\n\t" \
    "adds r0, r0, r4\n\t" \
    "lsls r5, r5, #1\n\t" \
    "adds r1, r1, r5\n\t" DOUBLE "adds r2, r2, r1\n\t" \
    "subs r6, #4\n\t" \
    "blt 7f\n" \
    "6: " PIXEL(STORE, "0", "0", "2") PIXEL(STORE, "2", SINGLE, "3") \
    PIXEL(STORE, "4", TWICE, "4") PIXEL(STORE, "6", THRICE, "5") \
    "adds r2, #" FOUR "\n\t" \
    "adds r1, #8\n\t" \
    "subs r6, #4\n\t" \
    "bge 6b\n" \
    "7: lsrs r6, r6, #1\n\t" \
    "bcc 8f\n\t" PIXEL(STORE, "0", "0", "2") \
    "adds r2, #" SINGLE "\n\t" \
    "adds r1, #2\n" \
    "8: lsrs r6, r6, #1\n\t" \
    "bcc 9f\n\t" PIXEL(STORE, "0", "0", "2") PIXEL(STORE, "2", SINGLE, "3") \
    "9: mov r4, r9\n\t" \
    "subs r4, #1\n\t" \
    "mov r9, r4\n\t" \
    "beq 2f\n\t" \
    "b 1b\n"

#endif
