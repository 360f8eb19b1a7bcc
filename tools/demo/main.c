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

/* A scene of built-in models for small displays of few greys. a scene for displays of few greys: windmills before a black sky. */

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

static const struct stage_kind kind = { "night", 128, 64, 5 / 30.0, 0x000000, night_build,
                                        night_move };

static bool night_open(struct scene *out, struct failure *f)
{
    return stage_open(&kind, 1, kind.name, out, f);
}

/* ------------------------------------------------------------------ layout */

/* Pictures made of pictures. *out is allocated by each function, and empty on failure. */

static uint8_t *pixel_at(const struct image *image, int x, int y)
{
    return image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static void fill(struct image *image, uint8_t red, uint8_t green, uint8_t blue)
{
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            memcpy(pixel_at(image, x, y), (const uint8_t[4]){ red, green, blue, 255 }, 4);
}

/* Side by side, with a white line of `gap` pixels between neighbours. All of one size. */
static bool layout_row(const struct image *pictures, int count, int gap, struct image *out,
                       struct failure *f)
{
    int width = pictures[0].width, height = pictures[0].height;
    *out = (struct image){ .rgba = NULL };
    for (int i = 1; i < count; i++)
        if (!image_check_same_size(&pictures[0], &pictures[i], f))
            return false;
    if (!image_alloc(out, count * width + (count - 1) * gap, height, f))
        return false;
    fill(out, 255, 255, 255);
    for (int i = 0; i < count; i++)
        for (int y = 0; y < height; y++)
            memcpy(pixel_at(out, i * (width + gap), y), pixel_at(&pictures[i], 0, y),
                   4 * (size_t)width);
    return true;
}

/* One above the other, with a black line between. */
static bool layout_column(const struct image *pictures, int count, int gap, struct image *out,
                          struct failure *f)
{
    int width = pictures[0].width, height = pictures[0].height;
    *out = (struct image){ .rgba = NULL };
    for (int i = 1; i < count; i++)
        if (!image_check_same_size(&pictures[0], &pictures[i], f))
            return false;
    if (!image_alloc(out, width, count * height + (count - 1) * gap, f))
        return false;
    for (int i = 0; i < count; i++)
        memcpy(pixel_at(out, 0, i * (height + gap)), pictures[i].rgba,
               4 * (size_t)width * (size_t)height);
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

/* The same as lamps behind dark glass: squares of scale - 1 in the colour 0xRRGGBB x grey, with
 * seams between them. */
static bool layout_lamps(const struct image *picture, int scale, unsigned color, struct image *out,
                         struct failure *f)
{
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
    FILM_EXACT                  /* the truth: the mean of FILM_INSTANTS instants, each posed anew */
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

/* What is made of a scene. */
enum exhibit_kind {
    SHARP, BLURRED, EXACT,      /* one look: enum film_look */
    PAIR,                       /* sharp | blurred */
    TRIPLE,                     /* sharp | blurred | exact */
    SCREEN,                     /* blurred, RGB565, enlarged */
    OLED                        /* sharp above blurred, 16 greys, enlarged */
};

struct exhibit {
    const char *name, *what;
    enum exhibit_kind kind;
    int width, height;          /* of one look; 0: the scene's */
    int zoom;                   /* of SCREEN and OLED */
    int frames;                 /* from time 0 on; 0: one picture, at */
    double time;                /* or, with 0, at the scene's */
    double fps;                 /* of frames; 0: the scene's */
};

/* A scene and what is shown of it. */
struct room {
    const char *builtin;        /* demo/..., or */
    bool (*open)(struct scene *out, struct failure *f);     /* a scene of the demo */
    const struct exhibit *exhibit;
    int count;
};

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof *(array)))

/* Ten frames a second: what a small machine draws. */
#define README_LOOP \
    { .name = "race-ten.gif", .kind = PAIR, .width = 240, .height = 180, .frames = 20, .fps = 10, \
      .what = "sharp | blurred, a loop of two seconds at ten frames a second" }

static const struct exhibit race[] = {
    { .name = "race-sharp.png", .kind = SHARP,
      .what = "racing car and drone, the sharp instant" },
    { .name = "race-blurred.png", .kind = BLURRED,
      .what = "the same blurred" },
    { .name = "race-exact.png", .kind = EXACT,
      .what = "the mean of 64 instants: what blur aims at" },
    { .name = "race-pair.png", .kind = PAIR, .what = "sharp | blurred" },
    { .name = "race-triple.png", .kind = TRIPLE, .what = "sharp | blurred | mean of 64 instants" },
    { .name = "race-640.png", .kind = BLURRED, .width = 640, .height = 480,
      .what = "blurred, 640x480" },
};

static const struct exhibit race_film[] = {
    { .name = "race.gif", .kind = BLURRED, .width = 240, .height = 180, .frames = 60,
      .what = "blurred, a loop of two seconds" },
    README_LOOP,
};

static const struct exhibit drone[] = {
    { .name = "drone-pair.png", .kind = PAIR, .width = 320, .height = 240, .time = 1.95,
      .what = "a car rushes by below a drone: sharp | blurred" },
    { .name = "screen-240.png", .kind = SCREEN, .zoom = 3, .time = 1.95,
      .what = "a display of 240x240 in RGB565, blurred, three times as large" },
    { .name = "drone-pair.gif", .kind = PAIR, .width = 240, .height = 180, .frames = 60,
      .what = "sharp | blurred, a loop of two seconds" },
    { .name = "drone.apng", .kind = BLURRED, .frames = 60,
      .what = "blurred, a loop of two seconds, true colour" },
};

static const struct exhibit night[] = {
    { .name = "oled-128x64.png", .kind = OLED, .zoom = 5,
      .what = "a display of 128x64 in 16 greys, sharp above blurred, five times as large" },
    { .name = "oled-128x64.gif", .kind = OLED, .zoom = 5, .frames = NIGHT_LOOP_FRAMES,
      .what = "the same as a loop" },
};

static const struct room demo_rooms[] = {
    { .builtin = "demo/race", .exhibit = race_film, .count = COUNT_OF(race_film) },
    { .builtin = "demo/race", .exhibit = race, .count = COUNT_OF(race) },
    { .builtin = "demo/drone", .exhibit = drone, .count = COUNT_OF(drone) },
    { .open = night_open, .exhibit = night, .count = COUNT_OF(night) },
};

/* ------------------------------------------------------------------ of the README */

static const struct exhibit readme_race[] = { README_LOOP };
static const struct exhibit readme_night[] = {
    { .name = "oled.png", .kind = OLED, .zoom = 3, .what = "mills on a display of 128x64 in 16 greys, sharp above blurred" },
};

static const struct room readme_rooms[] = {
    { .builtin = "demo/race", .exhibit = readme_race, .count = COUNT_OF(readme_race) },
    { .open = night_open, .exhibit = readme_night, .count = COUNT_OF(readme_night) },
};

/* ------------------------------------------------------------------ making pictures */

enum { SEAM = 2, MAX_PATH = 4096 };     /* pixels between pictures side by side */

/* The first `count` looks of the same instant. */
static bool take_looks(struct film *film, double time, int count, struct image *picture,
                       struct failure *f)
{
    static const enum film_look look[3] = { FILM_SHARP, FILM_BLURRED, FILM_EXACT };
    for (int i = 0; i < count; i++)
        if (!film_take(film, time, look[i], &picture[i], f))
            return false;
    return true;
}

static bool make_row(struct film *film, double time, int count, struct image *out,
                     struct failure *f)
{
    struct image picture[3] = { { .rgba = NULL } };
    bool ok = take_looks(film, time, count, picture, f) && layout_row(picture, count, SEAM, out, f);
    for (int i = 0; i < count; i++)
        image_free(&picture[i]);
    return ok;
}

static bool make_screen(struct film *film, double time, int zoom, struct image *out,
                        struct failure *f)
{
    struct image picture;
    bool ok = film_take(film, time, FILM_BLURRED, &picture, f) &&
              layout_zoom(&picture, zoom, out, f);
    image_free(&picture);
    return ok;
}

static bool make_oled(struct film *film, double time, int zoom, struct image *out,
                      struct failure *f)
{
    enum { LAMP_COLOR = 0xcfeaff };
    struct image picture[2] = { { .rgba = NULL } }, column = { .rgba = NULL };
    bool ok = take_looks(film, time, 2, picture, f) &&
              layout_column(picture, 2, SEAM, &column, f) &&
              layout_lamps(&column, zoom, LAMP_COLOR, out, f);
    image_free(&picture[0]);
    image_free(&picture[1]);
    image_free(&column);
    return ok;
}

static bool make_picture(struct film *film, const struct exhibit *e, double time, struct image *out,
                         struct failure *f)
{
    *out = (struct image){ .rgba = NULL };
    switch (e->kind) {
    case SHARP: return film_take(film, time, FILM_SHARP, out, f);
    case BLURRED: return film_take(film, time, FILM_BLURRED, out, f);
    case EXACT: return film_take(film, time, FILM_EXACT, out, f);
    case PAIR: return make_row(film, time, 2, out, f);
    case TRIPLE: return make_row(film, time, 3, out, f);
    case SCREEN: return make_screen(film, time, e->zoom, out, f);
    case OLED: return make_oled(film, time, e->zoom, out, f);
    }
    return false;
}

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

static bool make_exhibit(const char *folder, struct scene *scene, const struct exhibit *e, struct failure *f)
{
    int width = e->width > 0 ? e->width : scene->width;
    int height = e->height > 0 ? e->height : scene->height;
    smear_format format = e->kind == SCREEN ? SMEAR_RGB565
                        : e->kind == OLED   ? SMEAR_L4
                                            : SMEAR_XRGB8888;
    struct film film;
    const double fps = scene->fps;
    if (e->fps > 0)
        scene->fps = e->fps;
    bool ok = film_open(&film, scene, width, height, format, f) && write_exhibit(folder, &film, e, f);
    film_close(&film);
    scene->fps = fps;
    return ok;
}

/* ------------------------------------------------------------------ all of them */

/* A status. */
static int show_room(const struct room *room, const char *folder)
{
    struct scene scene = { .data = NULL };
    struct failure f = { "" };
    int status = STATUS_OK;
    if (!(room->open != NULL ? room->open(&scene, &f) : demo_make(room->builtin, &scene, &f)))
        return say_bad_input("built-in scene", &f);
    for (int i = 0; i < room->count; i++) {
        f = (struct failure){ "" };
        if (!make_exhibit(folder, &scene, &room->exhibit[i], &f))
            status = say_bad_input(room->exhibit[i].name, &f);
    }
    scene_free(&scene);
    return status;
}

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
    const struct room *room = is_readme ? readme_rooms : demo_rooms;
    int status = STATUS_OK;
    for (int i = 0; i < (is_readme ? COUNT_OF(readme_rooms) : COUNT_OF(demo_rooms)); i++) {
        const int result = show_room(&room[i], folder);
        status = result != STATUS_OK ? result : status;
    }
    printf("pictures in %s\n", folder);
    return status;
}
