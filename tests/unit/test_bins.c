/* SPDX-License-Identifier: MIT */
/* test_bins.c - lists per tile row: submission order, what has ended is dropped, parts of a
 * frame. Needs neither libc nor floating point. */
#include "geometry/bins.h"

#include "tests/random.h"
#include "tests/test.h"

enum { ROWS = 12, ROW_PX = 16, POOL_WORDS = 2400, MOST = 200 };

static uint32_t pool[POOL_WORDS];
static uint32_t opaque_last[ROWS], blend_last[ROWS];
static struct smear_segment segment[2];
static struct smear_bins bins;

/* What was added, in order. */
static struct { int first, end; bool blend; } added[MOST];    /* pixel rows [first, end) */

static void begin(int first, int end)
{
    bins = (struct smear_bins){
        .pool = pool, .pool_words = POOL_WORDS, .segment = segment, .segment_limit = 2,
        .opaque_last = opaque_last, .blend_last = blend_last, .row_px = ROW_PX, .row_count = ROWS
    };
    smear_bins_reset(&bins, first, end);
    smear_bins_open(&bins);
}

/* A triangle whose pixel centres lie in the rows [first, end), linked where it starts. */
static void add(int first, int end, bool blend)
{
    uint32_t i = bins.triangle_count;
    int row = bins_row(&bins, first);
    row = row < bins.row_first ? bins.row_first : row;
    const uint32_t at = bins.vertex_words;
    bins_add(&bins, blend ? &blend_last[row] : &opaque_last[row], at, at + VERTEX_BASE_WORDS, at + 2 * VERTEX_BASE_WORDS, 0, 0);
    for (int k = 0; k < 3; k++) {
        pool[bins.vertex_words + VERTEX_X] = 0;
        /* One vertex at the bottom, whose last covered centre is that of row end - 1. */
        pool[bins.vertex_words + VERTEX_Y] = (uint32_t)((k == 1 ? end : first) * 256);
        bins.vertex_words += VERTEX_BASE_WORDS;
    }
    added[i].first = first;
    added[i].end = end;
    added[i].blend = blend;
}

/* The list of a row holds, in order of submission, all that starts in it or above and reaches it. */
static bool check_list(uint32_t head, int row, bool blend)
{
    int top = row * ROW_PX, bottom = top + ROW_PX;
    for (uint32_t i = 0; i < bins.triangle_count; i++) {
        if (added[i].blend != blend || added[i].first >= bottom || added[i].end <= top)
            continue;
        if (!CHECK_EQ(head, i))
            return false;
        head = bins_triangle(&bins, head)->next;
    }
    return CHECK_EQ(head, SMEAR_NO_TRIANGLE);
}

static bool check_frame(int first, int end)
{
    uint32_t opaque = SMEAR_NO_TRIANGLE, blend = SMEAR_NO_TRIANGLE;
    for (int row = first; row < end; row++) {
        opaque = smear_bins_advance(&bins, bins.opaque_last, opaque, row);
        blend = smear_bins_advance(&bins, bins.blend_last, blend, row);
        if (!check_list(opaque, row, false) || !check_list(blend, row, true))
            return false;
    }
    return true;
}

static void test_lists_keep_the_order_of_submission_over_rows(void)
{
    random_state = 1;
    for (int n = 0; n < 40; n++) {
        begin(0, ROWS);
        int count = between(1, 180);
        for (int i = 0; i < count; i++) {
            int first = between(0, ROWS * ROW_PX - 1), most = ROWS * ROW_PX - first;
            int rows = between(0, 3) == 0 ? between(1, most) : between(1, most < 9 ? most : 9);
            add(first, first + rows, between(0, 2) == 0);
        }
        END_UNLESS(check_frame(0, ROWS));
    }
}

static void test_parts_of_a_frame_hold_their_rows_only(void)
{
    random_state = 2;
    for (int n = 0; n < 40; n++) {
        int first = between(0, ROWS - 1), end = between(first + 1, ROWS);
        for (int row = 0; row < ROWS; row++)
            opaque_last[row] = blend_last[row] = 12345;     /* of other parts: never looked at */
        begin(first, end);
        int count = between(1, 150);
        for (int i = 0; i < count; i++) {
            /* Starts in the part or above it, and reaches it. */
            int top = between(0, end * ROW_PX - 1);
            int bottom = between(top < first * ROW_PX ? first * ROW_PX + 1 : top + 1, ROWS * ROW_PX);
            add(top, bottom, between(0, 1));
        }
        END_UNLESS(check_frame(first, end));
        for (int row = 0; row < ROWS; row++)
            if (row < first || row >= end)
                CHECK(opaque_last[row] == 12345 && blend_last[row] == 12345);
    }
}

static void test_room_is_counted_to_the_word(void)
{
    begin(0, ROWS);
    const uint32_t triangle_words = sizeof(struct smear_triangle) / 4;
    CHECK(bins_has_room(&bins, POOL_WORDS - triangle_words, 1));
    CHECK(!bins_has_room(&bins, POOL_WORDS - triangle_words + 1, 1));
    CHECK(bins_has_room(&bins, POOL_WORDS, 0));
    while (bins_has_room(&bins, 3 * VERTEX_BASE_WORDS, 1) && bins.triangle_count < MOST)
        add(0, 1, false);
    CHECK_EQ(bins.triangle_count, POOL_WORDS / (triangle_words + 3 * VERTEX_BASE_WORDS));
    /* The newest triangle and the newest vertex do not meet. */
    CHECK((uint32_t *)(void *)bins_triangle(&bins, bins.triangle_count - 1)
          >= pool + bins.vertex_words);
}

static void test_segments_start_at_the_free_word_until_the_table_is_full(void)
{
    begin(0, ROWS);
    CHECK_EQ(segment[0].base, 0);
    bins.vertex_words = 77;
    struct smear_segment *s = smear_bins_open(&bins);
    CHECK(s == &segment[1] && s->base == 77);
    CHECK(smear_bins_open(&bins) == NULL);
    smear_bins_reset(&bins, 0, ROWS);
    CHECK_EQ(bins.segment_count + bins.vertex_words + bins.triangle_count, 0);
}

#include "build/suites/bins.h"
