/* SPDX-License-Identifier: MIT */
/* promise.c - whether a target is an error that is had, and what it costs beside plain instants.
 *
 *     promise [--scenes NAME,...] [--models FOLDER] [--light linear|encoded] [--count]
 *
 * Exact poses, 180 degrees, XRGB8888. For each scene and light: the error that each target has, in
 * parts of it, its cost, and its cost in parts of that of plain instants (SMEAR_SUBFRAMES 4, 8, 16,
 * straight lines between them in logarithms) at the same error. Cost is processor time, the least of
 * some rounds, or with --count instructions, counted by callgrind. Truth: truth.h. */
#include "tools/bench/promise.h"

#include "tools/bench/count.h"
#include "tools/bench/sheet.h"
#include "tools/bench/truth.h"
#include "tools/options/arguments.h"
#include "tools/options/say.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { TARGETS = 3, PLAINS = 3, SETTINGS = TARGETS + PLAINS, ROUNDS = 5, MOST = 64 };

static const double aimed[TARGETS] = { 3.0, 1.5, 0.75 };
static const int plain[PLAINS] = { 4, 8, 16 };
static const char *const group_name[PROMISE_GROUPS] = { "suite", "hero", "models", "unseen" };

struct measured {
    double error[SETTINGS], cost[SETTINGS];
};

enum light { BOTH_LIGHTS, ENCODED, LINEAR };

struct options {
    const char *scenes;
    enum light only_light;
    bool count;
};

/* ------------------------------------------------------------------ takes */

static bool make_take(const struct promise_scene *s, bool linear, int setting, struct take *out)
{
    *out = (struct take){
        .scene = s->scene, .clip = s->clip, .frame = s->frame, .format = SMEAR_XRGB8888,
        .method = setting < TARGETS ? SMEAR_AUTO : SMEAR_SUBFRAMES, .linear = linear, .shutter_poses = true
    };
    if (setting < TARGETS)
        out->target = (int)(64 * aimed[setting]);
    else
        out->samples = plain[setting - TARGETS];
    return true;
}

bool promise_take(int index, struct take *out)
{
    const int scene = index / SETTINGS / 2;
    return scene < promise_scene_count
        && make_take(&promise_scenes[scene], index / SETTINGS % 2 != 0, index % SETTINGS, out);
}

/* ------------------------------------------------------------------ measuring */

static double seconds_of(struct rig *rig, struct failure *f)
{
    double least = 1e9;
    for (int i = 0; i < ROUNDS; i++) {
        const double start = process_seconds();
        if (!rig_draw(rig, f))
            return -1.0;
        least = fmin(least, process_seconds() - start);
    }
    return least;
}

static bool measure_setting(const struct take *take, const struct float_image *truth, bool count, double *error,
                            double *cost, struct failure *f)
{
    struct rig rig;
    struct image picture;
    if (!rig_open(&rig, take, f))
        return false;
    bool ok = rig_picture(&rig, CLEAR_OF_SCENE, &picture, f);
    if (ok) {
        *error = truth_rmse(truth, &picture);
        image_free(&picture);
        *cost = count ? 0.0 : 1e3 * seconds_of(&rig, f);
    }
    rig_close(&rig);
    return ok;
}

static bool measure(int scene, bool linear, const struct options *o, const struct counter *counter,
                    struct measured *out, struct failure *f)
{
    struct float_image truth;
    struct take take;
    make_take(&promise_scenes[scene], linear, 0, &take);
    if (!truth_of_take(&take, counter->folder, &truth, f))
        return false;
    bool ok = true;
    for (int i = 0; i < SETTINGS && ok; i++) {
        make_take(&promise_scenes[scene], linear, i, &take);
        ok = measure_setting(&take, &truth, o->count, &out->error[i], &out->cost[i], f);
    }
    float_image_free(&truth);
    if (ok && o->count) {
        uint64_t instructions[SETTINGS];
        ok = count_takes(counter, "promise", (2 * scene + linear) * SETTINGS, SETTINGS, instructions, f);
        for (int i = 0; i < SETTINGS && ok; i++)
            out->cost[i] = (double)instructions[i] / 1e6;
    }
    return ok;
}

/* ------------------------------------------------------------------ what comes out */

/* What plain instants cost that have this error. */
static double plain_cost(const struct measured *m, double error)
{
    const double *e = m->error + TARGETS, *c = m->cost + TARGETS;
    const int i = error > e[1] ? 0 : 1;
    const double part = log(error / e[i]) / log(e[i + 1] / e[i]);
    return c[i] * pow(c[i + 1] / c[i], part);
}

struct summary {
    double part[MOST * 2 * TARGETS], ratio[PROMISE_GROUPS][MOST * 2 * TARGETS], held[MOST * 2 * TARGETS];
    int parts, ratios[PROMISE_GROUPS], helds;
};

static void note(struct summary *s, const struct promise_scene *scene, const struct measured *m)
{
    for (int i = 0; i < TARGETS; i++) {
        const double part = m->error[i] / aimed[i];
        s->part[s->parts++] = part;
        if (scene->held)
            s->held[s->helds++] = part;
        if (m->error[TARGETS] > 1.5 * m->error[SETTINGS - 1])     /* else plain instants get no better */
            s->ratio[scene->group][s->ratios[scene->group]++] = m->cost[i] / plain_cost(m, m->error[i]);
    }
}

static void print_scene(const struct promise_scene *scene, bool linear, const struct measured *m)
{
    char name[64];
    const char *slash = strrchr(scene->scene, '/');
    snprintf(name, sizeof name, "%s", slash + 1);
    if (scene->frame >= 0)
        snprintf(name + strlen(name), sizeof name - strlen(name), " %d", scene->frame);
    printf("%-20.20s %c%c ", name, linear ? 'l' : 'e', scene->held ? '*' : ' ');
    for (int i = 0; i < TARGETS; i++)
        printf(" %5.2f %4.2f%c %6.1f %4.2f |", m->error[i], m->error[i] / aimed[i], m->error[i] > 1.25 * aimed[i] ? '!' : ' ',
               m->cost[i], m->cost[i] / plain_cost(m, m->error[i]));
    for (int i = TARGETS; i < SETTINGS; i++)
        printf(" %5.2f %6.1f", m->error[i], m->cost[i]);
    printf("\n");
    fflush(stdout);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static const char *verdict(bool met)
{
    return met ? "met" : "MISSED";
}

static void print_parts(const char *what, double *part, int count)
{
    if (count == 0)
        return;
    qsort(part, (size_t)count, sizeof *part, compare);
    int within = 0;
    while (within < count && part[within] <= 1.25)
        within++;
    printf("%s: had / aimed at: at most 1.25 for %.0f %% of %d (at least 90 %s), largest %.2f (at most 1.6 %s), middle %.2f "
           "(at least 0.5 %s)\n", what, 100.0 * within / count, count, verdict(10 * within >= 9 * count), part[count - 1],
           verdict(part[count - 1] <= 1.6), part[count / 2], verdict(part[count / 2] >= 0.5));
}

static void print_summary(struct summary *s)
{
    print_parts("all", s->part, s->parts);
    print_parts("held out (*)", s->held, s->helds);
    for (int g = 0; g < PROMISE_GROUPS; g++) {
        double most = 0.0;
        for (int i = 0; i < s->ratios[g]; i++)
            most = fmax(most, s->ratio[g][i]);
        const double mean = s->ratios[g] > 0 ? geometric_mean(s->ratio[g], s->ratios[g]) : 0.0;
        if (s->ratios[g] > 0)
            printf("%s: cost in parts of plain instants' at equal error: %.2f in the mean (at most 0.6 %s), %.2f at most "
                   "(1 %s)\n", group_name[g], mean, verdict(mean <= 0.6), most, verdict(most <= 1.0));
    }
}

/* ------------------------------------------------------------------ the command */

static bool is_chosen(const struct options *o, const struct promise_scene *s)
{
    char word[64], list[1024];
    if (o->scenes == NULL)
        return true;
    snprintf(list, sizeof list, ",%s,", o->scenes);
    snprintf(word, sizeof word, ",%s,", strrchr(s->scene, '/') + 1);
    char *dot = strstr(word, ".glb,");
    if (dot != NULL)
        memcpy(dot, ",", 2);
    const bool by_name = strstr(list, word) != NULL;
    snprintf(word, sizeof word, ",%s,", group_name[s->group]);
    return by_name || strstr(list, word) != NULL;
}

static bool has_scenes(const struct options *o)
{
    for (int i = 0; i < promise_scene_count; i++)
        if (is_chosen(o, &promise_scenes[i]) && take_is_there(promise_scenes[i].scene))
            return true;
    fprintf(stderr, "smear: --scenes: none of these is there (\"%s\")\n", o->scenes);
    return false;
}

static const char *read_models(void *to, const char *value)
{
    (void)to;
    setenv("SMEAR_ASSETS", value, 1);
    return NULL;
}

static const struct option table[] = {
    { "--scenes", OPTION_TEXT, OPTION_AT(struct options, scenes), .needs = "scenes, with commas" },
    { "--models", OPTION_READ, .read = read_models },
    { "--light", OPTION_NAME, OPTION_AT(struct options, only_light), OPTION_NAMES("encoded", "linear"), .low = ENCODED },
    { "--count", OPTION_FLAG, OPTION_AT(struct options, count) },
    { .name = NULL },
};

static bool read_options(struct options *o, int count, char **text)
{
    bool wants_help;
    *o = (struct options){ .count = false };
    const int status = arguments_read(count, text, table, o, NULL, 0, &wants_help);
    if (status == STATUS_OK && wants_help)
        say_bad_usage("promise", "smear help bench lists its options");
    return status == STATUS_OK && !wants_help;
}

int promise_command(const char *program, int count, char **text)
{
    static struct summary summary;
    struct options o;
    struct failure f = { "" };
    const struct counter counter = { .program = program, .folder = "build/bench" };
    if (!read_options(&o, count, text) || !has_scenes(&o))
        return 2;
    if ((mkdir("build", 0777) != 0 && errno != EEXIST) || (mkdir(counter.folder, 0777) != 0 && errno != EEXIST)) {
        fprintf(stderr, "smear: %s: cannot make the folder (%s)\n", counter.folder, strerror(errno));
        return 1;
    }
    for (int i = 0; i < promise_scene_count; i++)
        for (int linear = 0; linear < 2; linear++) {
            struct measured m;
            if (o.only_light == (linear ? ENCODED : LINEAR) || !is_chosen(&o, &promise_scenes[i])
                || !take_is_there(promise_scenes[i].scene))
                continue;
            if (!measure(i, linear != 0, &o, &counter, &m, &f)) {
                fprintf(stderr, "smear: %s: %s\n", promise_scenes[i].scene, f.text);
                return 1;
            }
            print_scene(&promise_scenes[i], linear != 0, &m);
            note(&summary, &promise_scenes[i], &m);
        }
    print_summary(&summary);
    return 0;
}
