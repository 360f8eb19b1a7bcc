/* SPDX-License-Identifier: MIT */
/* render.c - `smear render`: frames of a scene through the library into files and statistics. */
#include "tools/cli/commands.h"

#include "tools/image/file.h"
#include "tools/options/options.h"
#include "tools/options/say.h"
#include "tools/options/setup.h"
#include "tools/player/device.h"
#include "tools/player/exact.h"
#include "tools/player/picture.h"
#include "tools/player/planes.h"
#include "tools/player/unseen.h"
#include "tools/scenes/methods.h"
#include "tools/view/orbit.h"

#include <inttypes.h>
#include <math.h>
#include <smear.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ statistics */

/* The statistics of `smear render --stats`, as JSON. */

struct frame_report {
    long frame;
    double time;                /* seconds */
    smear_stats counts;
    struct device_times times;  /* ticks */
};

struct stats_file {
    struct output file;         /* stream null: nobody wants statistics */
    long frames;
};

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_at(const struct device_times *times, double *spare, int count, size_t offset)
{
    for (int i = 0; i < count; i++)
        memcpy(&spare[i], (const char *)&times[i] + offset, sizeof *spare);
    qsort(spare, (size_t)count, sizeof *spare, compare_doubles);
    return (spare[(count - 1) / 2] + spare[count / 2]) / 2.0;
}

/* The middle value per stage (of an even number, the mean of the two in the middle). Sorts `times`
 * through the spare array of `count` doubles. */
static struct device_times stats_median(const struct device_times *times, double *spare, int count)
{
    struct device_times m;
    m.submit = median_at(times, spare, count, offsetof(struct device_times, submit));
    m.raster = median_at(times, spare, count, offsetof(struct device_times, raster));
    m.reduce = median_at(times, spare, count, offsetof(struct device_times, reduce));
    m.blur = median_at(times, spare, count, offsetof(struct device_times, blur));
    m.convert = median_at(times, spare, count, offsetof(struct device_times, convert));
    m.total = median_at(times, spare, count, offsetof(struct device_times, total));
    return m;
}

/* `-` is standard output. */
static bool stats_open(struct stats_file *s, const char *path, struct failure *f)
{
    *s = (struct stats_file){ .frames = 0 };
    if (!output_open_stream(&s->file, path, f))
        return false;
    fputs("{\"frames\":[", s->file.stream);
    return true;
}

static double us(double ticks)
{
    return ticks / DEVICE_TICKS_PER_US;
}

static void stats_add(struct stats_file *s, const struct frame_report *r)
{
    const smear_stats *c = &r->counts;
    const struct device_times *t = &r->times;
    fprintf(s->file.stream, "%s\n{\"frame\":%ld,\"time_s\":%.9g,\n", s->frames > 0 ? "," : "", r->frame,
            r->time);
    /* The library classifies while it reduces, and has no layers to merge. */
    fprintf(s->file.stream, " \"us\":{\"submit\":%.1f,\"raster\":%.1f,\"reduce\":%.1f,\"class\":0,"
            "\"blur\":%.1f,\"merge\":0,\"convert\":%.1f,\"total\":%.1f},\n",
            us(t->submit), us(t->raster), us(t->reduce), us(t->blur), us(t->convert), us(t->total));
    fprintf(s->file.stream, " \"triangles\":{\"in\":%" PRIu32 ",\"drawn\":%" PRIu32
            ",\"dropped\":%" PRIu32 ",\"split\":%" PRIu32 "},\n",
            c->triangles_in, c->triangles_drawn, c->triangles_dropped, c->parts_added);
    fprintf(s->file.stream, " \"pixels\":%" PRIu32 ",\"samples\":%" PRIu32 ",\n", c->pixels, c->samples);
    fprintf(s->file.stream, " \"tiles\":{\"still\":%" PRIu32 ",\"uniform\":%" PRIu32
            ",\"complex\":%" PRIu32 ",\"kept\":%" PRIu32 "},\n",
            c->tiles_static, c->tiles_uniform, c->tiles_complex, c->tiles_kept);
    for (int i = 0; i < method_count; i++)
        if (method_list[i].method != SMEAR_AUTO)        /* its tiles get other methods */
            fprintf(s->file.stream, "%s\"%s\":%" PRIu32, i == 0 ? " \"methods\":{" : ",", method_list[i].name,
                    c->tiles[method_list[i].method]);
    fputs("},\n", s->file.stream);
    fprintf(s->file.stream,
            " \"draws\":{\"moved\":%" PRIu32 ",\"beside\":%" PRIu32 "},\n \"static_cached\":%" PRIu32
            ",\n \"target\":%.4g,\"work\":%" PRIu32 ",\n",
            c->draws_moved, c->draws_beside, c->static_cached, c->target / 64.0, c->work);
    fprintf(s->file.stream, " \"arena_bytes\":%" PRIu32 ",\"crc32\":\"%08" PRIx32 "\"}", c->arena_bytes,
            c->crc32);
    s->frames++;
}

static bool stats_end(struct stats_file *s, struct failure *f)
{
    if (s->file.stream == NULL)
        return true;
    fputs("\n]}\n", s->file.stream);
    return output_commit(&s->file, f);
}

/* Leaves no unfinished file; harmless after stats_end and on a zeroed struct. */
static void stats_cancel(struct stats_file *s)
{
    output_discard(&s->file);
}

struct render {
    struct render_options options;
    struct source source;
    struct setup setup;
    struct orbit orbit;                 /* with --orbit */
    struct presenter *presenter;
    struct device device;               /* what is measured */
    struct exact exact;                 /* with --exact */
    struct planes planes;               /* with --depth or --velocity */
    struct image picture;
    struct device_times *times;         /* one per repetition */
    double *spare;                      /* as many, for medians */
    struct stats_file stats;
    struct unseen unseen;
};

/* ------------------------------------------------------------------ setting up */

static bool open_devices(struct render *r, struct failure *f)
{
    const struct render_options *o = &r->options;
    const int width = r->setup.width, height = r->setup.height;
    struct device_setup setup = setup_device(&r->setup, o);
    if (o->exact) {
        const int places = exact_places(&r->setup.present, width, height);
        if (!exact_open(&r->exact, width, height, places, o->format, o->dither, o->doubled, f))
            return false;
        setup.format = SMEAR_XRGB8888;
        setup.methods = SMEAR_SET(SMEAR_NONE);
        setup.width = width * places;
        setup.height = height * places;
    }
    if (!device_open(&r->device, &setup, f))
        return false;
    const struct device *shown = o->exact ? &r->exact.display : &r->device;
    if (!image_alloc(&r->picture, shown->width, shown->height, f))
        return false;
    if ((o->depth != NULL || o->velocity != NULL) &&
        !planes_open(&r->planes, width, height, f))
        return false;
    size_t repeat = o->repeat > 0 ? (size_t)o->repeat : 1;
    r->times = calloc(repeat, sizeof *r->times);
    r->spare = calloc(repeat, sizeof *r->spare);
    if (r->times == NULL || r->spare == NULL)
        return fail(f, "out of memory");
    r->presenter = presenter_new(o->orbit != 0.0 ? &r->orbit.scene : &r->source.scene, f);
    return r->presenter != NULL;
}

/* The time of a frame, in seconds. */
static double time_of(const struct render *r, long frame)
{
    const struct render_options *o = &r->options;
    return o->has_frames                         ? (double)frame / r->setup.present.fps
         : o->has_time || r->source.is_file ? o->time
                                            : r->source.scene.time;
}

/* About what the camera sees in the first frame, so that the last one leads to the first again. A single frame is
 * turned. */
static bool start_orbit(struct render *r, struct failure *f)
{
    const struct render_options *o = &r->options;
    double angle = 2.0 * 3.14159265358979323846 * o->orbit;
    if (o->orbit == 0.0)
        return true;
    orbit_open(&r->orbit, &r->source.scene);
    if (o->view.has_eye)                /* what it looks at has been said */
        r->orbit.focus = hypot(hypot(o->view.eye[0] - o->view.look[0], o->view.eye[1] - o->view.look[1]), o->view.eye[2] - o->view.look[2]);
    if (o->has_frames)
        r->orbit.spin = angle * r->setup.present.fps / (double)(o->last - o->first + 1);
    else
        r->orbit.yaw = angle;
    return r->orbit.focus > 0.0 || orbit_find_focus(&r->orbit, time_of(r, o->first), f);
}

/* ------------------------------------------------------------------ a frame */

/* What a frame is drawn from. */
struct shot {
    long frame;
    double time;
    struct present_options options;
    const struct presented *presented;  /* null with --exact: instants are posed one by one */
};

/* The picture in r->picture, counts in `report`. */
static bool draw_frame(struct render *r, const struct shot *shot, struct frame_report *report,
                       struct failure *f)
{
    struct device *shown = &r->device;
    if (r->options.exact) {
        shown = &r->exact.display;
        if (!exact_draw(&r->exact, r->presenter, &r->device, shot->time, &shot->options,
                        r->options.samples, &report->counts, f))
            return false;
    } else {
        if (!device_fit(&r->device, shot->presented, f) ||
            !device_draw(&r->device, shot->presented, f))
            return false;
        smear_get_stats(r->device.ctx, &report->counts);
        if (r->options.keep_display)        /* not of what was sent, but of what is shown */
            report->counts.crc32 = device_crc(&r->device);
    }
    picture_expand(&r->picture, shown->pixels, shown->stride, shown->setup.format);
    return true;
}

/* The frame again, for its times. */
static bool time_frame(struct render *r, const struct shot *shot, struct frame_report *report,
                       struct failure *f)
{
    int repeat = r->options.repeat > 0 ? r->options.repeat : 1;
    for (int i = 0; i < repeat; i++) {
        bool ok = r->options.exact
                    ? exact_time(r->presenter, &r->device, shot->time, &shot->options,
                                 r->options.samples, &r->times[i], f)
                    : device_time(&r->device, shot->presented, &r->times[i], f);
        if (!ok)
            return false;
    }
    report->times = stats_median(r->times, r->spare, repeat);
    return true;
}

static int write_planes(struct render *r, const struct shot *shot)
{
    struct failure f = { "" };
    struct render_options *o = &r->options;
    const struct presented *presented = shot->presented;
    if (o->depth == NULL && o->velocity == NULL)
        return STATUS_OK;
    if (presented == NULL)
        presented = presenter_frame(r->presenter, shot->time, &shot->options, &f);
    if (presented == NULL || !planes_draw(&r->planes, presented, &f))
        return say_bad_input(r->source.name, &f);
    if (o->depth != NULL &&
        !sink_add(&o->depth_sink, &r->picture, &r->planes.depth, shot->frame, &f))
        return say_bad_input(o->depth_sink.name, &f);
    if (o->velocity != NULL &&
        !sink_add(&o->velocity_sink, &r->picture, &r->planes.velocity, shot->frame, &f))
        return say_bad_input(o->velocity_sink.name, &f);
    return STATUS_OK;
}

static void print_times(const struct frame_report *report)
{
    printf("frame=%ld total_us=%.1f crc32=%08lx\n", report->frame,
           report->times.total / DEVICE_TICKS_PER_US, (unsigned long)report->counts.crc32);
}

/* The last look at a frame, which is poorer afterwards: see unseen_look. */
static bool look_for_nothing(struct render *r, const struct shot *shot, const smear_stats *counts, struct failure *f)
{
    const struct unseen_frame frame = {
        .scene = r->options.orbit != 0.0 ? &r->orbit.scene : &r->source.scene, .presenter = r->presenter,
        .options = &shot->options, .time = shot->time, .number = shot->frame, .width = r->setup.width, .height = r->setup.height,
        .picture = &r->picture, .has_sides = !r->source.is_file || r->source.model.has_sides,
        .is_covered = counts->triangles_drawn > 0 || counts->static_cached != 0 || counts->tiles_kept > 0,
    };
    return unseen_look(&r->unseen, &frame, f);
}

static int render_frame(struct render *r, long frame, double time)
{
    struct failure f = { "" };
    struct render_options *o = &r->options;
    struct frame_report report = { .frame = frame, .time = time };
    struct shot shot = { .frame = frame, .time = time,
                         .options = setup_frame(&r->setup, o, frame) };
    bool is_timed = o->stats != NULL || o->repeat > 0;
    if (!o->exact) {
        shot.presented = presenter_frame(r->presenter, time, &shot.options, &f);
        if (shot.presented == NULL)
            return say_bad_input(r->source.name, &f);
    }
    if (!draw_frame(r, &shot, &report, &f) || (is_timed && !time_frame(r, &shot, &report, &f)))
        return say_bad_input(r->source.name, &f);
    if (o->output != NULL && !sink_add(&o->picture_sink, &r->picture, NULL, frame, &f))
        return say_bad_input(o->picture_sink.name, &f);
    int status = write_planes(r, &shot);
    if (status != STATUS_OK)
        return status;
    if (r->stats.file.stream != NULL)
        stats_add(&r->stats, &report);
    else if (o->repeat > 0)
        print_times(&report);
    return look_for_nothing(r, &shot, &report.counts, &f) ? STATUS_OK : say_bad_input(r->source.name, &f);
}

/* ------------------------------------------------------------------ all frames */

static int render_frames(struct render *r)
{
    const struct render_options *o = &r->options;
    int status = STATUS_OK;
    for (long frame = o->first; frame <= o->last && status == STATUS_OK; frame++) {
        status = render_frame(r, frame, time_of(r, frame));
        say_progress(frame - o->first + 1, o->last - o->first + 1, "frame");
    }
    say_progress_end();
    return status;
}

static int finish(struct render *r)
{
    struct failure f = { "" };
    struct render_options *o = &r->options;
    if (!sink_end(&o->picture_sink, &f))
        return say_bad_input(o->picture_sink.name, &f);
    if (!stats_end(&r->stats, &f))
        return say_bad_input(o->stats, &f);
    if (o->output != o->default_output && !output_flush_standard(&f))
        return say_bad_input("standard output", &f);
    const char *failed = NULL;
    if (!outputs_publish(&failed, &f))
        return say_bad_input(failed, &f);
    if (o->output == o->default_output)
        printf("wrote %s\n", o->output);
    char text[600];
    if (unseen_tell(&r->unseen, text, sizeof text))
        say_warning_when_done(r->source.name, text);
    return STATUS_OK;
}

static int render_scene(struct render *r)
{
    struct failure f = { "" };
    struct apart_output outputs[OPTIONS_OUTPUTS];
    int status = setup_open(&r->options, &r->source, &r->setup);
    if (status == STATUS_OK)
        status = options_move(&r->options, source_period(&r->source, &r->options.view, r->setup.present.fps));
    options_outputs(&r->options, outputs);
    if (status == STATUS_OK)
        status = apart_check_inputs(outputs, OPTIONS_OUTPUTS);
    if (status != STATUS_OK)
        return status;
    r->options.picture_sink.fps = r->setup.present.fps;
    if (!start_orbit(r, &f) || !open_devices(r, &f))
        return say_bad_input(r->source.name, &f);
    if (r->options.stats != NULL && !stats_open(&r->stats, r->options.stats, &f))
        return say_bad_input(r->options.stats, &f);
    outputs_hold();
    status = render_frames(r);
    return status == STATUS_OK ? finish(r) : status;
}

static void release(struct render *r)
{
    sink_cancel(&r->options.picture_sink);
    stats_cancel(&r->stats);
    outputs_drop();
    presenter_free(r->presenter);
    planes_close(&r->planes);
    exact_close(&r->exact);
    device_close(&r->device);
    image_free(&r->picture);
    setup_release(&r->setup);
    free(r->times);
    free(r->spare);
    source_close(&r->source);
}

int command_render(int count, char **text)
{
    static struct render render;        /* large, and one is enough */
    bool wants_help;
    int status = options_read(&render.options, count, text, &wants_help);
    if (status != STATUS_OK || wants_help)
        return status == STATUS_OK ? help_print("render") : status;
    status = source_open(render.options.scene, &render.options.view, &render.source);
    if (status == STATUS_OK) {
        status = render_scene(&render);
        release(&render);
    }
    return status;
}
