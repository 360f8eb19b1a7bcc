/* SPDX-License-Identifier: MIT */
/* target_golden.c - draws every golden frame: the library gives the same bits on every target.
 *
 * Prints a line `TAPE FRAME CRC` per frame, what is wrong beside it, and a summary. Fails on a
 * wrong or unknown CRC, on an error of the library, and when nothing was drawn. A tape too large
 * for the machine is skipped, and that is said. */
#include "../platform/platform.h"
#include "play.h"
#include "target_print.h"

#include <stdbool.h>

struct tally {
    uint32_t right, wrong, skipped;
};

static void print_frame(const struct tape *tape, int frame, uint32_t crc)
{
    platform_print(tape->name);
    platform_print(" ");
    print_signed(frame);
    platform_print(" ");
    print_hex(crc);
}

static void play_tape(const struct tape *tape, struct tally *tally)
{
    struct player player;
    smear_stats stats;
    size_t room, need = play_memory(tape);
    void *arena = platform_arena(&room);
    if (need > room) {
        platform_print("# ");
        platform_print(tape->name);
        platform_print(" skipped: needs ");
        print_decimal((uint32_t)need);
        platform_print(" bytes\n");
        tally->skipped++;
        return;
    }
    /* exactly as much as it asks for, so that an overrun is not into its own slack */
    int result = need == 0 ? SMEAR_ERR_ARG : play_start(&player, tape, arena, need, NULL);
    for (int i = 0; i < tape->frame_count && result == SMEAR_OK; i++) {
        result = play_frame(&player, i, &stats);
        if (result != SMEAR_OK)
            break;
        print_frame(tape, i, stats.crc32);
        bool is_right = tape->crc != NULL && tape->crc[i] == stats.crc32;
        if (is_right)
            tally->right++;
        else
            tally->wrong++;
        if (!is_right) {
            platform_print(tape->crc != NULL ? " WRONG, want " : " NOT KNOWN");
            if (tape->crc != NULL)
                print_hex(tape->crc[i]);
        }
        platform_print("\n");
    }
    if (result != SMEAR_OK) {
        platform_print("# ");
        platform_print(tape->name);
        platform_print(" ERROR ");
        print_signed(result);
        platform_print("\n");
        tally->wrong++;
    }
}

int main(void)
{
    struct tally tally = { 0, 0, 0 };
    for (int i = 0; i < tape_count; i++)
        play_tape(tape_list[i], &tally);
    platform_print("golden frames: ");
    print_decimal(tally.right);
    platform_print(" right, ");
    print_decimal(tally.wrong);
    platform_print(" wrong, ");
    print_decimal(tally.skipped);
    platform_print(" tapes skipped");
    uint32_t stack = platform_stack_used();
    bool is_overflow = stack == UINT32_MAX;
    if (is_overflow) {
        platform_print("; STACK OVERFLOW");
    } else if (stack > 0) {
        platform_print("; stack ");
        print_decimal(stack);
        platform_print(" bytes");
    }
    platform_print("\n");
    return tally.wrong != 0 || tally.right == 0 || is_overflow;
}
