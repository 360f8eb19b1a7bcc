/* SPDX-License-Identifier: MIT */
/* test_chart.c - the chart of error against cost: what lies on the frontier, means, bars that can
 * be missed, its file, room for labels, pictures, and the truth it measures against. */
#include "tools/bench/chart.h"
#include "tools/bench/svg.h"
#include "tools/bench/truth.h"
#include "tools/player/exact.h"

#include "tests/host.h"

#include <sys/stat.h>

#define FOLDER "build/test"

static struct chart chart;

static bool make_folder(void)
{
    mkdir("build", 0777);
    mkdir(FOLDER, 0777);
    struct stat status;
    return CHECK(stat(FOLDER, &status) == 0);
}

static struct chart_value *value(const char *kind, const char *setting)
{
    return &chart.value[CHART_MAIN][kind_find(kind)][chart_find_setting(setting)];
}

/* With 1000 pixels, and 1 M instructions for a cost of 1. */
static void set(int kind, const char *setting, double cost, double rmse, double flicker)
{
    *value(kinds[kind].name, setting) = (struct chart_value){
        .known = true, .pixels = 1000, .instructions = 1e6 * cost, .rmse = rmse,
        .rmse_mean = rmse, .flip = 0.01, .ssim = 0.9, .flicker = flicker, .crc = 7, .arena = 1024
    };
}

/* A chart in which every bar is met. */
static void fill_good(void)
{
    memset(&chart, 0, sizeof chart);
    for (int k = 0; k < KINDS; k++) {
        bool still = kinds[k].group == GROUP_STILL, jump = strcmp(kinds[k].name, "teleport") == 0;
        double error = still ? 0.0 : 1.0;
        set(k, "none", 1.0, 10.0 * error, 15.0 * error);
        set(k, "accumulate 8", 9.0, 1.2 * error, 1.0 * error);
        set(k, "reconstruct 8", still ? 1.03 : 7.0, 5.0 * error, 6.0 * error);
        set(k, "object", 1.5, 1.7 * error, 3.0 * error);
        set(k, "layered 8", 6.0, 3.0 * error, 3.0 * error);
        set(k, "auto draft", still || jump ? 1.01 : 1.2, 4.0 * error, 3.0 * error);
        set(k, "auto balanced", still ? 1.01 : jump ? 1.05 : 1.8, 1.1 * error, 1.1 * error);
        set(k, "auto fine", still ? 1.01 : jump ? 1.1 : 2.5, 0.45 * error, 0.4 * error);
    }
}

/* ------------------------------------------------------------------ points */

static void test_a_point_is_on_the_frontier_unless_one_is_as_cheap_and_as_right(void)
{
    struct chart_point point[CHART_MAX_SETTINGS];
    memset(&chart, 0, sizeof chart);
    int pan = kind_find("pan");
    set(pan, "none", 1.0, 9.0, 0.0);
    set(pan, "accumulate 4", 4.0, 3.0, 0.0);
    set(pan, "accumulate 8", 5.0, 3.0, 0.0);        /* dearer, no better */
    set(pan, "reconstruct 8", 4.0, 3.5, 0.0);       /* as dear, worse */
    set(pan, "timemask 32", 6.0, 1.0, 0.0);
    REQUIRE_EQ(chart_points_of_kind(&chart, CHART_MAIN, pan, point), 5);
    for (int i = 0; i < 5; i++) {
        const char *name = chart_settings[point[i].setting].name;
        bool beaten = strcmp(name, "accumulate 8") == 0 || strcmp(name, "reconstruct 8") == 0;
        CHECK_EQ(point[i].on_frontier, !beaten);
    }
}

static void test_means_are_geometric_and_over_whole_groups_only(void)
{
    memset(&chart, 0, sizeof chart);
    int n = 0, fine = chart_find_setting("auto fine");
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].group == GROUP_CAMERA) {
            set(k, "none", 2.0, 8.0, 1.0);
            set(k, "auto fine", n % 2 == 0 ? 4.0 : 16.0, n % 2 == 0 ? 0.5 : 2.0, 1.0);
            n++;
        }
    struct chart_mean mean = chart_mean_of(&chart, CHART_MAIN, SET_CAMERA, fine);
    /* Four scenes of cost 2 and error 1/2, three of cost 8 and error 2. */
    CHECK(mean.known);
    CHECK_EQ(mean.scenes, 7);
    CHECK_CLOSE(mean.cost, exp((4 * log(2.0) + 3 * log(8.0)) / 7), 1e-9);
    CHECK_CLOSE(mean.rmse, exp((4 * log(0.5) + 3 * log(2.0)) / 7), 1e-9);
    value("arena", "auto fine")->known = false;
    CHECK(!chart_mean_of(&chart, CHART_MAIN, SET_CAMERA, fine).known);
    CHECK(!chart_mean_of(&chart, CHART_MAIN, SET_OBJECT, fine).known);
}

/* Costs of the peer are its own instructions against those of our sharp frame; sets without its frames have none. */
static void test_a_peer_is_measured_by_the_sharp_frame(void)
{
    double cost, rmse;
    memset(&chart, 0, sizeof chart);
    for (int k = 0; k < ALL_KINDS; k++)
        set(k, "none", 2.0, 8.0, 1.0);
    const struct chart_peer *translate = chart_peer_of(kind_find("translate")), *cross = chart_peer_of(kind_find("cross"));
    REQUIRE(translate != NULL && cross != NULL);
    CHECK(chart_peer_mean(&chart, CHART_MAIN, SET_OBJECT, PEER_8, &cost, &rmse));
    CHECK_CLOSE(cost, sqrt(translate->instructions[PEER_8] * cross->instructions[PEER_8]) / 2.0, 1e-9);
    CHECK_CLOSE(rmse, sqrt(translate->rmse[PEER_8] * cross->rmse[PEER_8]), 1e-9);
    CHECK(!chart_peer_mean(&chart, CHART_MAIN, SET_STILL, PEER_8, &cost, &rmse));
    for (int i = 0; i < PEER_FRAMES; i++) {
        CHECK(kind_find(chart_peer[i].kind) >= 0);
        for (int k = 1; k < PEER_SETTINGS; k++) {
            CHECK(chart_peer[i].instructions[k] > chart_peer[i].instructions[k - 1]);
            CHECK(chart_peer[i].rmse[k] < chart_peer[i].rmse[k - 1]);
        }
    }
    value("cross", "none")->known = false;
    CHECK(!chart_peer_mean(&chart, CHART_MAIN, SET_OBJECT, PEER_8, &cost, &rmse));
}

static void test_takes_have_numbers_of_their_own(void)
{
    struct take take;
    for (int c = 0; c < CHART_CONDITIONS; c++)
        for (int k = 0; k < ALL_KINDS; k++)
            for (int s = 0; s < chart_setting_count; s++) {
                REQUIRE(chart_take(chart_index(c, k, s), &take));
                CHECK(strcmp(take.scene, kinds[k].scene) == 0);
                CHECK_EQ(take.frame, kinds[k].frame);
                CHECK_EQ(take.method, chart_settings[s].method);
                CHECK_EQ(take.samples, chart_settings[s].samples);
                CHECK_EQ(take.target, chart_settings[s].target);
                CHECK_EQ(take.linear, chart_conditions[c].linear);
                CHECK_EQ(take.shutter_poses, !chart_conditions[c].previous);
                CHECK_EQ(take.dithered, c == CHART_DEFAULT);
                CHECK(chart_error_take(chart_index(c, k, s), &take));
                CHECK_EQ(take.format, SMEAR_XRGB8888);
                CHECK(!take.dithered);
            }
    CHECK(!chart_take(-1, &take));
    CHECK(!chart_take(chart_index(CHART_CONDITIONS, 0, 0), &take));
}

/* ------------------------------------------------------------------ bars */

static char *bars_text(struct chart_verdict *verdict)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out != NULL) {
        chart_print_bars(out, &chart, true, verdict);
        fclose(out);
    }
    return text;
}

/* Whether some line holds both. */
static bool has_line(const char *text, const char *what, const char *word)
{
    for (const char *line = text; line != NULL && *line != '\0';) {
        const char *end = strchr(line, '\n'), *a = strstr(line, what), *b = strstr(line, word);
        if (end == NULL || (a != NULL && a < end && b != NULL && b < end))
            return end != NULL;
        line = end + 1;
    }
    return false;
}

static void test_a_chart_that_meets_all_bars_meets_them(void)
{
    struct chart_verdict verdict;
    fill_good();
    char *text = bars_text(&verdict);
    CHECK_EQ(verdict.missed, 0);
    CHECK_EQ(verdict.unknown, 0);
    CHECK(verdict.met > 20);
    free(text);
}

static void for_group(enum kind_group group, const char *setting, double cost, double rmse)
{
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].group == group)
            set(k, setting, cost, rmse, value(kinds[k].name, setting)->flicker);
}

static void break_still_cost(void) { set(kind_find("still"), "auto fine", 1.03, 0.0, 0.0); }
static void break_still_bits(void) { value("still", "auto draft")->crc = 8; }
static void break_object_error(void) { for_group(GROUP_OBJECT, "auto balanced", 1.8, 1.41); }
static void break_object_cost(void) { for_group(GROUP_OBJECT, "auto fine", 2.61, 0.45); }
static void break_camera_error(void) { for_group(GROUP_CAMERA, "auto fine", 2.5, 1.21); }
static void break_camera_cost(void) { for_group(GROUP_CAMERA, "auto balanced", 5.1, 1.1); }
static void break_arena(void)
{
    for (int i = 0; i < 3; i++)
        set(kind_find("arena"), (const char *[]){ "auto draft", "auto balanced", "auto fine" }[i],
            4.1, 0.4, 1.0);
}
static void break_none(void) { set(kind_find("cubic"), "auto draft", 1.2, 10.1, 3.0); }
static void break_paying(void) { set(kind_find("roll"), "auto fine", 2.5, 1.2, 0.4); }
static void break_fine(void) { set(kind_find("long"), "auto fine", 2.5, 1.6, 0.4); }
static void break_textured(void) { set(kind_find("textured"), "auto fine", 2.5, 3.1, 0.4); }
static void break_teleport(void)
{
    set(kind_find("teleport"), "auto fine", 1.2, 0.45, 0.4);
}
static void break_flicker(void)
{
    for (int k = 0; k < KINDS; k++)
        value(kinds[k].name, "auto fine")->flicker = 0.6;
}
static void break_frontier(void) { for_group(GROUP_CAMERA, "accumulate 8", 1.5, 1.05); }

static const struct {
    void (*spoil)(void);
    const char *bar;
} spoilers[] = {
    { break_still_cost, "still scene: cost" },
    { break_still_bits, "still scene: settings whose picture differs" },
    { break_object_error, "object scenes, auto balanced: error" },
    { break_object_cost, "object scenes, auto fine: cost" },
    { break_camera_error, "camera scenes, auto fine: error" },
    { break_camera_cost, "camera scenes, auto balanced: cost" },
    { break_arena, "a typical game frame (arena)" },
    { break_none, "error above that of none" },
    { break_paying, "error added by paying more" },
    { break_fine, "auto fine, worst scene" },
    { break_textured, "auto fine, textured" },
    { break_teleport, "a jump (teleport)" },
    { break_flicker, "flicker of scenes with motion, auto fine" },
    { break_frontier, "settings of auto above the frontier, camera" },
};

static void test_every_bar_can_be_missed(void)
{
    for (size_t i = 0; i < sizeof spoilers / sizeof *spoilers; i++) {
        struct chart_verdict verdict;
        fill_good();
        spoilers[i].spoil();
        char *text = bars_text(&verdict);
        CHECK(verdict.missed > 0);
        if (!CHECK(text != NULL && has_line(text, spoilers[i].bar, "MISSED")))
            test_print(spoilers[i].bar);
        free(text);
    }
}

static void test_what_is_not_measured_is_neither_met_nor_missed(void)
{
    struct chart_verdict verdict;
    memset(&chart, 0, sizeof chart);
    char *text = bars_text(&verdict);
    CHECK_EQ(verdict.met + verdict.missed, 0);
    CHECK(verdict.unknown > 20);
    free(text);
}

/* ------------------------------------------------------------------ files */

static bool same_value(const struct chart_value *a, const struct chart_value *b)
{
    return a->known == b->known && a->pixels == b->pixels && a->instructions == b->instructions
        && fabs(a->rmse - b->rmse) < 1e-4 && fabs(a->flicker - b->flicker) < 1e-4
        && fabs(a->flip - b->flip) < 1e-5 && fabs(a->ssim - b->ssim) < 1e-5 && a->crc == b->crc
        && a->arena == b->arena;
}

static void test_a_file_brings_back_what_was_written(void)
{
    static struct chart back;
    struct failure f = { "" };
    const uint32_t mine = 0xfedcba98u, another = 1;
    END_UNLESS(make_folder());
    fill_good();
    value("pan", "auto fine")->crc = 0xffffffffu;
    CHECK(chart_write_csv(&chart, NULL, mine, FOLDER "/chart.csv", &f));
    CHECK(chart_read_csv(&back, &mine, FOLDER "/chart.csv", &f));
    for (int k = 0; k < ALL_KINDS; k++)
        for (int s = 0; s < chart_setting_count; s++)
            CHECK(same_value(&chart.value[CHART_MAIN][k][s], &back.value[CHART_MAIN][k][s]));
    CHECK(chart_read_csv(&back, &another, FOLDER "/chart.csv", &f));
    CHECK(!back.value[CHART_MAIN][0][chart_none].known);
    CHECK(f.text[0] == '\0');
}

static void test_a_spoilt_file_is_refused_with_its_line(void)
{
    struct failure f = { "" };
    static const char text[] = "light,...\nencoded,shutter,pan,camera,none,1,2\n";
    END_UNLESS(make_folder());
    CHECK(file_write(FOLDER "/bad.csv", (const uint8_t *)text, sizeof text - 1, &f));
    CHECK(!chart_read_csv(&chart, NULL, FOLDER "/bad.csv", &f));
    CHECK(strstr(f.text, "line 2") != NULL);
    struct failure missing = { "" };
    CHECK(!chart_read_csv(&chart, NULL, FOLDER "/none-such.csv", &missing));
}

/* ------------------------------------------------------------------ pictures */

static bool overlap(const struct label *a, const struct label *b)
{
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height
        && b->y < a->y + a->height;
}

static void test_labels_keep_off_each_other_and_inside(void)
{
    enum { COUNT = 24 };
    static struct label label[COUNT];
    const struct box bounds = { 0, 0, 400, 300 };
    /* A crowd: all anchors within 100 x 60 pixels. */
    for (int i = 0; i < COUNT; i++)
        label[i] = (struct label){ .width = 30, .height = 12, .gap = 5, .anchors = 1,
                                   .anchor_x = { 150 + 20 * (i % 6) },
                                   .anchor_y = { 120 + 20 * (i / 6) } };
    labels_place(label, COUNT, NULL, 0, bounds);
    for (int i = 0; i < COUNT; i++) {
        CHECK(label[i].x >= 0 && label[i].x + label[i].width <= bounds.width);
        CHECK(label[i].y >= 0 && label[i].y + label[i].height <= bounds.height);
        for (int k = 0; k < i; k++)
            CHECK(!overlap(&label[i], &label[k]));
    }
}

/* Tags that are closed, in their order; no numbers that are none. */
static bool is_well_formed(const char *text)
{
    char open[32][16];
    int depth = 0;
    for (const char *at = text; (at = strchr(at, '<')) != NULL;) {
        const char *end = strchr(at, '>');
        size_t length = strspn(at + 1, "abcdefghijklmnopqrstuvwxyz");
        if (end == NULL || strcspn(at + 1, "<") < (size_t)(end - at))
            return false;
        if (at[1] == '/') {
            length = (size_t)(end - at - 2);
            if (depth == 0 || strncmp(open[--depth], at + 2, length) != 0
                || open[depth][length] != '\0')
                return false;
        } else if (end[-1] != '/') {
            if (depth == 32 || length == 0 || length > 15)
                return false;
            memcpy(open[depth], at + 1, length);
            open[depth++][length] = '\0';
        }
        at = end;
    }
    return depth == 0 && strstr(text, "\"nan") == NULL && strstr(text, "nan,") == NULL
        && strstr(text, "inf,") == NULL;
}

static void test_pictures_are_well_formed_and_show_every_method_once(void)
{
    struct failure f = { "" };
    END_UNLESS(make_folder());
    fill_good();
    for (int k = KINDS; k < ALL_KINDS; k++)         /* of the demo; models are not there */
        for (int i = 0; i < chart_setting_count && kinds[k].group == GROUP_DEMO; i++)
            chart.value[CHART_MAIN][k][i] = chart.value[CHART_MAIN][0][i];
    memcpy(chart.value[CHART_DEFAULT], chart.value[CHART_MAIN], sizeof chart.value[CHART_MAIN]);
    CHECK(chart_write_pictures(&chart, FOLDER, &f));
    uint8_t *marks;
    size_t marks_size;
    REQUIRE(file_read(FOLDER "/marks.svg", 1 << 20, &marks, &marks_size, &f));
    static const char *const plain[] = { ">smear<", ">mean of sharp frames<", ">sharp<", ">draft<", ">balanced<", ">fine<", ">8<" };
    CHECK(is_well_formed((const char *)marks));
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        CHECK(strstr((const char *)marks, plain[i]) != NULL);
    CHECK(strstr((const char *)marks, "TGX") == NULL && strstr((const char *)marks, ">object<") == NULL);
    free(marks);
    static const char *const all[] = { ">accumulate", ">auto", ">As it comes", ">TGX<", ">4 frames of the demo<" };
    REQUIRE(file_read(FOLDER "/chart.svg", 1 << 20, &marks, &marks_size, &f));
    CHECK(is_well_formed((const char *)marks));
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        CHECK(strstr((const char *)marks, all[i]) != NULL);
    free(marks);
}

/* ------------------------------------------------------------------ truth */

/* The frame that stands for a scene, as the program draws it with --exact. */
static bool picture_of(const char *name, struct image *out, struct failure *f)
{
    struct scene scene OWNED(scene_free) = { 0 };
    if (!scene_builtin(name, &scene, f))
        return false;
    struct presenter *presenter = presenter_new(&scene, f);
    const struct present_options options = { .fps = scene.fps, .shutter_degrees = 180,
                                             .light = SMEAR_LIGHT_ENCODED, .clear = scene.clear };
    bool ok = presenter != NULL
           && exact_picture(presenter, scene.time, &options, scene.width, scene.height,
                            TRUTH_INSTANTS, out, f);
    presenter_free(presenter);
    return ok;
}

static void test_the_truth_is_that_of_the_command_line(void)
{
    struct failure f = { "" };
    struct float_image truth;
    struct image rounded, exact OWNED(image_free) = { 0 };
    struct image_distance distance = { .rmse = 99.0 };
    const struct take take = { .scene = "suite/teleport", .frame = -1 };
    if (!make_folder() || !CHECK(picture_of("suite/teleport", &exact, &f)))
        return;
    if (CHECK(truth_of_take(&take, FOLDER, &truth, &f))) {
        /* From the file this time: the same, but for halves that a float rounds the other way. */
        float_image_free(&truth);
        CHECK(truth_of_take(&take, FOLDER, &truth, &f));
        if (CHECK(truth_round(&truth, &rounded, &f))) {
            CHECK(image_compare(&rounded, &exact, IMAGE_PIXELS_PER_DEGREE, &distance, &f));
            CHECK(distance.rmse < 0.05);
            image_free(&rounded);
        }
        float_image_free(&truth);
    }
}

#include "build/suites/chart.h"
