/* SPDX-License-Identifier: MIT */
/* failures.c - pictures and measures of the failure catalogue; see failures.h. */
#include "tests/suite/failures.h"

/* One line per column of the table. */
const struct fail_method fail_method[METHODS] = {
    [NONE] = {"none", SMEAR_NONE, 0, 0, 0},
    [ACCUMULATE] = {"accumulate 32", SMEAR_ACCUMULATE, 32, 0, 0},
    [PLAIN] = {"reconstruct 8", SMEAR_RECONSTRUCT, 8, 0, 0},
    [MENDED] = {"mended 8", SMEAR_RECONSTRUCT, 8,
                 SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX, 0},
    [SUBFRAMES] = {"subframes 32", SMEAR_SUBFRAMES, 32, 0, 0},
    [TIMEMASK] = {"timemask 32", SMEAR_TIMEMASK, 32, 0, 0},
    [AUTO] = {"auto balanced", SMEAR_AUTO, 0, 0, SMEAR_BALANCED},
    [FINE] = {"auto fine", SMEAR_AUTO, 0, 0, SMEAR_FINE},
    [CAMERA] = {"camera 8", SMEAR_CAMERA, 8, 0, 0},
    [PINGPONG] = {"pingpong", SMEAR_PINGPONG, 0, 0, 0, .spread = true},
    [HALF_SIZE] = {"half 8", SMEAR_HALF, 8, SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX, 0},
    [JIMENEZ] = {"jimenez 8", SMEAR_RECONSTRUCT, 8, 0, 0, .weights = SMEAR_WEIGHTS_JIMENEZ},
    [OBJECT] = {"object", SMEAR_OBJECT, 8, 0, 0},
    [LAYERED] = {"layered 8", SMEAR_LAYERED, 8, 0, 0},
};

static bool broken(const struct subject *s, const char *why)
{
    test_state.failures_here++;
    say("  %s: %s\n", s->name, why);
    return false;
}

/* ------------------------------------------------------------------ drawing */

struct present_options fail_options(const struct subject *s, const struct fail_method *method)
{
    struct present_options present = subject_options(s);
    present.shutter_degrees = 360.0;
    present.shutter_poses = true;
    present.method = method->method;
    present.samples = method->samples;
    present.reconstruct = method->flags;
    present.target = method->target;
    present.weights = method->weights;
    present.pingpong.spread = method->spread;
    return present;
}

static const struct presented *present(struct subject *s, const struct present_options *options)
{
    struct failure f = {{0}};
    const struct presented *p = presenter_frame(s->presenter, s->time, options, &f);
    if (p == NULL)
        broken(s, f.text);
    return p;
}

uint8_t *fail_take(struct subject *s, const struct present_options *options, int width, int height)
{
    struct shot shot;
    const struct shot_options o = {.width = width, .height = height, .reach = FAIL_REACH, .tile = FAIL_TILE};
    return shot_take(s, options, &o, &shot) ? shot.rgb : NULL;
}

uint8_t *fail_sharp(struct subject *s, const struct present_options *options)
{
    struct present_options sharp = *options;
    sharp.method = SMEAR_NONE;
    return fail_take(s, &sharp, 0, 0);
}

static void move_origin(int32_t origin[3], const int32_t offset[3])
{
    for (int i = 0; i < 3; i++)
        origin[i] += offset[i];
}

enum { MOVED_DRAWS = 8 };

/* Draws p with its draws and its cameras moved, Q16.16. */
static uint8_t *draw_moved(struct subject *s, const struct presented *p, const int32_t draws[3],
                           const int32_t cameras[3])
{
    struct presented moved = *p;
    smear_draw draw[MOVED_DRAWS];
    smear_transform pose[MOVED_DRAWS][3];
    if (!CHECK(p->draw_count <= MOVED_DRAWS))
        return NULL;
    for (int i = 0; i < p->draw_count; i++) {
        draw[i] = p->draw[i];
        const smear_transform **of[3] = {&draw[i].now, &draw[i].open, &draw[i].close};
        for (int k = 0; k < 3; k++)
            if (*of[k] != NULL) {
                pose[i][k] = **of[k];
                move_origin(pose[i][k].origin, draws);
                *of[k] = &pose[i][k];
            }
    }
    for (int k = 0; k < 3; k++)
        move_origin(moved.camera[k].pose.origin, cameras);
    moved.frame.camera = &moved.camera[0];
    moved.frame.open = p->frame.open != NULL ? &moved.camera[1] : NULL;
    moved.frame.close = p->frame.close != NULL ? &moved.camera[2] : NULL;
    moved.draw = draw;
    struct shot shot;
    return shot_draw(s, &moved, &(struct shot_options){.reach = FAIL_REACH, .tile = FAIL_TILE}, &shot) ? shot.rgb : NULL;
}

uint8_t *fail_take_away(struct subject *s, const struct present_options *options,
                        const int offset[3])
{
    const struct presented *p = present(s, options);
    int32_t fixed[3];
    for (int i = 0; i < 3; i++)
        fixed[i] = offset[i] * 65536;
    return p != NULL ? draw_moved(s, p, fixed, fixed) : NULL;
}

uint8_t *fail_take_aside(struct subject *s, const struct present_options *options, int x, int y)
{
    const struct presented *p = present(s, options);
    if (p == NULL)
        return NULL;
    int32_t unit = (int32_t)(p->world_scale * 65536), still[3] = {0};
    return draw_moved(s, p, still, (int32_t[3]){-x * unit, y * unit, 0});
}

bool fail_look(struct subject *s, const struct present_options *options, struct shot *out)
{
    return shot_take(s, options,
                     &(struct shot_options){.reach = FAIL_REACH, .tile = FAIL_TILE, .look = true},
                     out);
}

/* ------------------------------------------------------------------ frames in turn */

bool reel_open(struct reel *reel, const char *scene)
{
    *reel = (struct reel){0};
    if (!subject_open(&reel->subject, scene))
        return false;
    const struct subject *s = &reel->subject;
    reel->rgb = malloc((size_t)s->width * (size_t)s->height * 3);
    return CHECK(reel->rgb != NULL);
}

void reel_close(struct reel *reel)
{
    rig_end(&reel->rig);
    free(reel->rgb);
    if (reel->subject.presenter != NULL)
        subject_close(&reel->subject);
    *reel = (struct reel){0};
}

bool reel_frame(struct reel *reel, const struct fail_method *method, double frame)
{
    struct subject *s = &reel->subject;
    struct present_options options = fail_options(s, method);
    options.keep_ids = true;
    options.shutter_poses = false;
    s->time = FAIL_TIME + frame / FAIL_FPS;
    const struct presented *p = present(s, &options);
    if (p == NULL)
        return false;
    if (reel->rig.ctx == NULL) {
        smear_desc desc = presented_desc(p, s->width, s->height);
        desc.reach = FAIL_REACH;
        desc.tile = FAIL_TILE;
        desc.format = SMEAR_XRGB8888;
        desc.methods |= SMEAR_SET(SMEAR_RECONSTRUCT);
        desc.max_triangles *= 5;
        desc.max_draws += 4;        /* more may come in later frames */
        if (!rig_begin(&reel->rig, &desc, false))
            return false;
    }
    rig_forget_output(&reel->rig);
    if (presented_submit(p, reel->rig.ctx) != SMEAR_OK || smear_render(reel->rig.ctx) != SMEAR_OK)
        return broken(s, "the library does not draw the frame");
    rig_rgb(&reel->rig, reel->rgb);
    return true;
}

/* ------------------------------------------------------------------ differences */

struct area fail_whole(const struct subject *s)
{
    return (struct area){0, 0, s->width, s->height};
}

struct area fail_around(const struct subject *s, int x, int y, int half_width, int half_height)
{
    x += s->width / 2;
    y += s->height / 2;
    return (struct area){x - half_width, y - half_height, x + half_width, y + half_height};
}

double fail_rmse(const struct subject *s, const uint8_t *rgb, const struct ref_truth *truth,
                 struct area area)
{
    double sum = 0.0;
    for (int y = area.y0; y < area.y1; y++)
        for (int i = 3 * area.x0; i < 3 * area.x1; i++) {
            size_t at = 3 * (size_t)y * (size_t)s->width + (size_t)i;
            double d = rgb[at] - truth->code[at];
            sum += d * d;
        }
    return sqrt(sum / (3.0 * (area.x1 - area.x0) * (area.y1 - area.y0)));
}

int fail_difference(const struct subject *s, const uint8_t *a, const uint8_t *b, struct area area)
{
    int worst = 0;
    for (int y = area.y0; y < area.y1; y++)
        for (int i = 3 * area.x0; i < 3 * area.x1; i++) {
            size_t at = 3 * (size_t)y * (size_t)s->width + (size_t)i;
            int d = abs(a[at] - b[at]);
            worst = d > worst ? d : worst;
        }
    return worst;
}

double fail_error(const struct subject *s, const uint8_t *rgb, const struct ref_truth *truth,
                  struct area area)
{
    double worst = 0.0;
    for (int y = area.y0; y < area.y1; y++)
        for (int i = 3 * area.x0; i < 3 * area.x1; i++) {
            size_t at = 3 * (size_t)y * (size_t)s->width + (size_t)i;
            worst = fmax(worst, fabs(rgb[at] - truth->code[at]));
        }
    return worst;
}

/* ------------------------------------------------------------------ streaks */

/* A line through two colours. */
struct ramp {
    bool encoded;
    double back[3], along[3];   /* along: fore - back, over its squared length */
};

static double value_of(double code, bool encoded)
{
    return encoded ? code / 255.0 : ref_srgb_decode(code / 255.0);
}

static struct ramp ramp_of(uint32_t fore, uint32_t back, bool encoded)
{
    struct ramp r = {.encoded = encoded};
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        int shift = 16 - 8 * k;
        r.back[k] = value_of(back >> shift & 255, encoded);
        r.along[k] = value_of(fore >> shift & 255, encoded) - r.back[k];
        square += r.along[k] * r.along[k];
    }
    for (int k = 0; k < 3; k++)
        r.along[k] /= square;
    return r;
}

static double alpha_of(const struct ramp *r, const double code[3])
{
    double alpha = 0.0;
    for (int k = 0; k < 3; k++)
        alpha += (value_of(code[k], r->encoded) - r->back[k]) * r->along[k];
    return alpha;
}

void fail_alpha(const struct subject *s, const uint8_t *rgb, struct area area, uint32_t fore,
                uint32_t back, bool encoded, double *alpha)
{
    struct ramp r = ramp_of(fore, back, encoded);
    for (int y = area.y0; y < area.y1; y++)
        for (int x = area.x0; x < area.x1; x++) {
            const uint8_t *p = rgb + 3 * ((size_t)y * (size_t)s->width + (size_t)x);
            *alpha++ = alpha_of(&r, (double[3]){p[0], p[1], p[2]});
        }
}

void fail_alpha_truth(const struct ref_truth *truth, struct area area, uint32_t fore,
                      uint32_t back, bool encoded, double *alpha)
{
    struct ramp r = ramp_of(fore, back, encoded);
    for (int y = area.y0; y < area.y1; y++)
        for (int x = area.x0; x < area.x1; x++)
            *alpha++ = alpha_of(&r, truth->code + 3 * ((size_t)y * (size_t)truth->width
                                                       + (size_t)x));
}

void fail_columns(const double *alpha, struct area area, double *column)
{
    int width = area.x1 - area.x0, height = area.y1 - area.y0;
    for (int x = 0; x < width; x++) {
        column[x] = 0.0;
        for (int y = 0; y < height; y++)
            column[x] += alpha[y * width + x] / height;
    }
}

double fail_half_length(const double *column, int count)
{
    double peak = 0.0;
    int first = -1, last = -1;
    for (int x = 0; x < count; x++)
        peak = fmax(peak, column[x]);
    for (int x = 0; x < count; x++)
        if (column[x] >= peak / 2) {
            first = first < 0 ? x : first;
            last = x;
        }
    if (first <= 0 || last >= count - 1)
        return peak > 0.0 ? count : 0.0;        /* beyond the area */
    double left = first - (column[first] - peak / 2) / (column[first] - column[first - 1]);
    double right = last + (column[last] - peak / 2) / (column[last] - column[last + 1]);
    return right - left;
}

/* ------------------------------------------------------------------ seams */

static bool is_border(int at)
{
    return at % FAIL_TILE == 0 || at % FAIL_TILE == FAIL_TILE - 1;
}

static void add_second(struct seams *seams, double before, double here, double after, bool border)
{
    double second = fabs(before - 2.0 * here + after);
    if (border) {
        seams->border += second;
        seams->border_count++;
    } else {
        seams->inside += second;
        seams->inside_count++;
    }
}

void fail_seams(const struct subject *s, const uint8_t *rgb, const struct ref_truth *truth,
                struct area area, struct seams *of_rgb, struct seams *of_truth)
{
    const double *t = truth->code;
    const int step[2] = {3, 3 * s->width};
    for (int y = area.y0 + 1; y < area.y1 - 1; y++)
        for (int x = area.x0 + 1; x < area.x1 - 1; x++)
            for (int axis = 0; axis < 2; axis++) {
                int at = 3 * (y * s->width + x) + 1, d = step[axis];    /* green */
                if (fabs(t[at - d] - t[at]) + fabs(t[at + d] - t[at]) < 0.01)
                    continue;
                bool border = is_border(axis == 0 ? x : y);
                add_second(of_rgb, rgb[at - d], rgb[at], rgb[at + d], border);
                add_second(of_truth, t[at - d], t[at], t[at + d], border);
            }
}

static double border_ratio(const struct seams *s)
{
    return s->border / (double)s->border_count / (s->inside / (double)s->inside_count);
}

double fail_seam_ratio(const struct seams *of_rgb, const struct seams *of_truth)
{
    return border_ratio(of_rgb) / border_ratio(of_truth);
}
