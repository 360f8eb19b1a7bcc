/* SPDX-License-Identifier: MIT */
/* chart_bars.c - the bars that blur is held to, met or missed, in the main condition. */
#include "tools/bench/chart.h"

#include "tools/bench/sheet.h"

#include <math.h>
#include <string.h>

struct bars {
    FILE *out;
    const struct chart *chart;
    struct chart_verdict *verdict;
    bool all;                   /* those that were not measured, too */
};

/* Presets of the method `auto`: one number, the error it aims at. */
static const char *const presets[] = { "auto draft", "auto balanced", "auto fine" };
enum { DRAFT, BALANCED, FINE, PRESETS };

static bool is_auto(int setting)
{
    return strncmp(chart_settings[setting].name, "auto", 4) == 0;
}

static double rmse_of(const struct bars *b, int kind, int setting)
{
    return b->chart->value[CHART_MAIN][kind][setting].rmse;
}

static double cost_of(const struct bars *b, int kind, int setting)
{
    return chart_cost(b->chart, CHART_MAIN, kind, setting);
}

/* ------------------------------------------------------------------ lines */

enum side { AT_MOST, AT_LEAST };

/* NAN: not measured. */
static void bar(struct bars *b, const char *what, double value, enum side side, double limit,
                const char *unit, const char *note)
{
    const char *word = "not measured";
    char number[32] = "-";
    char bound[32];
    if (isnan(value)) {
        b->verdict->unknown++;
        if (!b->all)
            return;
    } else {
        bool met = side == AT_MOST ? value <= limit : value >= limit;
        b->verdict->met += met;
        b->verdict->missed += !met;
        word = met ? "met" : "MISSED";
        snprintf(number, sizeof number, "%.2f%s", value, unit);
    }
    snprintf(bound, sizeof bound, "%.4g%s", limit, unit);
    fprintf(b->out, "  %-52s %7s  %s %-5s %-6s %s\n", what, number,
            side == AT_MOST ? "at most " : "at least", bound, word, note);
}

static void bar_mean(struct bars *b, const char *what, enum chart_set set, int preset,
                     double rmse, double cost)
{
    char text[80], note[80] = "";
    int setting = chart_find_setting(presets[preset]);
    struct chart_mean mean = { .known = false };
    if (setting >= 0)
        mean = chart_mean_of(b->chart, CHART_MAIN, set, setting);
    if (mean.known)
        snprintf(note, sizeof note, "(%.2f against the truth before rounding)", mean.rmse_mean);
    snprintf(text, sizeof text, "%s, %s: error", what, presets[preset]);
    bar(b, text, mean.known ? mean.rmse : NAN, AT_MOST, rmse, "", note);
    snprintf(text, sizeof text, "%s, %s: cost", what, presets[preset]);
    bar(b, text, mean.known ? mean.cost : NAN, AT_MOST, cost, "x", "");
}

/* By the preset that comes closest to both. */
static void bar_scene(struct bars *b, const char *what, const char *name, double rmse, double cost)
{
    int kind = kind_find(name), best = -1;
    double best_excess = INFINITY;
    char text[80];
    for (int i = 0; i < PRESETS; i++) {
        int s = chart_find_setting(presets[i]);
        if (s < 0 || cost_of(b, kind, s) == 0.0)
            continue;
        double excess = fmax(rmse_of(b, kind, s) / rmse, cost_of(b, kind, s) / cost);
        if (excess < best_excess) {
            best_excess = excess;
            best = s;
        }
    }
    const char *which = best >= 0 ? chart_settings[best].name : "auto";
    snprintf(text, sizeof text, "%s (%s), %s: error", what, name, which);
    bar(b, text, best >= 0 ? rmse_of(b, kind, best) : NAN, AT_MOST, rmse, "", "");
    snprintf(text, sizeof text, "%s (%s), %s: cost", what, name, which);
    bar(b, text, best >= 0 ? cost_of(b, kind, best) : NAN, AT_MOST, cost, "x", "");
}

/* ------------------------------------------------------------------ still */

static void bars_of_still(struct bars *b)
{
    int kind = kind_find("still"), known = 0, same = 0;
    const struct chart_value *value = b->chart->value[CHART_MAIN][kind];
    double worst = 0.0;
    char note[64];
    for (int s = 0; s < chart_setting_count; s++)
        if (is_auto(s) && cost_of(b, kind, s) > 0.0) {
            known++;
            same += value[s].crc == value[chart_none].crc;
            worst = fmax(worst, cost_of(b, kind, s));
        }
    snprintf(note, sizeof note, "(dearest of %d settings of auto)", known);
    bar(b, "still scene: cost", known > 0 ? worst : NAN, AT_MOST, 1.02, "x",
        known > 0 ? note : "");
    double different = known - same;
    bar(b, "still scene: settings whose picture differs from none", known > 0 ? different : NAN,
        AT_MOST, 0.0, "", "");
}

/* ------------------------------------------------------------------ every scene */

struct worst {
    double value;               /* NAN: nothing known */
    int kind, setting, other;
};

static void take_worst(struct worst *worst, double value, int kind, int setting, int other)
{
    if (isnan(worst->value) || value > worst->value)
        *worst = (struct worst){ value, kind, setting, other };
}

static void bars_of_every_scene(struct bars *b)
{
    struct worst none = { .value = NAN }, raise = { .value = NAN };
    struct worst fine = { .value = NAN }, textured = { .value = NAN };
    char note[160] = "";
    for (int k = 0; k < KINDS; k++)
        for (int s = 0; s < chart_setting_count; s++) {
            double cost = cost_of(b, k, s), rmse = rmse_of(b, k, s);
            if (!is_auto(s) || cost == 0.0)
                continue;
            take_worst(&none, rmse - rmse_of(b, k, chart_none), k, s, chart_none);
            for (int cheaper = 0; cheaper < chart_setting_count; cheaper++)
                if (is_auto(cheaper) && cost_of(b, k, cheaper) > 0.0
                    && cost_of(b, k, cheaper) < cost)
                    take_worst(&raise, rmse - rmse_of(b, k, cheaper), k, s, cheaper);
            if (strcmp(chart_settings[s].name, presets[FINE]) == 0)
                take_worst(strcmp(kinds[k].name, "textured") == 0 ? &textured : &fine, rmse, k,
                           s, s);
        }
    if (!isnan(none.value))
        snprintf(note, sizeof note, "(%s on %s)", chart_settings[none.setting].name,
                 kinds[none.kind].name);
    bar(b, "error above that of none, worst scene and setting", none.value, AT_MOST, 0.0, "", note);
    note[0] = '\0';
    if (!isnan(raise.value))
        snprintf(note, sizeof note, "(%s after %s on %s)", chart_settings[raise.setting].name,
                 chart_settings[raise.other].name, kinds[raise.kind].name);
    bar(b, "error added by paying more, worst scene and setting", raise.value, AT_MOST, 0.05, "",
        note);
    note[0] = '\0';
    if (!isnan(fine.value))
        snprintf(note, sizeof note, "(%s)", kinds[fine.kind].name);
    bar(b, "auto fine, worst scene: error", fine.value, AT_MOST, 1.5, "", note);
    bar(b, "auto fine, textured: error", textured.value, AT_MOST, 3.0, "", "");
}

static void bar_flicker(struct bars *b, int preset, double limit)
{
    char text[80];
    int setting = chart_find_setting(presets[preset]);
    struct chart_mean mean = { .known = false };
    if (setting >= 0)
        mean = chart_mean_of(b->chart, CHART_MAIN, SET_MOVING, setting);
    snprintf(text, sizeof text, "flicker of scenes with motion, %s", presets[preset]);
    bar(b, text, mean.known ? mean.flicker : NAN, AT_MOST, limit, "", "");
}

/* ------------------------------------------------------------------ the frontier */

/* Cheaper or more accurate by more than 1 %, and not worse in the other. */
static bool clearly_beats(const struct chart_point *a, const struct chart_point *b)
{
    return a->cost <= b->cost && a->error <= b->error
        && (1.01 * a->cost < b->cost || 1.01 * a->error < b->error);
}

/* The cheapest point of another method that beats one of auto; null when there is none. */
static const struct chart_point *beaten_by(const struct chart_point *point, int count, int which)
{
    const struct chart_point *by = NULL;
    if (!is_auto(point[which].setting))
        return NULL;
    for (int j = 0; j < count; j++)
        if (!is_auto(point[j].setting) && clearly_beats(&point[j], &point[which])
            && (by == NULL || point[j].cost < by->cost))
            by = &point[j];
    return by;
}

static int beaten(const struct chart_point *point, int count)
{
    int found = 0;
    for (int i = 0; i < count; i++)
        found += beaten_by(point, count, i) != NULL;
    return found;
}

static void name_beaten(struct bars *b, const struct chart_point *point, int count,
                        const char *what)
{
    for (int i = 0; i < count; i++) {
        const struct chart_point *by = beaten_by(point, count, i);
        if (by != NULL)
            fprintf(b->out, "    %s: %s %.2fx %.2f is beaten by %s %.2fx %.2f\n", what,
                    chart_settings[point[i].setting].name, point[i].cost, point[i].error,
                    chart_settings[by->setting].name, by->cost, by->error);
    }
}

static int autos_among(const struct chart_point *point, int count)
{
    int found = 0;
    for (int i = 0; i < count; i++)
        found += is_auto(point[i].setting);
    return found;
}

static void bar_frontier(struct bars *b)
{
    static const struct {
        enum chart_set set;
        const char *name;
    } sets[] = { { SET_OBJECT, "object scenes" }, { SET_CAMERA, "camera scenes" } };
    struct chart_point point[CHART_MAX_SETTINGS];
    char text[80], note[64];
    int points = 0, worse = 0;
    for (int i = 0; i < 2; i++) {
        int count = chart_points_of_set(b->chart, CHART_MAIN, sets[i].set, point);
        int autos = autos_among(point, count);
        double by_others = beaten(point, count);
        snprintf(text, sizeof text, "settings of auto above the frontier, %s", sets[i].name);
        snprintf(note, sizeof note, "(of %d)", autos);
        bar(b, text, autos > 0 ? by_others : NAN, AT_MOST, 0.0, "", autos > 0 ? note : "");
        name_beaten(b, point, count, sets[i].name);
    }
    for (int k = 0; k < KINDS; k++) {
        int count = chart_points_of_kind(b->chart, CHART_MAIN, k, point);
        if (kinds[k].group == GROUP_STILL)      /* has a bar of its own */
            continue;
        points += autos_among(point, count);
        worse += beaten(point, count);
    }
    if (points > 0)
        fprintf(b->out, "  Scene by scene %d of %d points of auto lie above it:\n", worse, points);
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].group != GROUP_STILL) {
            int count = chart_points_of_kind(b->chart, CHART_MAIN, k, point);
            name_beaten(b, point, count, kinds[k].name);
        }
}

/* ------------------------------------------------------------------ all */

void chart_print_bars(FILE *out, const struct chart *chart, bool all, struct chart_verdict *verdict)
{
    struct bars b = { out, chart, verdict, all };
    *verdict = (struct chart_verdict){ 0, 0, 0 };
    fprintf(out, "Bars (%s; errors against the truth rounded to 8 bits)\n",
            chart_conditions[CHART_MAIN].what);
    bars_of_still(&b);
    bar_mean(&b, "object scenes", SET_OBJECT, BALANCED, 1.4, 1.9);
    bar_mean(&b, "object scenes", SET_OBJECT, FINE, 0.6, 2.6);
    bar_mean(&b, "camera scenes", SET_CAMERA, BALANCED, 2.5, 5.0);
    bar_mean(&b, "camera scenes", SET_CAMERA, FINE, 1.2, 6.5);
    bar_scene(&b, "a typical game frame", "arena", 1.2, 4.0);
    bars_of_every_scene(&b);
    bar_scene(&b, "a jump", "teleport", 0.5, 1.15);
    bar_scene(&b, "near plane", "near", 1.2, 8.0);
    bar_flicker(&b, BALANCED, 1.2);
    bar_flicker(&b, FINE, 0.5);
    bar_frontier(&b);
}
