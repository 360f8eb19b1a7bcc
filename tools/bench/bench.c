/* SPDX-License-Identifier: MIT */
/* bench.c - what frames cost and how right they are, beside the bars that are set for them.
 *
 *     bench [peers] [accuracy] [filters] [formats] [targets FILE...]
 *     bench chart [options]
 *     bench promise [options]
 *
 * Without arguments, all but `targets`. `targets` reads what target_bench printed, from files named
 * after their target. Files are kept in build/bench; run it where that is. The exit status says
 * whether everything could be measured; with --strict, whether all bars were met as well. */
#include "tools/bench/chart.h"
#include "tools/bench/count.h"
#include "tools/bench/groups.h"
#include "tools/bench/promise.h"
#include "tools/bench/sheet.h"
#include "tools/options/say.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool group_take(const char *group, int index, struct take *out)
{
    static const struct {
        const char *name;
        bool (*take)(int index, struct take *out);
    } groups[] = { { "peers", peers_take }, { "filters", filters_take }, { "chart", chart_take }, { "promise", promise_take } };
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (strcmp(groups[i].name, group) == 0)
            return groups[i].take(index, out);
    return false;
}

struct report {
    const char *name;
    bool (*print)(struct sheet *sheet, struct failure *f);
};

static const struct report reports[] = {
    { "peers", peers_report }, { "accuracy", accuracy_report }, { "filters", filters_report }, { "formats", formats_report },
};
enum { REPORTS = sizeof reports / sizeof *reports };

static int usage(const char *what)
{
    struct guess guess = { .word = what };
    for (int i = 0; i < REPORTS; i++)
        guess_try(&guess, reports[i].name);
    guess_try(&guess, "promise");
    guess_try(&guess, "targets");
    guess_try(&guess, "--strict");
    return say_unknown(what, "no report of bench", &guess, "smear help bench");
}

static const struct report *find_report(const char *name)
{
    for (int i = 0; i < REPORTS; i++)
        if (strcmp(reports[i].name, name) == 0)
            return &reports[i];
    return NULL;
}

static bool make_folder(const char *path, struct failure *f)
{
    return mkdir(path, 0777) == 0 || errno == EEXIST
        || fail(f, "cannot make the folder (%s)", strerror(errno));
}

static int finish(bool ok, const char *what, const struct failure *f)
{
    if (!ok)
        fprintf(stderr, "smear: %s: %s\n", what, f->text);
    return ok ? 0 : 1;
}

static int serve(char **argument)
{
    struct failure f = { "" };
    return finish(count_serve(argument[0], argument[1], &f), argument[0], &f);
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    struct sheet sheet = { .folder = "build/bench",
                           .counter = { .program = argv[0], .folder = "build/bench" } };
    bool strict = false, ok = true;
    int asked = 0;
    if (argc == 4 && strcmp(argv[1], "--draw") == 0)
        return serve(argv + 2);
    if (argc >= 2 && strcmp(argv[1], "chart") == 0)
        return chart_command(argv[0], argc - 2, argv + 2);
    if (argc >= 2 && strcmp(argv[1], "promise") == 0)
        return promise_command(argv[0], argc - 2, argv + 2);
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "targets") == 0) {
            if (i + 1 == argc)
                return usage("targets, and no file");
            break;
        }
        if (strcmp(argv[i], "--strict") != 0 && find_report(argv[i]) == NULL)
            return usage(argv[i]);
    }
    if (!make_folder("build", &f) || !make_folder(sheet.folder, &f))
        return finish(false, sheet.folder, &f);
    for (int i = 1; i < argc && ok; i++) {
        const struct report *report = find_report(argv[i]);
        if (strcmp(argv[i], "--strict") == 0) {
            strict = true;
            continue;
        }
        asked++;
        if (report != NULL) {
            ok = report->print(&sheet, &f);
        } else {
            for (i++; i < argc && ok; i++) {
                ok = targets_report(&sheet, argv[i], &f);
                if (i + 1 < argc)
                    printf("\n");
            }
        }
        if (!ok)
            return finish(false, report != NULL ? report->name : "targets", &f);
        printf("\n");
    }
    for (int i = 0; i < REPORTS && asked == 0; i++) {
        if (!reports[i].print(&sheet, &f))
            return finish(false, reports[i].name, &f);
        printf("\n");
    }
    printf("%d of %d bars met\n", sheet.met, sheet.met + sheet.missed);
    return strict && sheet.missed > 0 ? 1 : 0;
}
