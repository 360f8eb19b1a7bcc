/* SPDX-License-Identifier: MIT */
/* bench.c - what frames cost and how right they are, beside the bars that are set for them.
 *
 *     bench [peers] [targets FILE...]
 *     bench chart [options]
 *
 * Without arguments, `peers`. `targets` reads what target_bench printed, from files named
 * after their target. Files are kept in build/bench; run it where that is. The exit status says
 * whether everything could be measured; with --strict, whether all bars were met as well. */
#include "tools/bench/chart.h"
#include "tools/bench/count.h"
#include "tools/bench/sheet.h"
#include "tools/bench/take.h"
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
    } groups[] = { { "peers", peers_take }, { "chart", chart_take } };
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (strcmp(groups[i].name, group) == 0)
            return groups[i].take(index, out);
    return false;
}

static int usage(const char *what)
{
    static const char *const reports[] = { "peers", "targets", "--strict" };
    struct guess guess = { .word = what };
    for (size_t i = 0; i < sizeof reports / sizeof *reports; i++)
        guess_try(&guess, reports[i]);
    return say_unknown(what, "no report of bench", &guess, "smear help bench");
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

/* What is asked for: the report on the peers' scenes, and files of targets from `first_file` on. */
struct asked {
    bool peers, strict;
    int first_file;
};

static int read_reports(int count, char **text, struct asked *asked)
{
    *asked = (struct asked){ .first_file = count };
    for (int i = 1; i < count; i++) {
        if (strcmp(text[i], "targets") == 0) {
            asked->first_file = i + 1;
            return i + 1 < count ? 0 : usage("targets, and no file");
        }
        if (strcmp(text[i], "--strict") == 0)
            asked->strict = true;
        else if (strcmp(text[i], "peers") == 0)
            asked->peers = true;
        else
            return usage(text[i]);
    }
    asked->peers = asked->peers || asked->first_file == count;
    return 0;
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    struct sheet sheet = { .folder = "build/bench",
                           .counter = { .program = argv[0], .folder = "build/bench" } };
    struct asked asked;
    if (argc == 4 && strcmp(argv[1], "--draw") == 0)
        return serve(argv + 2);
    if (argc >= 2 && strcmp(argv[1], "chart") == 0)
        return chart_command(argv[0], argc - 2, argv + 2);
    const int status = read_reports(argc, argv, &asked);
    if (status != 0)
        return status;
    if (!make_folder("build", &f) || !make_folder(sheet.folder, &f))
        return finish(false, sheet.folder, &f);
    if (asked.peers && !peers_report(&sheet, &f))
        return finish(false, "peers", &f);
    for (int i = asked.first_file; i < argc; i++) {
        printf("\n");
        if (!targets_report(&sheet, argv[i], &f))
            return finish(false, "targets", &f);
    }
    printf("\n%d of %d bars met\n", sheet.met, sheet.met + sheet.missed);
    return asked.strict && sheet.missed > 0 ? 1 : 0;
}
