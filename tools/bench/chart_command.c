/* SPDX-License-Identifier: MIT */
/* chart_command.c - the command `chart`: options, progress, what goes where.
 *
 * Whatever is measured is kept in build/chart/measured.csv together with a number that stands for
 * the program, so that a run goes on where another was stopped, and a changed program measures
 * anew. */
#include "tools/bench/chart.h"

#include "tools/bench/sheet.h"
#include "tools/image/image.h"
#include "tools/options/say.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct options {
    struct chart_choice choice;
    const char *from, *out;
    int jobs;
    bool is_part, few_scenes, quick, strict;
};

static const char help[] = "smear help chart";

/* ------------------------------------------------------------------ options */

/* The next word of a list with commas; false at the end. */
static bool next_word(const char **list, char word[64])
{
    *list += strspn(*list, ",");
    size_t length = strcspn(*list, ",");
    snprintf(word, 64, "%.*s", (int)length, *list);
    *list += length;
    return length > 0;
}

static int choose_scenes(struct options *o, const char *list)
{
    char word[64];
    memset(o->choice.kind, 0, sizeof o->choice.kind);
    while (next_word(&list, word)) {
        struct guess guess = { .word = word };
        bool found = false;
        for (int k = 0; k < ALL_KINDS; k++) {
            guess_try(&guess, kinds[k].name);
            if (strcmp(kinds[k].name, word) == 0)
                found = o->choice.kind[k] = true;
        }
        if (!found)
            return say_unknown(word, "no scene of the suite", &guess, help);
    }
    return 0;
}

static int choose_methods(struct options *o, const char *list)
{
    char word[64];
    memset(o->choice.setting, 0, sizeof o->choice.setting);
    o->choice.setting[chart_none] = true;
    while (next_word(&list, word)) {
        struct guess guess = { .word = word };
        bool found = false;
        for (int s = 0; s < chart_setting_count; s++) {
            guess_try(&guess, chart_settings[s].name);
            if (strncmp(chart_settings[s].name, word, strlen(word)) == 0)
                found = o->choice.setting[s] = true;
        }
        if (!found)
            return say_unknown(word, "no setting begins so", &guess, help);
    }
    return 0;
}

static int say_no_option(const char *name)
{
    static const char *const names[] = { "--scenes", "--methods", "--from", "--out", "--jobs", "--quick", "--strict" };
    struct guess guess = { .word = name };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        guess_try(&guess, names[i]);
    return say_unknown(name, "unknown option", &guess, help);
}

/* 0, or an exit status. Empty lists, as from a Makefile, choose everything. */
static int read_options(struct options *o, int count, char **text)
{
    int status;
    *o = (struct options){ .jobs = 2 };
    memset(&o->choice, 1, sizeof o->choice);
    for (int i = 0; i < count; i++) {
        const char *name = text[i], *value = i + 1 < count ? text[i + 1] : NULL;
        if (strcmp(name, "--quick") == 0) {
            o->quick = o->is_part = true;
            memset(o->choice.condition, 0, sizeof o->choice.condition);
            o->choice.condition[CHART_DEFAULT] = true;
            continue;
        }
        if (strcmp(name, "--strict") == 0) {
            o->strict = true;
            continue;
        }
        bool known = strcmp(name, "--scenes") == 0 || strcmp(name, "--methods") == 0
                  || strcmp(name, "--from") == 0 || strcmp(name, "--out") == 0
                  || strcmp(name, "--jobs") == 0;
        if (!known)
            return say_no_option(name);
        if (value == NULL)
            return say_bad_usage(name, "wants a value (%s)", help);
        i++;
        if (strcmp(name, "--scenes") == 0 && value[0] != '\0') {
            o->is_part = o->few_scenes = true;
            if ((status = choose_scenes(o, value)) != 0)
                return status;
        } else if (strcmp(name, "--methods") == 0 && value[0] != '\0') {
            o->is_part = true;
            if ((status = choose_methods(o, value)) != 0)
                return status;
        } else if (strcmp(name, "--from") == 0) {
            o->from = value;
        } else if (strcmp(name, "--out") == 0) {
            o->out = value;
        } else if (strcmp(name, "--jobs") == 0) {
            char *end;
            long jobs = strtol(value, &end, 10);
            if (*end != '\0' || jobs < 1 || jobs > 8)
                return say_bad_usage(value, "not 1 to 8 (%s)", help);
            o->jobs = (int)jobs;
        }
    }
    if (o->out == NULL)
        o->out = o->is_part ? "build/chart/part" : "build/chart";
    return 0;
}

/* ------------------------------------------------------------------ progress */

struct watch {
    const struct chart *chart;
    uint32_t program;
    double start;
    bool terminal;
};

#define MEASURED "build/chart/measured.csv"

static bool progress(void *user, int done, int all, const char *what, struct failure *f)
{
    const struct watch *w = user;
    double seconds = wall_seconds() - w->start, left = seconds * (all - done) / done;
    fprintf(stderr, "%schart: %d of %d, %d:%02d, about %d:%02d left: %s%s",
            w->terminal ? "\r\033[K" : "", done, all, (int)seconds / 60, (int)seconds % 60,
            (int)left / 60, (int)left % 60, what, w->terminal && done < all ? "" : "\n");
    fflush(stderr);
    return chart_write_csv(w->chart, NULL, w->program, MEASURED, f);
}

/* ------------------------------------------------------------------ the command */

static bool make_folder(const char *path, struct failure *f)
{
    return mkdir(path, 0777) == 0 || errno == EEXIST
        || fail(f, "cannot make the folder %s (%s)", path, strerror(errno));
}

static bool number_of(const char *program, uint32_t *number, struct failure *f)
{
    enum { MAX_PROGRAM = 1 << 28 };
    uint8_t *bytes;
    size_t size;
    if (!file_read(program, MAX_PROGRAM, &bytes, &size, f))
        return false;
    *number = crc32_update(0, bytes, size);
    free(bytes);
    return true;
}

static bool measure(struct chart *chart, const struct options *o, const char *program,
                    uint32_t number, struct failure *f)
{
    struct watch watch = { chart, number, wall_seconds(), isatty(STDERR_FILENO) != 0 };
    const struct chart_measuring how = {
        .counter = { .program = program, .folder = "build/chart" }, .folder = "build/chart",
        .jobs = o->jobs, .time = !o->quick, .progress = progress, .user = &watch
    };
    return chart_read_csv(chart, &number, MEASURED, f)
        && chart_measure(chart, &o->choice, &how, f);
}

/* Takes out what was not asked for. */
static void keep_chosen(struct chart *chart, const struct chart_choice *choice)
{
    for (int c = 0; c < CHART_CONDITIONS; c++)
        for (int k = 0; k < ALL_KINDS; k++)
            for (int s = 0; s < chart_setting_count; s++)
                if (!chart_is_wanted(choice, c, k, s))
                    chart->value[c][k][s].known = false;
}

/* Models that are not here are left out, and named. */
static void leave_out_models(struct chart_choice *choice)
{
    const char *mark = "";
    for (int k = 0; k < ALL_KINDS; k++) {
        if (!choice->kind[k] || take_is_there(kinds[k].scene))
            continue;
        fprintf(stderr, "%s%s", mark[0] == '\0' ? "chart: left out, as SMEAR_ASSETS names no folder with them: " : mark,
                kinds[k].scene);
        choice->kind[k] = false;
        mark = ", ";
    }
    if (mark[0] != '\0')
        fprintf(stderr, "\n");
}

static bool report(const struct chart *chart, const struct options *o, uint32_t number,
                   struct chart_verdict *verdict, struct failure *f)
{
    char path[512];
    snprintf(path, sizeof path, "%s/chart.csv", o->out);
    if (o->from == NULL && !chart_write_csv(chart, NULL, number, path, f))
        return false;
    snprintf(path, sizeof path, "%s/tables.md", o->out);
    if (!chart_write_tables(chart, path, f) || !chart_write_pictures(chart, o->out, f))
        return false;
    for (int k = 0; k < ALL_KINDS && o->few_scenes; k++)
        if (o->choice.kind[k])
            for (int c = 0; c < CHART_CONDITIONS; c++)
                chart_print_scene(stdout, chart, c, k);
    for (int c = 0; c < CHART_CONDITIONS && !o->few_scenes; c++)
        if (o->choice.condition[c]) {
            chart_print_means(stdout, chart, c);
            chart_print_none(stdout, chart, c);
            printf("\n");
        }
    chart_print_bars(stdout, chart, !o->is_part, 10, verdict);
    printf("\n%d bars met, %d missed, %d not measured. Tables and pictures: %s\n", verdict->met,
           verdict->missed, verdict->unknown, o->out);
    return true;
}

int chart_command(const char *program, int count, char **text)
{
    static struct chart chart;
    struct options o;
    struct failure f = { "" };
    struct chart_verdict verdict;
    uint32_t number = 0;
    int status = read_options(&o, count, text);
    if (status != 0)
        return status;
    if (o.from == NULL)
        leave_out_models(&o.choice);
    bool ok = o.from == NULL || chart_read_csv(&chart, NULL, o.from, &f);
    ok = ok && make_folder("build", &f) && make_folder("build/chart", &f)
      && make_folder(o.out, &f) && number_of(program, &number, &f);
    ok = ok && (o.from != NULL || measure(&chart, &o, program, number, &f));
    keep_chosen(&chart, &o.choice);
    if (!ok || !report(&chart, &o, number, &verdict, &f))
        return say_bad_input(o.from != NULL ? o.from : "chart", &f);
    return o.strict && verdict.missed + verdict.unknown > 0 ? 1 : 0;
}
