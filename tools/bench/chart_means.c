/* SPDX-License-Identifier: MIT */
/* chart_means.c - means over groups of scenes, and frontiers. */
#include "tools/bench/chart.h"

#include "tools/bench/sheet.h"

static const double least_error = 0.01;     /* so that geometric means stay finite */

bool chart_set_has(enum chart_set set, int kind)
{
    enum kind_group group = kinds[kind].group;
    switch (set) {
    case SET_OBJECT: return group == GROUP_OBJECT;
    case SET_CAMERA: return group == GROUP_CAMERA;
    case SET_MOVING: return group == GROUP_OBJECT || group == GROUP_CAMERA;
    case SET_DEMO:   return group == GROUP_DEMO;
    case SET_FIELD:  return group == GROUP_DEMO || group == GROUP_MODEL;
    case SET_PEER:   return chart_peer_of(kind) != NULL;
    default:         return group == GROUP_STILL;
    }
}

double chart_cost(const struct chart *chart, int condition, int kind, int setting)
{
    const struct chart_value *value = chart->value[condition][kind];
    if (!value[setting].known || !value[chart_none].known)
        return 0.0;
    return value[setting].instructions / value[chart_none].instructions;
}

double chart_time(const struct chart *chart, int condition, int kind, int setting)
{
    const struct chart_value *value = chart->value[condition][kind];
    return value[chart_none].ms > 0.0 ? value[setting].ms / value[chart_none].ms : 0.0;
}

double chart_cpu(const struct chart *chart, int condition, int kind, int setting)
{
    const struct chart_value *value = chart->value[condition][kind];
    return value[chart_none].cpu_ms > 0.0 ? value[setting].cpu_ms / value[chart_none].cpu_ms : 0.0;
}

static double least(double error)
{
    return error > least_error ? error : least_error;
}

struct chart_mean chart_mean_of(const struct chart *chart, int condition, enum chart_set set,
                                int setting)
{
    struct chart_mean mean = { .known = true };
    double cost[ALL_KINDS], rmse[ALL_KINDS], rmse_mean[ALL_KINDS], flicker[ALL_KINDS], instructions[ALL_KINDS], cpu[ALL_KINDS];
    bool timed = true;
    int n = 0;
    for (int k = 0; k < ALL_KINDS; k++) {
        const struct chart_value *v = &chart->value[condition][k][setting];
        if (!chart_set_has(set, k))
            continue;
        cost[n] = chart_cost(chart, condition, k, setting);
        if (cost[n] == 0.0)
            return (struct chart_mean){ .known = false };
        instructions[n] = v->instructions / 1e6;
        rmse[n] = least(v->rmse);
        rmse_mean[n] = least(v->rmse_mean);
        flicker[n] = least(v->flicker);
        cpu[n] = chart_cpu(chart, condition, k, setting);
        timed = timed && cpu[n] > 0.0;
        n++;
    }
    mean.scenes = n;
    mean.cost = geometric_mean(cost, n);
    mean.instructions = geometric_mean(instructions, n);
    mean.rmse = geometric_mean(rmse, n);
    mean.rmse_mean = geometric_mean(rmse_mean, n);
    mean.flicker = geometric_mean(flicker, n);
    mean.cpu = timed ? geometric_mean(cpu, n) : 0.0;
    return mean;
}

/* ------------------------------------------------------------------ frontiers */

static bool beats(const struct chart_point *a, const struct chart_point *b)
{
    return a->cost <= b->cost && a->error <= b->error
        && (a->cost < b->cost || a->error < b->error);
}

void chart_mark_frontier(struct chart_point *point, int count)
{
    for (int i = 0; i < count; i++) {
        point[i].on_frontier = true;
        for (int j = 0; j < count; j++)
            if (beats(&point[j], &point[i]))
                point[i].on_frontier = false;
    }
}

int chart_points_of_kind(const struct chart *chart, int condition, int kind,
                         struct chart_point out[CHART_MAX_SETTINGS])
{
    int n = 0;
    for (int s = 0; s < chart_setting_count; s++) {
        double cost = chart_cost(chart, condition, kind, s);
        if (cost > 0.0)
            out[n++] = (struct chart_point){ s, cost, chart->value[condition][kind][s].rmse,
                                             false };
    }
    chart_mark_frontier(out, n);
    return n;
}

int chart_points_of_set(const struct chart *chart, int condition, enum chart_set set,
                        struct chart_point out[CHART_MAX_SETTINGS])
{
    int n = 0;
    for (int s = 0; s < chart_setting_count; s++) {
        struct chart_mean mean = chart_mean_of(chart, condition, set, s);
        if (mean.known)
            out[n++] = (struct chart_point){ s, mean.cost, mean.rmse, false };
    }
    chart_mark_frontier(out, n);
    return n;
}
