/* SPDX-License-Identifier: MIT */
/* test_failures.c - the failures that motion blur is known for: each method passes each of them, or
 * fails as it is known to. A known failure has a bound that its number must not exceed; what is
 * found is written to build/test/failures.txt, so that the table tells today's numbers. */
#include "tests/suite/failures.h"

#include "tests/host.h"

#include <string.h>
#include <sys/stat.h>

void suite_failures(void);

enum { ROWS_MAX = 64, TEXT = 1 << 16 };

static const struct fail_row *row_list[ROWS_MAX];
static int row_count;

/* The table, as far as it is measured. */
static char table[TEXT];
static size_t table_length;

static void add_text(const char *text)
{
    size_t n = strlen(text);
    if (CHECK(table_length + n < sizeof table)) {
        memcpy(table + table_length, text, n + 1);
        table_length += n;
    }
}

/* ------------------------------------------------------------------ one row */

enum outcome { PASS, KNOWN, WRONG, ABSENT };

static bool is_taken(const struct fail_measure *m, int method)
{
    return m->only == 0 || (m->only & ONLY(method)) != 0;
}

static enum outcome outcome_of(const struct fail_row *row, int i, int method, double number)
{
    const struct fail_measure *m = &row->measure[i];
    if (!is_taken(m, method))
        return ABSENT;
    if (number <= m->bar)
        return PASS;
    return number <= fail_known(row, i, method) ? KNOWN : WRONG;
}

static void print_cell(const struct fail_row *row, int i, int method, double number)
{
    static const char *const word[] = {[PASS] = "pass", [KNOWN] = "known", [WRONG] = "WRONG"};
    char cell[40];
    enum outcome outcome = outcome_of(row, i, method, number);
    if (outcome == ABSENT)
        snprintf(cell, sizeof cell, " %14s", "-     ");
    else
        snprintf(cell, sizeof cell, " %8.*f %-5s", number < 99.95 ? 2 : 1, number, word[outcome]);
    add_text(cell);
}

static void print_measure(const struct fail_row *row, int i,
                          const double number[METHODS][FAIL_MEASURES])
{
    const struct fail_measure *m = &row->measure[i];
    char line[160], label[8] = "";
    if (i == 0)
        snprintf(label, sizeof label, row->number != 0 ? "%d" : "+", row->number);
    if (i == 0) {
        snprintf(line, sizeof line, "%-3s %s\n", label, row->name);
        add_text(line);
    }
    snprintf(line, sizeof line, "      %-42s %6.4g %-7s", m->what, m->bar, m->unit);
    add_text(line);
    for (int k = 0; k < METHODS; k++)
        print_cell(row, i, k, number[k][i]);
    add_text("\n");
}

static void print_remarks(const struct fail_row *row)
{
    char line[200];
    const char *said = NULL;
    for (int i = 0; i < FAIL_MEASURES && row->measure[i].what != NULL; i++) {
        const char *why = row->measure[i].otherwise;
        if (why == NULL || why == said)
            continue;
        snprintf(line, sizeof line, "      - %s: %s\n",
                 row->measure[i].only == NOBODY ? "not offered" : "not taken", why);
        add_text(line);
        said = why;
    }
    if (row->note != NULL) {
        snprintf(line, sizeof line, "      (%s)\n", row->note);
        add_text(line);
    }
}

static void check_measure(const struct fail_row *row, int i, int method, double number)
{
    const struct fail_measure *m = &row->measure[i];
    char subject[160];
    END_UNLESS(is_taken(m, method));
    snprintf(subject, sizeof subject, "%d %s, %s, %s", row->number, row->name, m->what,
             fail_method[method].name);
    CHECK_BAR(number, fmax(m->bar, fail_known(row, i, method)), subject);
    if (fail_known(row, i, method) > 0.0 && number <= m->bar)
        say("    %s: known to fail, but %.4g passes\n", subject, number);
}

static const struct fail_row *the_row;

static void test_row(void)
{
    double number[METHODS][FAIL_MEASURES], start = cpu_seconds();
    size_t from = table_length;
    for (int k = 0; k < METHODS; k++) {
        for (int i = 0; i < FAIL_MEASURES; i++)
            number[k][i] = NAN;
        the_row->take(&fail_method[k], number[k]);
    }
    truth_forget();
    for (int i = 0; i < FAIL_MEASURES && the_row->measure[i].what != NULL; i++) {
        print_measure(the_row, i, (const double(*)[FAIL_MEASURES])number);
        for (int k = 0; k < METHODS; k++)
            check_measure(the_row, i, k, number[k][i]);
    }
    print_remarks(the_row);
    test_print(table + from);
    say("      %.1f s\n", cpu_seconds() - start);
}

/* ------------------------------------------------------------------ all of them */

static void add_rows(const struct fail_row *row, int count)
{
    for (int i = 0; i < count && CHECK(row_count < ROWS_MAX); i++)
        row_list[row_count++] = &row[i];
}

/* By number; what is beyond the catalogue comes last. */
static int place(const struct fail_row *row)
{
    return row->number != 0 ? row->number : 1000;
}

static void sort_rows(void)
{
    for (int i = 1; i < row_count; i++)
        for (int k = i; k > 0 && place(row_list[k]) < place(row_list[k - 1]); k--) {
            const struct fail_row *other = row_list[k];
            row_list[k] = row_list[k - 1];
            row_list[k - 1] = other;
        }
}

static void test_all_36_failures_have_a_row(void)
{
    for (int number = 1; number <= 36; number++) {
        int rows = 0;
        for (int i = 0; i < row_count; i++)
            rows += row_list[i]->number == number;
        CHECK_EQ(rows, 1);
    }
}

/* A known failure is one that has failed: its bound lies above the bar, and of methods that the
 * measure is taken of. */
static void test_known_failures_are_stated_soundly(void)
{
    for (int i = 0; i < row_count; i++)
        for (int k = 0; k < FAIL_MEASURES && row_list[i]->measure[k].what != NULL; k++) {
            const struct fail_measure *m = &row_list[i]->measure[k];
            CHECK(m->only == 0 || m->otherwise != NULL);
            for (int method = 0; method < METHODS; method++)
                if (fail_known(row_list[i], k, method) != 0.0) {
                    CHECK(is_taken(m, method) && fail_known(row_list[i], k, method) > m->bar);
                    CHECK(!m->hard || method != FINE);
                }
        }
}

static void print_heading(void)
{
    char line[200];
    add_text("# Failures of motion blur: what is measured, the most at which it passes, and each\n"
             "# method's number. known: fails, and is known to; the test holds it to a bound.\n"
             "# Unless a row says otherwise: shutter 360 degrees, centred, linear light, poses at\n"
             "# shutter open, now and close; reach 12, tile 16; truth of 256 exact instants by\n"
             "# the reference renderer. mended: FENCE, CORNER, BOX, UNIFORM; half likewise; pingpong:\n"
             "# spread; jimenez: reconstruct with those weights. Written by\n"
             "# make run-suite SUITE=failures\n");
    snprintf(line, sizeof line, "%-57s%6s", "", "bar");
    add_text(line);
    for (int k = 0; k < METHODS; k++) {
        snprintf(line, sizeof line, " %14s", fail_method[k].name);
        add_text(line);
    }
    add_text("\n");
}

static void test_table_is_written(void)
{
    static const char *const path = "build/test/failures.txt";
    mkdir("build", 0777);
    mkdir("build/test", 0777);
    FILE *file = fopen(path, "w");
    REQUIRE(file != NULL);
    CHECK_EQ((int64_t)fwrite(table, 1, table_length, file), (int64_t)table_length);
    CHECK_EQ(fclose(file), 0);
}

void suite_failures(void)
{
    row_count = 0;
    table_length = 0;
    add_rows(fail_picture_rows, fail_picture_count);
    add_rows(fail_time_rows, fail_time_count);
    add_rows(fail_other_rows, fail_other_count);
    sort_rows();
    RUN(test_all_36_failures_have_a_row);
    RUN(test_known_failures_are_stated_soundly);
    print_heading();
    for (int i = 0; i < row_count; i++) {
        char name[100];
        the_row = row_list[i];
        snprintf(name, sizeof name, "test_failure_%02d: %s", the_row->number, the_row->name);
        test_run(name, test_row);
    }
    /* A part of the suite writes no table. */
    if (test_state.filter == NULL)
        RUN(test_table_is_written);
}

/* ------------------------------------------------------------------ known failures */

/* Known failures of camera, pingpong, half, other weights of reconstruct, object and layered: bounds that their numbers must not exceed.
 * camera knows no object's motion, so whatever moves an object fails as `none` does. Of object and layered, what turns or has no one
 * velocity is blurred by taps, rotation follows the chord; beyond the margin of a layer's rows nothing is known. */

/* Rows by their number, those beyond the catalogue by their name. */
static const struct {
    int number;
    const char *name;
    int measure;
    double at_most[METHODS - CAMERA];           /* CAMERA, PINGPONG, HALF_SIZE, JIMENEZ, OBJECT, LAYERED */
} known[] = {
    { 1, NULL, 0, { 30, 13, 15, 14, 13, 13 } },
    { 1, NULL, 1, { 18, 14, 12, 8, 4.4, 4.4 } },
    { 1, NULL, 2, { 30, 15, 16, 16, 14, 14 } },
    { 2, NULL, 0, { 15, 8, 8.7, 8, 7.7, 8 } },
    { 2, NULL, 1, { 2.2, 2.3, 2.3, 2.3, 2.3, 2.3 } },
    { 2, NULL, 2, { 2.2, 2.2, 2.4, 2.3, 2.2, 2.3 } },
    { 3, NULL, 0, { 59, 58, 59, 59, 0, 58 } },
    { 4, NULL, 1, { 19, 8.1, 9.7, 8.4, 2.4, 8.2 } },
    { 5, NULL, 0, { 0, 0, 150, 0, 0, 0 } },
    { 6, NULL, 0, { 35, 35, 13, 35, 36, 110 } },
    { 6, NULL, 1, { 38, 22, 31, 24, 9.2, 28 } },
    { 7, NULL, 1, { 8.5, 5.3, 4.9, 4.2, 0, 0 } },
    { 8, NULL, 0, { 0.5, 0.078, 0.14, 0, 0, 0.073 } },
    { 9, NULL, 0, { 110, 0, 110, 15, 110, 110 } },
    { 10, NULL, 0, { 0, 1.5, 0.98, 1.7, 0, 0 } },
    { 10, NULL, 1, { 12, 6.6, 7.2, 6.8, 0, 6.1 } },
    { 11, NULL, 0, { 13, 8.1, 9.4, 8.4, 8.2, 8.2 } },
    { 14, NULL, 0, { 26, 8.2, 26, 16, 0, 7.7 } },
    { 15, NULL, 0, { 9.1, 8.8, 8.9, 8.8, 8.9, 8.9 } },
    { 15, NULL, 1, { 3, 0, 3.2, 0, 0, 0 } },
    { 16, NULL, 0, { 14, 0, 3.7, 3.1, 0, 0 } },
    { 17, NULL, 0, { 4.2, 3.4, 4.9, 3.7, 5.3, 7.1 } },
    { 18, NULL, 0, { 13, 13, 13, 13, 13, 13 } },
    { 19, NULL, 1, { 0, 8.4, 15, 13, 6, 6 } },
    { 20, NULL, 0, { 0, 0, 17, 7.1, 0, 0 } },
    { 20, NULL, 1, { 27, 3.1, 16, 5.2, 2.4, 3.3 } },
    { 21, NULL, 0, { 35, 6.7, 30, 0, 0, 9 } },
    { 22, NULL, 0, { 83, 0, 0, 0, 0, 0 } },
    { 22, NULL, 1, { 520, 65, 160, 17, 0, 66 } },
    { 23, NULL, 0, { 1.7, 2, 3.4, 1.2, 2, 1.6 } },
    { 23, NULL, 1, { 1.2, 0, 0, 0, 0, 0 } },
    { 26, NULL, 1, { 0, 0, 23, 0, 0, 0 } },
    { 26, NULL, 2, { 16, 14, 15, 9.5, 7.6, 7.9 } },
    { 27, NULL, 1, { 5.7, 5.6, 5.8, 5.9, 4.4, 4.4 } },
    { 28, NULL, 0, { 2.9, 0, 2.4, 0, 0, 0 } },
    { 29, NULL, 1, { 6.1, 6.5, 19, 7.7, 6.1, 6.1 } },
    { 32, NULL, 0, { 5.9, 3, 4.5, 3.1, 2.6, 2.6 } },
    { 35, NULL, 0, { 32, 4.1, 9.9, 4.1, 0, 4.1 } },
    { 37, NULL, 0, { 49, 5.5, 20, 7.7, 6.4, 6.6 } },
    { 37, NULL, 1, { 72, 12, 27, 22, 13, 18 } },
    { 38, NULL, 0, { 27, 11, 14, 13, 9, 9 } },
    { 38, NULL, 1, { 45, 19, 23, 21, 18, 18 } },
    { 39, NULL, 0, { 25, 9.6, 15, 9.7, 8.1, 8.1 } },
    { 39, NULL, 1, { 62, 46, 48, 46, 46, 46 } },
    { 40, NULL, 0, { 31, 8.7, 12.5, 11, 7.7, 7.7 } },
    { 40, NULL, 1, { 58, 16, 22.5, 20, 15, 15 } },
    { 0, "every scene of the catalogue", 0, { 0, 1.1, 1.1, 1.1, 0, 0 } },
    { 0, "every scene of the catalogue", 1, { 0, 0, 75, 0, 42, 42 } },
    { 0, "trailing and leading exposures", 0, { 29, 3.9, 13, 5.2, 0, 4.1 } },
    { 0, "trailing and leading exposures", 1, { 29, 3.9, 13, 5.2, 0, 4.1 } },
};

double fail_known(const struct fail_row *row, int measure, int method)
{
    for (size_t i = 0; i < sizeof known / sizeof *known && method >= CAMERA; i++)
        if (known[i].number == row->number && known[i].measure == measure
            && (row->number != 0 || strcmp(known[i].name, row->name) == 0))
            return known[i].at_most[method - CAMERA];
    return row->measure[measure].known[method];
}
