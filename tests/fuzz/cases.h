/* SPDX-License-Identifier: MIT */
/* cases.h - a number becomes a case: a desc, meshes, textures, and a few frames over the whole interface.
 *
 * Values of a valid case lie within the ranges that smear.h states, though many are extreme: every call must succeed. In a
 * wild one, some lie anywhere: calls may refuse them. Arrays have exactly the size that the library may read. */
#ifndef SMEAR_FUZZ_CASES_H
#define SMEAR_FUZZ_CASES_H

#include "smear.h"
#include "smear_overlay.h"
#include "smear_scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ------------------------------------------------------------------ numbers */

struct source {
    uint64_t state;
    const uint8_t *bytes; /* whose words come first */
    size_t left;
};

uint32_t source_word(struct source *s);
/* low .. high, both included */
int32_t source_range(struct source *s, int32_t low, int32_t high);
/* Any number, small and extreme ones often. */
int32_t source_any(struct source *s);
/* True once in so many calls. */
bool source_chance(struct source *s, int one_in);

/* ------------------------------------------------------------------ cases */

enum { CASE_TEXTURES = 3,
       CASE_MESHES = 4,
       CASE_DRAWS = 8,
       CASE_ITEMS = 4,
       CASE_POINTS = 12,
       CASE_BLOCKS = 64 };

enum { HUGE_ROOM = 30000,       /* triangles of a huge mesh, all of which may pass the eye: in parts, it would take minutes */
       CASE_DEAR = 2500 };      /* triangles of a case of many of which more are dear: fewer instants, seldom parts */

struct fuzz_case {
    struct source source;
    bool wild;
    bool extreme; /* numbers of any size are frequent */
    bool large;   /* many triangles, pixels, instants: rare, as it costs 50 times more */
    bool with_overlay;
    int triangles; /* of a case of many, in all draws together; else 0 */
    int frames;
    smear_desc desc; /* without callbacks */
    smear_texture texture[CASE_TEXTURES];
    smear_mesh mesh[CASE_MESHES];
    int16_t *position[CASE_MESHES]; /* as in the mesh: may be changed with `refresh` */
    const int16_t *other[CASE_MESHES][2];
    smear_material material[CASE_DRAWS];
    smear_transform pose[CASE_DRAWS][3];
    smear_draw draw[CASE_DRAWS];
    int draws;
    smear_camera camera[3], layer_camera[3];
    smear_layer layer[SMEAR_LAYERS_MAX];
    smear_light light;
    uint8_t curve[SMEAR_SHUTTER_POINTS];
    smear_image image;
    smear_font font;
    char text[12];
    smear_overlay_item item[CASE_ITEMS];
    smear_point point[CASE_POINTS];
    smear_points points;
    smear_overlay overlay;
    smear_fog fog;
    smear_sky sky;
    smear_lights lights;
    smear_scene scene;
    smear_frame frame;
    void *block[CASE_BLOCKS];
    int blocks;
};

/* Makes case `number` up to its desc and scene. */
void case_make(struct fuzz_case *c, uint64_t number, bool wild);

/* Makes the case of which the bytes say what chance says otherwise, two for a word; then those of `state` 0 follow. */
void case_make_of_bytes(struct fuzz_case *c, const uint8_t *bytes, size_t size, bool wild);

/* Makes case `number` of 256 to 20,000 triangles, 2 to 8 workers and a store that may be too small: cases_many.c. What it is made
 * of: the desc, sizes of a mesh, a mesh, what is plain; and one worker's desc with room for all, which must draw the same. */
void case_make_many(struct fuzz_case *c, uint64_t number);
void case_make_of(struct fuzz_case *c, uint64_t state, int triangles, int draws);
void case_many_desc(struct fuzz_case *c);
void case_many_mesh(struct fuzz_case *c, int *across, int *down, int *vertices, int *triangles);
void case_many_cloud(struct fuzz_case *c, int16_t *position, int vertices, uint16_t *index, int triangles);
void case_many_plain(struct fuzz_case *c);
smear_desc case_many_other(struct fuzz_case *c);

/* Makes frame `k` of it: settings, cameras, poses. */
void case_frame(struct fuzz_case *c, int k);

/* What lies over the frames: cases_overlay.c. */
void case_make_overlay(struct fuzz_case *c);
void case_frame_overlay(struct fuzz_case *c);

/* Bytes of noise, which case_free gives back. */
void *case_random(struct fuzz_case *c, size_t size);

/* Puts anything into some fields of a wild case: of the desc, or of what a frame is made of. */
void case_spoil_desc(struct fuzz_case *c);
void case_spoil_frame(struct fuzz_case *c);

/* Another desc that must draw the same pictures: other workers, parts, caches, bands. */
smear_desc case_other_desc(struct fuzz_case *c);

void case_free(struct fuzz_case *c);

/* ------------------------------------------------------------------ drawing */

/* Draws a case, and ends the program where anything about it is not as it should be. */

/* As the program `frames` has them (frames.c). */
enum mode { MODE_VALID,
            MODE_WILD,
            MODE_SUMS,
            MODE_THREADS,
            MODE_MANY,
            MODE_PARTS };

struct counts {
    uint64_t cases, frames, refused, compared, parts, errors;
};

extern char now_at[80]; /* the case and its frame */
extern bool talks;

/* Returns a sum of the case's pictures. */
uint32_t run_case(struct counts *counts, uint64_t number, enum mode mode);

/* The case that the bytes tell. */
void run_bytes(const uint8_t *bytes, size_t size, enum mode mode);

#endif
