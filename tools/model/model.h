/* SPDX-License-Identifier: MIT */
/* model.h - a glTF 2.0 or OBJ file in memory, and its pose at an instant. Host only, double
 * precision.
 *
 * A model is loaded once. model_pose() gives, for any time, the same list of draws in the same
 * order, so the index of a draw is its identity from frame to frame. Rigid draws share the
 * model's vertex arrays and move by their matrix; skinned and morphed draws own posed arrays.
 *
 * Every index in a loaded model is in range and every number finite. Names are never null, but
 * empty when the file gives none. */
#ifndef SMEAR_TOOLS_MODEL_H
#define SMEAR_TOOLS_MODEL_H

#include "tools/failure.h"
#include "tools/image/image.h"

#include <stddef.h>
#include <stdint.h>

enum model_wrap { MODEL_WRAP_REPEAT, MODEL_WRAP_CLAMP, MODEL_WRAP_MIRROR };
enum model_alpha { MODEL_ALPHA_OPAQUE, MODEL_ALPHA_MASK, MODEL_ALPHA_BLEND };

struct model_material {
    char *name;
    float base[4];                  /* linear factor, each 0 to 1 */
    int image;                      /* index into images, or -1 */
    enum model_wrap wrap_u, wrap_v;
    enum model_alpha alpha;
    float alpha_cutoff;             /* for MASK */
    bool double_sided, unlit;
    uint8_t gloss, shine;           /* of a highlight, as smear_material has it */
};

/* One glTF primitive (mode TRIANGLES, STRIP or FAN, unrolled to triangles) or the faces of one OBJ
 * group that share a material and a form. Every vertex is used by a triangle. */
struct model_primitive {
    int material;                   /* always valid: a default material is appended when needed */
    int vertex_count, triangle_count;   /* at least 1 each */
    float *position;                /* 3 per vertex */
    float *normal;                  /* 3 per vertex, or null: flat normals of the posed triangle */
    float *uv;                      /* 2 per vertex, KHR_texture_transform applied, v down (row 0 =
                                       image top); never null when the material has an image */
    float *color;                   /* 4 per vertex, linear; or null */
    uint32_t *index;                /* 3 per triangle, each < vertex_count */
    int target_count;               /* morph targets */
    float **target_position;        /* [target] -> 3 per vertex or null */
    float **target_normal;          /* [target] -> 3 per vertex or null */
    uint16_t *joint;                /* 4 or 8 per vertex, see influences; or null */
    float *weight;                  /* as many as joint, normalised to sum 1 */
    int influences;                 /* joints per vertex: 0, 4 or 8 */
};

struct model_mesh {
    char *name;
    int primitive_count;
    struct model_primitive *primitive;
    int weight_count;               /* morph targets of each primitive */
    float *weight;                  /* at rest */
};

struct model_node {
    char *name;
    int parent;                     /* -1 for a root */
    double translation[3], rotation[4], scale[3];   /* rotation x y z w, unit; at rest */
    bool has_matrix;                /* then `matrix` (column major) places it, always */
    double matrix[16];
    int mesh, skin, camera;         /* -1 for none; camera counts as in the file */
    bool is_instance;               /* not in the file: an instance of its parent's mesh; behind all others */
    int weight_count;
    float *weight;                  /* overrides the mesh's; or null */
};

struct model_skin {
    char *name;
    int joint_count;
    int *joint;                     /* nodes */
    double *inverse_bind;           /* 16 each, column major */
};

struct model_camera {
    char *name;                     /* the camera's, else its node's */
    int node;
    bool orthographic;
    double yfov;                    /* radians; perspective */
    double xmag, ymag;              /* orthographic half extents */
    double znear, zfar;             /* zfar 0: none given */
};

/* What a frame has room for. */
enum { MODEL_SUN, MODEL_SECOND, MODEL_LAMP, MODEL_LIGHTS };

struct model_light {
    bool is_there;
    int node;                       /* shines along its -z, or from its place */
    double color[3];                /* linear, lux or candela */
    double range;                   /* of a point; 0: none given */
};

enum model_path { MODEL_TRANSLATION, MODEL_ROTATION, MODEL_SCALE, MODEL_WEIGHTS };
enum model_interpolation { MODEL_STEP, MODEL_LINEAR, MODEL_CUBICSPLINE };

struct model_channel {
    int node;
    enum model_path path;
    enum model_interpolation interpolation;
    int key_count, width;           /* width: values per key (3, 4 or morph target count) */
    float *time;                    /* seconds, strictly increasing */
    float *value;                   /* key_count * width, or * 3 (in-tangent, value, out-tangent)
                                       for CUBICSPLINE; rotations need not have length 1 */
};

struct model_clip {
    char *name;
    int channel_count;
    struct model_channel *channel;
    double duration;                /* longest channel's last key */
};

struct model {
    int node_count;
    struct model_node *node;
    int *order;                     /* node_count indices, every parent before its children */
    bool *in_scene;                 /* per node: reachable from the scene that is drawn */
    int mesh_count;
    struct model_mesh *mesh;
    int material_count;
    struct model_material *material;
    int image_count;
    struct image *image;            /* only those that a material of some primitive uses */
    int skin_count;
    struct model_skin *skin;
    int camera_count;
    struct model_camera *camera;    /* one per camera NODE in the scene, file order of nodes */
    int clip_count;
    struct model_clip *clip;
    struct model_light light[MODEL_LIGHTS];
    bool has_sides;                 /* the format says which faces are seen from both sides (glTF), or nothing of it (OBJ) */
    int skipped_primitives;         /* points, lines, curves and empty ones, counted and left out */
    char warning[1000];             /* what was left out or not found, one line; or empty */
};

/* Where the files lie that a model names. */
enum model_files {
    MODEL_FILES_BESIDE,             /* in its folder or below, whatever links there are */
    MODEL_FILES_ANYWHERE            /* .. may lead out of it; absolute paths and URLs are refused still */
};

/* Loads .glb, .gltf or .obj, told by content first, name second, with the buffers, images and .mtl
 * files that it names, which must be regular files. An OBJ whose .mtl or picture is missing is loaded
 * without, with a warning. On failure *out is empty. */
bool model_load_from(const char *path, enum model_files files, struct model *out, struct failure *f);
/* The same, with files beside it. */
bool model_load(const char *path, struct model *out, struct failure *f);
/* The same from memory; `folder` may be null, then nothing external can be read. */
bool model_parse(const uint8_t *bytes, size_t size, const char *folder, struct model *out,
                 struct failure *f);
void model_free(struct model *model);

/* All faces are seen from both sides, whatever their materials say. */
void model_show_both_sides(struct model *model);

/* Adds to model->warning, in printf style. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void model_warn(struct model *model, const char *format, ...);

/* Which clips move the model: one clip, all of them together (later in the file wins per node and
 * path), or none. */
enum { MODEL_CLIP_NONE = -1, MODEL_CLIP_ALL = -2 };

struct model_draw {
    int node, primitive_of_mesh;    /* where it comes from */
    const struct model_primitive *primitive;    /* indices, uv, colours, material: never change */
    double world[16];               /* object to world, column major; identity when skinned (then
                                       positions are in world space) */
    const float *position;          /* posed, object space; the primitive's own array when rigid */
    const float *normal;            /* posed, or null: not normalised */
    bool deformed;                  /* skinned or morphed: position and normal belong to the pose */
};

struct pose_scratch;

struct model_pose {
    int draw_count;
    struct model_draw *draw;
    double *node_world;             /* 16 per node */
    float **owned;                  /* arrays of deformed draws, reused from pose to pose */
    int owned_count;
    const struct model *model;      /* whose pose this is; posing another model starts afresh */
    struct pose_scratch *scratch;   /* private to pose.c */
};

/* Poses the model at `time` seconds: channels clamp at their ends, or, with `loop`, wrap by the
 * clip's longest channel (for ALL: by the longest of all). `pose` is zeroed before first use and
 * may be reused while the model lives; free with model_pose_free. A node with zero or negative
 * scale is fine. Fails when there is no such clip, when `time` is not finite, and when the pose
 * leaves +-1e30. */
bool model_pose(const struct model *model, int clip, double time, bool loop,
                struct model_pose *pose, struct failure *f);
/* The pose at `time` that a path may join with the pose at `now`: what jumps on the way (held keys, the end of a loop that does
 * not meet its start, two keys at almost the same time) has not jumped. Without a jump it is the pose at `time`, to the bit. */
bool model_pose_joined(const struct model *model, int clip, double time, double now, bool loop,
                       struct model_pose *pose, struct failure *f);
void model_pose_free(struct model_pose *pose);

/* World bounds of everything drawn in this pose; false when nothing is drawn. */
bool model_pose_bounds(const struct model_pose *pose, double min[3], double max[3]);

/* The file's lights at rest, in its world: colours linear, 1 is one; ways towards the first two, of length 1; where the lamp is, and where
 * its light ends. */
struct model_lights {
    bool has[MODEL_LIGHTS];
    double color[MODEL_LIGHTS][3], direction[2][3], place[3], reach;
};

/* Fails when a node of theirs is beyond +-1e30, or has no direction. */
bool model_find_lights(const struct model *model, struct model_lights *out, struct failure *f);

/* By exact name, else by decimal index; -1 when there is none. */
int model_find_clip(const struct model *model, const char *name_or_index);
int model_find_camera(const struct model *model, const char *name_or_index);
int model_find_node(const struct model *model, const char *name);
/* True for itself, too. */
bool model_node_is_under(const struct model *model, int node, int ancestor);

#endif
