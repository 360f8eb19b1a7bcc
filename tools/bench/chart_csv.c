/* SPDX-License-Identifier: MIT */
/* chart_csv.c - one line for every scene and setting. */
#include "tools/bench/chart.h"

#include "tools/image/image.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FILE = 1 << 24, COLUMNS = 21, MAX_LINE = 512 };

static const char header[] =
    "light,poses,scene,group,setting,pixels,instructions,per_pixel,cost,rmse,rmse_mean,flip,ssim,"
    "flicker,ms,time,cpu_ms,cpu,crc32,arena_bytes,program\n";

static int format_line(char *out, size_t room, const struct chart *chart, int c, int k, int s,
                       uint32_t program)
{
    const struct chart_value *v = &chart->value[c][k][s];
    return snprintf(out, room,
                    "%s,%s,%s,%s,%s,%.0f,%.0f,%.2f,%.4f,%.4f,%.4f,%.5f,%.5f,%.4f,%.4f,%.4f,"
                    "%.4f,%.4f,%08" PRIx32 ",%.0f,%08" PRIx32 "\n",
                    chart_conditions[c].light, chart_conditions[c].poses, kinds[k].name,
                    kind_group_name[kinds[k].group], chart_settings[s].name, v->pixels,
                    v->instructions, v->instructions / v->pixels, chart_cost(chart, c, k, s),
                    v->rmse, v->rmse_mean, v->flip, v->ssim, v->flicker, v->ms,
                    chart_time(chart, c, k, s), v->cpu_ms, chart_cpu(chart, c, k, s), v->crc,
                    v->arena, program);
}

bool chart_write_csv(const struct chart *chart, const struct chart_choice *choice,
                     uint32_t program, const char *path, struct failure *f)
{
    size_t room = sizeof header
                + (size_t)MAX_LINE * CHART_CONDITIONS * ALL_KINDS * (size_t)chart_setting_count;
    char *text = malloc(room);
    if (text == NULL)
        return fail(f, "out of memory");
    size_t at = (size_t)snprintf(text, room, "%s", header);
    for (int c = 0; c < CHART_CONDITIONS; c++)
        for (int k = 0; k < ALL_KINDS; k++)
            for (int s = 0; s < chart_setting_count; s++)
                if (chart->value[c][k][s].known
                    && (choice == NULL || chart_is_wanted(choice, c, k, s)))
                    at += (size_t)format_line(text + at, MAX_LINE, chart, c, k, s, program);
    bool ok = file_write(path, (const uint8_t *)text, at, f);
    free(text);
    return ok;
}

/* Cuts a line at its commas; false unless there are exactly COLUMNS pieces. */
static bool cut(char *line, char *column[COLUMNS])
{
    int count = 0;
    for (char *at = line; at != NULL && count < COLUMNS; count++) {
        column[count] = at;
        at = strchr(at, ',');
        if (at != NULL)
            *at++ = '\0';
        else
            return count + 1 == COLUMNS;
    }
    return false;
}

static bool read_line(struct chart *chart, char *line, const uint32_t *program)
{
    char *column[COLUMNS];
    if (!cut(line, column))
        return false;
    int c = chart_find_condition(column[0], column[1]), k = kind_find(column[2]);
    int s = chart_find_setting(column[4]);
    if (program != NULL && strtoul(column[20], NULL, 16) != *program)
        return true;
    if (c < 0 || k < 0)
        return false;
    if (s < 0)                  /* of a time when there were others */
        return true;
    chart->value[c][k][s] = (struct chart_value){
        .known = true, .pixels = atof(column[5]), .instructions = atof(column[6]),
        .rmse = atof(column[9]), .rmse_mean = atof(column[10]), .flip = atof(column[11]),
        .ssim = atof(column[12]), .flicker = atof(column[13]), .ms = atof(column[14]),
        .cpu_ms = atof(column[16]),
        .crc = (uint32_t)strtoul(column[18], NULL, 16), .arena = atof(column[19])
    };
    return true;
}

bool chart_read_csv(struct chart *chart, const uint32_t *program, const char *path,
                    struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    int lines = 0;
    bool ok = true;
    FILE *file = fopen(path, "rb");
    memset(chart, 0, sizeof *chart);
    if (file == NULL && program != NULL)
        return true;
    if (file != NULL)
        fclose(file);
    if (!file_read(path, MAX_FILE, &bytes, &size, f))
        return false;
    char *line = (char *)bytes;
    for (int number = 1; *line != '\0' && ok; number++) {
        char *end = strchr(line, '\n'), *next = end != NULL ? end + 1 : line + strlen(line);
        if (end != NULL)
            *end = '\0';
        if (number > 1 && !read_line(chart, line, program) && program == NULL)
            ok = fail(f, "not a line of a chart (line %d)", number);
        line = next;
        lines = number;
    }
    if (ok && program == NULL && lines < 2)
        ok = fail(f, "no line of a chart is in it");
    free(bytes);
    return ok;
}
