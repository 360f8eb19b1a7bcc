/* SPDX-License-Identifier: MIT */
/* stats.c - see stats.h. */
#include "tools/player/stats.h"

#include "tools/scenes/methods.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

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

struct device_times stats_median(const struct device_times *times, double *spare, int count)
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

bool stats_open(struct stats_file *s, const char *path, struct failure *f)
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

void stats_add(struct stats_file *s, const struct frame_report *r)
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

bool stats_end(struct stats_file *s, struct failure *f)
{
    if (s->file.stream == NULL)
        return true;
    fputs("\n]}\n", s->file.stream);
    return output_commit(&s->file, f);
}

void stats_cancel(struct stats_file *s)
{
    output_discard(&s->file);
}
