/* SPDX-License-Identifier: MIT */
/* gltf.h - what the parts of the glTF reader share; only gltf*.c and model.c include it.
 *
 * Order of work, each part on the results of those before it:
 *
 *   gltf.c            container, asset; runs the rest
 *   gltf_extension.c  extensions: read, drawn without, or refused
 *   gltf_buffer.c     buffers, buffer views, URIs
 *   gltf_accessor.c   accessors: all checked at once, decoded when asked for
 *   gltf_material.c   materials; at the end the pictures that drawn materials use
 *   gltf_mesh.c       primitives to triangle lists
 *   gltf_scene.c      nodes, scenes, skins, cameras
 *   gltf_animation.c  clips
 *   gltf_light.c      lights
 *   gltf_instance.c   a node for each instance of a mesh
 *
 * Every function that returns false has put its reason into g->f. */
#ifndef SMEAR_TOOLS_GLTF_H
#define SMEAR_TOOLS_GLTF_H

#include "tools/model/external.h"
#include "tools/model/json.h"
#include "tools/model/model.h"

/* A buffer view: a checked slice of a buffer. */
struct gltf_view {
    const uint8_t *bytes;       /* null: of a buffer that has none */
    size_t size;
    size_t stride;              /* 0: elements are packed */
    const char *packed_by;      /* the extension that has its bytes where the buffer has none; or null */
};

enum gltf_component {
    GLTF_I8 = 5120, GLTF_U8 = 5121, GLTF_I16 = 5122, GLTF_U16 = 5123, GLTF_U32 = 5125,
    GLTF_F32 = 5126
};

/* Values are the numbers per element; matrices are told apart by their rows. */
enum gltf_shape {
    GLTF_SCALAR = 1, GLTF_VEC2 = 2, GLTF_VEC3 = 3, GLTF_VEC4 = 4, GLTF_MAT2 = 32, GLTF_MAT3 = 33,
    GLTF_MAT4 = 34
};

/* An accessor whose every byte is known to lie in its views. */
struct gltf_accessor {
    enum gltf_component component;
    enum gltf_shape shape;
    int width;                  /* numbers per element */
    int count;                  /* elements, at least 1 */
    bool normalized;
    const uint8_t *bytes;       /* null: zeros */
    size_t stride;
    int sparse_count;           /* elements that replace others; 0: none */
    enum gltf_component sparse_component;
    const uint8_t *sparse_index, *sparse_value;     /* indices increase strictly, each < count */
};

/* What a material needs besides struct model_material. */
struct gltf_material {
    int picture;                /* index into the file's images, or -1 */
    int uv_set;
    double uv[6];               /* u' = uv[0] u + uv[1] v + uv[2]; v' = uv[3] u + uv[4] v + uv[5] */
    bool is_drawn;
};

struct gltf {
    struct json json;
    struct model *model;
    struct failure *f;
    struct external *files;
    const uint8_t *bin;         /* the GLB's BIN chunk or null */
    size_t bin_size;
    size_t source_bytes;        /* of the JSON and all buffers: lying counts are held against it */
    size_t decoded_bytes;       /* taken by gltf_alloc so far */
    size_t packed_bytes;        /* of pictures, each time one is read */

    int buffer_count;
    struct gltf_view *buffer;
    uint8_t **owned_buffer;     /* per buffer: its own bytes or null */
    int view_count;
    struct gltf_view *view;
    int accessor_count;
    struct gltf_accessor *accessor;
    int material_count;         /* in the file; the model may have a default one more */
    struct gltf_material *material;
    int *max_joint;             /* per mesh: largest joint with a weight, -1 when not skinned */
};

bool gltf_parse(const uint8_t *bytes, size_t size, struct external *files, struct model *model, struct failure *f);

/* Zeroed memory for count x size bytes, counted against MODEL_MAX_BYTES. */
void *gltf_alloc(struct gltf *g, size_t count, size_t size);

/* A member of `object` that is an array of objects; *array -1 and *count 0 when absent. */
bool gltf_list(struct gltf *g, int object, const char *key, int *array, int *count);

/* A copy of the text; null when out of memory. */
char *gltf_copy(struct gltf *g, const char *text);
/* A copy of the object's name, "" when it has none; null when it is no string or out of memory. */
char *gltf_name(struct gltf *g, int object);

/* The object's extension of that name, or -1. */
int gltf_extension(struct gltf *g, int object, const char *name);

/* Refuses files that need what is not read, and warns of what they are drawn without. */
bool gltf_read_extensions(struct gltf *g);
/* Fails at `value`, as the extension holds triangles that are nowhere else. */
bool gltf_packed(struct gltf *g, int value, const char *extension);

bool gltf_read_buffers(struct gltf *g);
void gltf_free_buffers(struct gltf *g);
/* Fails at `object`, which wants to read the view, when its buffer has no bytes. */
bool gltf_has_bytes(struct gltf *g, int view, int object);
/* The bytes a URI stands for; *owned (to be freed) is null when they are part of something else. */
bool gltf_read_uri(struct gltf *g, int object, const char *uri, uint8_t **owned, size_t *size);

bool gltf_read_accessors(struct gltf *g);
/* Reads the accessor index member `key` of `object`, -1 when absent. */
bool gltf_get_accessor(struct gltf *g, int object, const char *key, int *out);
/* Bits for gltf_expect: allowed component types. */
enum {
    GLTF_FLOAT = 1,
    GLTF_UNSIGNED = 2,          /* 8 or 16 bits */
    GLTF_BYTE_OR_SHORT = 4,     /* 8 or 16 bits, signed or not */
    GLTF_WORD = 8               /* 32 bits */
};
/* Fails at object.key unless the accessor has the shape, one of the component types and the count
 * (-1: any). */
bool gltf_expect(struct gltf *g, int accessor, enum gltf_shape shape, int components, int count,
                 int object, const char *key);
/* Elements rows[0..n) (strictly increasing; null: 0..n) as floats, integers normalised if the
 * accessor says so or `normalize`. Fails at object.key when a number is not finite. */
bool gltf_floats(struct gltf *g, int accessor, const uint32_t *rows, int n, bool normalize,
                 float *out, int object, const char *key);
/* All elements of a scalar unsigned accessor. */
void gltf_indices(struct gltf *g, int accessor, uint32_t *out);

bool gltf_read_materials(struct gltf *g);
/* The material for primitives that name none; appended to the model on first use. */
bool gltf_default_material(struct gltf *g, int *out);
bool gltf_read_pictures(struct gltf *g);

bool gltf_read_meshes(struct gltf *g);
/* The first `count` items of an array as weights of morph targets; zeros where there are fewer. */
bool gltf_weights(struct gltf *g, int array, int count, float **out);

bool gltf_read_nodes(struct gltf *g);
bool gltf_read_skins(struct gltf *g);
bool gltf_read_scene(struct gltf *g);
bool gltf_read_cameras(struct gltf *g);

bool gltf_read_animations(struct gltf *g);

/* KHR_lights_punctual; warns of lights that are left out. */
bool gltf_read_lights(struct gltf *g);

/* EXT_mesh_gpu_instancing: an instance is a node below the one that has its mesh in the file. */
bool gltf_read_instances(struct gltf *g);

#endif
