/* SPDX-License-Identifier: MIT */
/* chart_tables.c - means for the terminal; means and every scene in Markdown. */
#include "tools/bench/chart.h"

#include "tools/image/image.h"
#include "tools/bench/sheet.h"
#include "tools/bench/truth.h"

#include <stdlib.h>

/* ------------------------------------------------------------------ terminal */

static void print_mean(FILE *out, const struct chart_mean *mean)
{
    if (mean->known)
        fprintf(out, " %7.2f %6.2f %7.4f %7.2f", mean->cost, mean->rmse, mean->flip, mean->flicker);
    else
        fprintf(out, " %7s %6s %7s %7s", "-", "-", "-", "-");
    if (mean->known && mean->time > 0.0)
        fprintf(out, " %6.2f %6.2f", mean->time, mean->cpu);
    else
        fprintf(out, " %6s %6s", "-", "-");
}

void chart_print_means(FILE *out, const struct chart *chart, int condition)
{
    fprintf(out, "%s\n", chart_conditions[condition].what);
    fprintf(out, "%-24s %8s %37s %9s %37s %7s\n", "", "object:", "", "camera:", "", "still:");
    fprintf(out, "%-24s %8s %6s %7s %7s %6s %6s %9s %6s %7s %7s %6s %6s %7s %6s\n", "setting",
            "cost", "RMSE", "FLIP", "flicker", "wall", "cpu", "cost", "RMSE", "FLIP", "flicker",
            "wall", "cpu", "cost", "worst");
    for (int s = 0; s < chart_setting_count; s++) {
        struct chart_mean object = chart_mean_of(chart, condition, SET_OBJECT, s);
        struct chart_mean camera = chart_mean_of(chart, condition, SET_CAMERA, s);
        struct chart_mean still = chart_mean_of(chart, condition, SET_STILL, s);
        if (!object.known && !camera.known && !still.known)
            continue;
        fprintf(out, "%-24s ", chart_settings[s].name);
        print_mean(out, &object);
        fprintf(out, "  ");
        print_mean(out, &camera);
        if (still.known)
            fprintf(out, " %7.2f", still.cost);
        else
            fprintf(out, " %7s", "-");
        if (object.known && camera.known)
            fprintf(out, " %6.1f", object.worst > camera.worst ? object.worst : camera.worst);
        fprintf(out, "\n");
    }
}

void chart_print_none(FILE *out, const struct chart *chart, int condition)
{
    double each[KINDS], least = 0.0, most = 0.0;
    int n = 0;
    for (int k = 0; k < KINDS; k++) {
        const struct chart_value *v = &chart->value[condition][k][chart_none];
        if (!v->known)
            continue;
        each[n] = v->instructions / v->pixels;
        least = n == 0 || each[n] < least ? each[n] : least;
        most = each[n] > most ? each[n] : most;
        n++;
    }
    if (n > 0)
        fprintf(out, "none: %.0f to %.0f instructions per pixel, %.0f in the geometric mean of %d "
                "scenes\n", least, most, geometric_mean(each, n), n);
}

void chart_print_scene(FILE *out, const struct chart *chart, int condition, int kind)
{
    struct chart_point point[CHART_MAX_SETTINGS];
    int count = chart_points_of_kind(chart, condition, kind, point);
    const struct chart_value *none = &chart->value[condition][kind][chart_none];
    if (count == 0)
        return;
    fprintf(out, "%s, %s (none: %.2f M instructions, %.1f per pixel)\n", kinds[kind].name,
            chart_conditions[condition].what, none->instructions / 1e6,
            none->instructions / none->pixels);
    fprintf(out, "%-24s %8s %6s %7s %7s %7s %6s %6s\n", "setting", "cost", "RMSE", "FLIP", "SSIM",
            "flicker", "wall", "cpu");
    for (int i = 0; i < count; i++) {
        const struct chart_value *v = &chart->value[condition][kind][point[i].setting];
        fprintf(out, "%-24s %8.2f %6.2f %7.4f %7.4f %7.2f", chart_settings[point[i].setting].name,
                point[i].cost, v->rmse, v->flip, v->ssim, v->flicker);
        if (v->ms > 0.0)
            fprintf(out, " %6.2f %6.2f", chart_time(chart, condition, kind, point[i].setting),
                    chart_cpu(chart, condition, kind, point[i].setting));
        else
            fprintf(out, " %6s %6s", "-", "-");
        fprintf(out, "%s\n", point[i].on_frontier ? "  frontier" : "");
    }
    fprintf(out, "\n");
}

/* ------------------------------------------------------------------ Markdown */

static void write_means(FILE *out, const struct chart *chart, int condition, enum chart_set set,
                        const char *title)
{
    struct chart_point point[CHART_MAX_SETTINGS];
    int count = chart_points_of_set(chart, condition, set, point);
    if (count == 0)
        return;
    fprintf(out, "\n### %s\n\n", title);
    fprintf(out, "| setting | cost | RMSE | before rounding | FLIP | SSIM | flicker | wall | cpu "
                 "| worst RMSE | |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < count; i++) {
        int s = point[i].setting;
        struct chart_mean m = chart_mean_of(chart, condition, set, s);
        fprintf(out, "| %s | %.2f | %.2f | %.2f | %.4f | %.4f | %.2f | ", chart_settings[s].name,
                m.cost, m.rmse, m.rmse_mean, m.flip, m.ssim, m.flicker);
        if (m.time > 0.0)
            fprintf(out, "%.2f | %.2f", m.time, m.cpu);
        else
            fprintf(out, "|");
        fprintf(out, " | %.1f %s | %s |\n", m.worst, kinds[m.worst_kind].name,
                point[i].on_frontier ? "frontier" : "");
    }
}

static void write_scene(FILE *out, const struct chart *chart, int condition, int kind)
{
    struct chart_point point[CHART_MAX_SETTINGS];
    int count = chart_points_of_kind(chart, condition, kind, point);
    const struct chart_value *none = &chart->value[condition][kind][chart_none];
    if (count == 0)
        return;
    fprintf(out, "\n### %s\n\n", kinds[kind].name);
    fprintf(out, "`none`: %.2f million instructions, %.1f per pixel",
            none->instructions / 1e6, none->instructions / none->pixels);
    if (none->ms > 0.0)
        fprintf(out, ", %.2f ms of the processor", none->cpu_ms);
    fprintf(out, "\n\n| setting | cost | RMSE | before rounding | FLIP | SSIM | flicker | wall | "
                 "cpu | kB | |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < count; i++) {
        int s = point[i].setting;
        const struct chart_value *v = &chart->value[condition][kind][s];
        fprintf(out, "| %s | %.2f | %.2f | %.2f | %.4f | %.4f | %.2f | ", chart_settings[s].name,
                point[i].cost, v->rmse, v->rmse_mean, v->flip, v->ssim, v->flicker);
        if (v->ms > 0.0)
            fprintf(out, "%.2f | %.2f", chart_time(chart, condition, kind, s),
                    chart_cpu(chart, condition, kind, s));
        else
            fprintf(out, "|");
        fprintf(out, " | %.0f | %s |\n", v->arena / 1024.0,
                point[i].on_frontier ? "frontier" : "");
    }
}

static void write_tables(FILE *out, const struct chart *chart)
{
    struct chart_verdict verdict;
    fprintf(out, "# Speed against accuracy\n\n"
            "Written by `make chart`. Cost and time are relative to the sharp frame (`none`) of "
            "the same scene:\ncost in instructions of one thread (callgrind); wall and cpu in time "
            "(medians; what else the machine does\nshows in wall). RMSE and flicker are in codes "
            "of 1/255, against the mean of %d exact instants of a "
            "centred shutter of 180 degrees. Means are geometric, but for SSIM.\n"
            "FLIP at 67 pixels per degree. \"frontier\": no other setting is as cheap and as "
            "right.\n\n```\n", (int)TRUTH_EXACT_INSTANTS);
    chart_print_bars(out, chart, true, KINDS * CHART_MAX_SETTINGS, &verdict);
    fprintf(out, "```\n");
    for (int c = 0; c < CHART_CONDITIONS; c++) {
        fprintf(out, "\n## Means: %s\n", chart_conditions[c].what);
        write_means(out, chart, c, SET_OBJECT, "12 scenes with moving objects, still camera");
        write_means(out, chart, c, SET_CAMERA, "7 scenes with a moving camera or background");
        write_means(out, chart, c, SET_MOVING, "these 19 scenes");
        write_means(out, chart, c, SET_STILL, "1 still scene");
    }
    for (int c = 0; c < CHART_CONDITIONS; c++) {
        fprintf(out, "\n## Scenes: %s\n", chart_conditions[c].what);
        for (int k = 0; k < KINDS; k++)
            write_scene(out, chart, c, k);
    }
}

bool chart_write_tables(const struct chart *chart, const char *path, struct failure *f)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL)
        return fail(f, "out of memory");
    write_tables(out, chart);
    bool ok = fclose(out) == 0 || fail(f, "out of memory");
    ok = ok && file_write(path, (const uint8_t *)text, size, f);
    free(text);
    return ok;
}
