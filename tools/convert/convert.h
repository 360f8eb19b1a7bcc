/* SPDX-License-Identifier: MIT */
/* convert.h - a model file as constant data for firmware: meshes, textures and clips in the tables of
 * smear_model.h, as a C header or as a .smr blob. Host only.
 *
 * What comes out depends on the model and the options alone, bit for bit, on every host: see exact.h.
 *
 *     model (floats)                         tools/model
 *       limits.c    what is too much
 *       nodes.c     which nodes move; the others go into vertices or joints; scales
 *       track.c     clips at an instant, exactly
 *       keys.c      clips as keys that mix linearly, no more than the tolerance needs
 *       texture.c   smaller pictures, palettes, or colours instead of a texture
 *       shape.c     draws of one kind become one mesh; grids; int16 vertices
 *       weld.c      equal vertices become one; order.c: triangles in an order that reuses vertices
 *       deform.c    skins and morph targets
 *       measure.c   plays the result (src/model/anim.c) and compares it with the model's own poses
 *       blob.c, header.c                     files */
#ifndef SMEAR_TOOLS_CONVERT_H
#define SMEAR_TOOLS_CONVERT_H

#include "tools/failure.h"
#include "tools/model/model.h"

#include <smear_model.h>
#include <smear_scene.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum convert_texture {
    CONVERT_PALETTE8, CONVERT_RGB565, CONVERT_RGB8888,
    CONVERT_BAKED,              /* no texture: its colours go to the vertices, or to flat faces */
    CONVERT_NO_TEXTURE          /* no texture: the material's colour is all */
};

struct convert_options {
    const int *clip;            /* indices into model->clip, each once, in the order of the result */
    int clip_count;
    const uint8_t *keep;        /* per node: stays a node of its own, which programs may move; or null */
    double scale;               /* > 0 */
    double fit;                 /* > 0: the largest extent at rest, instead of scale; 0: none */
    bool z_up;                  /* the file's +Z is up */
    enum convert_texture texture;
    int texture_edge;           /* 1..4096: pictures are shrunk until no edge is longer */
    int colors;                 /* of a palette, 2..256 */
    bool mipmaps;               /* smaller pictures behind those whose sizes are powers of two and which repeat */
    bool bilinear;
    bool flat;                  /* normals are dropped */
    int influences;             /* joints per vertex at most, 1..4 */
    double clip_error_px;       /* > 0: what the keys of a clip may move a vertex by */
    double rows, fov_degrees;   /* what a pixel is: of this many rows with this field of view, */
    double distance;            /* at this distance in world units; 0: where the whole model is seen */
};

/* A vertex of a model's draw (its index in model_pose.draw) and where it went. */
struct convert_origin {
    int draw, vertex;           /* of the model */
    int mesh_vertex;            /* of the draw's mesh */
};

struct convert_texture_report {
    int from_width, from_height, width, height, colors;
    double rms;                 /* in codes, against the smaller picture; 0: none lost */
};

/* Texels of a texture and of the smaller pictures behind it. */
size_t convert_texel_count(const smear_texture *t);

struct convert_clip_report {
    int keys, keys_in_file;
    int jumps;                          /* from one key to the next: nothing joins them by a path */
    double error_px, error_time;        /* largest, and when */
};

/* What an actor, of whatever model, keeps of its poses' times to know what has jumped in between. */
enum { CONVERT_JUMP_BYTES = 24 };

/* Bytes on a core with 32-bit pointers. */
struct convert_bytes {
    size_t meshes, textures, animation; /* of flash */
    size_t actor[3];                    /* of RAM: with 1, 2 or 3 poses */
    size_t open;                        /* of RAM: what smear_model_open needs */
};

struct conversion {
    smear_model model;
    /* what model points to, and more */
    int texture_count, joint_count, skin_count, target_count, delta_count, delta_normals;
    int influence_count, channel_count, key_times, key_values, text_size;
    smear_texture *texture;
    int *palette_count;         /* of each texture; 0: none */
    int *same_texels;           /* of each texture: the first one that has its texels */
    const char **node_name;     /* of each node; empty when it has none */
    int *origin_count;          /* of each draw */
    struct convert_origin **origin;

    double root[16];            /* from the file's world to the result's */
    bool has_sun, has_lights;   /* the file's, at rest, in the result's world; headers have them */
    bool lamp_is_beyond;        /* of Q16.16: left out */
    smear_light sun;
    smear_lights lights;        /* the second one and the lamp; their shader is null */
    int triangles, vertices, triangles_in_file, vertices_in_file;
    int invisible;              /* draws left out because their material lets nothing through */
    int transformed, transformed_in_file;       /* vertices, with a vertex cache of 64 */
    struct convert_texture_report *texture_report;
    struct convert_clip_report *clip_report;
    struct convert_bytes bytes;
    double pixels_per_unit;     /* at the distance of the report */
    double distance;
    double rest_error_px;       /* largest error of a position at rest */
    double error_px;            /* of rest and all clips */
    struct convert_pile *pile;  /* owns it all */
};

/* The model need not outlive the conversion. On failure nothing is left to free. */
bool convert_model(const struct model *model, const struct convert_options *options, struct conversion *out,
                   struct failure *f);
void conversion_free(struct conversion *c);

/* The result as a file in memory; *bytes is malloc'ed. `name` is a C identifier in lower case, `from` the name of
 * the file it comes from. */
bool convert_to_header(const struct conversion *c, const char *name, const char *from, uint8_t **bytes, size_t *size,
                       struct failure *f);
bool convert_to_blob(const struct conversion *c, uint8_t **bytes, size_t *size, struct failure *f);

#endif
