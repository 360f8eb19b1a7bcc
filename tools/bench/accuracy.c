/* SPDX-License-Identifier: MIT */
/* accuracy.c - how right the sharp frames of the peers' scenes are: against the reference in double
 * precision, and whether meshes are closed. */
#include "tools/bench/layers.h"
#include "tools/bench/sheet.h"
#include "tools/bench/take.h"

#include "tools/ref/ref.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240, FRAMES = 8, FAR_OFF = 24 };

enum layers {
    LAYERS_UNCOUNTED,           /* too deep, or nothing but what is counted elsewhere */
    LAYERS_FOLDED,              /* folds smaller than a pixel may add a layer or take one */
    LAYERS_SHEET                /* every pixel once: what is drawn twice is wrong */
};

struct judged_scene {
    const char *name;
    double bar_db;              /* 0: none */
    double peer_db;             /* best comparable peer with RGB565, TGX; 0: not measured */
    enum layers layers;
};

static const struct judged_scene scenes[] = {
    { "peer/A", 40.5, 41.4, LAYERS_FOLDED }, { "peer/B64", 30.0, 29.6, LAYERS_FOLDED },
    { "peer/B256", 0.0, 0.0, LAYERS_UNCOUNTED }, { "peer/C", 38.0, 38.2, LAYERS_UNCOUNTED },
    { "peer/D", 30.0, 30.6, LAYERS_SHEET }, { "peer/E", 36.0, 36.0, LAYERS_FOLDED },
    { "peer/F", 41.4, 0.0, LAYERS_UNCOUNTED }, { "peer/F-lit", 41.0, 0.0, LAYERS_UNCOUNTED },
    { "peer/G", 38.9, 0.0, LAYERS_UNCOUNTED }, { "peer/G-lit", 38.0, 0.0, LAYERS_UNCOUNTED },
    { "peer/N", 0.0, 40.3, LAYERS_SHEET },
};

/* Sums over the frames of a scene. */
struct tally {
    double db;
    double worst_db;
    long far_off, pixels;
    long cracks;                /* pixels inside a surface that show the background */
    long fewer, more;           /* pixels with too few or too many layers of glass */
    long interior;              /* looked at for layers */
};

/* ------------------------------------------------------------------ colours */

static double psnr(const struct image *a, const struct image *b, long *far_off)
{
    size_t pixels = (size_t)a->width * (size_t)a->height;
    double sum = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        int worst = 0;
        for (size_t c = 0; c < 3; c++) {
            int d = abs(a->rgba[4 * i + c] - b->rgba[4 * i + c]);
            sum += d * d;
            worst = d > worst ? d : worst;
        }
        *far_off += worst > FAR_OFF;
    }
    return sum > 0.0 ? 10.0 * log10(255.0 * 255.0 * 3.0 * (double)pixels / sum) : 99.0;
}

/* The scene at `frame` as the reference sees it, on the given clear colour. */
static bool reference(struct scene *scene, int frame, uint32_t clear, struct image *out,
                      struct failure *f)
{
    struct scene_instant instant = { 0 };
    struct ref_options options = { .width = WIDTH, .height = HEIGHT, .encoded = true,
                                   .clear = clear };
    struct ref_frame drawn;
    bool ok = scene_pose(scene, frame / scene->fps, &instant, f)
           && ref_draw(&instant, NULL, NULL, &options, &drawn, f);
    scene_instant_free(scene, &instant);
    if (!ok)
        return false;
    ok = ref_frame_image(&drawn, out, f);
    ref_frame_free(&drawn);
    return ok;
}

static bool judge_color(struct rig *rig, int frame, struct tally *tally, struct failure *f)
{
    struct image ours = { 0 }, exact = { 0 };
    bool ok = rig_seek(rig, frame, f) && rig_picture(rig, CLEAR_OF_SCENE, &ours, f)
           && reference(&rig->scene, frame, rig->scene.clear, &exact, f);
    if (ok) {
        double db = psnr(&ours, &exact, &tally->far_off);
        tally->db += db;
        tally->worst_db = frame == 0 || db < tally->worst_db ? db : tally->worst_db;
        tally->pixels += WIDTH * HEIGHT;
    }
    image_free(&ours);
    image_free(&exact);
    return ok;
}

/* ------------------------------------------------------------------ cracks */

enum { BLACK = 0x000000, WHITE = 0xffffff };

static bool is_code(const struct image *image, int x, int y, int code)
{
    const uint8_t *p = image->rgba + 4 * (y * image->width + x);
    return p[0] == code && p[1] == code && p[2] == code;
}

/* Which pixels are drawn: those that do not change from black to white with the background. */
struct drawn {
    struct image on_black, on_white;
};

static bool is_background(const struct drawn *drawn, int x, int y)
{
    return is_code(&drawn->on_black, x, y, 0) && is_code(&drawn->on_white, x, y, 255);
}

static bool is_inside(const struct drawn *exact, int x, int y)
{
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++)
            if (is_background(exact, x + dx, y + dy))
                return false;
    return true;
}

static bool judge_cracks(struct rig *rig, int frame, struct tally *tally, struct failure *f)
{
    struct drawn ours = { 0 }, exact = { 0 };
    bool ok = rig_seek(rig, frame, f) && rig_picture(rig, BLACK, &ours.on_black, f)
           && rig_picture(rig, WHITE, &ours.on_white, f)
           && reference(&rig->scene, frame, BLACK, &exact.on_black, f)
           && reference(&rig->scene, frame, WHITE, &exact.on_white, f);
    for (int y = 1; y < HEIGHT - 1 && ok; y++)
        for (int x = 1; x < WIDTH - 1; x++)
            tally->cracks += is_background(&ours, x, y) && is_inside(&exact, x, y);
    image_free(&ours.on_black);
    image_free(&ours.on_white);
    image_free(&exact.on_black);
    image_free(&exact.on_white);
    return ok;
}

/* ------------------------------------------------------------------ layers */

static int layers_at(const struct image *image, int x, int y)
{
    return layers_from_code(image->rgba[4 * (y * image->width + x)]);
}

/* All of the 3x3 around the pixel is covered equally often in the reference: no silhouette is
 * near, only edges that triangles share. */
static bool is_interior(const struct image *exact, int x, int y)
{
    int here = layers_at(exact, x, y);
    if (here == 0 || here > LAYER_LIMIT)
        return false;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++)
            if (layers_at(exact, x + dx, y + dy) != here)
                return false;
    return true;
}

static bool judge_layers(struct rig *rig, int frame, struct tally *tally, struct failure *f)
{
    struct image ours = { 0 }, exact = { 0 };
    bool ok = rig_seek(rig, frame, f) && rig_picture(rig, CLEAR_OF_SCENE, &ours, f)
           && reference(&rig->scene, frame, rig->scene.clear, &exact, f);
    for (int y = 1; y < HEIGHT - 1 && ok; y++)
        for (int x = 1; x < WIDTH - 1; x++) {
            if (!is_interior(&exact, x, y))
                continue;
            int here = layers_at(&ours, x, y), wanted = layers_at(&exact, x, y);
            tally->interior++;
            tally->fewer += here < wanted;
            tally->more += here > wanted;
        }
    image_free(&ours);
    image_free(&exact);
    return ok;
}

/* ------------------------------------------------------------------ the table */

static bool each_frame(const struct judged_scene *judged, bool layers, struct tally *tally,
                       struct failure *f)
{
    struct take take = { .scene = judged->name, .width = WIDTH, .height = HEIGHT,
                         .band_rows = take_whole(HEIGHT), .method = SMEAR_NONE,
                         .format = layers ? SMEAR_XRGB8888 : SMEAR_RGB565,
                         .texels_565 = !layers, .fit_grid = true,
                         .change = layers ? layers_scene : NULL };
    struct rig rig;
    if (!rig_open(&rig, &take, f))
        return false;
    bool ok = true;
    for (int frame = 0; frame < FRAMES && ok; frame++)
        ok = layers ? judge_layers(&rig, frame, tally, f)
                    : judge_color(&rig, frame, tally, f) && judge_cracks(&rig, frame, tally, f);
    rig_close(&rig);
    return ok;
}

static void print_color(struct sheet *sheet, const struct judged_scene *judged,
                        const struct tally *tally)
{
    double db = tally->db / FRAMES;
    printf("%-9s %8.2f %6.2f  ", judged->name, db, tally->worst_db);
    if (judged->bar_db > 0.0)
        printf("%4.1f %-7s", judged->bar_db, sheet_least(sheet, db, judged->bar_db));
    else
        printf("%4s %-7s", "-", "");
    if (judged->peer_db > 0.0)
        printf("  %5.1f", judged->peer_db);
    else
        printf("  %5s", "-");
    printf("  %9.3f", 100.0 * (double)tally->far_off / (double)tally->pixels);
    printf("  %6.2f %-6s", (double)tally->cracks / FRAMES,
           sheet_most(sheet, (double)tally->cracks, 0.0));
}

static void print_layers(struct sheet *sheet, const struct judged_scene *judged,
                         const struct tally *tally)
{
    printf("  %6.2f  %6.2f %-6s  %7.0f", (double)tally->fewer / FRAMES,
           (double)tally->more / FRAMES,
           judged->layers == LAYERS_SHEET
               ? sheet_most(sheet, (double)(tally->fewer + tally->more), 0.0) : "-",
           (double)tally->interior / FRAMES);
}

bool accuracy_report(struct sheet *sheet, struct failure *f)
{
    printf("== sharp frames against the reference in double precision: %dx%d, RGB565, no dither,\n"
           "   encoded light, mean of %d frames; far off: a channel differs by more than %d codes\n"
           "   (pixels per frame: a crack is background inside a surface; fewer, more: layers in\n"
           "   surfaces when all triangles are drawn as glass: one more was drawn twice)\n"
           "\n",
           (int)WIDTH, (int)HEIGHT, (int)FRAMES, (int)FAR_OFF);
    printf("scene      PSNR dB  worst   bar           TGX  far off %%"
           "  cracks bar==0   fewer    more bar==0   inside\n");
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        const struct judged_scene *judged = &scenes[s];
        struct tally tally = { 0 };
        if (!each_frame(judged, false, &tally, f))
            return false;
        print_color(sheet, judged, &tally);
        if (judged->layers != LAYERS_UNCOUNTED) {
            if (!each_frame(judged, true, &tally, f))
                return false;
            print_layers(sheet, judged, &tally);
        }
        printf("\n");
        fflush(stdout);
    }
    return true;
}
