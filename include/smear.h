/* SPDX-License-Identifier: MIT */
/* smear.h - motion-blurred 3D for machines without a GPU: all that most programs need.
 *
 * You give it meshes, a transform for each and a camera, once per frame. It remembers where everything was in the frame
 * before, draws triangles in fixed point through a few rows of memory, blurs what moved, and hands finished bands of
 * display pixels to your callback, top to bottom. It has no malloc, no files, no floating point, no global state, no
 * full-frame buffer, no scene graph and no clock.
 *
 *     static uint64_t memory[SMEAR_MEMORY(240, 240, 600, 8)];     // pixels, triangles and draws of a frame
 *     smear_desc desc = { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8, .flush = flush };
 *     result = smear_init(&ctx, &desc, memory, sizeof memory);
 *     for (; result == SMEAR_OK; result = smear_render(ctx)) {    // calls flush, band after band
 *         smear_begin(ctx, &frame);                               // with the camera
 *         smear_submit(ctx, &draw);                               // for each draw: its id, mesh and transform
 *     }
 *     puts(smear_error_text(result));
 *
 * README.md has a whole program. Numbers: Q16.16 is an int32_t holding value x 65536; a basis is Q8.24. smear_math.h
 * makes both from constants and has rotations, look-at and the like. The world is right-handed, +Y up; a camera looks
 * along its own -Z; the screen's origin is top left, pixel centres lie at +0.5.
 *
 * Zero in a field means its default, which is the best picture in the least memory that is not slow: begin every struct
 * with `= {0}`. Functions return SMEAR_OK or a negative number, of which smear_error_text says what is wrong; a context
 * stays usable after any error. smear_methods.h has the methods that are there for comparison, with their fields. */
#ifndef SMEAR_H
#define SMEAR_H

#include <stddef.h>
#include <stdint.h>

#include "smear_config.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SMEAR_VERSION_MAJOR 0
#define SMEAR_VERSION_MINOR 3
#define SMEAR_VERSION_PATCH 0

/* What a function returns. Each field that may be wrong has a number of its own from SMEAR_ERR_FIELD down, each number
 * of bytes that smear_init lacks one from SMEAR_ERR_NEEDS down. */
typedef enum smear_result {
    SMEAR_OK         =  0,
    SMEAR_ERR_ARG    = -1,      /* a required argument is missing, or a value is outside its stated range */
    SMEAR_ERR_MEMORY = -2,      /* memory is missing, too little or not 8-byte aligned */
    SMEAR_ERR_ORDER  = -3,      /* a call out of turn: submit before begin, render twice, begin from within flush */
    SMEAR_ERR_FULL   = -4,      /* more draws in a frame than desc.max_draws; this one is not drawn */
    SMEAR_ERR_ROOM   = -5,      /* SMEAR_TIMEMASK: a tile's moving triangles do not fit into memory at once */
    SMEAR_ERR_FIELD  = -100,    /* and below: SMEAR_ERR_ARG, with the field that is wrong */
    SMEAR_ERR_NEEDS  = -1000    /* and below: SMEAR_ERR_MEMORY, minus the bytes that are enough */
} smear_result;

/* Returns SMEAR_ERR_ARG for the number of a field, SMEAR_ERR_MEMORY for one of bytes. */
static inline int smear_error_kind(int result)
{
    return result <= SMEAR_ERR_NEEDS ? (int)SMEAR_ERR_MEMORY : result <= SMEAR_ERR_FIELD ? (int)SMEAR_ERR_ARG : result;
}

/* Returns a sentence without a full stop, as "desc.width: not 1 to 2048 pixels"; never null. Where SMEAR_WITH_DEBUG is
 * 0 it is short and does not name the field. */
const char *smear_error_text(int result);

/* ------------------------------------------------------------------ what is drawn */

/* world = basis x object + origin. A basis may scale, shear and mirror (a negative determinant flips the winding).
 * Entries beyond +-127 do not fit: put large factors into the mesh's scale. */
typedef struct smear_transform {
    int32_t basis[9];           /* Q8.24, row by row */
    int32_t origin[3];          /* Q16.16, world units */
} smear_transform;

#define SMEAR_BASIS_ONE (1 << 24)
#define SMEAR_IDENTITY \
    { { SMEAR_BASIS_ONE, 0, 0, 0, SMEAR_BASIS_ONE, 0, 0, 0, SMEAR_BASIS_ONE }, { 0, 0, 0 } }

/* Vertices and triangles; all of it may stay in flash. Object coordinates are (position + offset) x scale / 2^shift. */
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
    int16_t  bounds[6];         /* least x y z and most of all positions: draws beyond a side of the view then cost next
                                 * to nothing. All 0: not known. smear_mesh_find_bounds */
} smear_mesh;

typedef enum smear_texel_format {
    SMEAR_TEXEL_8888,           /* uint32_t 0xAARRGGBB, sRGB-encoded, straight alpha */
    SMEAR_TEXEL_565,            /* uint16_t, red on top; opaque. Fastest for sharp frames of 16-bit displays */
    SMEAR_TEXEL_PALETTE8        /* uint8_t into palette[256] of 0xAARRGGBB */
} smear_texel_format;

typedef enum smear_wrap { SMEAR_REPEAT, SMEAR_CLAMP, SMEAR_MIRROR } smear_wrap;

/* Row 0 is v = 0. Powers of two are fastest; any size from 1 to 4096 works. |u| x width and |v| x height must stay
 * below 32768 texels, but for repeated powers of two, which may go on for ever. */
typedef struct smear_texture {
    const void *texels;         /* width x height, no padding, aligned to a texel */
    const uint32_t *palette;    /* for SMEAR_TEXEL_PALETTE8 */
    uint16_t width, height;
    uint8_t format;             /* smear_texel_format */
    uint8_t wrap_u, wrap_v;     /* smear_wrap */
    uint8_t levels;             /* mip levels that follow in `texels`, each half as wide and high, down to 1 x 1 at
                                 * most, as `smear convert --mipmaps` makes them. Each triangle shows one. Sizes are
                                 * powers of two; nearest texels that repeat both ways. 0: none */
} smear_texture;

typedef enum smear_alpha {
    SMEAR_OPAQUE, SMEAR_CUTOUT, /* the latter drawn where alpha >= cutoff; the rest keeps what lies behind, velocity too */
    SMEAR_BLEND,                /* drawn over everything opaque in submission order; tests depth, writes none */
    SMEAR_SHADOW                /* likewise, but over each pixel once, and over what is as far away: smear_scene.h */
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
    uint8_t gloss, shine;       /* of highlights: smear_scene.h */
} smear_material;

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

/* How poses of frames ago are joined, and where that goes on until the shutter closes. Of what turns, the fraction of
 * the turn is exact at every moment; only scales and what deforms change evenly. */
typedef enum smear_path {
    SMEAR_PATH_DEFAULT,         /* of a draw: the frame's. Of a frame: CURVE */
    SMEAR_PATH_CURVE,           /* through three poses where that two frames ago is known: a turn about the point that
                                 * explains all three (a wheel, a blade beside its pivot, a bend of the road). With two
                                 * poses, or where the third says nothing (a rebound, a jump): ORIGIN */
    SMEAR_PATH_LINE,            /* every vertex goes straight from pose to pose. Cheapest */
    SMEAR_PATH_ORIGIN,          /* turns about its own origin, which goes straight */
    SMEAR_PATH_SCREW            /* turns about the one axis that leads from pose to pose, and moves along it */
} smear_path;

/* One mesh in one place. Transforms are copied by smear_submit; what else is pointed to is read until smear_render
 * returns. Where it was is found by its id; or `open` says where it was a frame ago and `close` two frames ago, which
 * only tells along which curve it moves. With smear_frame.shutter.poses they are its poses at shutter open and close,
 * and `now` that in the middle. Unknown earlier poses (first sight, cut, id 0) mean no motion of its own. */
typedef struct smear_draw {
    uint32_t id;                /* identity from frame to frame, unique in a frame; 0: nothing is kept */
    const smear_mesh *mesh;
    const smear_material *material;     /* null: white, lit */
    const smear_transform *now;         /* null: identity */
    const smear_transform *open, *close;
    const int16_t *open_position;       /* deformed meshes: positions at those poses, in the mesh's scale */
    const int16_t *close_position;      /* and offset; null: mesh->position. Nothing is kept of positions */
    uint8_t motion;             /* smear_motion */
    uint8_t cut;                /* 1: teleported: no motion of its own in this frame */
    uint8_t billboard;          /* smear_billboard */
    uint8_t path;               /* smear_path */
    uint16_t open_count, close_count;   /* vertices in open_position, close_position; 0: as many as the mesh has. With
                                         * another number the deformation is unknown: the motion is rigid */
    uint8_t layers;             /* bits: the layers it is in, see smear_layer; 0 means 1, the first */
} smear_draw;

/* ------------------------------------------------------------------ how it is seen */

/* `pose` takes camera space to world space and must be a rotation and an origin: the lengths and right angles of its
 * axes may be 1/64 off, all else is refused. */
typedef struct smear_camera {
    smear_transform pose;
    int32_t focal;              /* Q16.16 > 0: 1 / tan(vertical field of view / 2); perspective */
    int32_t half_height;        /* Q16.16 world units: > 0 makes the camera orthographic, focal is ignored */
    int32_t near_plane;         /* Q16.16 > 0 */
    int32_t far_plane;          /* Q16.16 > near_plane; 0: none (perspective only) */
} smear_camera;

/* How a frame is blurred. desc.methods says for which of them there is room. */
typedef enum smear_method {
    SMEAR_DEFAULT_METHOD,       /* SMEAR_AUTO where desc.methods has it, else the first of those it has */
    SMEAR_NONE,                 /* the sharp instant; always there */
    SMEAR_ACCUMULATE, SMEAR_RECONSTRUCT,        /* smear_methods.h */
    SMEAR_SUBFRAMES,            /* where something moves, the mean of instants, one per half pixel of travel, at most
                                 * frame.samples */
    SMEAR_TIMEMASK,                             /* smear_methods.h */
    SMEAR_AUTO,                 /* per tile as many instants as frame.target asks for, and along their paths what lies
                                 * between them; of coarse targets, what stands still by SMEAR_SET_SKETCH */
    SMEAR_CAMERA, SMEAR_PINGPONG, SMEAR_HALF, SMEAR_OBJECT, SMEAR_LAYERED,      /* smear_methods.h */
    SMEAR_METHOD_COUNT
} smear_method;

/* Sets of methods, for desc.methods: SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_SUBFRAMES). */
#define SMEAR_SET(method) (1u << (method))

/* Error aimed at by SMEAR_AUTO: RMS against the truth, in 1/64 of an 8-bit code. Before a camera that moves, sketches and drafts take
 * the short way of SMEAR_SET_SKETCH, where desc.methods has it. */
enum { SMEAR_SKETCH = 512, SMEAR_DRAFT = 256, SMEAR_BALANCED = 96, SMEAR_FINE = 32 };

#include "smear_methods.h"

typedef enum smear_exposure { SMEAR_CENTRED, SMEAR_TRAILING, SMEAR_LEADING } smear_exposure;

/* How the exposure follows the time from frame to frame, smear_shutter.frame_us. */
typedef enum smear_shutter_mode {
    SMEAR_SHUTTER_NATIVE,       /* `degrees` of the frame time */
    SMEAR_SHUTTER_CAPPED,       /* as NATIVE, at most as at reference_hz: frames that come late do not smear more */
    SMEAR_SHUTTER_FIXED         /* `degrees` at reference_hz, whatever the frame time: streaks keep their length */
} smear_shutter_mode;

/* Points of a shutter's openness over the exposure. */
#define SMEAR_SHUTTER_POINTS 33

/* When the shutter is open. */
typedef struct smear_shutter {
    uint16_t degrees;           /* 1..3600 of the frame time; 0 means 180 */
    uint8_t exposure;           /* smear_exposure */
    uint8_t poses;              /* 1: open/close are the poses at shutter open and close, not one frame ago, and the
                                 * present ones those in the middle of the exposure */
    uint8_t mode;               /* smear_shutter_mode. With `poses` the application's poses say it all */
    uint8_t path;               /* smear_path of cameras, and of draws that do not say; with `poses` it is of no use */
    uint16_t reference_hz;      /* 1..1000; 0 means 30 */
    uint32_t frame_us;          /* microseconds since the pose a frame ago, up to 1000000; `us` and modes need it */
    uint32_t us;                /* exposure in microseconds; 0: by `degrees`. CAPPED: at most a frame */
    const uint8_t *curve;       /* openness at SMEAR_SHUTTER_POINTS even steps from open to close, not all 0; null: a
                                 * box. Copied. Filters take it for a box */
} smear_shutter;

/* How much of what moved is shown as motion, in 1/256; 0 means 256, SMEAR_SCALE_NONE nothing. */
typedef struct smear_motion_scale {
    uint16_t rotation;          /* of the camera's rotation and zoom, up to 16128 */
    uint16_t translation;       /* of the camera's translation, likewise */
    uint16_t object;            /* of draws and their deformation (which grows 8 times at most) */
} smear_motion_scale;

#define SMEAR_SCALE_NONE 65535u

/* What working values mean: linear light (products, interpolation and the mean over time are light, encoded once at
 * output), or sRGB codes throughout, which is a little cheaper. */
typedef enum smear_light_space { SMEAR_LIGHT_LINEAR, SMEAR_LIGHT_ENCODED } smear_light_space;

/* One directional light and what comes from everywhere, in linear light: 65535 is one. A lit surface shows base x
 * (ambient + diffuse x max(0, n.l)), not above one. */
typedef struct smear_light {
    int32_t direction[3];       /* towards the light, in world space; any length but zero */
    uint16_t ambient[3], diffuse[3];    /* r g b */
} smear_light;

/* What smear_frame.light is when it is null: from (0.36, 0.80, 0.48), ambient 0.30, diffuse 0.70, white. */
#define SMEAR_LIGHT_DEFAULT { { 5898, 13107, 7864 }, { 19661, 19661, 19661 }, { 45875, 45875, 45875 } }

/* Fog that grows evenly with the distance along the view. What lies beyond its far plane is all fog and is cut off; the
 * background is fog, too. Colours are mixed in the frame's light space, before they are blended. */
typedef struct smear_fog {
    uint32_t color;             /* 0xRRGGBB, sRGB-encoded */
    int32_t near_plane;         /* Q16.16 world units from the eye, where it begins: 0 or more */
    int32_t far_plane;          /* where all is fog: more than near_plane by at least a 256th of itself, and beyond the
                                 * camera's near_plane */
} smear_fog;

/* How edges look whose pixels lie partly on one side of them and partly on the other. SMOOTH needs SMEAR_AUTO or
 * SMEAR_SUBFRAMES: instants of what moves are drawn at other places within the pixel, and edges of what stands still
 * mix both sides, but for those of blended draws and holes of cutouts. With buffer_age only beside cache_static. */
typedef enum smear_edges { SMEAR_EDGES_HARD, SMEAR_EDGES_SMOOTH } smear_edges;

typedef struct smear_overlay smear_overlay;
typedef struct smear_scene smear_scene;

typedef struct smear_frame {
    const smear_camera *camera;         /* now; required */
    const smear_camera *open, *close;   /* as in smear_draw; null: the cameras kept from the last frames (if they are of
                                         * the same kind; else nothing has camera motion) */
    uint8_t method;             /* smear_method */
    uint8_t light_space;        /* smear_light_space */
    uint8_t cut;                /* 1: camera cut: nothing has motion in this frame */
    uint8_t refresh;            /* with desc.reuse: 1: vertices, colours or texels that static draws point to have
                                 * changed in place since the last frame, or the display has lost what it was sent */
    uint16_t samples;           /* 1..1024: instants (or taps, or time samples); 0 means 32 for SMEAR_SUBFRAMES and
                                 * SMEAR_TIMEMASK, else 8. Without SMEAR_WITH_LINEAR at most 256 instants */
    uint16_t target;            /* SMEAR_AUTO: error aimed at in 1/64 codes; 0 means SMEAR_BALANCED, for SMEAR_L4 and
                                 * 1-bit formats SMEAR_DRAFT: rounding to steps of 17 codes alone errs by 5. From
                                 * SMEAR_DRAFT on, SMEAR_SET_SKETCH in desc.methods makes it cheap */
    uint32_t budget;            /* SMEAR_AUTO: how much of what moves may be drawn, pixels x instants: of `target` and
                                 * coarser errors the first that needs no more, SMEAR_DRAFT in any case. Reckoned from
                                 * triangles before a pixel is drawn (smear_stats.work): no clock; 0: no bound */
    uint32_t clear;             /* 0xRRGGBB, sRGB-encoded */
    const smear_light *light;   /* copied; null: SMEAR_LIGHT_DEFAULT */
    const smear_fog *fog;       /* copied; null: none */
    smear_shutter shutter;
    smear_filter filter;        /* smear_methods.h */
    smear_motion_scale scale;
    const smear_layer *layer;   /* smear_methods.h */
    uint8_t layer_count;
    uint8_t edges;              /* smear_edges */
    const smear_overlay *overlay;       /* text and sprites over the frame, points in the world: smear_overlay.h */
    const smear_scene *scene;           /* a sky, more lights: smear_scene.h. Copied; null: none */
} smear_frame;

/* ------------------------------------------------------------------ where it is shown */

typedef enum smear_format {
    SMEAR_XRGB8888,             /* uint32_t 0x00RRGGBB in the machine's byte order */
    SMEAR_RGB565,               /* uint16_t, red on top, low byte first */
    SMEAR_RGB565_SWAPPED,       /* high byte first, as most SPI panels want it */
    SMEAR_RGB555,               /* uint16_t 0 bbbbb ggggg rrrrr (Game Boy Advance), low byte first */
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
    SMEAR_DITHER_DIFFUSE        /* SMEAR_L4, SMEAR_L1 and SMEAR_L1_PAGES: what rounding leaves over goes to the pixels
                                 * on the right and below; 1-bit formats keep edges. Not with reuse.buffer_age */
} smear_dither;

typedef enum smear_doubled { SMEAR_DOUBLED_NONE, SMEAR_DOUBLED_X, SMEAR_DOUBLED_Y, SMEAR_DOUBLED_XY } smear_doubled;

/* How finished pixels become the display's. */
typedef struct smear_display {
    uint8_t dither;             /* smear_dither; XRGB8888 and L8 are never dithered */
    uint8_t doubled;            /* smear_doubled: each pixel becomes two beside or above each other, or four: the
                                 * display is twice as wide, as high, or both */
} smear_display;

/* Finished pixels of columns x .. x + width - 1 and rows y .. y + height - 1 of the display: whole rows of it, x = 0,
 * but for a desc with `reuse.buffer_age`. With desc.display.doubled they count as often as the display has them. */
typedef struct smear_band {
    const void *pixels;         /* valid until flush returns or, with two bands, until smear_band_done() */
    int16_t x, y, width, height;
    uint32_t stride;            /* bytes from row to row (from page to page for SMEAR_L1_PAGES) */
    uint32_t size;              /* bytes in all */
} smear_band;

/* Returns 0, or a negative value that ends the frame and is returned by smear_render; with two bands, a refused band
 * needs no smear_band_done(). */
typedef int smear_flush_fn(void *user, const smear_band *band);

/* What is kept from frame to frame, for SMEAR_AUTO, SMEAR_SUBFRAMES and SMEAR_TIMEMASK: the same pictures. Where
 * desc.methods has SMEAR_NONE, alone or beside those, and cache_static is 0, buffer_age is for sharp frames, too: 16
 * bytes for each of max_draws, which are compared in their order, so those that stand still come first. */
typedef struct smear_reuse {
    uint8_t cache_static;       /* 1: what does not move is drawn again only where camera, background or a static draw
                                 * is another: 6 bytes per pixel of the whole frame */
    uint8_t buffer_age;         /* 1..7: the display keeps what it is sent, and the buffer that is drawn into shows the
                                 * frame so many frames ago: 1 for a panel with memory of its own, 2 where pages flip.
                                 * Only damaged tiles are drawn and sent, in bands of tiles beside each other. 0: all */
    uint8_t one_pose;           /* 1: of ids and the camera only the pose a frame ago is kept, not that before it: 52
                                 * bytes less for each of max_draws. SMEAR_PATH_CURVE then has two poses */
} smear_reuse;

#include "smear_stats.h"

typedef struct smear_desc {
    int16_t width, height;      /* pixels, 1..2048; required */
    uint32_t max_triangles;     /* drawn triangles (in view, facing the camera, after clipping) there is memory for;
                                 * more are drawn in parts; at most 2^24; 0 means 1024 */
    uint16_t max_draws;         /* draws per frame, and ids kept from frame to frame; 0 means 16 */
    uint16_t methods;           /* SMEAR_SET(...) of all that frames will ask for; 0 means SMEAR_SET_DEFAULT, SMEAR_AUTO
                                 * alone */
    int16_t tile;               /* 8, 16, 32 or 64, not below a reach; 0 means the smallest such or, without a reach,
                                 * the smallest not below a twentieth of the width, 32 at most; 4 without blur */
    int16_t reach;              /* smear_methods.h */
    int16_t strip;              /* pixels that are drawn at once at each instant, 1 to 64 tiles; 0 means 8 tiles, but
                                 * 128 pixels at most and one tile at least. Wider is faster, up to a point, and takes
                                 * 22 bytes per pixel for each worker. The picture depends on it, a little */
    int16_t band_rows;          /* rows flushed at once, 2 or more (a multiple of 8 for SMEAR_L1_PAGES). 0 means tile,
                                 * but with tile 0 and SMEAR_NONE alone on 64-bit machines a quarter of the height in
                                 * whole tiles, 64 at most. Another number than tile only without blur */
    uint8_t bands;              /* 1 or 2 band buffers; 0 means 1. With 2, drawing goes on while one is sent */
    uint8_t format;             /* smear_format */
    uint8_t workers;            /* 1..8 cores that assemble draws and run tile jobs; 0 means 1 */
    uint16_t vertex_cache;      /* transformed vertices remembered, a power of two 16..4096; 0 means 128 */
    smear_reuse reuse;
    smear_filter_room filter;   /* smear_methods.h */
    smear_display display;
    smear_flush_fn *flush;      /* required */
    void (*idle)(void *user);   /* null: spin. Called while waiting for a band to be sent or for a worker */
    void *user;                 /* handed to the callbacks */
    smear_debug debug;          /* smear_stats.h */
} smear_desc;

/* ------------------------------------------------------------------ functions */

typedef struct smear_context smear_context;

/* smear_begin, any number of smear_submit, smear_render, and so on; smear_begin may also start a begun frame anew. From
 * callbacks, which are called within smear_render and smear_filter_row, only smear_get_stats and smear_band_done. A
 * call that returns an error changes nothing but what its comment says. One core at a time makes these calls. */

/* Bytes smear_init needs for this desc, whose callbacks do not matter; 0 when the desc is not valid. */
size_t smear_memory_size(const smear_desc *desc);

/* Finds mesh->bounds: once, where a mesh is made that brings none. Goes through all positions. */
void smear_mesh_find_bounds(smear_mesh *mesh);

/* Cuts `memory`, 8-byte aligned, into what the context needs. SMEAR_MEMORY words are enough for a desc that says no
 * more than width, height, max_triangles, max_draws, format and callbacks; for too little the result is minus the bytes
 * it takes (smear_memory_needed). The context lives there and holds nothing else: forgetting the memory frees it. desc
 * is copied. Else it returns SMEAR_ERR_ARG or the number of the desc's field that is not valid or was left out. */
int smear_init(smear_context **ctx, const smear_desc *desc, void *memory, size_t bytes);

/* Starts a frame. `frame` and the cameras are copied. A frame begun before is not rendered, but its poses count as the
 * past of this one. SMEAR_ERR_ARG, SMEAR_ERR_ORDER (from a callback), or the number of the field that is not valid:
 * then the frame begun before goes on. */
int smear_begin(smear_context *ctx, const smear_frame *frame);

/* Adds a draw. The struct and its transforms are copied; mesh, material and positions are read until smear_render
 * returns. SMEAR_ERR_ARG, the number of the field that is not valid (an id that was submitted in this frame already,
 * too), SMEAR_ERR_ORDER (no frame has been begun) or SMEAR_ERR_FULL: the frame goes on without it. */
int smear_submit(smear_context *ctx, const smear_draw *draw);

/* Draws the frame and hands it to flush, band after band, top to bottom. A full triangle list is no error: the frame is
 * drawn in parts (stats.parts_added counts them), down to a tile row whose triangles are assembled a few at a time: the
 * same picture, slower. Returns SMEAR_OK, what flush returned if negative, SMEAR_ERR_ROOM, or SMEAR_ERR_ORDER. */
int smear_render(smear_context *ctx);

/* With desc.bands == 2: a band handed to flush has been sent; may be called from an interrupt or another core. Bands
 * finish in the order in which they were handed out. */
void smear_band_done(smear_context *ctx);

/* With desc.workers > 1: the other cores call this, each with its own index 1..workers-1, once per frame, or in a loop
 * for ever: it waits for core 0 to enter smear_render, and returns when the frame is done. smear_render waits for all
 * of them. Never from a callback. */
void smear_work(smear_context *ctx, int worker);

#ifdef __cplusplus
}
#endif

#include "smear_memory.h"

#endif
