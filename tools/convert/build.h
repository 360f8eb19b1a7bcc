/* SPDX-License-Identifier: MIT */
/* build.h - the state of a conversion, shared by the files of this folder and by nobody else. */
#ifndef SMEAR_TOOLS_CONVERT_BUILD_H
#define SMEAR_TOOLS_CONVERT_BUILD_H

#include "tools/convert/convert.h"

#include "tools/scenes/present_surface.h"

/* ------------------------------------------------------------------ memory */

/* Blocks that are freed together. */
struct convert_pile {
    int count, room;
    void **block;
};

/* Zeroed; of size 0, too. Null only when out of memory. */
void *pile_alloc(struct convert_pile *pile, size_t count, size_t size, struct failure *f);
void pile_free(struct convert_pile *pile);

/* An array that grows; `data` belongs to the list until list_keep hands it to a pile. */
struct list {
    void *data;
    size_t size;                /* of an element */
    int count, room;
};

/* The address of `count` new, zeroed elements; null when out of memory. */
void *list_add(struct list *l, int count, struct failure *f);
void *list_keep(struct list *l, struct convert_pile *pile, struct failure *f);
void list_free(struct list *l);

/* ------------------------------------------------------------------ state */

enum { NO_NODE = -1 };

/* A node of the result. World = parent's world x (moves: the source's own translation, rotation and scale as the
 * clip has them; else `fixed`). */
struct out_node {
    int source;                 /* of the model, or NO_NODE */
    int parent;                 /* of the result, or NO_NODE */
    bool moves;
    double fixed[16];
    double size;                /* largest column of the world's basis, at rest and in every clip */
    int exponent;               /* the device's basis is the world's x 2^-exponent */
};

/* Where a node of the model is: world = world of `node` x `matrix`. */
struct carrier {
    int node;                   /* of the result, or NO_NODE: the world itself */
    double matrix[16];
};

struct out_skin {
    int source;                 /* of the model */
    int joint_count;
    int joint[256];             /* of the model's skin */
    int *place_of;              /* per joint of the model's skin: index in `joint`, or -1 */
    struct bounds in, out;      /* of its meshes as stored, and posed in the world */
    struct grid in_grid, out_grid;
};

/* Draws of the model that become one draw of the result. Vertices are those of the draws, one after the other. */
struct shape {
    int material;               /* of the model */
    int node;                   /* of the result, or NO_NODE */
    int skin;                   /* of the result, or -1 */
    int same;                   /* a shape before it that has the same vertices on another node, or -1 */
    int morph_node;             /* of the model: has the weights; or -1 */
    int draw_count;
    int *draw;                  /* of the model */
    int vertex_count, triangle_count, target_count;
    float *position, *normal, *uv, *color, *face_color;
    uint32_t *index;
    struct convert_origin *origin;      /* of each vertex; mesh_vertex is not set yet */
    struct bounds bounds;       /* of the positions, morphed ones included */
    struct grid grid;
};

struct out_material {
    smear_material material;    /* without its texture */
    int texture;                /* of the result, or -1 */
};

struct out_texture {
    smear_texture texture;
    int image, palette_count;
    int same;                   /* the first one that has its texels */
};

/* A draw of the model. */
struct source_draw {
    int node, primitive_of_mesh;
    const struct model_primitive *primitive;
    int skin;                   /* of the result, or -1 */
    struct carrier at;          /* rigid: where it is */
    bool bakes;                 /* at.matrix goes into the vertices */
    bool is_shared;             /* several nodes have this mesh */
};

/* An instant that bounds are taken at. */
struct instant {
    int clip;                   /* of the model, or -1: at rest */
    double time;
};

struct converter {
    const struct model *model;
    const struct convert_options *options;
    struct conversion *out;
    struct convert_pile *pile;
    struct failure *f;

    double root[16];
    double tolerance;           /* world units: what one channel may move a vertex by */
    double *reach;              /* per node of the model: farthest vertex it moves, world units */
    bool *used;                 /* per node of the model: carries a vertex that is drawn */
    bool *moves;                /* per node of the model */
    struct carrier *carrier, root_carrier;      /* per node of the model */
    int instant_count;
    struct instant *instant;
    int node_count, node_room;
    struct out_node *node;
    int *node_of;               /* per node of the model: node of the result that is just that, or -1 */
    struct bounds all;          /* of everything, in the world, at all instants */
    int unit_exponent;          /* a model unit is 2^unit_exponent world units */

    int draw_count;
    struct source_draw *draw;
    int skin_count;
    struct out_skin *skin;
    int *weight_first;          /* per node of the model: its first weight, or -1 */
    int weight_count;
    struct list weight_factor;  /* double per weight of the result: a power of two its deltas have been scaled by */
    int shape_count;
    struct shape *shape;
    struct list mesh, material, draws, joint, skins, influence, target, delta, delta_normal;
    struct list clip, channel, key_time, key_value, text, texture, texture_report;
    int *material_of;           /* per material of the model, without and with its texture: of the result, or -1 */
    struct image *picture;      /* per image of the model: shrunk, made when used */
    int draw_room, transform_count, deformed_count, joint_limit;
    uint32_t deformed_vertices;
    bool has_normals;
};

/* ------------------------------------------------------------------ stages, in order */

/* limits.c: no more than firmware can hold, and than can be converted in seconds */
bool check_work(struct converter *c);

/* nodes.c */
bool find_draws(struct converter *c);
bool find_moving_nodes(struct converter *c);
bool find_carriers(struct converter *c);
bool find_bounds(struct converter *c);
bool write_nodes(struct converter *c);

/* shape.c: find_shapes before find_bounds, which wants their vertices */
bool find_shapes(struct converter *c);
bool write_meshes(struct converter *c);

/* texture.c */
const struct image *shrunk_picture(struct converter *c, int image);
bool bake_texture(struct converter *c, struct shape *s);
/* The texture of a material in the result, or -1; false on failure. */
bool texture_for(struct converter *c, const struct model_material *m, int *texture);
bool finish_textures(struct converter *c);

/* keys.c */
bool write_clips(struct converter *c);
/* Whether a kept clip moves this node by more than the tolerance. */
bool channel_moves(const struct converter *c, const struct model_channel *channel);

/* A mesh in the library's integers, before and after welding. */
struct raw_mesh {
    int vertex_count, triangle_count;
    int16_t *position, *uv;
    int8_t *normal;
    uint8_t *color, *face_color;
    uint16_t *index;
    int influences;             /* per vertex */
    uint8_t *influence;         /* 2 influences - 1 per vertex */
    int target_count, weight_first;
    int32_t *delta;             /* 3 per vertex, target after target; steps */
    int8_t *delta_normal;       /* 3 per vertex, target after target; or null */
    struct convert_origin *origin;      /* grows beyond the vertices when they are welded */
    int origin_count;
};

/* deform.c */
bool skin_influences(struct converter *c, const struct shape *s, struct raw_mesh *mesh);
bool morph_deltas(struct converter *c, const struct shape *s, struct raw_mesh *mesh);
bool write_skins(struct converter *c);
bool write_targets(struct converter *c, const struct raw_mesh *mesh, smear_model_draw *draw);

/* weld.c */
bool weld_vertices(struct raw_mesh *mesh, struct convert_pile *pile, struct failure *f);

/* order.c: misses of a direct-mapped vertex cache, and an order that has few. keep_order: of the triangles */
int count_transforms(const uint32_t *index, int triangles);
bool order_triangles(struct raw_mesh *mesh, bool keep_order, struct convert_pile *pile, struct failure *f);

/* measure.c */
bool measure(struct converter *c);
void count_bytes(struct conversion *out);

/* ------------------------------------------------------------------ small things */

double largest_column(const double m[16]);
void transform_double(double out[3], const double m[16], const double p[3]);
bool is_identity(const double m[16]);

/* x 2^fraction_bits to nearest; fails where the result is beyond +-limit. */
bool to_fixed(int32_t *out, double x, int fraction_bits, double limit, struct failure *f);

/* A grid of int16 steps over bounds that leaves nothing to the transform: see present_surface.h. */
struct grid grid_without_fold(const struct bounds *b);

/* ------------------------------------------------------------------ records */

/* Tables of smear_model.h that headers and blobs have alike, with what an element is made of. */

/* A letter of `fields` is a number: b B 8 bits, h H 16, i I 32, with and without sign; x 32 in hexadecimal; p 8, a path of a
 * channel; c a letter. Braces enclose arrays. A table of one letter is an array of numbers. */
struct record_table {
    int blob;                   /* BLOB_DRAW ... */
    const char *type, *name, *fields;
    int per_line;               /* of a header */
    const void *data;
    int count;
};

enum { RECORD_TABLES = 14 };

/* In the order in which they are written. */
void record_tables(const struct conversion *c, struct record_table out[RECORD_TABLES]);

/* Reads the number that a letter stands for, at *data, which goes on behind it. */
int64_t record_number(char letter, const uint8_t **data);

/* Bytes of it. */
int record_size(char letter);

#endif
