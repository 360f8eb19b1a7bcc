/* SPDX-License-Identifier: MIT */
/* test_apart.c - whether outputs are one file, in folders full of links (tools/options/apart.c), against a search that
 * writes out every name of every pattern and follows each. APART_FOLDERS=n makes n folders. */
#define _XOPEN_SOURCE 700               /* realpath, mkdtemp */
#include "tests/host.h"

#include "tools/options/apart.h"
#include "tools/options/say.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum { OUTPUTS = 4, PATH = 512, MOST_NAMES = 64 };

/* ------------------------------------------------------------------ a folder of links */

static const char *const names[] = { "x.pfm", "x0.pfm", "x1.pfm", "x2.pfm", "x01.pfm", "x001.pfm", "x10.pfm", "x11.pfm", "x12.pfm",
                                     "1.pfm", "y", "x011.pfm" };
static const char *const patterns[] = { "x%d.pfm", "x%02d.pfm", "x%03d.pfm", "x1%d.pfm", "%d.pfm", "x%d1.pfm", "y%d", "x%01d.pfm" };
static const char *const folders[] = { "", "./", "a/", "b/", "a/../", "la/", "a/./", "b/../a/", "lb/", "gone/", "a/gone/" };

#define PICK(list) list[between(0, (int32_t)(sizeof list / sizeof list[0]) - 1)]

/* Files, second names of them and links, each made where nothing is in its way. */
static void fill_folder(void)
{
    char from[PATH], to[PATH];
    if (mkdir("a", 0700) != 0 || mkdir("b", 0700) != 0 || symlink("a", "la") != 0 || symlink("./b", "lb") != 0)
        abort();
    for (int n = between(0, 12); n > 0; n--) {
        snprintf(from, sizeof from, "%s%s", folders[between(0, 4)], PICK(names));
        snprintf(to, sizeof to, "%s%s", folders[between(0, 4)], PICK(names));
        int kind = between(0, 2), file = open(kind == 0 ? to : from, O_WRONLY | O_CREAT | O_EXCL, 0600);
        if (file >= 0)
            close(file);
        bool is_made = kind == 1 ? link(from, to) == 0 : kind == 2 && symlink(chance(2) ? PICK(names) : from, to) == 0;
        (void)is_made;
    }
}

static struct apart_output random_output(char path[PATH])
{
    struct apart_output o = { .path = path, .is_pattern = chance(2), .first = between(0, 12) };
    o.last = o.first + between(0, 20);
    snprintf(path, PATH, "%s%s", PICK(folders), o.is_pattern ? PICK(patterns) : PICK(names));
    return o;
}

/* ------------------------------------------------------------------ the search */

/* Where a name leads to: a file's numbers, or the path that one would be made at. */
struct end {
    bool is_there;
    dev_t device;
    ino_t number;
    char path[2 * PATH];
};

static void find_end(const char *name, struct end *e)
{
    struct stat there;
    char at[PATH], target[PATH / 2];
    *e = (struct end){ .is_there = stat(name, &there) == 0 };
    if (e->is_there) {
        e->device = there.st_dev;
        e->number = there.st_ino;
    }
    snprintf(at, sizeof at, "%s", name);
    for (int i = 0; lstat(at, &there) == 0 && S_ISLNK(there.st_mode); i++) {
        if (i == 16) {                  /* in circles, or farther than anybody looks: to no file */
            snprintf(at, sizeof at, "%s", name);
            break;
        }
        ssize_t length = readlink(at, target, sizeof target - 1);
        char *slash = strrchr(at, '/');
        target[length > 0 ? length : 0] = '\0';
        if (slash != NULL)
            snprintf(slash + 1, (size_t)(at + sizeof at - slash - 1), "%s", target);
        else
            snprintf(at, sizeof at, "%s", target);
    }
    char *slash = strrchr(at, '/'), *folder;
    const char *last = slash != NULL ? slash + 1 : at;
    char parent[PATH];
    snprintf(parent, sizeof parent, "%.*s", (int)(last - at), at);
    folder = realpath(parent[0] != '\0' ? parent : ".", NULL);
    snprintf(e->path, sizeof e->path, "%s/%s", folder != NULL ? folder : parent, last);
    free(folder);
}

/* All names that an output gives, and where they lead. */
struct ends {
    int count;
    struct end end[MOST_NAMES];
    char plain[MOST_NAMES][2 * PATH];       /* links of the last part not followed */
};

static void write_out(const struct apart_output *o, struct ends *out)
{
    out->count = 0;
    for (long i = o->is_pattern ? o->first : 0; i <= (o->is_pattern ? o->last : 0); i++) {
        char name[PATH], folder[PATH], *real;
        const char *percent = strchr(o->path, '%');
        if (percent == NULL)
            snprintf(name, sizeof name, "%s", o->path);
        else
            snprintf(name, sizeof name, "%.*s%0*ld%s", (int)(percent - o->path), o->path, percent[1] == '0' ? percent[2] - '0' : 1, i,
                     strchr(percent, 'd') + 1);
        const char *slash = strrchr(name, '/'), *last = slash != NULL ? slash + 1 : name;
        snprintf(folder, sizeof folder, "%.*s", (int)(last - name), name);
        real = realpath(folder[0] != '\0' ? folder : ".", NULL);
        snprintf(out->plain[out->count], sizeof out->plain[0], "%s/%s", real != NULL ? real : folder, last);
        free(real);
        find_end(name, &out->end[out->count++]);
    }
}

static bool are_one(const struct ends *a, const struct ends *b)
{
    for (int i = 0; i < a->count; i++)
        for (int k = 0; k < b->count; k++) {
            const struct end *p = &a->end[i], *q = &b->end[k];
            if ((p->is_there && q->is_there && p->device == q->device && p->number == q->number) || strcmp(p->path, q->path) == 0
                || strcmp(a->plain[i], b->plain[k]) == 0 || strcmp(a->plain[i], q->path) == 0 || strcmp(p->path, b->plain[k]) == 0)
                return true;
        }
    return false;
}

/* ------------------------------------------------------------------ */

static int status_quietly(const struct apart_output *list, int count)
{
    fflush(stderr);
    int kept = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    int status = apart_check(list, count);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(nowhere);
    close(kept);
    return status;
}

static void clear_folder(const char *folder)
{
    char command[PATH];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (system(command) != 0)
        abort();
}

static void test_outputs_that_are_one_file_are_found(void)
{
    static struct ends ends[OUTPUTS];
    int cases = (int)number_from("APART_FOLDERS", 300), refused = 0, taken = 0, home = open(".", O_RDONLY);
    char path[OUTPUTS][PATH], base[] = "/tmp/smear-apart-XXXXXX";
    REQUIRE(home >= 0 && mkdtemp(base) != NULL);
    random_state = 1;
    for (int n = 0; n < cases; n++) {
        struct apart_output list[OUTPUTS] = { { .path = NULL } };
        char folder[PATH];
        snprintf(folder, sizeof folder, "%s/%d", base, n);
        if (!CHECK(mkdir(folder, 0700) == 0 && chdir(folder) == 0))
            break;
        fill_folder();
        /* Many lists for a folder: making one takes the time. */
        for (int tries = 0; tries < 20; tries++) {
            int count = between(2, OUTPUTS);
            bool is_one = false;
            for (int i = 0; i < count; i++) {
                list[i] = random_output(path[i]);
                write_out(&list[i], &ends[i]);
                for (int k = 0; k < i; k++)
                    is_one = is_one || are_one(&ends[i], &ends[k]);
            }
            int status = status_quietly(list, count);
            refused += status != STATUS_OK;
            taken += status == STATUS_OK;
            if (!CHECK_EQ(status, is_one ? STATUS_BAD_USAGE : STATUS_OK))
                for (int i = 0; i < count; i++) {
                    test_print(list[i].path);
                    test_print("\n");
                }
        }
        if (!CHECK(fchdir(home) == 0))
            break;
        clear_folder(folder);
    }
    close(home);
    clear_folder(base);
    CHECK(refused > cases && taken > cases);
}

/* A range that no disk holds is looked at in no time, as only what is there is. */
static void test_patterns_of_a_billion_frames_are_compared(void)
{
    struct apart_output list[2] = { { .path = "nowhere-%d.pfm", .is_pattern = true, .last = 999999999 },
                                    { .path = "./nowhere-%09d.pfm", .is_pattern = true, .last = 999999999 } };
    CHECK_EQ(status_quietly(list, 2), STATUS_BAD_USAGE);
    list[0].last = list[1].last = 99999999;
    CHECK_EQ(status_quietly(list, 2), STATUS_OK);
}

#include "build/suites/apart.h"
