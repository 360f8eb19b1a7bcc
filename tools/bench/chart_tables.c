/* SPDX-License-Identifier: MIT */
/* chart_tables.c - means, and one scene after the other, for the terminal. */
#include "tools/bench/chart.h"

#include "tools/bench/sheet.h"

static void print_mean(FILE *out, const struct chart_mean *mean)
{
    if (mean->known)
        fprintf(out, " %7.1f %6.2f %5.2f %5.2f", mean->instructions, mean->cost, mean->rmse, mean->flicker);
    else
        fprintf(out, " %7s %6s %5s %5s", "-", "-", "-", "-");
}

/* Of the sets that stand beside each other in the table. */
static const struct {
    enum chart_set set;
    const char *what;
} columns[] = { { SET_OBJECT, "objects" }, { SET_CAMERA, "camera" }, { SET_DEMO, "demo" }, { SET_FIELD, "demo, models" },
                { SET_PEER, "with peer" } };
enum { COLUMNS = sizeof columns / sizeof *columns };

static void print_peers(FILE *out, const struct chart *chart, int condition)
{
    for (int s = 0; s < PEER_SETTINGS; s++) {
        double cost[COLUMNS], rmse[COLUMNS], none[COLUMNS];
        bool known[COLUMNS], any = false;
        for (int i = 0; i < COLUMNS; i++) {
            known[i] = columns[i].set == SET_PEER
                    && chart_peer_mean(chart, condition, columns[i].set, s, &cost[i], &rmse[i]);
            none[i] = chart_mean_of(chart, condition, columns[i].set, chart_none).instructions;
            any = any || known[i];
        }
        if (!any)
            continue;
        fprintf(out, "TGX %-20s", chart_peer_name[s]);
        for (int i = 0; i < COLUMNS; i++)
            if (known[i])
                fprintf(out, " %7.1f %6.2f %5.2f %5s", cost[i] * none[i], cost[i], rmse[i], "-");
            else
                fprintf(out, " %7s %6s %5s %5s", "-", "-", "-", "-");
        fprintf(out, "\n");
    }
}

void chart_print_means(FILE *out, const struct chart *chart, int condition)
{
    fprintf(out, "%s\n", chart_conditions[condition].what);
    fprintf(out, "%-24s", "");
    for (int i = 0; i < COLUMNS; i++)
        fprintf(out, " %-26s", columns[i].what);
    fprintf(out, "  still, cpu\n%-24s", "setting");
    for (int i = 0; i < COLUMNS; i++)
        fprintf(out, " %7s %6s %5s %5s", "M", "cost", "RMSE", "flick");
    fprintf(out, " %6s %6s\n", "cost", "moving");
    for (int s = 0; s < chart_setting_count; s++) {
        struct chart_mean mean[COLUMNS], still = chart_mean_of(chart, condition, SET_STILL, s);
        struct chart_mean moving = chart_mean_of(chart, condition, SET_MOVING, s);
        bool any = still.known;
        for (int i = 0; i < COLUMNS; i++) {
            mean[i] = chart_mean_of(chart, condition, columns[i].set, s);
            any = any || mean[i].known;
        }
        if (!any)
            continue;
        fprintf(out, "%-24s", chart_settings[s].name);
        for (int i = 0; i < COLUMNS; i++)
            print_mean(out, &mean[i]);
        if (still.known)
            fprintf(out, " %6.2f", still.cost);
        else
            fprintf(out, " %6s", "-");
        if (moving.known && moving.cpu > 0.0)
            fprintf(out, " %6.2f", moving.cpu);
        fprintf(out, "\n");
    }
    print_peers(out, chart, condition);
}

void chart_print_none(FILE *out, const struct chart *chart, int condition)
{
    double each[ALL_KINDS], least = 0.0, most = 0.0;
    int n = 0;
    for (int k = 0; k < ALL_KINDS; k++) {
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
    fprintf(out, "%-24s %8s %8s %6s %6s %7s %7s %7s %6s %6s %6s\n", "setting", "M", "cost", "RMSE", "exact", "FLIP", "SSIM",
            "flicker", "kB", "wall", "cpu");
    for (int i = 0; i < count; i++) {
        const struct chart_value *v = &chart->value[condition][kind][point[i].setting];
        fprintf(out, "%-24s %8.2f %8.2f %6.2f %6.2f %7.4f %7.4f %7.2f %6.0f", chart_settings[point[i].setting].name,
                v->instructions / 1e6, point[i].cost, v->rmse, v->rmse_mean, v->flip, v->ssim, v->flicker, v->arena / 1024.0);
        if (v->ms > 0.0)
            fprintf(out, " %6.2f %6.2f", chart_time(chart, condition, kind, point[i].setting),
                    chart_cpu(chart, condition, kind, point[i].setting));
        else
            fprintf(out, " %6s %6s", "-", "-");
        fprintf(out, "%s\n", point[i].on_frontier ? "  frontier" : "");
    }
    fprintf(out, "\n");
}
