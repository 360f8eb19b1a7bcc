/* SPDX-License-Identifier: MIT */
/* main.c - the program behind `make demo`: a folder of pictures, sharp and motion-blurred, all
 * drawn by the library.
 *
 *     smear-demo [--readme] FOLDER
 *     smear-demo --enlarge ZOOM PICTURE OUT.png
 *
 * --readme writes the pictures of the README instead, --enlarge a picture whose pixels are squares of ZOOM x ZOOM. */
#include "tools/demo/film.h"
#include "tools/demo/layout.h"
#include "tools/demo/night.h"

#include "tools/image/file.h"
#include "tools/options/say.h"
#include "tools/options/sink.h"
#include "tools/scenes/builtin.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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
