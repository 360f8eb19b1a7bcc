/* SPDX-License-Identifier: MIT */
/* injected.c - the program smear with every fault there is, one at a time (after the tests of SQLite and littlefs):
 * each allocation, open, read, write, synchronisation, close, rename and thread of these commands fails once, and the
 * power goes before each change of a disk. What must hold: no crash; one line says what is wrong; outputs are all
 * there and right, or as they were; no other file is touched, none is left behind. After a power cut each output is
 * the old or the new one, whole.
 *
 *     faults-injected ROOT [COMMAND]       ROOT: the repository; COMMAND: only that of this number
 */
#define _GNU_SOURCE                     /* MAP_ANONYMOUS, mkdtemp */
#include "tests/faults/faults.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

int __real_main(int argc, char **argv);
int __wrap_main(int argc, char **argv);

enum { MAX_ARGS = 24, MAX_OUTPUTS = 6, MAX_FILES = 64, SECONDS = 60, MAX_SHOWN = 20 };

static const struct command {
    const char *text;                   /* words with blanks between them */
    const char *output[MAX_OUTPUTS];
} commands[] = {
    { "help", { NULL } },
    { "render model.gltf --size 8x8 -o a.png --depth d.pfm --stats s.json", { "a.png", "d.pfm", "s.json" } },
    { "render model.gltf --size 8x8 --stats -", { NULL } },
    { "render builtin:demo/drone --size 8x8 --frames 0-1 -o a.gif --velocity v%d.pfm", { "a.gif", "v0.pfm", "v1.pfm" } },
    { "render card.obj --size 8x8 --frames 0-1 -o a.apng", { "a.apng" } },
    { "render model.gltf --size 8x8 --method accumulate --exact --samples 2 --threads 3 -o a%d.ppm --frames 0-1",
      { "a0.ppm", "a1.ppm" } },
    { "render model.gltf --size 8x8 --method object --mask flag --motion elbow=none -o a.pfm", { "a.pfm" } },
    { "render model.gltf --size 8x8 --arena 60000 --method reconstruct -o a.ppm", { "a.ppm" } },
    { "convert model.gltf -o m.h", { "m.h" } },
    { "convert model.gltf -o m.smr --texture rgb565 --clip wave", { "m.smr" } },
    { "convert card.obj -o -", { NULL } },
    { "convert card.obj --kit kit -o m.zip", { "m.zip" } },
    { "compare one.ppm two.ppm --diff d.png", { "d.png" } },
    { "compare one.ppm one.png", { NULL } },
    { "info card.obj", { NULL } },
    { "info photo.obj", { NULL } },
    { "view builtin:demo/drone --size 8x8 --out null --frames 2 --check list --update", { "list", "list.0000.png", "list.0001.png" } },
    { "view model.gltf --size 8x8 --out null --frames 2 --crc --record rec", { "rec" } },
    { "view card.obj --size 8x8 --out null --frames 2 --play keys --split none --see velocity", { NULL } },
};

struct bytes {
    char name[256];
    char *data;
    size_t size;
};

static struct folder {
    struct bytes file[MAX_FILES];
    int count;
} before, after, wanted;

static char home[4096];
static long failures, injected, cuts;

/* ------------------------------------------------------------------ folders */

static bool read_bytes(const char *path, struct bytes *out)
{
    struct stat there;
    int file = open(path, O_RDONLY);
    if (file < 0 || fstat(file, &there) != 0)
        return false;
    out->size = (size_t)there.st_size;
    out->data = malloc(out->size + 1);
    bool ok = out->data != NULL && read(file, out->data, out->size) == (ssize_t)out->size;
    close(file);
    return ok;
}

static void write_bytes(const char *path, const void *data, size_t size)
{
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || write(file, data, size) != (ssize_t)size || close(file) != 0) {
        perror(path);
        exit(1);
    }
}

static void forget(struct folder *f)
{
    for (int i = 0; i < f->count; i++)
        free(f->file[i].data);
    f->count = 0;
}

static void look(struct folder *f)
{
    DIR *list = opendir(home);
    struct dirent *entry;
    forget(f);
    while (list != NULL && f->count < MAX_FILES && (entry = readdir(list)) != NULL) {
        struct bytes *b = &f->file[f->count];
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        snprintf(b->name, sizeof b->name, "%s", entry->d_name);
        f->count += read_bytes(entry->d_name, b);
    }
    closedir(list);
}

static const struct bytes *find(const struct folder *f, const char *name)
{
    for (int i = 0; i < f->count; i++)
        if (strcmp(f->file[i].name, name) == 0)
            return &f->file[i];
    return NULL;
}

static bool is_same(const struct bytes *a, const struct bytes *b)
{
    return a != NULL && b != NULL && a->size == b->size && memcmp(a->data, b->data, a->size) == 0;
}

static void restore(void)
{
    for (int i = 0; i < after.count; i++)
        if (find(&before, after.file[i].name) == NULL)
            unlink(after.file[i].name);
    for (int i = 0; i < before.count; i++)
        if (!is_same(&before.file[i], find(&after, before.file[i].name)))
            write_bytes(before.file[i].name, before.file[i].data, before.file[i].size);
}

/* ------------------------------------------------------------------ one run */

struct outcome {
    int status;                 /* 256: it crashed */
    int lines;                  /* on standard error */
    char text[400];
};

static struct outcome run(const struct command *c, enum fault_mode mode, long at, struct fault_counts *shared)
{
    struct outcome o = { 0 };
    struct bytes said = { .data = NULL };
    memset(shared, 0, sizeof *shared);
    pid_t child = fork();
    if (child == 0) {
        static char text[400], *args[MAX_ARGS] = { "smear" };
        int count = 1, err = open("../err", O_WRONLY | O_CREAT | O_TRUNC, 0644), out = open("../out", O_WRONLY | O_CREAT | O_TRUNC, 0644);
        dup2(err, 2);
        dup2(out, 1);
        close(err);
        close(out);
        close(0);
        snprintf(text, sizeof text, "%s", c->text);
        for (char *word = strtok(text, " "); word != NULL && count < MAX_ARGS; word = strtok(NULL, " "))
            args[count++] = word;
        alarm(SECONDS);
        faults_begin(shared, mode, at);
        _exit(__real_main(count, args));
    }
    int status = 0;
    waitpid(child, &status, 0);
    o.status = WIFEXITED(status) ? WEXITSTATUS(status) : 256;
    if (read_bytes("../err", &said)) {
        snprintf(o.text, sizeof o.text, "%.*s", (int)said.size, said.data);
        for (size_t i = 0; i < said.size; i++)
            o.lines += said.data[i] == '\n';
    }
    free(said.data);
    return o;
}

static void complain(const struct command *c, const struct fault_counts *counts, long at, const char *what, const struct outcome *o)
{
    if (failures++ < MAX_SHOWN)
        printf("FAIL: %s: fault %ld (%s): %s: exit %d: %s\n", c->text, at, fault_names[counts->hit], what, o->status, o->text);
}

/* Statistics hold times, which never are the same: they must be whole. */
static bool is_right(const struct bytes *got, const struct bytes *want)
{
    static const char begin[] = "{\"frames\":[", end[] = "]}\n";
    if (got == NULL || want == NULL)
        return got == want;
    if (strcmp(got->name, "s.json") != 0)
        return is_same(got, want);
    return got->size > sizeof begin + sizeof end && memcmp(got->data, begin, sizeof begin - 1) == 0
        && memcmp(got->data + got->size - (sizeof end - 1), end, sizeof end - 1) == 0;
}

static bool is_output(const struct command *c, const char *name)
{
    for (int i = 0; i < MAX_OUTPUTS && c->output[i] != NULL; i++)
        if (strcmp(c->output[i], name) == 0)
            return true;
    return false;
}

static bool is_temporary(const char *name)
{
    return strncmp(name, ".smear-", 7) == 0;
}

/* Files that are no outputs are as they were; after a power cut unfinished ones may lie there. */
static bool others_stay(const struct command *c, bool power)
{
    for (int i = 0; i < after.count; i++)
        if (!is_output(c, after.file[i].name) && !(power && is_temporary(after.file[i].name))
            && !is_same(&after.file[i], find(&before, after.file[i].name)))
            return false;
    for (int i = 0; i < before.count; i++)
        if (find(&after, before.file[i].name) == NULL)
            return false;
    return true;
}

static void check_failed(const struct command *c, const struct fault_counts *counts, long at, const struct outcome *o)
{
    bool are_old = true, are_new = true;
    look(&after);
    for (int i = 0; i < MAX_OUTPUTS && c->output[i] != NULL; i++) {
        are_old = are_old && is_same(find(&after, c->output[i]), find(&before, c->output[i]));
        are_new = are_new && is_right(find(&after, c->output[i]), find(&wanted, c->output[i]));
    }
    if (o->status > 2)
        complain(c, counts, at, "crashes", o);
    else if (!others_stay(c, false))
        complain(c, counts, at, "touches another file", o);
    else if (o->status == 0 && !are_new && strstr(o->text, "warning") == NULL)
        complain(c, counts, at, "succeeds with wrong outputs", o);
    else if (o->status != 0 && (o->lines != 1 || strncmp(o->text, "smear: ", 7) != 0))
        complain(c, counts, at, "does not say one line", o);
    else if (o->status != 0 && !are_old)
        complain(c, counts, at, "fails, and has changed an output", o);
    restore();
}

static void check_cut(const struct command *c, const struct fault_counts *counts, long at, const struct outcome *o)
{
    look(&after);
    for (int i = 0; i < MAX_OUTPUTS && c->output[i] != NULL; i++) {
        const struct bytes *got = find(&after, c->output[i]);
        if (!is_same(got, find(&before, c->output[i])) && !is_right(got, find(&wanted, c->output[i])))
            complain(c, counts, at, "leaves half an output", o);
    }
    if (o->status != FAULT_EXIT)
        complain(c, counts, at, "is not reached", o);
    if (!others_stay(c, true))
        complain(c, counts, at, "touches another file", o);
    restore();
}

static void try_command(const struct command *c, struct fault_counts *shared, long by_kind[FAULT_KINDS])
{
    for (int i = 0; i < MAX_OUTPUTS && c->output[i] != NULL; i++)
        write_bytes(c->output[i], "what was there before\n", 22);
    look(&before);
    struct outcome o = run(c, FAULT_NONE, 0, shared);
    look(&wanted);
    look(&after);
    const struct fault_counts all = *shared;
    if (o.status != 0 || strncmp(o.text, "smear: ", 7) == 0)
        complain(c, &all, 0, "fails without any fault", &o);
    restore();
    for (long at = 1; at <= all.all; at++) {
        o = run(c, FAULT_FAILS, at, shared);
        if (shared->was_hit)
            by_kind[shared->hit]++;
        injected++;
        check_failed(c, shared, at, &o);
    }
    run(c, FAULT_POWER, 0, shared);         /* counts removals, too */
    const long changes = shared->changes;
    look(&after);
    restore();
    for (long at = 1; at <= changes; at++, cuts++) {
        o = run(c, FAULT_POWER, at, shared);
        check_cut(c, shared, at, &o);
    }
    for (int i = 0; i < MAX_OUTPUTS && c->output[i] != NULL; i++)
        unlink(c->output[i]);
}

/* ------------------------------------------------------------------ what is there to read */

static void copy(const char *root, const char *from, const char *to)
{
    char path[4200];
    struct bytes b;
    snprintf(path, sizeof path, "%s/%s", root, from);
    if (!read_bytes(path, &b)) {
        perror(path);
        exit(1);
    }
    write_bytes(to, b.data, b.size);
    free(b.data);
}

static void prepare(const char *root)
{
    static const char obj[] = "mtllib card.mtl\no card\nusemtl red\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    static const char mtl[] = "newmtl red\nKd 1 0 0\nmap_Kd one.png\n";
    static const char photo[] = "mtllib photo.mtl\nusemtl red\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n";
    static const char photo_mtl[] = "newmtl red\nmap_Kd photo.jpg\n";
    static const char keys[] = "0 key b\n1 key i\n";
    static char kit[1536] = "smear/smear.c";            /* a ustar archive of that file, empty */
    copy(root, "tests/data/arm.gltf", "model.gltf");
    memcpy(kit + 124, "00000000000", 12);
    kit[156] = '0';
    memcpy(kit + 257, "ustar", 6);
    write_bytes("kit", kit, sizeof kit);
    write_bytes("card.obj", obj, sizeof obj - 1);
    write_bytes("card.mtl", mtl, sizeof mtl - 1);
    copy(root, "tests/data/jpeg/422-progressive.jpg", "photo.jpg");
    write_bytes("photo.obj", photo, sizeof photo - 1);
    write_bytes("photo.mtl", photo_mtl, sizeof photo_mtl - 1);
    write_bytes("keys", keys, sizeof keys - 1);
    write_bytes("a.png.tmp", "somebody's\n", 11);
    struct fault_counts counts;
    const struct command pictures[] = { { "render builtin:demo/drone --size 12x12 -o one.ppm", { NULL } },
                                        { "render builtin:demo/drone --size 12x12 -o one.png", { NULL } },
                                        { "render builtin:demo/race --size 12x12 -o two.ppm", { NULL } } };
    for (int i = 0; i < 3; i++)
        run(&pictures[i], FAULT_NONE, 0, &counts);
}

int __wrap_main(int argc, char **argv)
{
    char folder[] = "/tmp/smear-faults.XXXXXX", inner[64], root[4096];
    long by_kind[FAULT_KINDS] = { 0 };
    struct fault_counts *shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (argc < 2 || realpath(argv[1], root) == NULL || shared == MAP_FAILED || mkdtemp(folder) == NULL)
        return 2;
    snprintf(inner, sizeof inner, "%s/work", folder);
    if (mkdir(inner, 0755) != 0 || chdir(inner) != 0)
        return 2;
    snprintf(home, sizeof home, "%s", inner);
    prepare(root);
    const int count = sizeof commands / sizeof *commands;
    for (int i = 0; i < count; i++) {
        if (argc > 2 && atoi(argv[2]) != i)
            continue;
        long had = injected + cuts, had_failed = failures;
        try_command(&commands[i], shared, by_kind);
        printf("%6ld faults, %ld failed: smear %s\n", injected + cuts - had, failures - had_failed, commands[i].text);
        fflush(stdout);
    }
    for (int i = 0; i < FAULT_KINDS; i++)
        if (by_kind[i] > 0)
            printf("%s %ld, ", fault_names[i], by_kind[i]);
    printf("power %ld\n%ld faults and %ld power cuts injected\n", cuts, injected, cuts);
    printf("%ld passed, %ld failed\n", injected + cuts - failures, failures);
    look(&after);
    for (int i = 0; i < after.count; i++)
        unlink(after.file[i].name);
    unlink("../err");
    unlink("../out");
    if (chdir("/") != 0 || rmdir(inner) != 0 || rmdir(folder) != 0)
        return 2;
    return failures > 0;
}
