/* SPDX-License-Identifier: MIT */
/* view_cost.c - where the numbers of tools/view/cost.c come from (`make cost-model`):
 *
 *     view_cost tapes OUT.c OUT.counts     frames for target_bench, and the work counted in them
 *     view_cost fit COUNTS BENCH           the instructions per piece of work that explain best what
 *                                          target_bench has measured, and how well they do
 *
 * The fit minimises the squared relative error over all frames; no piece may cost less than
 * nothing. */
#include "tools/image/image.h"
#include "tools/scenes/present.h"
#include "tools/scenes/tape.h"
#include "tools/view/cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIANGLES = 12000, MAX_FRAMES = 200, ROUNDS = 20000 };

static const char *const scenes[] = { "demo/race", "demo/drone", "suite/arena", "suite/dolly",
                                      "suite/propeller", "suite/swarm", "peer/E", "peer/B64" };
static const struct {
    const char *name;
    smear_method method;
    int samples;
} methods[] = {
    { "none", SMEAR_NONE, 0 },           { "accumulate", SMEAR_ACCUMULATE, 4 },
    { "reconstruct", SMEAR_RECONSTRUCT, 0 }, { "subframes", SMEAR_SUBFRAMES, 0 },
    { "timemask", SMEAR_TIMEMASK, 0 },   { "auto", SMEAR_AUTO, 0 },
    { "camera", SMEAR_CAMERA, 0 },       { "pingpong", SMEAR_PINGPONG, 0 },
    { "half", SMEAR_HALF, 0 },           { "object", SMEAR_OBJECT, 0 },
    { "layered", SMEAR_LAYERED, 0 },
};
enum { SCENES = sizeof scenes / sizeof *scenes, METHODS = sizeof methods / sizeof *methods };

/* Of different sizes, or nobody could tell what a frame costs and what its pixels. */
static const int sizes[][2] = { { 96, 64 }, { 176, 128 } };

/* ------------------------------------------------------------------ tapes */

static int throw_away(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    return 0;
}

static bool count(const smear_desc *desc, const struct presented *frame, smear_stats *stats,
                  struct failure *f)
{
    smear_context *ctx;
    size_t bytes = smear_memory_size(desc);
    void *memory = malloc(bytes + 1);
    int result = memory != NULL ? smear_init(&ctx, desc, memory, bytes) : SMEAR_ERR_MEMORY;
    if (result == SMEAR_OK)
        result = presented_submit(frame, ctx);
    if (result == SMEAR_OK)
        result = smear_render(ctx);
    if (result == SMEAR_OK)
        smear_get_stats(ctx, stats);
    free(memory);
    return result == SMEAR_OK || fail(f, "the library refused a frame: %s", smear_error_text(result));
}

static bool add_tape(struct tape_writer *writer, const char *scene_name, int m, const int size[2],
                     FILE *counts, struct failure *f)
{
    struct scene scene = { 0 };
    char name[64];
    smear_stats stats;
    double work[COST_WORKS];
    if (!scene_builtin(scene_name, &scene, f))
        return false;
    struct presenter *presenter = presenter_new(&scene, f);
    struct present_options o = { .fps = scene.fps, .shutter_degrees = 180, .clear = scene.clear,
                                 .method = methods[m].method, .samples = methods[m].samples };
    const struct presented *frame = presenter_frame(presenter, scene.time, &o, f);
    bool ok = frame != NULL;
    if (ok) {
        smear_desc desc = presented_desc(frame, size[0], size[1]);
        desc.format = SMEAR_RGB565;
        desc.reach = 8;
        desc.max_triangles = TRIANGLES;
        present_tiles(&desc, false);
        desc.flush = throw_away;
        snprintf(name, sizeof name, "%.5s-%d-%s", strchr(scene_name, '/') + 1, size[0],
                 methods[m].name);
        name[13] = '\0';                /* the column of target_bench */
        ok = count(&desc, frame, &stats, f) && tape_begin(writer, name, &desc, f) &&
             tape_add(writer, frame, NULL, f);
        cost_count(&stats, work);
        for (int i = 0; i < COST_WORKS && ok; i++)
            fprintf(counts, "%.0f ", work[i]);
        fprintf(counts, "%s/%dx%d/%s\n", scene_name, size[0], size[1], methods[m].name);
    }
    presenter_free(presenter);
    scene_free(&scene);
    return ok;
}

static bool write_tapes(const char *path, const char *counts_path, struct failure *f)
{
    struct tape_writer *writer = tape_writer_new(f);
    FILE *counts = fopen(counts_path, "w");
    bool ok = writer != NULL && counts != NULL;
    for (int s = 0; s < SCENES && ok; s++)
        for (int m = 0; m < METHODS * 2 && ok; m++)
            ok = add_tape(writer, scenes[s], m / 2, sizes[m % 2], counts, f);
    ok = ok && tape_write(writer, path, "view_cost tapes", f);
    tape_writer_free(writer);
    return counts != NULL && fclose(counts) == 0 && ok;
}

/* ------------------------------------------------------------------ the fit */

struct sample {
    double work[COST_WORKS], instructions;
    char name[64];
};

static int read_samples(const char *counts_path, const char *bench_path, struct sample *sample)
{
    FILE *counts = fopen(counts_path, "r"), *bench = fopen(bench_path, "r");
    char line[400];
    int read = 0;
    while (counts != NULL && bench != NULL && read < MAX_FRAMES && fgets(line, sizeof line, bench)) {
        struct sample *s = &sample[read];
        unsigned long total;
        if (strchr(line, '-') == NULL || strlen(line) < 15)
            continue;                   /* not the line of a tape */
        for (int i = 0; i < COST_WORKS; i++)
            if (fscanf(counts, "%lf", &s->work[i]) != 1)
                return read;
        if (fscanf(counts, "%63s", s->name) != 1)
            return read;
        if (sscanf(line + 14, "%lu", &total) == 1) {
            s->instructions = (double)total;
            read++;
        }
    }
    if (counts != NULL)
        fclose(counts);
    if (bench != NULL)
        fclose(bench);
    return read;
}

static double predicted(const struct sample *s, const double cost[COST_WORKS])
{
    double sum = 0.0;
    for (int i = 0; i < COST_WORKS; i++)
        sum += s->work[i] * cost[i];
    return sum;
}

/* One coefficient after the other, each to the best it can be while the others stay. */
static void fit(const struct sample *sample, int count, double cost[COST_WORKS])
{
    memset(cost, 0, COST_WORKS * sizeof *cost);
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < COST_WORKS; i++) {
            double top = 0.0, below = 0.0;
            for (int k = 0; k < count; k++) {
                double x = sample[k].work[i] / sample[k].instructions;
                double rest = 1.0 - predicted(&sample[k], cost) / sample[k].instructions;
                top += x * (rest + x * cost[i]);
                below += x * x;
            }
            cost[i] = below > 0.0 && top > 0.0 ? top / below : 0.0;
        }
}

static bool print_fit(const char *counts_path, const char *bench_path)
{
    static struct sample sample[MAX_FRAMES];
    double cost[COST_WORKS], sum = 0.0, worst = 0.0;
    int count = read_samples(counts_path, bench_path, sample);
    if (count < COST_WORKS) {
        fprintf(stderr, "view_cost: too few frames (%d)\n", count);
        return false;
    }
    fit(sample, count, cost);
    for (int i = 0; i < count; i++) {
        double error = predicted(&sample[i], cost) / sample[i].instructions - 1.0;
        printf("%-40s %12.0f instructions, estimated %+5.0f %%\n", sample[i].name,
               sample[i].instructions, 100.0 * error);
        sum += error * error;
        worst = fmax(worst, fabs(error));
    }
    printf("{");
    for (int i = 0; i < COST_WORKS; i++)
        printf("%s %.0f", i > 0 ? "," : "", cost[i]);
    printf(" }   error of %d frames: %.0f %% RMS, %.0f %% at most\n", count,
           100.0 * sqrt(sum / count), 100.0 * worst);
    return true;
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    if (argc == 4 && strcmp(argv[1], "fit") == 0)
        return print_fit(argv[2], argv[3]) ? 0 : 1;
    if (argc != 4 || strcmp(argv[1], "tapes") != 0) {
        fprintf(stderr, "usage: view_cost tapes OUT.c OUT.counts | fit COUNTS BENCH\n");
        return 2;
    }
    if (write_tapes(argv[2], argv[3], &f))
        return 0;
    fprintf(stderr, "view_cost: %s\n", f.text);
    return 1;
}
