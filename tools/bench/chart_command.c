/* SPDX-License-Identifier: MIT */
/* chart_command.c - the command `chart`: options, progress, what goes where.
 *
 * Whatever is measured is kept in build/chart/measured.csv together with a number that stands for
 * the program, so that a run goes on where another was stopped, and a changed program measures
 * anew. */
#include "tools/bench/chart.h"

#include "tools/image/image.h"
#include "tools/bench/sheet.h"

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

static int bad_usage(const char *what, const char *text)
{
    fprintf(stderr, "smear: %s: %s (smear help chart)\n", what, text);
    return 2;
}

static int bad_input(const char *what, const struct failure *f)
{
    fprintf(stderr, "smear: %s: %s\n", what, f->text);
    return 1;
}

/* ------------------------------------------------------------------ options */

/* The next word of a list with commas; its length, or 0 at the end. */
static size_t next_word(const char **list, const char **word)
{
    *list += strspn(*list, ",");
    *word = *list;
    size_t length = strcspn(*list, ",");
    *list += length;
    return length;
}

static bool choose_scenes(struct options *o, const char *list)
{
    const char *word;
    memset(o->choice.kind, 0, sizeof o->choice.kind);
    for (size_t n; (n = next_word(&list, &word)) > 0;) {
        int found = -1;
        for (int k = 0; k < ALL_KINDS; k++)
            if (strlen(kinds[k].name) == n && strncmp(kinds[k].name, word, n) == 0)
                found = k;
        if (found < 0)
            return false;
        o->choice.kind[found] = true;
    }
    return true;
}

static bool choose_methods(struct options *o, const char *list)
{
    const char *word;
    memset(o->choice.setting, 0, sizeof o->choice.setting);
    o->choice.setting[chart_none] = true;
    for (size_t n; (n = next_word(&list, &word)) > 0;) {
        bool found = false;
        for (int s = 0; s < chart_setting_count; s++)
            if (strncmp(chart_settings[s].name, word, n) == 0)
                found = o->choice.setting[s] = true;
        if (!found)
            return false;
    }
    return true;
}

/* 0, or an exit status. Empty lists, as from a Makefile, choose everything. */
static int read_options(struct options *o, int count, char **text)
{
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
            return bad_usage(name, "unknown option");
        if (value == NULL)
            return bad_usage(name, "wants a value");
        i++;
        if (strcmp(name, "--scenes") == 0 && value[0] != '\0') {
            o->is_part = o->few_scenes = true;
            if (!choose_scenes(o, value))
                return bad_usage(value, "not scenes of the suite");
        } else if (strcmp(name, "--methods") == 0 && value[0] != '\0') {
            o->is_part = true;
            if (!choose_methods(o, value))
                return bad_usage(value, "no setting begins so");
        } else if (strcmp(name, "--from") == 0) {
            o->from = value;
        } else if (strcmp(name, "--out") == 0) {
            o->out = value;
        } else if (strcmp(name, "--jobs") == 0) {
            char *end;
            long jobs = strtol(value, &end, 10);
            if (*end != '\0' || jobs < 1 || jobs > 8)
                return bad_usage(value, "not 1 to 8");
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
        return bad_input(o.from != NULL ? o.from : "chart", &f);
    return o.strict && verdict.missed + verdict.unknown > 0 ? 1 : 0;
}
