/* SPDX-License-Identifier: MIT */
/* count.c - starts callgrind, and reads the totals of its dumps: one for every call of
 * bench_frame. */
#include "tools/bench/count.h"

#include "tools/bench/take.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATH_LIMIT = 512, NOT_RUN = 127 };

/* ------------------------------------------------------------------ running */

/* The exit status, NOT_RUN when there is no such program, or -1. Output goes to the file `log`. */
static int run(char *const argument[], const char *log)
{
    int status;
    pid_t child = fork();
    if (child < 0)
        return -1;
    if (child == 0) {
        int out = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (out >= 0) {
            dup2(out, STDOUT_FILENO);
            dup2(out, STDERR_FILENO);
        }
        execvp(argument[0], argument);
        _exit(NOT_RUN);
    }
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static bool path_in(char out[PATH_LIMIT], const struct counter *counter, const char *name)
{
    int length = snprintf(out, PATH_LIMIT, "%s/%s", counter->folder, name);
    return length > 0 && length < PATH_LIMIT;
}

/* ------------------------------------------------------------------ reading */

/* The number after `key` at the start of some line. */
static bool read_total(const char *path, uint64_t *total, struct failure *f)
{
    static const char key[] = "totals: ";
    char line[1024];
    bool found = false;
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return fail(f, "callgrind left no dump (%s)", path);
    while (!found && fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, key, sizeof key - 1) == 0)
            found = sscanf(line + sizeof key - 1, "%" SCNu64, total) == 1;
    fclose(file);
    return found || fail(f, "a dump of callgrind has no total (%s)", path);
}

static bool read_dumps(const char *base, int frames, uint64_t *instructions, struct failure *f)
{
    char path[PATH_LIMIT + 16];
    bool ok = true;
    for (int i = 0; i < frames; i++) {
        snprintf(path, sizeof path, "%s.%d", base, i + 1);
        ok = ok && read_total(path, &instructions[i], f);
        remove(path);
    }
    remove(base);           /* what was collected after the last frame: nothing */
    return ok;
}

/* The numbers with commas; malloc'ed. */
static char *list_text(const int *index, int count)
{
    size_t room = (size_t)count * 12 + 1, at = 0;
    char *text = malloc(room);
    if (text != NULL)
        text[0] = '\0';
    for (int i = 0; i < count && text != NULL; i++)
        at += (size_t)snprintf(text + at, room - at, i > 0 ? ",%d" : "%d", index[i]);
    return text;
}

/* On a terminal, what is being counted: callgrind takes its time. */
static void tell(const char *group, int frames)
{
    if (isatty(STDERR_FILENO) == 0)
        return;
    if (frames > 0)
        fprintf(stderr, "\r\033[Kbench: %s: counting instructions of %d frames ...", group, frames);
    else
        fprintf(stderr, "\r\033[K");
}

bool count_list(const struct counter *counter, const char *group, const int *index, int frames, uint64_t *instructions,
                struct failure *f)
{
    char base[PATH_LIMIT], log[PATH_LIMIT], out[PATH_LIMIT + 64], name[64];
    snprintf(name, sizeof name, "count.%ld.%d", (long)getpid(), index[0]);
    if (!path_in(base, counter, name))
        return fail(f, "the folder's name is too long");
    snprintf(name, sizeof name, "valgrind.%d.log", index[0]);
    if (!path_in(log, counter, name))
        return fail(f, "the folder's name is too long");
    snprintf(out, sizeof out, "--callgrind-out-file=%s", base);
    char *list = list_text(index, frames);
    if (list == NULL)
        return fail(f, "out of memory");
    /* execvp takes pointers to char for history's sake and changes nothing. */
    char *const argument[] = {
        (char *)"valgrind", (char *)"--tool=callgrind", (char *)"--dump-after=bench_frame", (char *)"--toggle-collect=bench_frame",
        out, (char *)counter->program, (char *)"--draw", (char *)group, list, NULL
    };
    tell(group, frames);
    int status = run(argument, log);
    tell(group, 0);
    free(list);
    if (status == NOT_RUN)
        return fail(f, "valgrind is not there");
    if (status != 0)
        return fail(f, "callgrind failed with status %d (see %s)", status, log);
    remove(log);
    return read_dumps(base, frames, instructions, f);
}

bool count_takes(const struct counter *counter, const char *group, int first, int frames, uint64_t *instructions,
                 struct failure *f)
{
    int index[COUNT_MAX_FRAMES];
    if (frames > COUNT_MAX_FRAMES)
        return fail(f, "too many takes at once (%d)", frames);
    for (int i = 0; i < frames; i++)
        index[i] = first + i;
    return count_list(counter, group, index, frames, instructions, f);
}

/* ------------------------------------------------------------------ the other side */

/* Takes that differ in their frame alone share a rig. */
static bool same_rig(const struct take *a, const struct take *b)
{
    return strcmp(a->scene, b->scene) == 0 && a->width == b->width && a->height == b->height
        && a->windowed == b->windowed && a->band_rows == b->band_rows
        && a->format == b->format && a->dithered == b->dithered && a->plain_context == b->plain_context
        && a->method == b->method && a->samples == b->samples
        && a->reconstruct == b->reconstruct && a->plain == b->plain
        && a->target == b->target && a->reach == b->reach && a->filter == b->filter
        && a->camera_step == b->camera_step && a->weights == b->weights
        && memcmp(&a->pingpong, &b->pingpong, sizeof a->pingpong) == 0 && a->shutter_poses == b->shutter_poses
        && a->workers == b->workers && a->texels_565 == b->texels_565
        && a->linear == b->linear && a->instant_only == b->instant_only && a->later == b->later;
}

bool count_serve(const char *group, const char *list, struct failure *f)
{
    struct rig rig;
    struct take last = { 0 };
    bool is_open = false, ok = true;
    for (const char *at = list; ok && *at != '\0'; at += *at == ',') {
        struct take take;
        char *end;
        long index = strtol(at, &end, 10);
        if (end == at || index < 0 || index > INT_MAX || !group_take(group, (int)index, &take)) {
            ok = fail(f, "no such take (%s %s)", group, at);
            break;
        }
        at = end;
        if (is_open && same_rig(&take, &last)) {
            ok = rig_seek(&rig, take.frame, f);
        } else {
            if (is_open)
                rig_close(&rig);
            ok = is_open = rig_open(&rig, &take, f);
        }
        last = take;
        ok = ok && rig_draw(&rig, f);
    }
    if (is_open)
        rig_close(&rig);
    return ok;
}
