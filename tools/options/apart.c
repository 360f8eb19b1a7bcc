/* SPDX-License-Identifier: MIT */
/* apart.c - see apart.h. A name says what will be written; what is there already says what that is: so the folders of
 * patterns are looked through for links, instead of asking the disk for every number. */
#include "tools/options/apart.h"

#include "tools/image/file.h"
#include "tools/options/say.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_PATH = 4096, MAX_NUMBER = 9 };

/* A file or folder, by whatever name. */
struct identity {
    bool is_there;
    dev_t device;
    ino_t number;
};

/* Where a name leads to, links followed: a file that is there, or may be made there. */
struct place {
    struct identity file, folder;
    char *folder_name, *name;
};

/* An output: the names that it may give, and where those lead to that are there and are links, or have other names. */
struct written {
    const struct apart_output *from;
    struct identity folder;
    char folder_name[MAX_PATH];     /* ends with a slash, or is empty */
    const char *name;               /* or the pattern */
    struct place *place;
    int count, room;
};

static struct identity identity_of(const char *path)
{
    struct stat there;
    bool ok = stat(path[0] != '\0' ? path : ".", &there) == 0;
    return ok ? (struct identity){ true, there.st_dev, there.st_ino } : (struct identity){ .is_there = false };
}

static bool is_same(const struct identity *a, const struct identity *b)
{
    return a->is_there && b->is_there && a->device == b->device && a->number == b->number;
}

/* Folders that are not there have nothing but their names. */
static bool is_same_folder(const struct identity *a, const char *name_a, const struct identity *b, const char *name_b)
{
    return is_same(a, b) || (!a->is_there && !b->is_there && strcmp(name_a, name_b) == 0);
}

/* Parts a path; false where the folder's name is too long. */
static bool split(const char *path, char folder[MAX_PATH], const char **name)
{
    const char *slash = strrchr(path, '/');
    *name = slash != NULL ? slash + 1 : path;
    int length = snprintf(folder, MAX_PATH, "%.*s", (int)(*name - path), path);
    return length >= 0 && length < MAX_PATH;
}

/* ------------------------------------------------------------------ names */

/* A pattern in parts: what stands before its number and behind it, and how many digits the number has at least. */
struct pattern {
    size_t head;
    const char *tail;
    int digits;
};

static struct pattern pattern_of(const char *name)
{
    const char *percent = strrchr(name, '%'), *d = strchr(percent, 'd');
    return (struct pattern){ .head = (size_t)(percent - name), .tail = d + 1, .digits = percent[1] == '0' ? percent[2] - '0' : 1 };
}

/* Whether the output gives a file this name. */
static bool gives(const struct written *o, const char *name)
{
    if (!o->from->is_pattern)
        return strcmp(o->name, name) == 0;
    struct pattern p = pattern_of(o->name);
    size_t length = strlen(name), tail = strlen(p.tail);
    if (length <= p.head + tail || memcmp(o->name, name, p.head) != 0 || strcmp(name + length - tail, p.tail) != 0)
        return false;
    const char *number = name + p.head;
    int digits = (int)(length - p.head - tail);
    if (digits < p.digits || digits > MAX_NUMBER || (int)strspn(number, "0123456789") < digits
        || (digits > p.digits && number[0] == '0'))
        return false;
    long value = 0;
    for (int i = 0; i < digits; i++)
        value = value * 10 + (number[i] - '0');
    return value >= o->from->first && value <= o->from->last;
}

/* Whether two patterns may give one name, for some number of `a`. Alike around their numbers, they do when they write the
 * largest that both have alike; else what stands around the numbers has to fit. */
static bool patterns_meet(const struct written *a, const struct written *b)
{
    struct pattern p = pattern_of(a->name), q = pattern_of(b->name);
    size_t tail_p = strlen(p.tail), tail_q = strlen(q.tail), head = p.head < q.head ? p.head : q.head;
    size_t tail = tail_p < tail_q ? tail_p : tail_q;
    char name[MAX_PATH];
    if (memcmp(a->name, b->name, head) != 0 || strcmp(p.tail + tail_p - tail, q.tail + tail_q - tail) != 0)
        return false;
    bool are_alike = p.head == q.head && tail_p == tail_q;
    long last = are_alike && b->from->last < a->from->last ? b->from->last : a->from->last;
    for (long i = are_alike && last > a->from->first ? last : a->from->first; i <= last; i++) {
        int length = snprintf(name, sizeof name, "%.*s%0*ld%s", (int)p.head, a->name, p.digits, i, p.tail);
        if (length > 0 && length < (int)sizeof name && gives(b, name))
            return true;
    }
    return false;
}

static bool names_meet(const struct written *a, const struct written *b)
{
    if (!is_same_folder(&a->folder, a->folder_name, &b->folder, b->folder_name))
        return false;
    if (a->from->is_pattern && b->from->is_pattern)
        return patterns_meet(a, b);
    return a->from->is_pattern ? gives(a, b->name) : gives(b, a->name);
}

/* ------------------------------------------------------------------ what is there */

static char *copy(const char *text)
{
    char *out = malloc(strlen(text) + 1);
    if (out != NULL)
        memcpy(out, text, strlen(text) + 1);
    return out;
}

/* Adds where the path leads to; false without memory. A link that leads in circles leads to itself. */
static bool add_place(struct written *o, const char *path)
{
    char folder[MAX_PATH], *behind = file_behind_links(path);
    const char *name;
    if (o->count == o->room) {
        int room = o->room > 0 ? o->room * 2 : 4;
        struct place *more = realloc(o->place, (size_t)room * sizeof *more);
        if (more == NULL) {
            free(behind);
            return false;
        }
        o->place = more;
        o->room = room;
    }
    bool ok = split(behind != NULL ? behind : path, folder, &name);
    struct place *p = &o->place[o->count];
    *p = (struct place){ .file = identity_of(path), .folder = identity_of(ok ? folder : ""), .folder_name = copy(ok ? folder : ""),
                         .name = copy(name) };
    o->count++;
    free(behind);
    return p->folder_name != NULL && p->name != NULL;
}

/* Of the files that a pattern's names have already, those that may have other names, too. */
static bool add_entries(struct written *o)
{
    char path[MAX_PATH];
    bool ok = true;
    DIR *folder = opendir(o->folder_name[0] != '\0' ? o->folder_name : ".");
    for (struct dirent *e; ok && folder != NULL && (e = readdir(folder)) != NULL;) {
        struct stat there;
        int length = snprintf(path, sizeof path, "%s%s", o->folder_name, e->d_name);
        if (length > 0 && length < (int)sizeof path && gives(o, e->d_name) && lstat(path, &there) == 0
            && (S_ISLNK(there.st_mode) || there.st_nlink > 1))
            ok = add_place(o, path);
    }
    if (folder != NULL)
        closedir(folder);
    return ok;
}

/* Text on standard output goes into the file that it leads to. */
static bool look_at_standard(struct written *o)
{
    struct stat there;
    o->place = calloc(1, sizeof *o->place);
    if (o->place == NULL)
        return false;
    o->count = o->room = 1;
    if (fstat(STDOUT_FILENO, &there) == 0 && S_ISREG(there.st_mode))
        o->place[0].file = (struct identity){ true, there.st_dev, there.st_ino };
    o->place[0].folder_name = copy("-");
    o->place[0].name = copy("-");
    return o->place[0].folder_name != NULL && o->place[0].name != NULL;
}

static bool look(struct written *o, const struct apart_output *from)
{
    *o = (struct written){ .from = from };
    if (strcmp(from->path, "-") == 0) {
        o->name = "-";
        snprintf(o->folder_name, sizeof o->folder_name, "-");
        return look_at_standard(o);
    }
    if (!split(from->path, o->folder_name, &o->name))
        return true;                /* no disk takes that; writing it says so */
    o->folder = identity_of(o->folder_name);
    return from->is_pattern ? add_entries(o) : add_place(o, from->path);
}

static void forget(struct written *o)
{
    for (int i = 0; i < o->count; i++) {
        free(o->place[i].folder_name);
        free(o->place[i].name);
    }
    free(o->place);
    *o = (struct written){ .from = NULL };
}

/* ------------------------------------------------------------------ two of them */

static bool leads_to(const struct place *p, const struct written *o)
{
    return is_same_folder(&p->folder, p->folder_name, &o->folder, o->folder_name) && gives(o, p->name);
}

static bool are_one(const struct written *a, const struct written *b)
{
    if (names_meet(a, b))
        return true;
    for (int i = 0; i < a->count; i++)
        if (leads_to(&a->place[i], b))
            return true;
    for (int k = 0; k < b->count; k++)
        if (leads_to(&b->place[k], a))
            return true;
    for (int i = 0; i < a->count; i++)
        for (int k = 0; k < b->count; k++) {
            const struct place *p = &a->place[i], *q = &b->place[k];
            if (is_same(&p->file, &q->file)
                || (is_same_folder(&p->folder, p->folder_name, &q->folder, q->folder_name) && strcmp(p->name, q->name) == 0))
                return true;
        }
    return false;
}

static int no_memory(void)
{
    struct failure f = { "" };
    fail(&f, "out of memory");
    return say_bad_input("the names of outputs", &f);
}

int apart_check(const struct apart_output *list, int count)
{
    int status = STATUS_OK;
    struct written *output = calloc((size_t)count + 1, sizeof *output);
    if (output == NULL)
        return no_memory();
    for (int i = 0; i < count && status == STATUS_OK; i++) {
        if (list[i].path == NULL)
            continue;
        if (!look(&output[i], &list[i]))
            status = no_memory();
        for (int k = 0; k < i && status == STATUS_OK; k++)
            if (output[k].from != NULL && are_one(&output[i], &output[k]))
                status = say_bad_usage(list[i].path, "is to be written twice: it is %s, too", list[k].path);
    }
    for (int i = 0; i < count; i++)
        forget(&output[i]);
    free(output);
    return status;
}

int apart_check_inputs(const struct apart_output *list, int count)
{
    int status = STATUS_OK;
    for (int i = 0; i < count && status == STATUS_OK; i++) {
        struct written o;
        char path[2 * MAX_PATH];
        if (list[i].path == NULL || strcmp(list[i].path, "-") == 0)
            continue;
        bool is_read = !list[i].is_pattern && file_is_kept(list[i].path);
        o = (struct written){ .from = &list[i] };
        DIR *folder = list[i].is_pattern && split(list[i].path, o.folder_name, &o.name)
                        ? opendir(o.folder_name[0] != '\0' ? o.folder_name : ".") : NULL;
        for (struct dirent *e; !is_read && folder != NULL && (e = readdir(folder)) != NULL;) {
            snprintf(path, sizeof path, "%s%s", o.folder_name, e->d_name);
            is_read = gives(&o, e->d_name) && file_is_kept(path);
        }
        if (folder != NULL)
            closedir(folder);
        if (is_read)
            status = say_bad_usage(list[i].path, "cannot be written (it has been read, and would be lost)");
    }
    return status;
}
