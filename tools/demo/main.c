/* SPDX-License-Identifier: MIT */
/* main.c - the program behind `make demo`: a folder of pictures, sharp and motion-blurred, all
 * drawn by the library.
 *
 *     smear-demo [--readme] FOLDER
 *     smear-demo --enlarge ZOOM PICTURE OUT.png
 *
 * --readme writes the pictures of the README instead, --enlarge a picture whose pixels are squares of ZOOM x ZOOM. */

#include "tools/failure.h"
#include "tools/image/file.h"
#include "tools/image/image.h"
#include "tools/options/say.h"
#include "tools/options/sink.h"
#include "tools/player/device.h"
#include "tools/player/exact.h"
#include "tools/player/picture.h"
#include "tools/scenes/build.h"
#include "tools/scenes/builtin.h"
#include "tools/scenes/present.h"
#include "tools/scenes/scene.h"

#include <errno.h>
#include <math.h>
#include <smear.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ------------------------------------------------------------------ night */

/* A scene for displays of few greys: windmills before a black sky. */

enum { NIGHT_LOOP_FRAMES = 48 };

#define PI 3.14159265358979323846

#define LOOP_SECONDS (NIGHT_LOOP_FRAMES / 30.0)
/* Whole turns, so that every blade comes back to its own place: 37.5 degrees a frame. */
#define TURNS_PER_LOOP 5

enum { MILLS = 2 };

static const struct { double x, z, size, phase; } mill[MILLS] = {
    { -1.05, 0, 1.0, 0.35 }, { 2.9, -4.6, 1.0, 1.1 },
};

struct night {
    int land, sail;             /* still; the first of MILLS */
};

/* Hub and blades turn about z; a mill of size 1 has its hub at 2.2. */
static const struct scene_surface *sails(struct stage *stage)
{
    enum { BLADES = 3 };
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < BLADES; i++) {
        b.at = xform_turn_z(2 * PI * i / BLADES);
        build_color(&b, 0xffffff);
        build_quad(&b, vec3(-0.10, 0.10, 0.02), vec3(0.06, 0.10, 0.02), vec3(0.30, 1.45, 0.02),
                   vec3(-0.10, 1.55, 0.02));
    }
    b.at = xform_turn_x(PI / 2);
    build_color(&b, 0x9a9a9a);
    build_drum(&b, 0.17, 0.11, -0.05, 0.14, 8);
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.unlit = s->material.double_sided = true;
    return s;
}

static void tower(struct build *b, double x, double z, double size)
{
    b->at = xform_mul(xform_move(x, 0, z), xform_scale(size, size, size));
    static const double wall[8] = { 0.52, 0, 0.34, 1.5, 0.27, 2.15, 0.24, 2.15 };
    static const double cap[6] = { 0.31, 2.13, 0.25, 2.40, 0, 2.62 };
    b->at = xform_mul(b->at, xform_move(0, 0, -0.42));
    build_color(b, 0xb8b8b8);
    build_lathe(b, wall, 4, 9);
    build_color(b, 0x6a6a6a);
    build_lathe(b, cap, 3, 9);
    build_color(b, 0x101010);
    build_box(b, vec3(-0.13, 0, 0.40), vec3(0.13, 0.55, 0.55));
    b->at = xform_identity();
}

static void disc(struct build *b, double x, double y, double z, double radius, int sides)
{
    uint32_t centre = build_vertex(b, vec3(x, y, z), vec3(0, 0, 1), 0, 0);
    for (int i = 0; i < sides; i++) {
        double a = 2 * PI * i / sides;
        build_vertex(b, vec3(x + radius * cos(a), y + radius * sin(a), z), vec3(0, 0, 1), 0, 0);
    }
    for (uint32_t i = 0; i < (uint32_t)sides; i++)
        build_triangle(b, centre, centre + 1 + i, centre + 1 + (i + 1) % (uint32_t)sides);
}

/* Towers, ground, fence, moon and stars. */
static const struct scene_surface *land(struct stage *stage)
{
    static const double star[][2] = {
        { -37, 12 }, { -31, 23 }, { -4, 17 }, { 4, 26 },
        { 12, 12 },  { 36, 11 },  { 41, 24 }, { -47, 20 },
    };
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < MILLS; i++)
        tower(&b, mill[i].x, mill[i].z, mill[i].size);
    build_color(&b, 0x4c4c4c);
    build_field(&b, -60, -30, 60, 8, 1, 1, NULL);
    build_color(&b, 0x8c8c8c);
    for (int i = -3; i <= 12; i++)
        build_box(&b, vec3(0.35 + 0.55 * i, 0, 1.15), vec3(0.43 + 0.55 * i, 0.42, 1.2));
    build_color(&b, 0xd0d0d0);
    build_box(&b, vec3(-4, 0.26, 1.2), vec3(9, 0.32, 1.22));
    build_color(&b, 0xffffff);
    disc(&b, 26, 20.5, -60, 4.6, 24);
    build_color(&b, 0);
    disc(&b, 28.2, 21.9, -59.5, 3.9, 24);
    build_color(&b, 0xe0e0e0);
    for (size_t i = 0; i < sizeof star / sizeof *star; i++)
        disc(&b, star[i][0], star[i][1], -58, 0.42, 4);
    struct scene_surface *s = build_finish(&b);
    return s;
}

static void night_build(struct stage *stage)
{
    struct night *n = stage_alloc(stage, sizeof *n);
    if (n == NULL)
        return;
    stage->extra = n;
    n->land = stage_add(stage, land(stage));
    const struct scene_surface *s = sails(stage);
    n->sail = stage->prop_count;
    for (int i = 0; i < MILLS; i++)
        stage_add(stage, s);
}

static void night_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct night *n = stage->extra;
    double turn = 2 * PI * TURNS_PER_LOOP * time / LOOP_SECONDS;
    stage_camera(out, xform_look(vec3(0.55, 1.1, 5.6), vec3(0.55, 1.88, 0), vec3(0, 1, 0)), 42);
    out->camera.znear = 0.5;
    out->camera.zfar = 90;
    for (int i = 0; i < MILLS; i++) {
        struct xform hub = xform_move(mill[i].x, 2.2 * mill[i].size, mill[i].z);
        hub = xform_mul(hub, xform_turn_y(0.25 - 0.2 * i));
        hub = xform_mul(hub, xform_scale(mill[i].size, mill[i].size, mill[i].size));
        stage_place(out, n->sail + i, xform_mul(hub, xform_turn_z(mill[i].phase - turn)));
    }
}

static const struct stage_kind night = { "night", 128, 64, 5 / 30.0, 0x000000, night_build,
                                         night_move };

/* ------------------------------------------------------------------ layout */

/* Pictures made of pictures. *out is allocated by each function, and empty on failure. */

enum { SEAM = 2 };              /* pixels between pictures */

static uint8_t *pixel_at(const struct image *image, int x, int y)
{
    return image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

/* Pictures of one size: side by side with white lines between neighbours, or one below the other with black ones. */
static bool layout_all(const struct image *pictures, int count, bool down, struct image *out, struct failure *f)
{
    const int width = pictures[0].width, height = pictures[0].height, across = down ? 0 : width + SEAM, below = down ? height + SEAM : 0;
    if (!image_alloc(out, width + (count - 1) * across, height + (count - 1) * below, f))
        return false;
    if (!down)
        memset(out->rgba, 255, 4 * (size_t)out->width * (size_t)out->height);
    for (int i = 0; i < count; i++)
        for (int y = 0; y < height; y++)
            memcpy(pixel_at(out, i * across, i * below + y), pixel_at(&pictures[i], 0, y), 4 * (size_t)width);
    return true;
}

/* Every pixel a square of scale x scale. */
static bool layout_zoom(const struct image *picture, int scale, struct image *out, struct failure *f)
{
    if (!image_alloc(out, picture->width * scale, picture->height * scale, f))
        return false;
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++)
            memcpy(pixel_at(out, x, y), pixel_at(picture, x / scale, y / scale), 4);
    return true;
}

/* The same as lamps behind dark glass: squares of scale - 1 in their colour x grey, with seams between them. */
static bool layout_lamps(const struct image *picture, int scale, struct image *out, struct failure *f)
{
    const unsigned color = 0xcfeaff;
    static const uint8_t glass[4] = { 8, 9, 11, 255 };
    if (!image_alloc(out, picture->width * scale, picture->height * scale, f))
        return false;
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            uint8_t *to = pixel_at(out, x, y);
            bool is_seam = x % scale == scale - 1 || y % scale == scale - 1;
            const unsigned grey = pixel_at(picture, x / scale, y / scale)[0];
            for (int k = 0; k < 3; k++) {
                unsigned full = color >> (16 - 8 * k) & 255u;
                unsigned lit = (full - glass[k]) * grey / 255u;
                to[k] = (uint8_t)(glass[k] + (is_seam ? lit / 4u : lit));
            }
            to[3] = 255;
        }
    return true;
}

/* ------------------------------------------------------------------ films */

/* Takes pictures of a scene through the library: the display of a device and the context behind it, kept from picture to picture. */

enum film_look {
    FILM_SHARP,                 /* the instant */
    FILM_BLURRED,               /* by SMEAR_AUTO */
    FILM_EXACT,                 /* the truth: the mean of FILM_INSTANTS instants, each posed anew */
    FILM_LOOKS
};

enum { FILM_INSTANTS = 64 };

struct film {
    struct scene *scene;
    struct presenter *presenter;
    struct device device;
};

/* Half of each frame's time, as film cameras have it. The scenes are functions of time, so the
 * library gets the poses at which the shutter opens and closes. */
static struct present_options options_of(const struct scene *scene, enum film_look look)
{
    return (struct present_options){
        .fps = scene->fps, .shutter_degrees = look == FILM_SHARP ? 0 : 180, .exposure = SMEAR_CENTRED,
        .shutter_poses = true, .method = SMEAR_AUTO, .edges = SMEAR_EDGES_SMOOTH,
        .light = SMEAR_LIGHT_LINEAR, .clear = scene->clear,
    };
}

/* `film` is released by film_close in any case; the scene must live until then. FILM_EXACT needs
 * SMEAR_XRGB8888. */
static bool film_open(struct film *film, struct scene *scene, int width, int height, smear_format format,
                      struct failure *f)
{
    const struct device_setup setup = { .width = width, .height = height, .format = format,
                                        .methods = SMEAR_SET(SMEAR_AUTO), .threads = 1 };
    *film = (struct film){ .scene = scene };
    film->presenter = presenter_new(scene, f);
    return film->presenter != NULL && device_open(&film->device, &setup, f);
}

static void film_close(struct film *film)
{
    presenter_free(film->presenter);
    device_close(&film->device);
    *film = (struct film){ .scene = NULL };
}

/* *out is allocated here, and empty on failure. Every other format is widened to 8 bits. */
static bool film_take(struct film *film, double time, enum film_look look, struct image *out,
                      struct failure *f)
{
    const struct device_setup *setup = &film->device.setup;
    const struct present_options options = options_of(film->scene, look);
    *out = (struct image){ .rgba = NULL };
    if (look == FILM_EXACT)
        return exact_picture(film->presenter, time, &options, setup->width, setup->height,
                             FILM_INSTANTS, out, f);
    const struct presented *presented = presenter_frame(film->presenter, time, &options, f);
    if (presented == NULL || !device_fit(&film->device, presented, f) ||
        !device_draw(&film->device, presented, f))
        return false;
    if (!image_alloc(out, setup->width, setup->height, f))
        return false;
    picture_expand(out, film->device.pixels, film->device.stride, setup->format);
    return true;
}

/* ------------------------------------------------------------------ exhibits */

/* Sets of looks. */
enum { SHARP = 1 << FILM_SHARP, BLURRED = 1 << FILM_BLURRED, PAIR = SHARP | BLURRED, TRIPLE = PAIR | 1 << FILM_EXACT };

/* A scene, and what is shown of it: looks side by side; of SMEAR_L4 one above the other, as lamps. */
struct exhibit {
    const char *name, *scene, *what;
    int looks;
    smear_format format;
    int width, height;          /* of one look; 0: the scene's */
    int zoom;                   /* 0: 1 */
    int frames;                 /* from time 0 on; 0: one picture, at */
    double time;                /* or, with 0, at the scene's */
    double fps;                 /* of frames; 0: the scene's */
    bool readme;                /* a picture of the README, too */
};

static const struct exhibit exhibits[] = {
    /* Ten frames a second: what a small machine draws. */
    { "race-ten.gif", "demo/race", "sharp | blurred, a loop of two seconds at ten frames a second", PAIR, .width = 240, .height = 180,
      .frames = 20, .fps = 10, .readme = true },
    { "race.gif", "demo/race", "blurred, a loop of two seconds", BLURRED, .width = 240, .height = 180, .frames = 60 },
    { "race.png", "demo/race", "sharp | blurred | the mean of 64 instants, what blur aims at", .looks = TRIPLE },
    { "race-640.png", "demo/race", "blurred, 640x480", BLURRED, .width = 640, .height = 480 },
    { "drone.png", "demo/drone", "a car rushes by below a drone: sharp | blurred", PAIR, .width = 320, .height = 240, .time = 1.95 },
    { "drone.gif", "demo/drone", "sharp | blurred, a loop of two seconds", PAIR, .width = 240, .height = 180, .frames = 60 },
    { "drone.apng", "demo/drone", "blurred, a loop of two seconds, true colour", BLURRED, .frames = 60 },
    { "screen.png", "demo/drone", "a display of 240x240 in RGB565, blurred, three times as large", BLURRED, SMEAR_RGB565, .zoom = 3,
      .time = 1.95 },
    { "oled.png", "night", "mills on a display of 128x64 in 16 greys, sharp above blurred, three times as large", PAIR, SMEAR_L4,
      .zoom = 3, .readme = true },
    { "oled.gif", "night", "the same as a loop", PAIR, SMEAR_L4, .zoom = 3, .frames = NIGHT_LOOP_FRAMES },
};

static bool make_picture(struct film *film, const struct exhibit *e, double time, struct image *out, struct failure *f)
{
    struct image picture[FILM_LOOKS] = { { .rgba = NULL } }, all = { .rgba = NULL };
    const bool is_lamps = e->format == SMEAR_L4;
    const int zoom = e->zoom > 0 ? e->zoom : 1;
    int count = 0;
    bool ok = true;
    *out = (struct image){ .rgba = NULL };
    for (int look = 0; look < FILM_LOOKS && ok; look++)
        if (e->looks >> look & 1)
            ok = film_take(film, time, (enum film_look)look, &picture[count++], f);
    ok = ok && layout_all(picture, count, is_lamps, &all, f)
      && (is_lamps ? layout_lamps(&all, zoom, out, f) : layout_zoom(&all, zoom, out, f));
    for (int i = 0; i < count; i++)
        image_free(&picture[i]);
    image_free(&all);
    return ok;
}

enum { MAX_PATH = 4096 };

static bool write_exhibit(const char *folder, struct film *film, const struct exhibit *e, struct failure *f)
{
    char path[MAX_PATH];
    struct sink sink;
    const double fps = film->scene->fps, time = e->time > 0 ? e->time : film->scene->time;
    if (snprintf(path, sizeof path, "%s/%s", folder, e->name) >= (int)sizeof path)
        return fail(f, "the path is too long");
    if (sink_open(&sink, "demo", path, e->frames, false) != STATUS_OK)
        return false;
    sink.fps = fps;
    bool ok = true;
    for (int i = 0; ok && i < (e->frames > 0 ? e->frames : 1); i++) {
        struct image picture;
        ok = make_picture(film, e, e->frames > 0 ? i / fps : time, &picture, f) && sink_add(&sink, &picture, NULL, i, f);
        image_free(&picture);
    }
    ok = ok && sink_end(&sink, f);
    sink_cancel(&sink);
    if (ok)
        printf("%-34s %s\n", path, e->what);
    fflush(stdout);
    return ok;
}

static bool make_exhibit(const char *folder, const struct exhibit *e, struct failure *f)
{
    struct scene scene = { .data = NULL };
    struct film film;
    if (!(strcmp(e->scene, night.name) == 0 ? stage_open(&night, 1, night.name, &scene, f) : demo_make(e->scene, &scene, f)))
        return false;
    if (e->fps > 0)
        scene.fps = e->fps;
    const bool ok = film_open(&film, &scene, e->width > 0 ? e->width : scene.width, e->height > 0 ? e->height : scene.height, e->format, f)
                 && write_exhibit(folder, &film, e, f);
    film_close(&film);
    scene_free(&scene);
    return ok;
}

/* ------------------------------------------------------------------ all of them */

/* Makes the folder and those above it. */
static bool make_folders(const char *folder, struct failure *f)
{
    char path[MAX_PATH];
    struct stat info;
    const size_t length = strlen(folder);
    if (length == 0 || length >= sizeof path)
        return fail(f, "is no name for a folder");
    for (size_t i = 1; i <= length; i++) {
        if (folder[i] != '/' && folder[i] != '\0')
            continue;
        snprintf(path, sizeof path, "%.*s", (int)i, folder);
        if (mkdir(path, 0777) != 0 && (errno != EEXIST || stat(path, &info) != 0 || !S_ISDIR(info.st_mode)))
            return fail(f, "cannot be made (%s)", strerror(errno));
    }
    return true;
}

/* A status. */
static int enlarge(const char *zoom, const char *from, const char *to)
{
    struct image picture = { .rgba = NULL }, large = { .rgba = NULL };
    struct failure f = { "" };
    int scale = atoi(zoom);
    if (scale < 1 || scale > 16)
        return say_bad_usage("--enlarge", "the zoom is a number from 1 to 16");
    bool ok = image_load(from, &picture, &f) && layout_zoom(&picture, scale, &large, &f);
    int status = ok ? STATUS_OK : say_bad_input(from, &f);
    if (ok && !png_save(to, &large, &f))
        status = say_bad_input(to, &f);
    image_free(&picture);
    image_free(&large);
    return status;
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    if (argc == 5 && strcmp(argv[1], "--enlarge") == 0)
        return enlarge(argv[2], argv[3], argv[4]);
    bool is_readme = argc > 1 && strcmp(argv[1], "--readme") == 0;
    if (argc != (is_readme ? 3 : 2) || argv[argc - 1][0] == '-')
        return say_bad_usage("usage", "smear-demo [--readme] FOLDER");
    const char *folder = argv[argc - 1];
    output_catch_signals();
    if (!make_folders(folder, &f))
        return say_bad_input(folder, &f);
    int status = STATUS_OK;
    for (size_t i = 0; i < sizeof exhibits / sizeof *exhibits; i++)
        if ((!is_readme || exhibits[i].readme) && !make_exhibit(folder, &exhibits[i], &f))
            status = say_bad_input(exhibits[i].name, &f);
    printf("pictures in %s\n", folder);
    return status;
}
