/* SPDX-License-Identifier: MIT */
/* files.c - tools/image/file.h where files are blocks of memory: no other program has any, no power goes, and all that
 * was dropped onto the page lies in one folder. */
#include "tools/image/file.h"
#include "tools/options/apart.h"

#include <errno.h>
#include <string.h>

FILE *file_open_regular(const char *path, struct failure *f)
{
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        fail(f, "cannot be opened (%s)", strerror(errno));
    return stream;
}

long long file_left(FILE *stream)
{
    (void)stream;
    return -1;
}

bool file_lies_in(const char *path, const char *folder, struct failure *f)
{
    (void)path;
    (void)folder;
    (void)f;
    return true;
}

bool output_open(struct output *o, const char *path, struct failure *f)
{
    *o = (struct output){ .stream = fopen(path, "wb") };
    return o->stream != NULL || fail(f, "out of memory");
}

bool output_commit(struct output *o, struct failure *f)
{
    bool ok = ferror(o->stream) == 0;
    ok = fclose(o->stream) == 0 && ok;
    *o = (struct output){ 0 };
    return ok || fail(f, "out of memory");
}

void output_discard(struct output *o)
{
    if (o->stream != NULL)
        fclose(o->stream);
    *o = (struct output){ 0 };
}

bool output_open_text(struct output *o, const char *path, struct failure *f)
{
    return output_open(o, path, f);
}

void outputs_hold(void) {}

void outputs_drop(void) {}

bool outputs_publish(const char **failed, struct failure *f)
{
    (void)failed;
    (void)f;
    return true;
}

bool output_flush_standard(struct failure *f)
{
    return fflush(stdout) == 0 || fail(f, "out of memory");
}

int apart_check(const struct apart_output *list, int count)
{
    (void)list;
    (void)count;
    return 0;
}

int apart_check_inputs(const struct apart_output *list, int count)
{
    return apart_check(list, count);
}
