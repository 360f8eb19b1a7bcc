/* SPDX-License-Identifier: MIT */
/* output.c - complete files out. New bytes lie beside the old ones and reach the disk, and only then does the name
 * move, which a disk does at once or not at all: when the power goes at any moment, there is the old file or the new. */
#define _XOPEN_SOURCE 700               /* realpath */
#include "tools/image/file.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { MAX_TRIES = 100 };

/* A file that is being written, or that waits for its name. In the list from before it is there until it is gone. */
struct output_name {
    struct output_name *volatile next;
    char *path;                         /* null: text for standard output */
    char *volatile temporary;           /* beside it; null: none is there */
    char *volatile old;                 /* while names are given: what had the name before */
    FILE *device;                       /* where text goes that is no file; else null */
    char *text;                         /* which is put together here */
    size_t text_size;
    bool had_old;
    enum { WRITTEN, COMPLETE, GIVEN } state;    /* still written; waits for its name; has it, unless that is undone */
};

static struct output_name *volatile names;
static bool are_held;

void output_remove_all(void)
{
    for (struct output_name *n = names; n != NULL; n = n->next) {
        if (n->temporary != NULL)
            unlink(n->temporary);
        if (n->old != NULL)
            unlink(n->old);
    }
}

static const char *reason(void)
{
    return errno != 0 ? strerror(errno) : "write error";
}

/* ------------------------------------------------------------------ names */

static void forget(struct output_name *name)
{
    struct output_name *volatile *at = &names;
    while (*at != NULL && *at != name)
        at = &(*at)->next;
    if (*at != NULL)
        *at = name->next;
    if (name->device != NULL)
        fclose(name->device);
    free(name->path);
    free(name->temporary);
    free(name->old);
    free(name->text);
    free(name);
}

/* The file goes; its name is free again. */
static void remove_temporary(struct output_name *name)
{
    if (name->temporary != NULL)
        unlink(name->temporary);
    forget(name);
}

/* At the end of the list: names are given in the order in which files were opened. */
static void append(struct output_name *name)
{
    struct output_name *volatile *at = &names;
    while (*at != NULL)
        at = &(*at)->next;
    *at = name;
}

static struct output_name *new_name(const char *path)
{
    struct output_name *name = calloc(1, sizeof *name);
    if (name != NULL && path != NULL) {
        name->path = malloc(strlen(path) + 1);
        if (name->path == NULL) {
            free(name);
            return NULL;
        }
        memcpy(name->path, path, strlen(path) + 1);
    }
    return name;
}

/* FOLDER/.smear-XXXXXXXXXXXXXXXX.tmp, which may be there already; null without memory. */
static char *temporary_beside(const char *path)
{
    static uint64_t count;
    const char *slash = strrchr(path, '/');
    size_t folder = slash != NULL ? (size_t)(slash - path) + 1 : 0, room = folder + 32;
    struct timespec now = { 0, 0 };
    char *name = malloc(room);
    clock_gettime(CLOCK_REALTIME, &now);
    uint64_t mix = ((uint64_t)now.tv_sec << 30 ^ (uint64_t)now.tv_nsec) + ((uint64_t)getpid() << 40) + count++;
    mix = (mix ^ mix >> 31) * UINT64_C(0x9e3779b97f4a7c15);
    mix ^= mix >> 29;
    if (name != NULL) {
        memcpy(name, path, folder);
        snprintf(name + folder, room - folder, ".smear-%016llx.tmp", (unsigned long long)mix);
    }
    return name;
}

/* ------------------------------------------------------------------ opening */

/* A new file of its own; never one that is there, never one behind a link. */
static int create(struct output_name *name, struct failure *f)
{
    for (int i = 0; i < MAX_TRIES; i++) {
        char *temporary = temporary_beside(name->path);
        if (temporary == NULL) {
            fail(f, "out of memory (file name)");
            return -1;
        }
        int file = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file >= 0) {
            name->temporary = temporary;
            return file;
        }
        free(temporary);
        if (errno != EEXIST)
            break;
    }
    fail(f, "cannot be written (%s)", strerror(errno));
    return -1;
}

bool output_open(struct output *o, const char *path, struct failure *f)
{
    *o = (struct output){ 0 };
    if (!file_is_replaceable(path, f))
        return false;
    struct output_name *name = new_name(path);
    if (name == NULL)
        return fail(f, "out of memory (file name)");
    output_block_signals(true);         /* a file that is there is in the list */
    append(name);
    int file = create(name, f);
    output_block_signals(false);
    if (file >= 0 && (o->stream = fdopen(file, "wb")) == NULL) {
        fail(f, "cannot be written (%s)", strerror(errno));
        close(file);
    }
    if (o->stream == NULL) {
        remove_temporary(name);
        return false;
    }
    o->name = name;
    return true;
}

/* Text that is put together in memory. */
static bool open_memory(struct output *o, const char *path, FILE *device, struct failure *f)
{
    struct output_name *name = new_name(path);
    if (name != NULL) {
        name->device = device;
        device = NULL;
        o->stream = open_memstream(&name->text, &name->text_size);
    }
    if (o->stream == NULL) {
        if (name != NULL)
            forget(name);
        if (device != NULL)
            fclose(device);
        return fail(f, "out of memory");
    }
    append(name);
    o->name = name;
    return true;
}

/* Open files have names there, whatever kind of file they are. */
static bool is_of_system(const char *path)
{
    return strncmp(path, "/dev/", 5) == 0 || strncmp(path, "/proc/", 6) == 0;
}

bool output_open_text(struct output *o, const char *path, struct failure *f)
{
    *o = (struct output){ 0 };
    return strcmp(path, "-") == 0 ? open_memory(o, NULL, NULL, f) : output_open(o, path, f);
}

bool output_open_stream(struct output *o, const char *path, struct failure *f)
{
    struct stat there;
    *o = (struct output){ 0 };
    if (strcmp(path, "-") == 0)
        return open_memory(o, NULL, NULL, f);
    bool is_there = stat(path, &there) == 0;
    if (is_there && (is_of_system(path) || (!S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode)))) {
        FILE *device = file_is_kept(path) ? NULL : fopen(path, "wb");
        if (device == NULL)
            return file_is_replaceable(path, f) && fail(f, "cannot be written (%s)", strerror(errno));
        return open_memory(o, path, device, f);
    }
    char *behind = file_behind_links(path);
    if (behind == NULL)
        return fail(f, "cannot be written (a link that cannot be followed)");
    bool ok = output_open(o, behind, f);
    free(behind);
    return ok;
}

/* ------------------------------------------------------------------ completing */

/* All bytes of a file are on the disk, where its system can say so. */
static bool reach_disk(FILE *stream)
{
    return fsync(fileno(stream)) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS;
}

/* Text goes where it belongs. */
static bool send_text(struct output_name *name)
{
    FILE *to = name->device != NULL ? name->device : stdout;
    bool ok = (name->text_size == 0 || fwrite(name->text, 1, name->text_size, to) == name->text_size) && fflush(to) == 0;
    if (name->device != NULL) {
        name->device = NULL;
        if (fclose(to) != 0)
            ok = false;
    }
    return ok;
}

static bool backup(struct output_name *name, struct failure *f)
{
    struct stat there;
    name->had_old = lstat(name->path, &there) == 0;
    for (int i = 0; name->had_old && i < MAX_TRIES; i++) {
        char *old = temporary_beside(name->path);
        if (old == NULL)
            return fail(f, "out of memory (file name)");
        if (link(name->path, old) == 0) {
            name->old = old;
            break;
        }
        free(old);
        if (errno != EEXIST)            /* a disk without second names: what is replaced can't come back */
            break;
    }
    return true;
}

/* As it was before its name was given. */
static void undo(struct output_name *name)
{
    if (name->state == COMPLETE)
        unlink(name->temporary);
    else if (!name->had_old)
        unlink(name->path);
    else if (name->old != NULL)
        rename(name->old, name->path);
}

/* One name after the other; text last, as nothing takes it back. `failed` is left where that ends. */
static bool give_names(bool are_several, struct output_name **failed, struct failure *f)
{
    for (int texts = 0; texts < 2; texts++)
        for (struct output_name *n = names; n != NULL; n = n->next) {
            if (n->state != COMPLETE || (n->temporary == NULL) != (texts == 1))
                continue;
            errno = 0;
            *failed = n;
            if (texts == 1 ? !send_text(n)
                           : (are_several && !backup(n, f)) || rename(n->temporary, n->path) != 0)
                return fail(f, "cannot be written (%s)", reason());
            n->state = GIVEN;
        }
    return true;
}

bool outputs_publish(const char **failed, struct failure *f)
{
    static char whose[4200];
    struct output_name *at = NULL, *next;
    int count = 0;
    are_held = false;
    for (struct output_name *n = names; n != NULL; n = n->next)
        count += n->state == COMPLETE;
    output_block_signals(true);
    bool ok = give_names(count > 1, &at, f);
    if (!ok) {
        snprintf(whose, sizeof whose, "%s", at->path != NULL ? at->path : "standard output");
        if (failed != NULL)
            *failed = whose;
    }
    for (struct output_name *n = names; n != NULL; n = next) {
        next = n->next;
        if (n->state == WRITTEN)
            continue;
        if (!ok && n->temporary != NULL)
            undo(n);
        if (n->old != NULL)
            unlink(n->old);
        forget(n);
    }
    output_block_signals(false);
    return ok;
}

bool output_commit(struct output *o, struct failure *f)
{
    struct output_name *name = o->name;
    errno = 0;
    bool ok = fflush(o->stream) == 0 && ferror(o->stream) == 0 && (name->temporary == NULL || reach_disk(o->stream));
    int why = errno;
    if (fclose(o->stream) != 0 && ok) {
        ok = false;
        why = errno;
    }
    *o = (struct output){ 0 };
    if (!ok) {
        remove_temporary(name);
        return fail(f, "cannot be written (%s)", why != 0 ? strerror(why) : "write error");
    }
    name->state = COMPLETE;
    return are_held || outputs_publish(NULL, f);
}

void output_discard(struct output *o)
{
    if (o->stream != NULL) {
        fclose(o->stream);
        remove_temporary(o->name);
    }
    *o = (struct output){ 0 };
}

void outputs_hold(void)
{
    are_held = true;
}

void outputs_drop(void)
{
    struct output_name *next;
    are_held = false;
    for (struct output_name *n = names; n != NULL; n = next) {
        next = n->next;
        if (n->state == COMPLETE)
            remove_temporary(n);
    }
}

bool output_flush_standard(struct failure *f)
{
    errno = 0;
    bool ok = fflush(stdout) == 0;
    return (ok && ferror(stdout) == 0) || fail(f, "cannot be written (%s)", reason());
}

/* ------------------------------------------------------------------ interrupts */

/* What a signal ends leaves no unfinished files. */

static const int ending[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ };
enum { ENDINGS = sizeof ending / sizeof *ending };

static void end(int signal_number)
{
    output_remove_all();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

void output_catch_signals(void)
{
    for (int i = 0; i < ENDINGS; i++) {
        struct sigaction action = { .sa_handler = end }, before;
        sigemptyset(&action.sa_mask);
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(ending[i], &action, NULL);
    }
}

void output_block_signals(bool blocked)
{
    static sigset_t before;
    sigset_t those;
    sigemptyset(&those);
    for (int i = 0; i < ENDINGS; i++)
        sigaddset(&those, ending[i]);
    sigaddset(&those, SIGALRM);         /* ends the viewer, some time after one of those */
    if (blocked)
        sigprocmask(SIG_BLOCK, &those, &before);
    else
        sigprocmask(SIG_SETMASK, &before, NULL);
}

/* ------------------------------------------------------------------ places */

/* What a file is and where it lies: whoever opens a name that a stranger wrote asks here. */

#define _XOPEN_SOURCE 700               /* realpath */
#include "tools/image/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Without O_NONBLOCK the opening itself would wait at a pipe; regular files know no such thing. */
FILE *file_open_regular(const char *path, struct failure *f)
{
    struct stat there;
    int file = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (file < 0) {
        fail(f, "cannot be opened (%s)", strerror(errno));
        return NULL;
    }
    FILE *stream = NULL;
    if (fstat(file, &there) != 0)
        fail(f, "cannot be opened (%s)", strerror(errno));
    else if (!S_ISREG(there.st_mode))
        fail(f, "is no regular file");
    else if ((stream = fdopen(file, "rb")) == NULL)
        fail(f, "cannot be opened (%s)", strerror(errno));
    if (stream == NULL)
        close(file);
    return stream;
}

long long file_left(FILE *stream)
{
    struct stat there;
    long at = ftell(stream);
    if (at < 0 || fstat(fileno(stream), &there) != 0 || !S_ISREG(there.st_mode) || there.st_size < at)
        return -1;
    return (long long)there.st_size - at;
}

char *file_behind_links(const char *path)
{
    enum { MAX_LINKS = 16 };
    char *at = malloc(strlen(path) + 1);
    struct stat there;
    if (at != NULL)
        memcpy(at, path, strlen(path) + 1);
    for (int i = 0; at != NULL && lstat(at, &there) == 0 && S_ISLNK(there.st_mode); i++) {
        char target[4096];
        ssize_t length = readlink(at, target, sizeof target);
        const char *slash = strrchr(at, '/');
        size_t folder = slash != NULL && target[0] != '/' ? (size_t)(slash - at) + 1 : 0;
        char *next = i < MAX_LINKS && length > 0 && length < (ssize_t)sizeof target ? malloc(folder + (size_t)length + 1) : NULL;
        if (next != NULL) {
            memcpy(next, at, folder);
            memcpy(next + folder, target, (size_t)length);
            next[folder + (size_t)length] = '\0';
        }
        free(at);
        at = next;
    }
    return at;
}

bool file_lies_in(const char *path, const char *folder, struct failure *f)
{
    char *real = realpath(path, NULL);
    if (real == NULL)
        return fail(f, "cannot be opened (%s)", strerror(errno));
    char *around = realpath(folder[0] != '\0' ? folder : ".", NULL);
    bool ok = around != NULL || fail(f, "cannot be opened (its folder: %s)", strerror(errno));
    size_t length = ok ? strlen(around) : 0;
    while (length > 0 && around[length - 1] == '/')         /* the root */
        length--;
    if (ok && (strncmp(real, around, length) != 0 || real[length] != '/'))
        ok = fail(f, "lies outside of the model's folder (--outside)");
    free(real);
    free(around);
    return ok;
}
