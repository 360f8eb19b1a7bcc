/* SPDX-License-Identifier: MIT */
/* chart_measure.c - errors, instructions and times of the settings of a chart.
 *
 * A job is one scene under one condition: its pictures are drawn here, its instructions counted in
 * a process of their own. Jobs are shared among threads; times are taken when all are done, so that
 * nothing of ours disturbs them. */
#include "tools/bench/chart.h"

#include "tools/bench/sheet.h"
#include "tools/bench/truth.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

enum { MAX_THREADS = 8, TIME_ROUNDS = 9 };

static const double flicker_step = 1.0 / 8.0;   /* frames */

struct job {
    int condition, kind;
    bool timing;
};

struct run {
    struct chart *chart;
    const struct chart_choice *choice;
    const struct chart_measuring *how;
    struct job job[2 * CHART_CONDITIONS * ALL_KINDS];
    int jobs, next, done;
    pthread_mutex_t lock;               /* of the above, of chart and of progress */
    pthread_mutex_t truth[ALL_KINDS];       /* a truth is drawn by one thread only */
    bool ok;
    struct failure failure;             /* the first */
};

/* Settings that a job still lacks. */
struct missing {
    int count, setting[CHART_MAX_SETTINGS];
};

static void find_missing(const struct run *run, const struct job *job, struct missing *out)
{
    out->count = 0;
    for (int i = 0; i < chart_setting_count; i++) {
        const struct chart_value *value = &run->chart->value[job->condition][job->kind][i];
        bool has = job->timing ? value->ms > 0.0 : value->known;
        if (!has && chart_is_wanted(run->choice, job->condition, job->kind, i))
            out->setting[out->count++] = i;
    }
}

/* ------------------------------------------------------------------ errors */

/* The truth of a scene at the time that stands for it, and a little later. */
struct truths {
    struct float_image now, later;
    struct image picture;       /* of `now` */
};

static bool open_truths(struct run *run, const struct job *job, struct truths *out,
                        struct failure *f)
{
    struct take now, later;
    chart_error_take(chart_index(job->condition, job->kind, chart_none), &now);
    later = now;
    later.later = flicker_step;
    pthread_mutex_lock(&run->truth[job->kind]);
    memset(out, 0, sizeof *out);
    bool ok = truth_of_take(&now, run->how->folder, &out->now, f)
           && truth_of_take(&later, run->how->folder, &out->later, f)
           && truth_round(&out->now, &out->picture, f);
    pthread_mutex_unlock(&run->truth[job->kind]);
    return ok;
}

static void close_truths(struct truths *truths)
{
    float_image_free(&truths->now);
    float_image_free(&truths->later);
    image_free(&truths->picture);
}

static double rms_flicker(const struct truths *truths, const struct image *now,
                          const struct image *later)
{
    size_t values = 3 * (size_t)now->width * (size_t)now->height;
    double sum = 0.0;
    for (size_t i = 0; i < values; i++) {
        size_t at = i / 3 * 4 + i % 3;
        double picture = later->rgba[at] - now->rgba[at];
        double truth = 255.0 * ((double)truths->later.value[i] - (double)truths->now.value[i]);
        sum += (picture - truth) * (picture - truth);
    }
    return sqrt(sum / (double)values);
}

static bool draw(const struct take *take, struct image *out, double *arena, struct failure *f)
{
    struct rig rig;
    if (!rig_open(&rig, take, f))
        return false;
    bool ok = rig_picture(&rig, CLEAR_OF_SCENE, out, f);
    *arena = rig.stats.arena_bytes;
    rig_close(&rig);
    return ok;
}

static bool measure_error(const struct truths *truths, int index, struct chart_value *out,
                          struct failure *f)
{
    struct take take;
    struct image now = { 0 }, later = { 0 };
    struct image_distance distance = { 0 };
    chart_error_take(index, &take);
    bool ok = draw(&take, &now, &out->arena, f);
    take.later = flicker_step;
    ok = ok && draw(&take, &later, &out->arena, f)
      && image_compare(&now, &truths->picture, IMAGE_PIXELS_PER_DEGREE, &distance, f);
    if (ok) {
        size_t pixels = (size_t)now.width * (size_t)now.height;
        out->pixels = (double)pixels;
        out->rmse = distance.rmse;
        out->flip = distance.flip;
        out->ssim = distance.ssim;
        out->rmse_mean = truth_rmse(&truths->now, &now);
        out->flicker = rms_flicker(truths, &now, &later);
        out->crc = crc32_update(0, now.rgba, 4 * pixels);
    }
    image_free(&now);
    image_free(&later);
    return ok;
}

/* ------------------------------------------------------------------ one job */

static bool measure(struct run *run, const struct job *job, struct failure *f)
{
    struct chart_value value[CHART_MAX_SETTINGS];
    uint64_t instructions[CHART_MAX_SETTINGS];
    int index[CHART_MAX_SETTINGS];
    struct missing missing;
    struct truths truths;
    find_missing(run, job, &missing);
    bool ok = open_truths(run, job, &truths, f);
    memset(value, 0, sizeof value);
    for (int i = 0; i < missing.count && ok; i++) {
        index[i] = chart_index(job->condition, job->kind, missing.setting[i]);
        ok = measure_error(&truths, index[i], &value[i], f);
    }
    close_truths(&truths);
    ok = ok && count_list(&run->how->counter, "chart", index, missing.count, instructions, f);
    pthread_mutex_lock(&run->lock);
    for (int i = 0; i < missing.count && ok; i++) {
        struct chart_value *out = &run->chart->value[job->condition][job->kind]
                                                    [missing.setting[i]];
        *out = value[i];
        out->instructions = (double)instructions[i];
        out->known = true;
    }
    pthread_mutex_unlock(&run->lock);
    return ok;
}

/* All settings of a scene in turn, so that what else the machine does hits all alike. `none` is
 * taken along: ratios need it from the same run. */
static bool take_times(struct run *run, const struct job *job, struct failure *f)
{
    static struct rig rig[CHART_MAX_SETTINGS];
    static double ms[CHART_MAX_SETTINGS][TIME_ROUNDS], cpu_ms[CHART_MAX_SETTINGS][TIME_ROUNDS];
    struct missing missing;
    int open = 0;
    bool ok = true;
    find_missing(run, job, &missing);
    if (missing.setting[0] != chart_none) {
        memmove(missing.setting + 1, missing.setting, (size_t)missing.count * sizeof(int));
        missing.setting[0] = chart_none;
        missing.count++;
    }
    while (open < missing.count && ok) {
        struct take take;
        chart_take(chart_index(job->condition, job->kind, missing.setting[open]), &take);
        ok = rig_open(&rig[open], &take, f);
        open += ok;
        ok = ok && rig_draw(&rig[open - 1], f);     /* caches and pages are warm from here on */
    }
    for (int round = 0; round < TIME_ROUNDS && ok; round++)
        for (int i = 0; i < open && ok; i++) {
            double start = wall_seconds(), cpu_start = process_seconds();
            ok = rig_draw(&rig[i], f);
            cpu_ms[i][round] = 1e3 * (process_seconds() - cpu_start);
            ms[i][round] = 1e3 * (wall_seconds() - start);
        }
    for (int i = 0; i < open && ok; i++) {
        struct chart_value *out = &run->chart->value[job->condition][job->kind]
                                                    [missing.setting[i]];
        out->ms = median(ms[i], TIME_ROUNDS);
        out->cpu_ms = median(cpu_ms[i], TIME_ROUNDS);
    }
    for (int i = 0; i < open; i++)
        rig_close(&rig[i]);
    return ok;
}

/* ------------------------------------------------------------------ all jobs */

static void finish(struct run *run, const struct job *job, bool ok, struct failure *f)
{
    char what[160];
    snprintf(what, sizeof what, "%s%s, %s", job->timing ? "time of " : "",
             kinds[job->kind].name, chart_conditions[job->condition].what);
    pthread_mutex_lock(&run->lock);
    run->done++;
    ok = ok && run->how->progress(run->how->user, run->done, run->jobs, what, f);
    if (!ok)
        fail(&run->failure, "%s (%s)", f->text, what);
    run->ok = run->ok && ok;
    pthread_mutex_unlock(&run->lock);
}

static const struct job *next_job(struct run *run, bool timing)
{
    pthread_mutex_lock(&run->lock);
    const struct job *job = run->ok && run->next < run->jobs ? &run->job[run->next] : NULL;
    if (job != NULL && job->timing == timing)
        run->next++;
    else
        job = NULL;
    pthread_mutex_unlock(&run->lock);
    return job;
}

static void *work(void *argument)
{
    struct run *run = argument;
    for (const struct job *job; (job = next_job(run, false)) != NULL;) {
        struct failure f = { "" };
        bool ok = measure(run, job, &f);
        finish(run, job, ok, &f);
    }
    return NULL;
}

static void list_jobs(struct run *run)
{
    for (int timing = 0; timing <= (run->how->time ? 1 : 0); timing++)
        for (int c = 0; c < (timing ? 1 : CHART_CONDITIONS); c++)
            for (int k = 0; k < ALL_KINDS; k++) {
                struct job job = { c, k, timing != 0 };
                struct missing missing;
                find_missing(run, &job, &missing);
                if (missing.count > 0)
                    run->job[run->jobs++] = job;
            }
}

bool chart_measure(struct chart *chart, const struct chart_choice *choice,
                   const struct chart_measuring *how, struct failure *f)
{
    static struct run run;
    pthread_t thread[MAX_THREADS];
    int threads = 0, wanted = how->jobs < MAX_THREADS ? how->jobs : MAX_THREADS;
    memset(&run, 0, sizeof run);
    run.chart = chart;
    run.choice = choice;
    run.how = how;
    run.ok = true;
    list_jobs(&run);
    pthread_mutex_init(&run.lock, NULL);
    for (int i = 0; i < ALL_KINDS; i++)
        pthread_mutex_init(&run.truth[i], NULL);
    while (threads < wanted - 1 && pthread_create(&thread[threads], NULL, work, &run) == 0)
        threads++;
    work(&run);
    for (int i = 0; i < threads; i++)
        pthread_join(thread[i], NULL);
    for (const struct job *job; (job = next_job(&run, true)) != NULL;) {
        struct failure ignored = { "" };
        bool ok = take_times(&run, job, &ignored);
        finish(&run, job, ok, &ignored);
    }
    pthread_mutex_destroy(&run.lock);
    for (int i = 0; i < ALL_KINDS; i++)
        pthread_mutex_destroy(&run.truth[i]);
    return run.ok || fail(f, "%s", run.failure.text);
}
