/* SPDX-License-Identifier: MIT */
/* smear.h - motion-blurred 3D for machines without a GPU. The whole public interface.
 *
 * What it does. You give it meshes, a transform for each and a camera, once per frame. It remembers where everything
 * was in the frame before, draws triangles in fixed point through a few tile rows of memory, blurs what moved, and
 * hands finished bands of display pixels to your callback, top to bottom.
 *
 * What it does not. No malloc, no files, no floating point, no global state, no full-frame buffer (but for
 * SMEAR_ACCUMULATE and what you ask to be cached), no scene graph, no clock. It never reads the display back.
 *
 *     #include <smear.h>
 *     #include <smear_math.h>                             // SMEAR_Q16, smear_perspective, smear_rotate_y ...
 *     #include <smear_memory.h>                           // SMEAR_MEMORY_WORDS, SMEAR_DESC
 *
 *     #define SCREEN 240, 240, 600, 8                     // width, height, triangles, draws
 *     static uint64_t memory[SMEAR_MEMORY_WORDS(SCREEN)];
 *     static const int16_t corner[] = { -1, -1, 0,  1, -1, 0,  0, 1, 0 };
 *     static const uint16_t side[] = { 0, 1, 2 };
 *     static smear_mesh mesh;                             // zero: the default of every field
 *     static smear_frame frame;
 *     static smear_draw draw;
 *
 *     static int flush(void *user, const smear_band *band)
 *     {
 *         ...send band->size bytes from band->pixels to rows band->y and below of the panel...
 *         return 0;
 *     }
 *
 *     int main(void)
 *     {
 *         smear_context *ctx;
 *         smear_desc desc = SMEAR_DESC(SCREEN);
 *         desc.format = SMEAR_RGB565;
 *         desc.flush = flush;
 *         int result = smear_init(&ctx, &desc, memory, sizeof memory);
 *         smear_camera camera = smear_perspective(SMEAR_DEGREES(45), SMEAR_Q16(0.1), SMEAR_Q16(100));
 *         frame.camera = &camera;
 *         mesh.position = corner, mesh.vertex_count = 3, mesh.index = side, mesh.triangle_count = 1;
 *         draw.id = 1, draw.mesh = &mesh;                 // the id tells where it was a frame ago
 *         for (int n = 0; result == SMEAR_OK; n++) {
 *             smear_transform pose = smear_move(n * SMEAR_Q16(0.1), 0, SMEAR_Q16(-6));
 *             draw.now = &pose;
 *             smear_begin(ctx, &frame);
 *             smear_submit(ctx, &draw);
 *             result = smear_render(ctx);                 // bands come to flush()
 *         }
 *         puts(smear_error_text(result));
 *     }
 *
 * Numbers. Q16.16 is an int32_t holding value x 65536; a basis is Q8.24. smear_math.h makes both from constants and
 * has rotations, look-at and the like. The world is right-handed, +Y up; a camera looks along its own -Z; the screen's
 * origin is top left, pixel centres lie at +0.5.
 *
 * Zero in an optional field means the default, which is the best picture in the least memory that is not slow, so
 * `= {0}` is a good start for every struct. Functions return SMEAR_OK or a negative number, of which smear_error_text
 * says what is wrong; a context stays usable after any error.
 *
 * Where to find what: smear_desc, what a context is made for; smear_frame, how a frame is seen and blurred; smear_draw,
 * smear_mesh, smear_material, what is drawn; smear_method, the ways to blur; the functions come last. */
#ifndef SMEAR_H
#define SMEAR_H

#include <stddef.h>
#include <stdint.h>

#include "smear_config.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SMEAR_VERSION_MAJOR 0
#define SMEAR_VERSION_MINOR 2
#define SMEAR_VERSION_PATCH 0

/* What a function returns. Each field that may be wrong has a number of its own, SMEAR_ERR_FIELD or less:
 * smear_error_text puts it in words, smear_error_kind makes SMEAR_ERR_ARG of it. */
typedef enum smear_result {
    SMEAR_OK         =  0,
    SMEAR_ERR_ARG    = -1,      /* a required argument is missing, or a value is outside its stated range */
    SMEAR_ERR_MEMORY = -2,      /* fewer than smear_memory_size() bytes, or not 8-byte aligned */
    SMEAR_ERR_ORDER  = -3,      /* a call out of turn: submit before begin, render twice, begin from within flush */
    SMEAR_ERR_FULL   = -4,      /* more draws in a frame than desc.max_draws; this one is not drawn */
    SMEAR_ERR_ROOM   = -5,      /* SMEAR_TIMEMASK: the moving triangles of a tile do not find room at once: more
                                 * max_triangles, or another method, which draws them in parts */
    SMEAR_ERR_FIELD  = -100     /* and below: SMEAR_ERR_ARG, with the field that is wrong */
} smear_result;

static inline int smear_error_kind(int result)
{
    return result <= SMEAR_ERR_FIELD ? (int)SMEAR_ERR_ARG : result;
}

/* Returns a sentence without a full stop, as "desc.width: not 1 to 2048 pixels"; never null. Where SMEAR_WITH_DEBUG
 * is 0 it is short and does not name the field. */
const char *smear_error_text(int result);

/* ------------------------------------------------------------------ geometry */

/* world = basis x object + origin. A basis may scale, shear and mirror (a negative determinant flips the winding).
 * Entries beyond +-127 do not fit: put large factors into the mesh's scale. */
typedef struct smear_transform {
    int32_t basis[9];           /* Q8.24, row by row */
    int32_t origin[3];          /* Q16.16, world units */
} smear_transform;

#define SMEAR_BASIS_ONE (1 << 24)
#define SMEAR_IDENTITY \
    { { SMEAR_BASIS_ONE, 0, 0, 0, SMEAR_BASIS_ONE, 0, 0, 0, SMEAR_BASIS_ONE }, { 0, 0, 0 } }

/* Vertices and triangles, all constant data that may stay in flash. Object coordinates are
 * (position + offset) x scale / 2^shift world units. */
typedef struct smear_mesh {
    const int16_t *position;    /* x y z of each vertex; required */
    const int8_t  *normal;      /* x y z of each vertex, 127 is one; null: flat, from the triangle */
    const int16_t *uv;          /* u v of each vertex, in 1/2^uv_shift of the texture; null: none */
    const uint8_t *color;       /* r g b a of each vertex, r g b sRGB-encoded; null: white */
    const uint8_t *face_color;  /* r g b a of each triangle, likewise, times color; null: white */
    const uint16_t *index;      /* three vertices per triangle, counter-clockwise seen from the front; required */
    uint32_t triangle_count;
    uint16_t vertex_count;      /* indices are below it; triangles with others are left out, and counted as dropped */
    int8_t   shift;             /* -32..62 */
    uint8_t  uv_shift;          /* 0..15; 0 means 15 */
    int32_t  scale;             /* > 0; 0 means 1 */
    int32_t  offset[3];         /* in vertex steps, +-2^20 */
    int16_t  bounds[6];         /* least x y z and most of all positions: draws whose bounds lie beyond a side of the
                                 * view cost next to nothing; where positions differ from pose to pose they count for
                                 * nothing. All 0: not known. smear_mesh_find_bounds */
} smear_mesh;

typedef enum smear_texel_format {
    SMEAR_TEXEL_8888,           /* uint32_t 0xAARRGGBB, sRGB-encoded, straight alpha */
    SMEAR_TEXEL_565,            /* uint16_t, red on top; opaque */
    SMEAR_TEXEL_PALETTE8        /* uint8_t into palette[256] of 0xAARRGGBB */
} smear_texel_format;

typedef enum smear_wrap { SMEAR_REPEAT, SMEAR_CLAMP, SMEAR_MIRROR } smear_wrap;

/* Row 0 is v = 0. SMEAR_TEXEL_565 is fastest where SMEAR_NONE draws RGB565 without dither in a context that
 * has no other method: with textures of that format alone and nothing blended, triangles are drawn as the display's
 * pixels, and converted never. Powers of two are fastest; any size from 1 to 4096 works. |u| x width and
 * |v| x height must stay below 32768 texels, but for repeated powers of two, which may go on for ever. */
typedef struct smear_texture {
    const void *texels;         /* width x height, no padding, aligned to a texel */
    const uint32_t *palette;    /* for SMEAR_TEXEL_PALETTE8 */
    uint16_t width, height;
    uint8_t format;             /* smear_texel_format */
    uint8_t wrap_u, wrap_v;     /* smear_wrap */
    uint8_t levels;             /* smaller pictures that follow in `texels`, each half as wide and half as high as that before
                                 * it (1 at least), down to 1 x 1 at most; `smear convert --mipmaps` makes them. Each triangle
                                 * shows that whose texels are as large as its pixels, or the next larger picture: less
                                 * shimmer, and fewer cache misses. Sizes are powers of two. Only where texels are nearest and
                                 * repeat both ways; what moves under SMEAR_TIMEMASK shows the largest. 0: none */
} smear_texture;

typedef enum smear_alpha {
    SMEAR_OPAQUE,
    SMEAR_CUTOUT,               /* drawn where alpha >= cutoff; the rest keeps
                                 * what lies behind, velocity too */
    SMEAR_BLEND                 /* drawn over everything opaque in submission order; tests depth, writes neither
                                 * depth nor velocity. Filters, SMEAR_OBJECT and SMEAR_LAYERED draw it sharp after
                                 * the blur; the other methods blur it */
} smear_alpha;

/* color x vertex color x texel; color alpha 0 means "white, opaque". */
typedef struct smear_material {
    const smear_texture *texture;
    uint8_t color[4];           /* r g b a, r g b sRGB-encoded */
    uint8_t alpha;              /* smear_alpha */
    uint8_t cutoff;             /* 1..255 of SMEAR_CUTOUT; 0 means 128 */
    uint8_t unlit;              /* 1: no light */
    uint8_t double_sided;       /* 1: back faces are drawn with flipped normals */
    uint8_t bilinear;           /* 1: bilinear texels; 0: nearest */
} smear_material;

/* `pose` takes camera space to world space and must be a rotation and an origin: the lengths and right angles of its axes
 * may be 1/64 off, all else is refused. */
typedef struct smear_camera {
    smear_transform pose;
    int32_t focal;              /* Q16.16 > 0: 1 / tan(vertical field of view / 2); perspective */
    int32_t half_height;        /* Q16.16 world units: > 0 makes the camera orthographic, focal is ignored */
    int32_t near_plane;         /* Q16.16 > 0 */
    int32_t far_plane;          /* Q16.16 > near_plane; 0: none (perspective only) */
} smear_camera;

/* ------------------------------------------------------------------ drawing */

typedef enum smear_motion {
    SMEAR_MOTION_FULL,          /* object and camera */
    SMEAR_MOTION_CAMERA,        /* as if the object stood still */
    SMEAR_MOTION_NONE           /* zero velocity, also over what moves behind it */
} smear_motion;

/* How a draw turns with the camera: with that of now, and in each other pose with that of the pose. */
typedef enum smear_billboard {
    SMEAR_BILLBOARD_NONE,
    SMEAR_BILLBOARD_FACING,     /* its basis is relative to the camera's */
    SMEAR_BILLBOARD_UPRIGHT     /* as FACING, but turned about the world's y only */
} smear_billboard;

/* How poses of frames ago are joined, and where that goes on until the shutter closes. Of what turns, the fraction of the
 * turn is exact at every moment; only scales and what deforms change evenly. */
typedef enum smear_path {
    SMEAR_PATH_DEFAULT,         /* of a draw: the frame's. Of a frame: CURVE */
    SMEAR_PATH_CURVE,           /* through three poses where that two frames ago is known: a turn about the point that
                                 * explains all three, be it the own origin (a wheel), another one (a blade beside its
                                 * pivot) or one far away (a bend of the road). With two poses, or where the third says
                                 * nothing (a rebound, a jump): ORIGIN */
    SMEAR_PATH_LINE,            /* every vertex goes straight from pose to pose. Cheapest */
    SMEAR_PATH_ORIGIN,          /* turns about its own origin, which goes straight */
    SMEAR_PATH_SCREW            /* turns about the one axis that leads from pose to pose, and moves along it */
} smear_path;

/* One mesh in one place. Transforms are copied by smear_submit; what else is pointed to is read until smear_render
 * returns.
 *
 * Where it was: with smear_frame.shutter.poses, `open` and `close` are its poses at shutter open and close,
 * and `now` is that in the middle between them, whatever the exposure is. Otherwise `open` is its pose one
 * frame ago and `close` that two frames ago, which only tells along which curve it moves (smear_path); where `open` is
 * null, the library takes both from what it kept under `id`. A draw whose earlier pose is unknown
 * (first sight, cut, first frame, id 0) has no motion of its own. */
typedef struct smear_draw {
    uint32_t id;                /* identity from frame to frame, unique in a frame; 0: nothing is kept */
    const smear_mesh *mesh;
    const smear_material *material;     /* null: white, lit */
    const smear_transform *now;         /* null: identity */
    const smear_transform *open, *close;
    const int16_t *open_position;       /* deformed meshes: positions at those poses, in the mesh's scale */
    const int16_t *close_position;      /* and offset; null: mesh->position. Nothing is kept of positions. */
    uint8_t motion;             /* smear_motion */
    uint8_t cut;                /* 1: teleported: no motion of its own in this frame */
    uint8_t billboard;          /* smear_billboard */
    uint8_t path;               /* smear_path */
    uint16_t open_count, close_count;   /* vertices in open_position, close_position; 0: as many as the
                                         * mesh has. With another number nothing is known of the
                                         * deformation: the motion is rigid */
    uint8_t layers;             /* bits: the layers it is in, see smear_layer; 0 means 1, the first */
} smear_draw;

/* How a frame is blurred. desc.methods says for which of them there is room. */
typedef enum smear_method {
    SMEAR_DEFAULT_METHOD,       /* SMEAR_AUTO where desc.methods has it, else the first of those it has */
    SMEAR_NONE,                 /* the sharp instant; always there */
    SMEAR_ACCUMULATE,           /* mean of `samples` sharp instants of the whole frame */
    SMEAR_RECONSTRUCT,          /* tile-maximum reconstruction filter */
    SMEAR_SUBFRAMES,            /* tiles in which something moves: mean of instants, one per half pixel of travel, at
                                 * most `samples` */
    SMEAR_TIMEMASK,             /* the time each moving triangle covers each pixel, in `samples` time samples (8, 16
                                 * or 32) */
    SMEAR_AUTO,                 /* per tile as many instants as `target` asks for, and along their paths what lies
                                 * between them */
    SMEAR_CAMERA,               /* `filter.kind` along the camera's motion alone, told from depth: nothing is done per
                                 * vertex */
    SMEAR_PINGPONG,             /* few taps, two or three times over: see smear_pingpong */
    SMEAR_HALF,                 /* `filter.kind` at half the size, over the whole frame by amount of motion */
    SMEAR_OBJECT,               /* each moving object along its one displacement, over the static scene, by sums whose
                                 * cost does not grow with its length; those without one displacement as in
                                 * SMEAR_LAYERED */
    SMEAR_LAYERED,              /* each blurred layer by velocities of its pixels, over the static scene */
    SMEAR_METHOD_COUNT
} smear_method;

/* Sets of methods, for desc.methods: SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT). */
#define SMEAR_SET(method) (1u << (method))
#define SMEAR_SET_TEMPORAL (SMEAR_SET(SMEAR_SUBFRAMES) | SMEAR_SET(SMEAR_TIMEMASK) | SMEAR_SET(SMEAR_AUTO))
#define SMEAR_SET_LAYERS (SMEAR_SET(SMEAR_OBJECT) | SMEAR_SET(SMEAR_LAYERED))
#define SMEAR_SET_FILTERS \
    (SMEAR_SET(SMEAR_RECONSTRUCT) | SMEAR_SET(SMEAR_CAMERA) | SMEAR_SET(SMEAR_PINGPONG) | SMEAR_SET(SMEAR_HALF))
/* What 0 means: SMEAR_AUTO, or what there is without SMEAR_WITH_SUBFRAMES. */
#define SMEAR_SET_DEFAULT \
    (SMEAR_WITH_SUBFRAMES ? SMEAR_SET(SMEAR_AUTO) : SMEAR_WITH_RECONSTRUCT ? SMEAR_SET(SMEAR_RECONSTRUCT) : SMEAR_SET(SMEAR_NONE))
/* Stands for SMEAR_ACCUMULATE with 12 bytes per pixel of a band, not of the frame: rows are assembled anew at every
 * instant. Small and slow. */
#define SMEAR_SET_ACCUMULATE_BANDS (1u << 15)

/* Methods that look at several instants of what moves. */
static inline uint8_t smear_method_is_temporal(int method)
{
    return method >= SMEAR_SUBFRAMES && method <= SMEAR_AUTO;
}

/* Methods that filter a window of rows by the velocities of pixels: they have a reach. */
static inline uint8_t smear_method_is_filter(int method)
{
    return method == SMEAR_RECONSTRUCT || (method >= SMEAR_CAMERA && method <= SMEAR_HALF);
}

/* Methods that blur layers and merge them over the static scene: they have a reach, too. */
static inline uint8_t smear_method_has_layers(int method)
{
    return method == SMEAR_OBJECT || method == SMEAR_LAYERED;
}

/* What blurs within SMEAR_CAMERA and SMEAR_HALF. */
typedef enum smear_filter_kind {
    SMEAR_FILTER_DEFAULT,       /* MEAN in SMEAR_CAMERA, RECONSTRUCT in SMEAR_HALF */
    SMEAR_FILTER_MEAN,          /* `samples` taps along each pixel's own velocity, all
                                 * alike, of tiles that motion reaches */
    SMEAR_FILTER_RECONSTRUCT,   /* as SMEAR_RECONSTRUCT, with its options */
    SMEAR_FILTER_PINGPONG       /* as SMEAR_PINGPONG, which desc.methods must have */
} smear_filter_kind;

/* A blur in passes: each takes few taps of what the one before it left, `base` times
 * closer, so that 8 and 8 taps weigh like 64. */
typedef struct smear_pingpong {
    uint8_t passes;             /* 1..3, not above desc.filter.passes; 0 means 2. One is a direct blur */
    uint8_t taps;               /* of a pass, 2..64; 0 means 8 */
    uint8_t base;               /* 2..64; 0 means `taps`: all positions weigh alike. The comb
                                 * of the original: 7 taps, base 4 */
    uint8_t jitter;             /* how far taps are moved from pixel to pixel, in 1/128
                                 * of their spacing to either side */
    uint8_t bias;               /* a tap nearer than its pixel by more than so many 1/256 of the distance is
                                 * left out. 255: none is. 0 means 255, with `spread` 16 */
    uint8_t spread;             /* 1: moving things spread over what is static: tile maxima tell
                                 * a pixel what may come over it */
} smear_pingpong;

/* Error aimed at by SMEAR_AUTO: RMS against the truth, in 1/64 of an 8-bit code. */
enum { SMEAR_DRAFT = 256, SMEAR_BALANCED = 96, SMEAR_FINE = 32 };

/* Points of a shutter's openness over the exposure. */
#define SMEAR_SHUTTER_POINTS 33

/* How the exposure follows the time from frame to frame, smear_shutter.frame_us. */
typedef enum smear_shutter_mode {
    SMEAR_SHUTTER_NATIVE,       /* `degrees` of the frame time */
    SMEAR_SHUTTER_CAPPED,       /* as NATIVE, but never more than at reference_hz: frames
                                 * that come late do not smear more */
    SMEAR_SHUTTER_FIXED         /* `degrees` at reference_hz, whatever the frame time
                                 * is: streaks keep their length */
} smear_shutter_mode;

/* A scale of motion that is nothing. */
#define SMEAR_SCALE_NONE 65535u

typedef enum smear_exposure { SMEAR_CENTRED, SMEAR_TRAILING, SMEAR_LEADING } smear_exposure;

/* What working values mean: linear light (products, interpolation and the mean over time are light, encoded once at
 * output), or sRGB codes throughout, which is a little cheaper. */
typedef enum smear_light_space { SMEAR_LIGHT_LINEAR, SMEAR_LIGHT_ENCODED } smear_light_space;

/* Departures of SMEAR_RECONSTRUCT from the Post Processing Stack v2 filter, or-ed together. */
enum {
    SMEAR_FENCE     = 1,    /* a static pixel takes nothing from behind: keeps the edges of static foreground */
    SMEAR_CORNER    = 2,    /* a diagonal neighbour counts only if its motion points here */
    SMEAR_BOX       = 4,    /* box shutter instead of the tent */
    SMEAR_DIRECTION = 8,    /* second direction as in Guertin 2014 */
    SMEAR_UNIFORM   = 16    /* where all motion in reach is alike or changes without a step: plain mean along
                             * the pixel's own velocity; motion below a pixel stays as it is */
};

/* Whose weights SMEAR_RECONSTRUCT gives to what it gathers. FENCE, BOX
 * and DIRECTION are departures of the first. */
typedef enum smear_weights {
    SMEAR_WEIGHTS_STACK,        /* Post Processing Stack v2 */
    SMEAR_WEIGHTS_MCGUIRE,      /* McGuire, Hennessy, Bukowski, Osman 2012 */
    SMEAR_WEIGHTS_GUERTIN,      /* Guertin, McGuire, Nowrouzezahrai 2014 */
    SMEAR_WEIGHTS_JIMENEZ       /* Jimenez 2014: the weights are an alpha, hidden sides are mirrored */
} smear_weights;

/* A set of draws that is blurred on its own and merged over what is static, for SMEAR_OBJECT
 * and SMEAR_LAYERED. A draw is in the first of the frame's layers whose mask shares a bit
 * with smear_draw.layers; in none, it is as SMEAR_NONE draws it, bit for bit where no
 * streak passes over it. So is what does not move. */
typedef struct smear_layer {
    uint8_t mask;               /* bits of smear_draw.layers; required */
    uint8_t method;             /* SMEAR_OBJECT, SMEAR_LAYERED, or SMEAR_NONE: sharp; 0: the frame's */
    uint8_t over;               /* 1: over all before it in the frame's list and all that is
                                 * static, whatever the depths are */
    uint8_t two_camera;         /* 1: SMEAR_OBJECT as two cameras do it: what moves along one
                                 * velocity, that of the layer's first draw, in `samples` taps (up
                                 * to 64), over all that is static */
    uint16_t shutter_degrees;   /* 1..3600; 0: the frame's */
    const smear_camera *camera; /* its own: a cockpit, a weapon, a display in the view;
                                 * implies `over`. Null: the frame's */
    const smear_camera *open, *close;   /* as in smear_frame; null: `camera` does not move */
} smear_layer;

enum { SMEAR_LAYERS_MAX = 8 };

/* One directional light and what comes from everywhere, in linear light: 65535 is one. A lit surface shows
 * base x (ambient + diffuse x max(0, n.l)), not above one. */
typedef struct smear_light {
    int32_t direction[3];       /* towards the light, in world space; any length but zero */
    uint16_t ambient[3];        /* r g b */
    uint16_t diffuse[3];
} smear_light;

/* What smear_frame.light is when it is null: from (0.36, 0.80, 0.48), ambient 0.30, diffuse 0.70, white. */
#define SMEAR_LIGHT_DEFAULT { { 5898, 13107, 7864 }, { 19661, 19661, 19661 }, { 45875, 45875, 45875 } }

/* Fog that grows evenly with the distance along the view. What lies beyond its far plane is all fog: it is cut off as by a
 * camera's far plane, which costs nothing per pixel and saves triangles. The background is fog, too: frame.clear does not
 * count. Colours are mixed in the frame's light space, each surface's before it is blended over others. Distances are those
 * of frame.camera; points of an overlay have no fog. */
typedef struct smear_fog {
    uint32_t color;             /* 0xRRGGBB, sRGB-encoded */
    int32_t near_plane;         /* Q16.16 world units from the eye, where it begins: 0 or more */
    int32_t far_plane;          /* where all is fog: more than near_plane by at least a 256th of itself, and beyond the
                                 * camera's near_plane */
} smear_fog;

/* When the shutter is open. */
typedef struct smear_shutter {
    uint16_t degrees;           /* 1..3600 of the frame time; 0 means 180 */
    uint8_t exposure;           /* smear_exposure */
    uint8_t poses;              /* 1: open/close are the poses at shutter open and close, not one frame ago, and the
                                 * present ones those in the middle of the exposure */
    uint8_t mode;               /* smear_shutter_mode. With `poses` the application's poses say it all */
    uint8_t path;               /* smear_path of cameras, and of draws that do not say; with `poses` it is of no use */
    uint16_t reference_hz;      /* 1..1000; 0 means 30 */
    uint32_t frame_us;          /* microseconds since the pose a frame ago, up to 1000000; needed by `us` and by modes
                                 * other than native */
    uint32_t us;                /* exposure in microseconds, in place of `degrees`; 0: by those. CAPPED: at most a
                                 * frame */
    const uint8_t *curve;       /* openness at SMEAR_SHUTTER_POINTS even steps from open to close, not all 0; null: a
                                 * box. Copied. Filters take it for a box */
} smear_shutter;

/* What methods that filter do, and SMEAR_LAYERED as far as it says so. */
typedef struct smear_filter {
    uint8_t kind;               /* smear_filter_kind, of SMEAR_CAMERA and SMEAR_HALF */
    uint8_t flags;              /* SMEAR_FENCE | ...; 0: none */
    uint8_t weights;            /* smear_weights, of SMEAR_RECONSTRUCT and where it is the kind */
    uint8_t camera_step;        /* 1, 2 or 4: draws that do not move themselves get their velocity from depth and the
                                 * two cameras, at each pixel or each 2 x 2 or 4 x 4; the background too. 0: from their
                                 * vertices, the background none (SMEAR_CAMERA: as 1) */
    smear_pingpong pingpong;
} smear_filter;

/* How much of what moved is shown as motion, in 1/256; 0 means 256, SMEAR_SCALE_NONE nothing. */
typedef struct smear_motion_scale {
    uint16_t rotation;          /* of the camera's rotation and zoom, up to 16128 */
    uint16_t translation;       /* of the camera's translation, likewise */
    uint16_t object;            /* of draws and their deformation (which grows 8 times at most) */
} smear_motion_scale;

/* How edges look whose pixels lie partly on one side of them and partly on the other. */
typedef enum smear_edges {
    SMEAR_EDGES_HARD,           /* a pixel shows what lies under its centre */
    SMEAR_EDGES_SMOOTH          /* SMEAR_AUTO, SMEAR_SUBFRAMES: what moves is drawn at another place within the pixel at each
                                 * instant, and edges of what stands still mix what lies on both sides of them. What is
                                 * blended and stands still keeps hard edges, and so do holes of cutouts. Sharp frames:
                                 * SMEAR_AUTO with `cut`. With desc.reuse.buffer_age only beside cache_static */
} smear_edges;

typedef struct smear_overlay smear_overlay;

typedef struct smear_frame {
    const smear_camera *camera;         /* now; required */
    const smear_camera *open, *close;   /* as in smear_draw; null: the cameras kept from the last frames
                                         * (if they are of the same kind; else nothing has camera motion) */
    uint8_t method;             /* smear_method */
    uint8_t light_space;        /* smear_light_space */
    uint8_t cut;                /* 1: camera cut: nothing has motion in this frame */
    uint8_t refresh;            /* with desc.reuse: 1: vertices, colours or texels that static draws point to have
                                 * changed in place since the last frame, or the display has lost what it was sent */
    uint16_t samples;           /* 1..1024: taps, instants or time samples; 0 means 8, or 32 for SMEAR_SUBFRAMES and
                                 * _TIMEMASK. Without SMEAR_WITH_LINEAR at most 256 instants */
    uint16_t target;            /* SMEAR_AUTO: error aimed at in 1/64 codes; 0 means SMEAR_BALANCED, for SMEAR_L4 and
                                 * 1-bit formats SMEAR_DRAFT: rounding to steps of 17 codes alone errs by 5 */
    uint32_t budget;            /* SMEAR_AUTO: how much of what moves may be drawn, pixels x instants: of `target` and
                                 * coarser errors the first that needs no more, SMEAR_DRAFT in any case. Reckoned from
                                 * areas and travels of triangles before a pixel is drawn (smear_stats.work), so the
                                 * same frame has the same picture; 0: no bound */
    uint32_t clear;             /* 0xRRGGBB, sRGB-encoded */
    const smear_light *light;   /* copied; null: SMEAR_LIGHT_DEFAULT */
    const smear_fog *fog;       /* copied; null: none */
    smear_shutter shutter;
    smear_filter filter;
    smear_motion_scale scale;
    const smear_layer *layer;   /* up to SMEAR_LAYERS_MAX, copied with their cameras; null: one layer of all that
                                 * moves */
    uint8_t layer_count;
    uint8_t edges;              /* smear_edges */
    const smear_overlay *overlay;       /* text and sprites over the frame, points in the world:
                                         * smear_overlay.h. Null: none */
} smear_frame;

/* ------------------------------------------------------------------ output */

typedef enum smear_format {
    SMEAR_XRGB8888,             /* uint32_t 0x00RRGGBB in the machine's byte order */
    SMEAR_RGB565,               /* uint16_t, red on top, low byte first */
    SMEAR_RGB565_SWAPPED,       /* high byte first, as most SPI panels want it */
    SMEAR_RGB555,               /* uint16_t 0 rrrrr ggggg bbbbb with BLUE on top
                                 * (Game Boy Advance), low byte first */
    SMEAR_RGB332,
    SMEAR_L8,
    SMEAR_L4,                   /* two pixels per byte, left one in the high nibble */
    SMEAR_L1,                   /* eight pixels per byte along x, left one in bit 7, 1 is lit */
    SMEAR_L1_PAGES              /* OLED pages: a byte is a column of 8 pixels, top one in bit 0 */
} smear_format;

typedef enum smear_dither {
    SMEAR_DITHER_ORDERED,
    SMEAR_DITHER_NONE,
    SMEAR_DITHER_BLUE,
    SMEAR_DITHER_DIFFUSE        /* SMEAR_L4, SMEAR_L1 and SMEAR_L1_PAGES: what rounding leaves over goes to the pixels on the
                                 * right and below. 1-bit formats: code c becomes (c - 32) 4/3, and edges are kept. Not with
                                 * reuse.buffer_age, as a change shows in all that comes after it. A byte per pixel of a
                                 * band, and 3 per pixel of a row */
} smear_dither;

typedef enum smear_doubled { SMEAR_DOUBLED_NONE, SMEAR_DOUBLED_X, SMEAR_DOUBLED_Y, SMEAR_DOUBLED_XY } smear_doubled;

/* How finished pixels become the display's. */
typedef struct smear_display {
    uint8_t dither;             /* smear_dither; XRGB8888 and L8 are never dithered */
    uint8_t doubled;            /* smear_doubled: each pixel becomes two beside each other, above each other, or four: the
                                 * display is twice as wide, as high, or both. A band takes so many times the bytes */
} smear_display;

/* Finished pixels of columns x .. x + width - 1 and rows y .. y + height - 1 of the display: whole rows of it, x = 0,
 * but for a desc with `reuse.buffer_age`. With desc.display.doubled they count as often as the display has them. */
typedef struct smear_band {
    const void *pixels;         /* valid until flush returns or, with two bands, until smear_band_done() */
    int16_t x, y, width, height;
    uint32_t stride;            /* bytes from row to row (from page to page for SMEAR_L1_PAGES) */
    uint32_t size;              /* bytes in all */
} smear_band;

/* Returns 0, or a negative value that ends the frame and is returned by smear_render; with two bands,
 * a refused band needs no smear_band_done(). */
typedef int smear_flush_fn(void *user, const smear_band *band);

/* Shows a drawn row before the blur to tests and tools. depth: codes, see smear_depth_units().
 * velocity: x y of each pixel in 1/256 px per frame, before any clamp or packing. */
typedef void smear_inspect_fn(void *user, int y, const uint32_t *color, const uint16_t *depth,
                              const int32_t *velocity);

/* What is kept from frame to frame. Pictures may be so for SMEAR_AUTO, SMEAR_SUBFRAMES and SMEAR_TIMEMASK, and are the
 * same; frames of other methods are drawn and sent whole. Where SMEAR_SET(SMEAR_NONE) is in desc.methods, alone or beside those, and
 * cache_static is not, buffer_age is for sharp frames, too: each draw is compared with that of the last one at the same place in
 * their order, so those that stand still come first; a mesh without bounds that moves damages all tiles. 16 bytes for each of
 * max_draws. See smear_frame.refresh. */
typedef struct smear_reuse {
    uint8_t cache_static;       /* 1: what does not move is kept from frame to frame, and drawn again only where
                                 * camera, background or a static draw is another: 6 bytes per pixel of the whole frame
                                 * (with a window as many as that takes) */
    uint8_t buffer_age;         /* 1..7: the display keeps what it is sent, and the buffer that is drawn into shows the
                                 * frame so many frames ago: 1 for a panel with memory of its own, 2 where pages flip.
                                 * Then only damaged tiles are drawn and sent: bands of tiles beside each other, from
                                 * left to right and top to bottom, as many as it takes, or none. 0: all are */
    uint8_t one_pose;           /* 1: of ids and of the camera only the pose a frame ago is kept, not that before it: 52
                                 * bytes less for each of max_draws, 64 for the camera. SMEAR_PATH_CURVE then has two
                                 * poses */
} smear_reuse;

/* Room beyond the usual for methods that filter. */
typedef struct smear_filter_room {
    uint8_t passes;             /* 2 or 3: passes of SMEAR_PINGPONG: 4 bytes per pixel of the window for each but the
                                 * last; 0 means 2 where desc.methods has SMEAR_PINGPONG. One may be had with any
                                 * window */
    uint8_t scatter;            /* 1: the reach may exceed the tile: motion of a tile is told to all tiles on its way,
                                 * and as many tile rows more are kept. Not with temporal methods, SMEAR_PINGPONG or
                                 * SMEAR_HALF */
} smear_filter_room;

/* For tests, tools and tuning. */
typedef struct smear_debug {
    uint8_t crc;                /* 1: statistics give the CRC of each frame; 0: no time is spent on it */
    smear_inspect_fn *inspect;  /* null: none; with a window; costs 8 bytes per pixel of it */
    uint32_t (*clock)(void *user);      /* null: no times in the statistics */
} smear_debug;

/* The first seventeen values, to filter.scatter but without reuse.one_pose, are what SMEAR_MEMORY and SMEAR_DESC of
 * smear_memory.h take; reuse.one_pose is the eighteenth, display.dither and .doubled come last. */
typedef struct smear_desc {
    int16_t width, height;      /* pixels, 1..2048; required */
    uint32_t max_triangles;     /* drawn triangles (in view, facing the camera, after clipping) there is memory for; more
                                 * are drawn in parts; at most 2^24; 0 means 1024 */
    uint16_t max_draws;         /* draws per frame, and ids kept from frame to frame; 0 means 16 */
    uint16_t methods;           /* SMEAR_SET(...) of all that frames will ask for; 0 means SMEAR_SET_DEFAULT,
                                 * SMEAR_AUTO alone */
    int16_t tile;               /* 8, 16, 32 or 64, not below a reach (but with scatter); 0 means the smallest
                                 * such; where nothing has a reach, the smallest not below a twentieth of the width,
                                 * 32 at most. Also 4 with SMEAR_NONE, SMEAR_ACCUMULATE and filters
                                 * but SMEAR_HALF and scatter: the least memory, a little slower */
    int16_t reach;              /* longest blur radius of a filter or layer in pixels, 1..64; 0 means 5 % of the height,
                                 * 64 at most. Ignored where no method has a reach */
    int16_t strip;              /* temporal methods: width in pixels of what is drawn at once at each instant, 1 to 64
                                 * tiles; 0 means 8 tiles, but 128 pixels at most and one tile at least. Wider is
                                 * faster, up to a point, and takes 22 bytes per pixel for each worker. The picture depends on it, a
                                 * little */
    int16_t band_rows;          /* rows flushed at once, 2 or more (a multiple of 8 for SMEAR_L1_PAGES). 0 means tile, but
                                 * on 64-bit machines with tile 0 and SMEAR_NONE and SMEAR_ACCUMULATE alone a quarter of
                                 * the height in whole tiles, 64 at most: with these two as many rows are drawn at once.
                                 * With a window and without temporal methods, layers and SMEAR_HALF it may divide the
                                 * tile: a smaller band buffer, the same picture */
    uint8_t bands;              /* 1 or 2 band buffers; 0 means 1. With 2, drawing goes on while one is sent */
    uint8_t format;             /* smear_format */
    uint8_t workers;            /* 1..8 cores that assemble draws and run tile jobs; 0 means 1 */
    uint16_t vertex_cache;      /* transformed vertices remembered, a power of two 16..4096; 0 means 64 */
    smear_reuse reuse;
    smear_filter_room filter;
    smear_display display;
    smear_flush_fn *flush;      /* required */
    void (*idle)(void *user);   /* null: spin. Called while waiting for a band to be sent or for a worker */
    void *user;                 /* handed to the callbacks */
    smear_debug debug;
} smear_desc;

/* How full a list was, at most, and how much finds room in it. */
typedef struct smear_fill {
    uint32_t used, room;
} smear_fill;

typedef struct smear_stats {
    /* submitted; covering a pixel; left out for a bad index. In a frame drawn in parts the second counts a triangle once
     * per part, and the third may. */
    uint32_t triangles_in, triangles_drawn, triangles_dropped;
    uint32_t parts_added;               /* times a list was full: a part of the frame was halved, or a tile row's
                                         * triangles were gone through in turns */
    uint32_t draws_moved;               /* whose velocity came from their vertices: they moved, deformed, or
                                         * (but with camera_step) the camera did */
    uint32_t draws_beside;              /* left out, as their bounds lie beyond a side of the view; of a frame drawn
                                         * in parts, once per part at most */
    uint32_t pixels;                    /* of the frame */
    uint32_t samples;                   /* filter taps taken, or instants drawn x pixels */
    uint32_t tiles[SMEAR_METHOD_COUNT]; /* by the method each tile got: SMEAR_NONE where nothing moves; SMEAR_AUTO's
                                         * tiles count as SMEAR_SUBFRAMES; layers count where they reach into a
                                         * tile */
    uint32_t tiles_static, tiles_uniform, tiles_complex;        /* by the kind of motion in them */
    uint32_t tiles_kept;                /* neither drawn nor sent: the display has them (desc.reuse.buffer_age) */
    uint8_t static_cached;              /* 1: what is static was not drawn, and is not among triangles_drawn */
    uint32_t target;                    /* SMEAR_AUTO: smear_frame.target, or what the budget allowed; of a frame
                                         * drawn in parts, each of which has its share, the coarsest */
    uint32_t work;                      /* with a budget: areas of moving triangles x instants, saturated */
    uint32_t crc32;                     /* of the bytes of all bands in their order, as in zlib (XRGB8888: R, G,
                                         * B); 0 without desc.debug.crc */
    uint32_t arena_bytes;               /* memory in use */
    struct {                            /* ticks of desc.debug.clock */
        uint32_t submit, raster, reduce, blur, convert, total;
    } time;
    struct {                            /* triangles and vertices in bytes; draws of one layout of vertices; draws */
        smear_fill geometry, segments, draws;
    } fill;
} smear_stats;

typedef struct smear_context smear_context;

/* Which call a context takes when, and what it is then. "Drawing" is what callbacks see: flush, idle, inspect and clock are called
 * from within smear_render and smear_filter_row.
 *
 *                          idle            begun           filtering       drawing
 *     smear_begin          begun           begun           begun           SMEAR_ERR_ORDER
 *     smear_submit         ..._ORDER       begun           ..._ORDER       ..._ORDER
 *     smear_render         ..._ORDER       idle            ..._ORDER       ..._ORDER
 *     smear_filter_begin   filtering       filtering       filtering       ..._ORDER
 *     smear_filter_row     ..._ORDER       ..._ORDER       filtering; idle after the last row or an error      ..._ORDER
 *     smear_get_stats, smear_band_done     always; of a frame that is being drawn, statistics are not complete
 *     smear_work           always, by other cores; never from a callback, whose frame it would wait for
 *
 * A call that returns an error, whatever it is, changes nothing but what its comment says: a frame that was begun stays so, with
 * all that was submitted, and its picture is as if the call had not been made. One core at a time makes the first five. */

/* Bytes smear_init needs for this desc, whose callbacks do not matter; 0 when the desc is not valid. SMEAR_MEMORY of
 * smear_memory.h is the same as a constant for static arrays. */
size_t smear_memory_size(const smear_desc *desc);

/* Finds mesh->bounds: once, where a mesh is made that brings none. Goes through all positions. */
void smear_mesh_find_bounds(smear_mesh *mesh);

/* Cuts `memory` (8-byte aligned, at least smear_memory_size(desc) bytes) into what the context needs. The
 * context lives in it and holds nothing else: forgetting the memory frees it. desc is copied. SMEAR_ERR_ARG,
 * SMEAR_ERR_MEMORY, or the number of the desc's field that is not valid or asks for what smear_config.h left out. */
int smear_init(smear_context **ctx, const smear_desc *desc, void *memory, size_t bytes);

/* Starts a frame. `frame` and the cameras are copied. A frame begun before is not rendered,
 * but its poses count as the past of this one. SMEAR_ERR_ARG, SMEAR_ERR_ORDER (from a callback), or the number of the field that is
 * not valid: then the frame begun before goes on. */
int smear_begin(smear_context *ctx, const smear_frame *frame);

/* Adds a draw. The struct and its transforms are copied; mesh, material and positions are read until smear_render
 * returns. SMEAR_ERR_ARG, the number of the field that is not valid (an id that was submitted in this frame already,
 * too), SMEAR_ERR_ORDER (no frame has been begun) or SMEAR_ERR_FULL: the frame goes on without it. */
int smear_submit(smear_context *ctx, const smear_draw *draw);

/* Draws the frame and hands it to flush, band after band, top to bottom. Time grows with triangles and
 * pixels. A full triangle list is no error: the frame is drawn in parts (stats.parts_added counts them), down to a tile row
 * whose triangles are assembled again and again, a few at a time: the same picture, whatever it costs. What is not in a part
 * is passed over where neighbours follow each other in their mesh. Only time masks need all of a tile's at once. Returns
 * SMEAR_OK, what flush returned if negative, SMEAR_ERR_ROOM, or SMEAR_ERR_ORDER (no frame has been begun). */
int smear_render(smear_context *ctx);

/* With desc.bands == 2: a band handed to flush has been sent; may be called from an interrupt or another
 * core. Bands finish in the order in which they were handed out. */
void smear_band_done(smear_context *ctx);

/* With desc.workers > 1: the other cores call this, each with its own index 1..workers-1, once per frame, or in
 * a loop for ever: it waits for core 0 to enter smear_render, and returns when the frame is done. smear_render
 * waits for all of them. */
void smear_work(smear_context *ctx, int worker);

/* Copies the statistics of the last frame that was rendered. */
void smear_get_stats(const smear_context *ctx, smear_stats *stats);

/* ------------------------------------------------------------------ the filter alone */

/* Blurs a frame that another renderer drew: begin, then every row from top to bottom, each
 * once. Finished bands come through flush as the window moves. Uses the context's desc (width,
 * height, reach, tile, format; one worker) and of `frame` the method (a filter, but not SMEAR_CAMERA) with its
 * options, light, exposure, samples and shutter; camera needs only near_plane. Errors are those of smear_begin and
 * smear_render; one of flush ends the frame.
 *
 *   color     width pixels 0x00RRGGBB, sRGB-encoded
 *   depth     width distances along the view in Q16.16 units, 0 for background
 *   velocity  x y of each pixel in 1/16 px per frame, x right, y down */
int smear_filter_begin(smear_context *ctx, const smear_frame *frame);
int smear_filter_row(smear_context *ctx, const uint32_t *color, const uint32_t *depth,
                     const int16_t *velocity);

/* ------------------------------------------------------------------ depth codes */

/* 16-bit depth grows towards the eye in two slopes: 0 is the background, 65535 the near plane. A perspective
 * distance is near_plane x SMEAR_DEPTH_NEAR / units; relative step at most 1/2048 for distances up to 256
 * near planes, 1/557 at 1000. Orthographic: far - (far - near) x units / SMEAR_DEPTH_NEAR. */
#define SMEAR_DEPTH_NEAR 557040u

static inline uint32_t smear_depth_units(uint16_t code)
{
    return code < 32768u ? code : 32768u + (uint32_t)(code - 32768u) * 16u;
}

#ifdef __cplusplus
}
#endif

#endif
