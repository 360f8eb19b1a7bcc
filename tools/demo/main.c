/* SPDX-License-Identifier: MIT */
/* main.c - the program behind `make demo`: a folder full of pictures, sharp and motion-blurred, all
 * drawn by the library.
 *
 *     smear-demo [--readme] ASSETS|- FOLDER
 *
 * ASSETS is a folder of models; with `-`, and wherever a model is missing or broken, only the
 * built-in scenes are shown. --readme writes the few pictures the README shows instead. */
#include "dioramas.h"
#include "film.h"
#include "gallery.h"
#include "layout.h"

#include "../cli/say.h"

#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------------ exhibits */

/* What is made of a scene's picture. */
enum exhibit_kind {
    LONE,                       /* one look */
    PAIR,                       /* sharp | blurred */
    TRIPLE,                     /* sharp | blurred | exact */
    SCREEN,                     /* blurred, RGB565, enlarged */
    OLED,                       /* blurred, 16 greys, enlarged */
    REEL                        /* blurred, moving */
};

struct exhibit {
    const char *scene;          /* of the catalog; null: `diorama` */
    const struct diorama_kind *diorama;
    const char *name, *what;
    enum exhibit_kind kind;
    enum film_look look;        /* of LONE */
    int width, height;          /* 0: the scene's */
    int zoom;                   /* of SCREEN and OLED */
    double time;                /* 0: the scene's */
    int frames;                 /* of REEL */
};

static const struct exhibit gallery_exhibits[] = {
    { "demo/race", NULL, "race-sharp.png", "racing car and drone, the sharp instant", LONE, FILM_SHARP },
    { "demo/race", NULL, "race-blurred.png", "the same instant, blurred by the filter", LONE,
      FILM_BLURRED },
    { "demo/race", NULL, "race-exact.png", "the mean of 64 instants: what the filter aims at", LONE,
      FILM_EXACT },
    { "demo/race", NULL, "race-pair.png", "sharp | blurred", PAIR },
    { "demo/race", NULL, "race-triple.png", "sharp | blurred | mean of 64 instants", TRIPLE },
    { "demo/race", NULL, "race-640.png", "640x480", LONE, FILM_BLURRED, 640, 480 },
    { "demo/drone", NULL, "drone-pair.png", "drone and passing car: sharp | blurred", PAIR },
    { "demo/drone", NULL, "screen-240.png", "a 240x240 display in RGB565, three times as large", SCREEN,
      .zoom = 3, .width = 240, .height = 240 },
    { "demo/drone", NULL, "oled-128.png", "a 128x64 OLED in 16 greys, four times as large", OLED,
      .zoom = 4, .width = 128, .height = 64 },
    { "demo/race", NULL, "race.gif", "a loop of two seconds", REEL, .width = 240, .height = 180,
      .frames = 60 },
    { "demo/drone", NULL, "drone.apng", "a loop of two seconds in true colour", REEL, .frames = 60 },
    { NULL, &diorama_rally, "rally-sharp.png", "trucks on a forest track, the sharp instant", LONE,
      FILM_SHARP },
    { NULL, &diorama_rally, "rally-blurred.png", "blurred: the camera drives along, wheels spin", LONE,
      FILM_BLURRED },
    { NULL, &diorama_rally, "rally-triple.png", "sharp | blurred | mean of 64 instants", TRIPLE },
    { NULL, &diorama_rally, "rally-640.png", "640x480", LONE, FILM_BLURRED, 640, 480 },
    { NULL, &diorama_rally, "rally.gif", "a loop of two seconds", REEL, .width = 240, .height = 180,
      .frames = RALLY_LOOP_FRAMES },
    { NULL, &diorama_pass, "pass-pair.png", "trucks rush past: sharp | blurred", PAIR },
    { NULL, &diorama_chase, "chase-pair.png", "robot and fox run: sharp | blurred", PAIR },
    { NULL, &diorama_dance, "dance-pair.png", "robot dances before fans: sharp | blurred", PAIR },
    { NULL, &diorama_wind, "wind-pair.png", "fans: sharp | blurred", PAIR },
    { NULL, &diorama_coins, "coins-pair.png", "a jump through turning coins: sharp | blurred", PAIR },
};

/* ------------------------------------------------------------------ making them */

static bool make_row(struct film *film, double time, int count, struct image *out, struct failure *f)
{
    static const enum film_look look[3] = { FILM_SHARP, FILM_BLURRED, FILM_EXACT };
    struct image picture[3] = { { 0 } };
    bool ok = true;
    for (int i = 0; i < count && ok; i++)
        ok = film_take(film, time, look[i], &picture[i], f);
    ok = ok && layout_row(picture, count, 2, out, f);
    for (int i = 0; i < count; i++)
        image_free(&picture[i]);
    return ok;
}

static bool make_screen(struct film *film, const struct exhibit *e, double time, struct image *out,
                        struct failure *f)
{
    enum { OLED_COLOR = 0xcfeaff };
    struct image picture;
    bool ok = film_take(film, time, FILM_BLURRED, &picture, f) &&
              (e->kind == OLED ? layout_lamps(&picture, e->zoom, OLED_COLOR, out, f)
                               : layout_zoom(&picture, e->zoom, out, f));
    image_free(&picture);
    return ok;
}

static bool make_picture(struct film *film, const struct exhibit *e, double time, struct image *out,
                         struct failure *f)
{
    switch (e->kind) {
    case PAIR: return make_row(film, time, 2, out, f);
    case TRIPLE: return make_row(film, time, 3, out, f);
    case SCREEN:
    case OLED: return make_screen(film, e, time, out, f);
    default: return film_take(film, time, e->look, out, f);
    }
}

static smear_format format_of(const struct exhibit *e)
{
    return e->kind == SCREEN ? SMEAR_RGB565 : e->kind == OLED ? SMEAR_L4 : SMEAR_XRGB8888;
}

static bool make_exhibit(struct gallery *gallery, struct scene *scene, const struct exhibit *e,
                         struct failure *f)
{
    int width = e->width > 0 ? e->width : scene->width;
    int height = e->height > 0 ? e->height : scene->height;
    double time = e->time > 0 ? e->time : scene->time;
    struct image picture = { .rgba = NULL };
    struct film film;
    bool ok = film_open(&film, scene, width, height, format_of(e), f);
    if (ok && e->kind == REEL) {
        const struct gallery_reel reel = { .name = e->name, .what = e->what, .look = FILM_BLURRED,
                                           .fps = scene->fps, .count = e->frames };
        ok = gallery_show(gallery, &film, &reel, f);
    } else if (ok) {
        ok = make_picture(&film, e, time, &picture, f) &&
             gallery_hang(gallery, e->name, e->what, &picture, f);
    }
    image_free(&picture);
    film_close(&film);
    return ok;
}

/* ------------------------------------------------------------------ all of them */

struct demo {
    const char *assets;         /* null: none */
    struct gallery gallery;
    int status;
};

static bool is_same_scene(const struct exhibit *a, const struct exhibit *b)
{
    return a->diorama == b->diorama && (a->diorama != NULL || strcmp(a->scene, b->scene) == 0);
}

/* Exhibits of one scene stand together: it is opened once for all of them. Returns how many. */
static int show_scene(struct demo *demo, const struct exhibit *e, int count)
{
    struct scene scene = { 0 };
    struct failure f = { "" };
    int same = 1;
    while (same < count && is_same_scene(e, e + same))
        same++;
    if (e->diorama != NULL && demo->assets == NULL)
        return same;
    bool ok = e->diorama != NULL ? diorama_open(e->diorama, demo->assets, &scene, &f)
                                 : scene_builtin(e->scene, &scene, &f);
    if (!ok) {
        say_warning(e->diorama != NULL ? e->diorama->stage->name : e->scene, f.text);
        return same;
    }
    for (int i = 0; i < same; i++) {
        f = (struct failure){ "" };
        if (!make_exhibit(&demo->gallery, &scene, &e[i], &f))
            demo->status = say_bad_input(e[i].name, &f);
    }
    scene_free(&scene);
    return same;
}

int main(int argc, char **argv)
{
    struct demo demo = { .status = STATUS_OK };
    struct failure f = { "" };
    if (argc != 3)
        return say_bad_usage("usage", "smear-demo ASSETS|- FOLDER");
    demo.assets = strcmp(argv[1], "-") != 0 ? argv[1] : NULL;
    if (!gallery_open(&demo.gallery, argv[2], &f))
        return say_bad_input(argv[2], &f);
    int count = sizeof gallery_exhibits / sizeof *gallery_exhibits;
    for (int i = 0; i < count;)
        i += show_scene(&demo, &gallery_exhibits[i], count - i);
    printf("pictures in %s\n", argv[2]);
    return demo.status;
}
