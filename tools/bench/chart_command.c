/* SPDX-License-Identifier: MIT */
/* chart_command.c - the command `chart`: options, progress, what goes where.
 *
 * Whatever is measured is kept in build/chart/measured.csv together with a number that stands for
 * the program, so that a run goes on where another was stopped, and a changed program measures
 * anew. */
#include "tools/bench/chart.h"

#include "tools/bench/sheet.h"
#include "tools/image/image.h"
#include "tools/options/arguments.h"
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
    bool is_part, few_scenes, quick, marks, strict;
};

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

/* Empty lists, as from a Makefile, choose everything. */
static const char *read_scenes(void *to, const char *list)
{
    static char word[64];
    struct options *o = to;
    if (list[0] != '\0')
        memset(o->choice.kind, 0, sizeof o->choice.kind);
    while (next_word(&list, word)) {
        bool found = false;
        o->is_part = o->few_scenes = true;
        for (int k = 0; k < ALL_KINDS; k++)
            if (strcmp(kinds[k].name, word) == 0)
                found = o->choice.kind[k] = true;
        for (int k = 0; k < ALL_KINDS && !found; k++)
            read_near(word, kinds[k].name);
        if (!found)
            return "has what is no scene of the suite (smear help chart)";
    }
    return NULL;
}

static const char *read_methods(void *to, const char *list)
{
    static char word[64];
    struct options *o = to;
    if (list[0] != '\0')
        memset(o->choice.setting, 0, sizeof o->choice.setting);
    o->choice.setting[chart_none] = true;
    while (next_word(&list, word)) {
        bool found = false;
        o->is_part = true;
        for (int s = 0; s < chart_setting_count; s++)
            if (strncmp(chart_settings[s].name, word, strlen(word)) == 0)
                found = o->choice.setting[s] = true;
        for (int s = 0; s < chart_setting_count && !found; s++)
            read_near(word, chart_settings[s].name);
        if (!found)
            return "has what no setting begins with (smear help chart)";
    }
    return NULL;
}

#define AT(member) OPTION_AT(struct options, member)

static const struct option table[] = {
    { "--scenes", OPTION_READ, .read = read_scenes },
    { "--methods", OPTION_READ, .read = read_methods },
    { "--from", OPTION_TEXT, AT(from) },
    { "--out", OPTION_TEXT, AT(out), .needs = "a folder" },
    { "--jobs", OPTION_INTEGER, AT(jobs), .low = 1, .high = 8 },
    { "--quick", OPTION_FLAG, AT(quick) },
    { "--marks", OPTION_FLAG, AT(marks) },
    { "--strict", OPTION_FLAG, AT(strict) },
    { .name = NULL },
};

static int read_options(struct options *o, int count, char **text)
{
    bool wants_help;
    *o = (struct options){ .jobs = 2 };
    memset(&o->choice, 1, sizeof o->choice);
    int status = arguments_read(count, text, table, o, NULL, 0, &wants_help);
    if (status == STATUS_OK && wants_help)
        return say_bad_usage("chart", "smear help chart lists its options");
    for (int k = 0; k < ALL_KINDS && o->marks; k++)
        o->choice.kind[k] &= chart_set_has(SET_MOVING, k);
    for (int s = 0; s < chart_setting_count && o->marks; s++)
        o->choice.setting[s] &= chart_is_plain(s);
    o->quick |= o->marks;
    if (o->quick) {
        o->is_part = true;
        memset(o->choice.condition, 0, sizeof o->choice.condition);
        o->choice.condition[CHART_DEFAULT] = true;
    }
    if (o->out == NULL)
        o->out = o->is_part ? "build/chart/part" : "build/chart";
    return status;
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
    if (!chart_write_pictures(chart, o->out, f))
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
    chart_print_bars(stdout, chart, !o->is_part, verdict);
    printf("\n%d bars met, %d missed, %d not measured. Numbers and pictures: %s\n", verdict->met,
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
