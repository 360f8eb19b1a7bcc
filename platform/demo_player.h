/* SPDX-License-Identifier: MIT */
/* demo_player.h - draws frames of the demo: the screens it knows, and how it uses the library. */
#ifndef SMEAR_DEMO_PLAYER_H
#define SMEAR_DEMO_PLAYER_H

#include "platform/demo_scene.h"

struct demo_screen {
    const char *name;
    smear_desc desc;                /* without callbacks */
    uint8_t method;                 /* smear_method of blurred frames */
    uint8_t light;                  /* smear_light_space */
    uint32_t sky;                   /* 0xRRGGBB */
    const char *level;              /* of detail, in demo_props.c */
    uint8_t path;                   /* smear_path */
    uint8_t sharp_tile;             /* desc.tile of SMEAR_NONE; 0: desc's, for all ways to blur */
    uint16_t target;                /* of SMEAR_AUTO; 0: the default */
};

/* A way to blur, to compare costs (make demo-cost BLUR=...). */
struct demo_blur {
    const char *name;
    uint8_t method;                 /* smear_method */
    uint16_t number;                /* samples, or the target of SMEAR_AUTO; 0: the default, or the screen's target */
};

extern const struct demo_blur demo_blurs[];
extern const int demo_blur_count;

/* Null when there is none of this name. */
const struct demo_blur *demo_blur_find(const char *name);

/* What the screen's context needs for it. */
void demo_blur_desc(const struct demo_blur *blur, const struct demo_screen *screen, smear_desc *desc);

extern const struct demo_screen demo_screens[];
extern const int demo_screen_count;

/* Null when there is none of this name. */
const struct demo_screen *demo_screen_find(const char *name);

struct demo_player {
    smear_context *ctx;
    const struct demo_screen *screen;
    const smear_draw *props;
    uint16_t shutter_degrees;       /* 0: sharp; what keys change */
    const struct demo_blur *blur;   /* null: as the screen has it */
    const smear_fog *fog;           /* null: none */
    const smear_scene *extras;      /* likewise */
    struct demo_scene scene;
};

/* Starts the library in `memory`. `desc` is the screen's with callbacks, and perhaps of another
 * size. Returns a smear_result. */
int demo_player_start(struct demo_player *player, const struct demo_screen *screen,
                      const smear_desc *desc, void *memory, size_t bytes);

/* Poses frame `frame` and submits it; with `draw`, renders it, too. Frames come in order: the
 * library remembers where everything was. Returns a smear_result. */
int demo_player_frame(struct demo_player *player, uint32_t frame, int draw);

/* Keys of the demo, enum display_key: A sharp or blurred; left and right a shorter or longer shutter; start stops and goes on. */
struct demo_controls {
    unsigned held;                  /* at the last look */
    int is_paused;
};

/* Does what the keys pressed since the last look ask for; true when that changes the picture. */
int demo_player_obey(struct demo_player *player, struct demo_controls *controls, unsigned held);

/* Renders the sharp instant at a time between frames, in DEMO_TIME of a frame. Returns a smear_result. */
int demo_player_instant(struct demo_player *player, int32_t time);

#endif
