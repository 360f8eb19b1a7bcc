/* SPDX-License-Identifier: MIT */
/* failures_picture.c - rows of the failure catalogue that one picture shows: the shape of streaks,
 * and what hides what. */
#include "tests/suite/failures.h"

#include "tests/host.h"

#define PI 3.14159265358979323846

/* Colours of the scenes. */
#define GREY 0x303848u
#define CREAM 0xffe9b0u
#define RED 0xe0402au
#define WHITE 0xffffffu

/* A scene, its picture by the method, and its truth. */
struct taken {
    struct subject s;
    struct present_options present;
    uint8_t *rgb;
    const struct ref_truth *truth;
};

static void put_away(struct taken *t)
{
    free(t->rgb);
    subject_close(&t->s);
    *t = (struct taken){0};
}

/* With other options than fail_options; they are filled in after taken_open. */
static bool taken_draw(struct taken *t)
{
    t->rgb = fail_take(&t->s, &t->present, 0, 0);
    t->truth = t->rgb != NULL ? truth_of(&t->s, &t->present, FAIL_INSTANTS) : NULL;
    if (t->truth != NULL)
        return true;
    put_away(t);
    return false;
}

static bool taken_open(struct taken *t, const char *scene, const struct fail_method *method)
{
    *t = (struct taken){0};
    if (!subject_open(&t->s, scene))
        return false;
    t->present = fail_options(&t->s, method);
    return true;
}

static bool take(struct taken *t, const char *scene, const struct fail_method *method)
{
    return taken_open(t, scene, method) && taken_draw(t);
}

/* A scene as one of these takes it, of the row's method; without it the row has no numbers. */
#define TAKE(t, taker, scene) \
    struct taken t OWNED(put_away) = { 0 }; \
    END_UNLESS(taker(&t, scene, method))

static double rmse_in(const struct taken *t, struct area area)
{
    return fail_rmse(&t->s, t->rgb, t->truth, area);
}

static double rmse(const struct taken *t)
{
    return rmse_in(t, fail_whole(&t->s));
}

enum { COLUMNS = 256, PIXELS = 256 * 192 };

/* Mean over the rows of the area, of the picture and of the truth. */
static void profiles(const struct taken *t, struct area area, uint32_t fore, uint32_t back,
                     double column[COLUMNS], double want[COLUMNS])
{
    static double alpha[PIXELS];
    fail_alpha(&t->s, t->rgb, area, fore, back, false, alpha);
    fail_columns(alpha, area, column);
    fail_alpha_truth(t->truth, area, fore, back, false, alpha);
    fail_columns(alpha, area, want);
}

/* How far the streak's length is from the true one, in percent. */
static double length_error(const struct taken *t, struct area area, uint32_t fore, uint32_t back)
{
    double column[COLUMNS], want[COLUMNS];
    profiles(t, area, fore, back, column, want);
    int n = area.x1 - area.x0;
    return 100.0 * fabs(fail_half_length(column, n) / fail_half_length(want, n) - 1.0);
}

/* ------------------------------------------------------------------ 1 rotation */

/* Mean over the circle, bilinear, of a picture's green. */
static double around(const struct subject *s, const uint8_t *rgb, const double *code, double radius)
{
    enum { STEPS = 720 };
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double x = s->width / 2.0 + radius * cos(2 * PI * i / STEPS) - 0.5;
        double y = s->height / 2.0 + radius * sin(2 * PI * i / STEPS) - 0.5;
        int x0 = (int)x, y0 = (int)y;
        for (int k = 0; k < 4; k++) {
            int px = x0 + (k & 1), py = y0 + (k >> 1);
            double weight = (1 - fabs(x - px)) * (1 - fabs(y - py));
            int at = 3 * (py * s->width + px) + 1;
            sum += weight * (rgb != NULL ? rgb[at] : code[at]);
        }
    }
    return sum / STEPS;
}

static void rotation(const struct fail_method *method, double number[])
{
    static const double radius[3] = {10, 30, 55};
    struct taken t;
    END_UNLESS(take(&t, "fail/rotation", method));
    number[0] = rmse(&t);
    number[1] = 0.0;
    for (int i = 0; i < 3; i++)
        number[1] = fmax(number[1], fabs(around(&t.s, t.rgb, NULL, radius[i])
                                         - around(&t.s, NULL, t.truth->code, radius[i])));
    put_away(&t);
    /* And with no more than the pose a frame ago. */
    END_UNLESS(taken_open(&t, "fail/rotation", method));
    t.present.shutter_poses = false;
    END_UNLESS(taken_draw(&t));
    number[2] = rmse(&t);
    put_away(&t);
}

/* ------------------------------------------------------------------ 2 curve */

static void centroid(const double *alpha, struct area area, double out[2])
{
    double sum = 0.0;
    out[0] = out[1] = 0.0;
    for (int y = area.y0; y < area.y1; y++)
        for (int x = area.x0; x < area.x1; x++, alpha++) {
            sum += *alpha;
            out[0] += *alpha * x;
            out[1] += *alpha * y;
        }
    out[0] /= sum;
    out[1] /= sum;
}

static double centroid_error(const struct taken *t)
{
    static double alpha[PIXELS];
    double got[2], want[2];
    struct area whole = fail_whole(&t->s);
    fail_alpha(&t->s, t->rgb, whole, CREAM, GREY, false, alpha);
    centroid(alpha, whole, got);
    fail_alpha_truth(t->truth, whole, CREAM, GREY, false, alpha);
    centroid(alpha, whole, want);
    return hypot(got[0] - want[0], got[1] - want[1]);
}

static void curve(const struct fail_method *method, double number[])
{
    struct taken t;
    END_UNLESS(take(&t, "fail/curve", method));
    number[0] = rmse(&t);
    number[1] = centroid_error(&t);
    put_away(&t);
    /* And with no more than the pose a frame ago. */
    END_UNLESS(taken_open(&t, "fail/curve", method));
    t.present.shutter_poses = false;
    END_UNLESS(taken_draw(&t));
    number[2] = centroid_error(&t);
    put_away(&t);
}

/* ------------------------------------------------------------------ 3 long */

/* The largest step of the error from column to column over borders of tiles, less the largest one
 * elsewhere. */
static double border_step(const struct taken *t, struct area area)
{
    double border = 0.0, inside = 0.0, before = 0.0;
    for (int x = area.x0; x < area.x1; x++) {
        double error = 0.0;
        for (int y = area.y0; y < area.y1; y++) {
            int at = 3 * (y * t->s.width + x) + 1;
            error += (t->rgb[at] - t->truth->code[at]) / (area.y1 - area.y0);
        }
        double *most = x % FAIL_TILE == 0 ? &border : &inside;
        if (x > area.x0)
            *most = fmax(*most, fabs(error - before));
        before = error;
    }
    return fmax(border - inside, 0.0);
}

static void longer(const struct fail_method *method, double number[])
{
    TAKE(t, take, "fail/long");
    struct area middle = fail_around(&t.s, 0, -1, 76, 6);
    number[0] = length_error(&t, middle, CREAM, GREY);
    number[1] = border_step(&t, middle);
}

/* ------------------------------------------------------------------ 4 opposite */

static void opposite(const struct fail_method *method, double number[])
{
    TAKE(t, take, "fail/opposite");
    number[0] = fmax(length_error(&t, fail_around(&t.s, 0, -15, 60, 4), CREAM, GREY),
                     length_error(&t, fail_around(&t.s, 0, 15, 60, 4), RED, GREY));
    number[1] = rmse(&t);
}

/* ------------------------------------------------------------------ 5 slow */

static void slow(const struct fail_method *method, double number[])
{
    TAKE(t, take, "fail/slow");
    uint8_t *sharp = fail_sharp(&t.s, &t.present);
    int worst = 0;
    for (int y = 0; y < t.s.height && sharp != NULL; y++)
        for (int x = 0; x < t.s.width; x++) {
            double beyond = fmax(fabs(fail_x(&t.s, x)) - FAIL_SLOW_STREAK / 2.0, 0);
            if (hypot(beyond, fail_y(&t.s, y)) < FAIL_SLOW_RADIUS + 1.5)
                continue;
            int d = fail_difference(&t.s, t.rgb, sharp, (struct area){x, y, x + 1, y + 1});
            worst = d > worst ? d : worst;
        }
    if (sharp != NULL)
        number[0] = worst;
    free(sharp);
}

/* ------------------------------------------------------------------ 6 thin */

static void thin(const struct fail_method *method, double number[])
{
    static double alpha[PIXELS];
    struct taken t OWNED(put_away) = { 0 };
    double got = 0.0, want = 0.0;
    END_UNLESS(take(&t, "fail/thin", method));
    fail_alpha(&t.s, t.rgb, fail_whole(&t.s), WHITE, GREY, false, alpha);
    for (int i = 0; i < t.s.width * t.s.height; i++)
        got += alpha[i];
    fail_alpha_truth(t.truth, fail_whole(&t.s), WHITE, GREY, false, alpha);
    for (int i = 0; i < t.s.width * t.s.height; i++)
        want += alpha[i];
    number[0] = 100.0 * fabs(got / want - 1.0);
    number[1] = rmse(&t);
}

/* ------------------------------------------------------------------ 7 fence */

static bool is_picket(const struct subject *s, int x)
{
    double at = fail_x(s, x);
    return at - FAIL_PICKET_PITCH * floor(at / FAIL_PICKET_PITCH) < FAIL_PICKET;
}

static void fence(const struct fail_method *method, double number[])
{
    TAKE(t, take, "fail/fence");
    double worst = 0.0, sum = 0.0;
    int columns = 0;
    for (int x = 0; x < t.s.width; x++) {
        struct area column = {x, 0, x + 1, t.s.height};
        if (is_picket(&t.s, x)) {
            worst = fmax(worst, fail_error(&t.s, t.rgb, t.truth, column));
        } else {
            sum += pow(rmse_in(&t, column), 2);
            columns++;
        }
    }
    number[0] = worst;
    number[1] = sqrt(sum / columns);
}

/* ------------------------------------------------------------------ 8 edge */

static void edge(const struct fail_method *method, double number[])
{
    struct taken t OWNED(put_away) = { 0 };
    double column[COLUMNS], want[COLUMNS];
    END_UNLESS(take(&t, "fail/edge", method));
    struct area middle = fail_around(&t.s, 0, 0, 60, 4);
    profiles(&t, middle, CREAM, GREY, column, want);
    number[0] = 0.0;
    for (int x = 0; x < middle.x1 - middle.x0; x++)
        number[0] = fmax(number[0], fabs(column[x] - want[x]));
}

/* ------------------------------------------------------------------ 9 sprites */

/* From the sprite's right edge to where less than a sixteenth of it is left. */
static double spread(const double *column, struct area area, const struct subject *s)
{
    int first = s->width / 2 + FAIL_SPRITE_HALF - area.x0, n = area.x1 - area.x0, x = first;
    while (x < n && column[x] >= 1.0 / 16)
        x++;
    return x - first;
}

static void sprites(const struct fail_method *method, double number[])
{
    struct taken t OWNED(put_away) = { 0 };
    double column[COLUMNS], want[COLUMNS];
    END_UNLESS(take(&t, "fail/sprites", method));
    struct area middle = fail_around(&t.s, 0, 0, 60, 12);
    profiles(&t, middle, CREAM, 0x28503c, column, want);
    number[0] = 100.0 * (1.0 - spread(column, middle, &t.s) / spread(want, middle, &t.s));
}

/* ------------------------------------------------------------------ 10 enter */

static void enter(const struct fail_method *method, double number[])
{
    struct taken t OWNED(put_away) = { 0 }, inside;
    END_UNLESS(take(&t, "fail/enter", method));
    if (take(&inside, "fail/enter_inside", method)) {
        struct area first = {0, 0, FAIL_ENTER_STREAK / 2, t.s.height}, same = first;
        same.x0 += FAIL_ENTER_ASIDE;
        same.x1 += FAIL_ENTER_ASIDE;
        number[0] = fmax(rmse_in(&t, first) - rmse_in(&inside, same), 0.0);
        number[1] = rmse(&t);
        put_away(&inside);
    }
}

/* ------------------------------------------------------------------ 11 near plane */

/* The quad's velocities point away from the middle (`way` 1) or towards it (-1), and are as long as
 * the reach. */
static bool near_velocities(struct subject *s, const struct present_options *present, double way,
                            double *angle, double *length)
{
    struct shot shot OWNED(shot_free) = { 0 };
    int seen = 0;
    if (!fail_look(s, present, &shot))
        return false;
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            int at = y * s->width + x;
            if (!(shot.distance[at] < 1.0f))
                continue;
            double vx = shot.packed[2 * at] / 8.0, vy = -shot.packed[2 * at + 1] / 8.0;
            double rx = way * fail_x(s, x), ry = way * fail_y(s, y), size = hypot(vx, vy);
            double off = size > 0 ? atan2(vx * ry - vy * rx, vx * rx + vy * ry) : PI;
            *angle = fmax(*angle, fabs(off) * 180 / PI);
            *length = fmax(*length, fabs(size - FAIL_REACH));
            seen++;
        }
    return CHECK(seen > 100);
}

static void near_plane(const struct fail_method *method, double number[])
{
    struct taken t;
    double angle = 0.0, length = 0.0, error = 0.0;
    for (int i = 0; i < 2; i++) {
        END_UNLESS(taken_open(&t, i == 0 ? "fail/near" : "fail/pass", method));
        t.present.shutter_poses = i == 1;       /* else the pose a frame ago, behind the eye */
        END_UNLESS(taken_draw(&t));
        error = fmax(error, rmse(&t));
        bool looked = method->method != SMEAR_RECONSTRUCT
                   || near_velocities(&t.s, &t.present, i == 0 ? -1 : 1, &angle, &length);
        put_away(&t);
        if (!looked)
            return;
    }
    number[0] = error;
    number[1] = angle;
    number[2] = length;
}

/* ------------------------------------------------------------------ 14 hidden */

static void hidden(const struct fail_method *method, double number[])
{
    struct taken t OWNED(put_away) = { 0 };
    int reach = FAIL_HIDDEN_STREAK / 4;
    END_UNLESS(take(&t, "fail/hidden", method));
    struct area left = fail_around(&t.s, -FAIL_HIDDEN_HALF - reach, 0, reach, FAIL_HIDDEN_HALF);
    struct area right = fail_around(&t.s, FAIL_HIDDEN_HALF + reach, 0, reach, FAIL_HIDDEN_HALF);
    number[0] = hypot(rmse_in(&t, left), rmse_in(&t, right)) / sqrt(2.0);
}

/* ------------------------------------------------------------------ 15 pane */

static void pane(const struct fail_method *method, double number[])
{
    TAKE(t, take, "fail/pane");
    int half = FAIL_PANE_HALF + FAIL_PANE_STREAK / 2;
    int above = t.s.height / 2 - FAIL_PANE_HALF - 1;
    struct area back = {0, 0, t.s.width, above};
    number[0] = rmse_in(&t, fail_around(&t.s, 0, 0, half, FAIL_PANE_HALF));
    number[1] = rmse_in(&t, back);
}

/* ------------------------------------------------------------------ 16 leaf */

/* The largest velocity in a hole, where nothing moves. */
static double hole_velocity(struct subject *s, const struct present_options *present)
{
    struct shot shot;
    double worst = 0.0, leaf = 0.0;
    if (!fail_look(s, present, &shot))
        return NAN;
    struct area area = fail_around(s, 0, 0, FAIL_LEAF_HALF, FAIL_LEAF_HALF);
    for (int y = area.y0; y < area.y1; y++)
        for (int x = area.x0; x < area.x1; x++) {
            int at = y * s->width + x;
            bool hole = ((x - area.x0) / 8 + (y - area.y0) / 8) & 1;
            double v = hypot((double)shot.velocity[2 * at], (double)shot.velocity[2 * at + 1]);
            if (hole)
                worst = fmax(worst, v);
            else
                leaf = fmax(leaf, v);
        }
    shot_free(&shot);
    CHECK_CLOSE(leaf, 16.0, 0.2);
    return worst;
}

static void leaf(const struct fail_method *method, double number[])
{
    TAKE(t, take, "fail/leaf");
    number[0] = rmse(&t);
    if (method->method == SMEAR_RECONSTRUCT)
        number[1] = hole_velocity(&t.s, &t.present);
}

/* ------------------------------------------------------------------ 27 roll, 28 zoom, 29 sky */

static void roll(const struct fail_method *method, double number[])
{
    enum { CORNER = 32 };
    struct taken t OWNED(put_away) = { 0 };
    double sum = 0.0;
    END_UNLESS(take(&t, "fail/roll", method));
    number[0] = rmse_in(&t, fail_around(&t.s, 0, 0, 8, 8));
    for (int i = 0; i < 4; i++) {
        int x = i & 1 ? t.s.width - CORNER : 0, y = i & 2 ? t.s.height - CORNER : 0;
        sum += pow(rmse_in(&t, (struct area){x, y, x + CORNER, y + CORNER}), 2);
    }
    number[1] = sqrt(sum / 4);
}

static void zoom(const struct fail_method *method, double number[])
{
    TAKE(t, take, "fail/zoom");
    uint8_t *sharp = fail_sharp(&t.s, &t.present);
    number[0] = rmse(&t);
    if (sharp != NULL)
        number[1] = fail_difference(&t.s, t.rgb, sharp,
                                    fail_around(&t.s, 0, 0, FAIL_INSET_HALF, FAIL_INSET_HALF));
    free(sharp);
}

static void sky(const struct fail_method *method, double number[])
{
    struct taken t OWNED(put_away) = { 0 };
    double star[COLUMNS], post[COLUMNS], want[COLUMNS];
    END_UNLESS(take(&t, "fail/sky", method));
    struct area stars = fail_around(&t.s, 0, -22, 18, 3), posts = fail_around(&t.s, 0, 9, 18, 3);
    profiles(&t, stars, 0xfff4d8, 0x183058, star, want);
    profiles(&t, posts, 0xfff4d8, 0x183058, post, want);
    number[0] = 100.0 * fabs(fail_half_length(star, 36) / fail_half_length(post, 36) - 1.0);
    number[1] = rmse(&t);
}

/* ------------------------------------------------------------------ 37 sign, 38 fan, 39 rotor, 40 wheel */

/* As the program draws when nothing is said: half a frame, the poses of frames ago. */
static bool take_default(struct taken *t, const char *scene, const struct fail_method *method)
{
    if (!taken_open(t, scene, method))
        return false;
    t->present.shutter_degrees = 180.0;
    t->present.shutter_poses = false;
    return taken_draw(t);
}

static double error_at(const struct taken *t, int x, int y)
{
    const int at = 3 * (y * t->s.width + x) + 1;
    return t->rgb[at] - t->truth->code[at];
}

/* How unevenly the error goes on: the root of the mean square of its second differences along rows and columns. */
static double roughness(const struct taken *t, struct area area)
{
    double sum = 0.0;
    for (int y = area.y0 + 1; y < area.y1 - 1; y++)
        for (int x = area.x0 + 1; x < area.x1 - 1; x++) {
            const double twice = 2 * error_at(t, x, y);
            sum += pow(error_at(t, x - 1, y) + error_at(t, x + 1, y) - twice, 2)
                 + pow(error_at(t, x, y - 1) + error_at(t, x, y + 1) - twice, 2);
        }
    return sqrt(sum / (2.0 * (area.x1 - area.x0 - 2) * (area.y1 - area.y0 - 2)));
}

static void sign(const struct fail_method *method, double number[])
{
    TAKE(t, take_default, "fail/sign");
    number[0] = rmse(&t);
    number[1] = roughness(&t, fail_around(&t.s, 0, 0, 60, 24));
}

static void fan(const struct fail_method *method, double number[])
{
    TAKE(t, take_default, "fail/fan");
    const int half = FAIL_FAN_RADIUS - FAIL_FAN_ASIDE;
    number[0] = rmse(&t);
    number[1] = rmse_in(&t, fail_around(&t.s, 0, 0, half, 30));
}

/* The largest error of a mean of 3 x 3 pixels in a ring. */
static double worst_in_ring(const struct taken *t, double low, double high)
{
    double worst = 0.0;
    for (int y = 1; y < t->s.height - 1; y++)
        for (int x = 1; x < t->s.width - 1; x++) {
            const double radius = hypot(fail_x(&t->s, x), fail_y(&t->s, y));
            double sum = 0.0;
            if (radius < low || radius > high)
                continue;
            for (int i = 0; i < 9; i++)
                sum += error_at(t, x + i % 3 - 1, y + i / 3 - 1);
            worst = fmax(worst, fabs(sum / 9));
        }
    return worst;
}

static void rotor(const struct fail_method *method, double number[])
{
    TAKE(t, take_default, "fail/rotor");
    number[0] = rmse(&t);
    number[1] = worst_in_ring(&t, 0.8 * FAIL_ROTOR_RADIUS, FAIL_ROTOR_RADIUS);
}

static void wheel(const struct fail_method *method, double number[])
{
    TAKE(t, take_default, "fail/wheel");
    number[0] = rmse(&t);
    number[1] = rmse_in(&t, fail_around(&t.s, 0, 0, FAIL_ROLLING_RADIUS, FAIL_ROLLING_RADIUS));
}

/* ------------------------------------------------------------------ rows */

#define VELOCITIES "keeps no velocity of a pixel"

const struct fail_row fail_picture_rows[] = {
    {1, "rotation", rotation, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 32, [PLAIN] = 17, [MENDED] = 16}},
        {"mean over circles of 10, 30, 55 px", "codes", 2.0,
         .known = {[NONE] = 19, [PLAIN] = 9.6, [MENDED] = 9}},
        {"rmse, only the pose a frame ago", "codes", 2.0,
         .known = {[NONE] = 32, [PLAIN] = 18, [MENDED] = 17}},
    }, NULL},
    {2, "curved path", curve, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 16, [PLAIN] = 9.2, [MENDED] = 8.6}},
        {"centroid of the streak", "px", 0.5,
         .known = {[NONE] = 2.4, [PLAIN] = 2.4, [MENDED] = 2.4}},
        {"centroid, only the pose a frame ago", "px", 0.5,
         .known = {[NONE] = 2.4, [ACCUMULATE] = 2.4, [PLAIN] = 2.5, [MENDED] = 2.6,
         [SUBFRAMES] = 2.4, [TIMEMASK] = 2.4, [AUTO] = 2.4, [FINE] = 2.4}},
    }, NULL},
    {3, "longer than a tile", longer, {
        {"length of the streak", "%", 5.0, .known = {[NONE] = 63, [PLAIN] = 63, [MENDED] = 61}},
        {"step at tile borders", "codes", 1.5, .hard = true},
    }, NULL},
    {4, "opposite motions in a tile", opposite, {
        {"length of the streaks", "%", 10.0, .known = {0}},
        {"rmse", "codes", 2.0, .known = {[NONE] = 20, [PLAIN] = 9.8, [MENDED] = 9}},
    }, NULL},
    {5, "slow thing in a fast tile", slow, {
        {"still pixels off the path", "codes", 0.0,
         .known = {[PLAIN] = 220, [MENDED] = 230}},
    }, NULL},
    {6, "thin objects", thin, {
        {"energy", "%", 2.0, .known = {[NONE] = 37, [PLAIN] = 17, [MENDED] = 39}},
        {"rmse", "codes", 2.0,
         .known = {[NONE] = 40, [ACCUMULATE] = 4.8, [PLAIN] = 35, [MENDED] = 36,
         [SUBFRAMES] = 4.8, [TIMEMASK] = 4.8, [AUTO] = 9, [FINE] = 7.5}},
    }, "auto: what is thinner than a pixel falls between pixels at some of its few instants"},
    {7, "still foreground, moving background", fence, {
        {"pickets", "codes", 1.0, .known = {[PLAIN] = 130}},
        {"rmse between them", "codes", 2.0, .known = {[NONE] = 9.1, [PLAIN] = 4.6, [MENDED] = 5.1}},
    }, NULL},
    {8, "moving foreground, still background", edge, {
        {"alpha across the edge", "", 1.0 / 16, .known = {[NONE] = 0.54, [PLAIN] = 0.14}},
    }, NULL},
    {9, "neighbours at one depth", sprites, {
        {"outward streak is shorter by", "%", 10.0,
         .known = {[NONE] = 110, [ACCUMULATE] = 110, [PLAIN] = 110, [MENDED] = 110,
         [SUBFRAMES] = 110, [TIMEMASK] = 110, [AUTO] = 110, [FINE] = 110}},
    }, NULL},
    {10, "entering the frame", enter, {
        {"rmse at the edge above that inside", "codes", 0.25,
         .known = {[PLAIN] = 0.71, [MENDED] = 1.4}, .hard = true},
        {"rmse", "codes", 2.0, .known = {[NONE] = 12, [PLAIN] = 8.1, [MENDED] = 7.4}},
    }, NULL},
    {11, "near plane, previous w <= 0", near_plane, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 14, [PLAIN] = 11, [MENDED] = 9.7}, .hard = true},
        {"direction", "degrees", 10.0, .only = FILTERS, .otherwise = VELOCITIES},
        {"length off the clamp", "px", 0.25, .only = FILTERS, .otherwise = VELOCITIES},
    }, NULL},
    {14, "hidden background", hidden, {
        {"rmse of what is uncovered", "codes", 2.0,
         .known = {[NONE] = 28, [PLAIN] = 34, [MENDED] = 33}},
    }, NULL},
    {15, "transparency", pane, {
        {"rmse of the pane", "codes", 2.0, .known = {[NONE] = 9.8, [PLAIN] = 9.5, [MENDED] = 9.4}},
        {"rmse of the background", "codes", 2.0, .known = {[NONE] = 3.2}},
    }, NULL},
    {16, "cutouts", leaf, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 15, [PLAIN] = 4.4, [MENDED] = 2.5}},
        {"velocity in holes", "px", 0.0, .only = FILTERS, .otherwise = VELOCITIES},
    }, NULL},
    {27, "roll", roll, {
        {"rmse of the middle", "codes", 2.0, .known = {0}},
        {"rmse of the corners", "codes", 2.0,
         .known = {[NONE] = 14, [PLAIN] = 7.6, [MENDED] = 6.1}},
    }, NULL},
    {28, "zoom", zoom, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 3.1, [MENDED] = 2.8}},
        {"still inset", "codes", 0.0, .known = {[PLAIN] = 81}},
    }, NULL},
    {29, "sky", sky, {
        {"streaks of stars against posts", "%", 5.0, .known = {[PLAIN] = 6.8, [MENDED] = 14}},
        {"rmse", "codes", 2.0, .known = {[NONE] = 33, [PLAIN] = 13, [MENDED] = 12}},
    }, NULL},
    {37, "letters of a sign", sign, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 49, [PLAIN] = 13, [MENDED] = 9}},
        {"stairs in the letters", "codes", 4.0, .known = {[NONE] = 72, [PLAIN] = 25, [MENDED] = 21}},
    }, NULL},
    {38, "fans that overlap", fan, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 27, [PLAIN] = 13, [MENDED] = 12}},
        {"rmse where they do", "codes", 3.0, .known = {[NONE] = 45, [PLAIN] = 21, [MENDED] = 20}},
    }, NULL},
    {39, "tips of a rotor", rotor, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 25, [PLAIN] = 13, [MENDED] = 12}},
        {"forks, means of 3x3", "codes", 10.0, .known = {[NONE] = 62, [PLAIN] = 51, [MENDED] = 47}},
    }, NULL},
    {40, "rolling wheel", wheel, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 31, [PLAIN] = 12, [MENDED] = 11}},
        {"rmse of the wheel", "codes", 3.0, .known = {[NONE] = 58, [PLAIN] = 21, [MENDED] = 19}},
    }, NULL},
};

const int fail_picture_count = sizeof fail_picture_rows / sizeof *fail_picture_rows;
