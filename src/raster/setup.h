/* SPDX-License-Identifier: MIT */
/* setup.h - a triangle made ready for its rows: planes of depth, colour, texture and velocity.
 *
 * Attributes are planes over the screen, a + x dx + y dy in 32-bit wrapping arithmetic: exact modulo 2^32
 * wherever one starts, so the picture does not depend on how the frame is cut into columns and bands. */
#ifndef SMEAR_SETUP_H
#define SMEAR_SETUP_H

#include "raster/target.h"

#include "base/fixmath.h"
#include "base/tables.h"
#include "kernels/kernels.h"

struct plane {
    int32_t at;             /* at the centre of pixel (0, 0) of the frame, modulo 2^32 */
    int32_t dx, dy;
};

static inline int32_t plane_at(const struct plane *p, int32_t x, int32_t y)
{
    return add_wrap(p->at, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
}

/* Nothing but opaque triangles of one colour was compiled in. */
#define ALWAYS_FLAT (!SMEAR_WITH_TEXTURE && !SMEAR_WITH_GOURAUD && !SMEAR_WITH_ALPHA && !SMEAR_WITH_FOG)

/* What a plane's slopes are at most. */
#define PLANE_STEEP (1 << 28)

/* How a triangle's texture coordinates follow from planes. */
enum texture_mode {
    TEXTURE_AFFINE,         /* they are planes */
    TEXTURE_CURVED,         /* they are polynomials of second degree */
    TEXTURE_DIVIDED         /* the quotients of planes, by reciprocal */
};

/* Coordinates are counted in turns (a turn is the texture's width or height; in 32 bits what wraps is what
 * repeats) or, where textures do not repeat by their bits, in texels q16. Where they are no polynomials they
 * are exact at the ends of blocks of pixels, and run along a chord or a parabola between. */
struct texture_setup {
    enum texture_mode mode;
    bool turns;
    bool parabolic;              /* parabolas; else chords */
    uint8_t block;          /* pixels: 1, 4, 8, 16, 32 or 64 */
    uint8_t up;             /* turns: shift; texels: 0 */
    int8_t shift;           /* what planes yield is turns in 2^(32 - shift) */
    uint8_t spare;          /* divided: they are of units 2^spare times as fine as the mesh's */
    struct plane q;         /* divided: q */
    struct plane uv[2];     /* affine: coordinates. Divided: mesh units over w */
    int32_t slope;          /* divided: how q changes per pixel, times 2^7 */
    int32_t x0, y0;         /* curved: the pixel from which polynomials count, near v[0] */
    struct curve curve[2];  /* u and v: turns q32 (those of v in steps of CURVE_STEP), or mesh units q14 */
};

/* What u carries into v, and borrows, when both are stepped together: a turn's 2^-32 each. */
enum { CURVE_STEP = 16, CURVE_TURNS = 6 };

enum {
    TEXTURE_OFF = 2,            /* 1/64 texel: what a coordinate may be off between
                                 * the ends of a block, or affine */
    PARABOLA_OFF = 4,           /* likewise between the ends of a block that follows a parabola */
    CURVED_OFF = 17             /* E^2 texels / 4 where it is a polynomial: off by
                                 * 0.46 texel in the farthest corner */
};

struct setup;
struct span_rows;

/* Draws rows of a triangle at once, velocities included (span.h). */
typedef void smear_rows_fn(const struct setup *s, const struct span_rows *r);

/* What is still to be done about a triangle's fog. */
enum {
    FOG_NONE,
    FOG_EVEN,               /* and above: one part of it throughout, see fog_even_part */
    FOG_VARIES = 0x8000     /* and the pixels that may have one part where vertices have no colours, or FOG_LEVEL */
};

/* A row has one part of fog, however long it is. */
enum { FOG_LEVEL = 255 };

struct setup {
    const struct smear_raster_frame *frame;
    const struct smear_raster_target *target;
    const struct smear_segment *segment;
    const struct smear_raster_draw *draw;
    const int32_t *v[3];            /* records, clockwise on the screen */
    struct bounds bounds;
    int32_t x1, y1, x2, y2;         /* edge vectors from v[0], q8 */
    bool writes_velocity;
    bool velocity_unknown;          /* with 0 poses: depth will tell it */

    /* From here on it may be kept from row to row, so much of it as a triangle has (kept.h). */
    struct plane depth;             /* units q11 */
    uint32_t color;                 /* 0xAARRGGBB: flat */
    enum depth_slope slope;
    uint8_t color_block;            /* pixels in a block of perspective colours: 4, 8 or 16 */
    bool even_color;                /* channels are the same everywhere */
    bool perspective_color;         /* channel planes are value / w: value >> 8 times q >> 16 */
    bool flat;                      /* one colour, opaque: `color` */
    uint16_t fog;                   /* FOG_NONE ... */
    uint8_t level;                  /* of the texture: 0 is the largest */
    uint8_t poses;                  /* velocity: 0 writes zero or nothing, 1 or 2 poses */
    bool has_velocity;              /* its planes are made */
    bool velocity_affine;

    smear_rows_fn *rows;            /* what draws its rows at once, or null: smear_cover_choose */
    struct texture_setup texture;
    struct plane channel[4];        /* SHADE_GOURAUD: r g b a, codes (or
                                     * linear >> 8) in q16, see channel_value */
    uint32_t area_recip;            /* 1 / (twice the area), which is positive: 2^61 / normalised area */
    int area_zeros;                 /* area << zeros is normalised to 64 bits */
    struct plane displacement[2];           /* along x and y; affine: q18 px */
    struct plane place[2][2], ratio[2];     /* else: numerators and denominator per pose */
};

/* Pixels [left, right) of rows [top, bottom). */
struct pixel_box {
    int32_t left, right, top, bottom;
};

/* How a depth code in 16.16 steps. */
static inline int32_t step_from_units(int32_t units, enum depth_slope slope)
{
    return shl_wrap(units, slope == SLOPE_FAR ? 5 : 1);
}

/* Channel c (r g b a) of a vertex with SHADE_GOURAUD, as it is interpolated: q16. */
static inline int32_t channel_value(const struct setup *s, int vertex, int c)
{
    uint32_t word = (uint32_t)s->v[vertex][s->segment->color + (c >> 1)];
    return channel_of_vertex(c & 1 ? word >> 16 : word & 0xffffu, c < 3 ? frame_transfer(s->frame) : TRANSFER_CODES);
}

/* A code as channel_value has it. */
static inline int32_t channel_value_of_code(const struct smear_raster_frame *frame, uint32_t code)
{
    return channel_of_vertex(channel_of_code(code, frame_transfer(frame)) >> 8, frame_transfer(frame));
}

static inline int fog_of(const struct setup *s)
{
    return SMEAR_WITH_FOG ? s->fog : FOG_NONE;
}

static inline bool fog_varies(const struct setup *s) { return fog_of(s) >= FOG_VARIES; }
static inline bool fog_is_even(const struct setup *s) { return fog_of(s) >= FOG_EVEN && !fog_varies(s); }

/* Whether more than one opaque colour is drawn, but for fog. */
static inline bool setup_has_looks(const struct setup *s)
{
    return segment_textured(s->segment) || segment_gouraud(s->segment) || !draw_is_opaque(s->draw);
}

/* Whether colours without a texture change from pixel to pixel: those of vertices, or fog. */
static inline bool setup_is_shaded(const struct setup *s)
{
    return segment_gouraud(s->segment) || fog_of(s) != FOG_NONE;
}

static inline int32_t setup_mesh_u(const struct setup *s, int i)
{
    return (int16_t)(s->v[i][s->segment->uv] & 0xffff);
}

static inline int32_t setup_mesh_v(const struct setup *s, int i)
{
    return s->v[i][s->segment->uv] >> 16;
}

static inline bool setup_writes_velocity(const struct setup *s)
{
    return SMEAR_WITH_RECONSTRUCT && s->writes_velocity;
}

/* floor(a q / 2^15), a of 16 bits. */
static inline int32_t times_q15(int32_t a, int32_t q) { return a * (q >> 15) + (a * (q & 0x7fff) >> 15); }

/* a b / c for c > 0, by reciprocal; clamped. Good to 2^-18: for bounds. */
uint32_t smear_times_over(uint32_t a, uint32_t b, uint32_t c);

/* A plane through three values; values and their differences fit 32 bits. */
void smear_plane_make(const struct setup *s, struct plane *p, int32_t a0, int32_t a1, int32_t a2);

/* Finds the edge vectors. Returns twice the area, q16. */
static inline uint64_t setup_edges(struct setup *s)
{
    s->x1 = s->v[1][VERTEX_X] - s->v[0][VERTEX_X];
    s->y1 = s->v[1][VERTEX_Y] - s->v[0][VERTEX_Y];
    s->x2 = s->v[2][VERTEX_X] - s->v[0][VERTEX_X];
    s->y2 = s->v[2][VERTEX_Y] - s->v[0][VERTEX_Y];
    return (uint64_t)edges_area(s->x1, s->y1, s->x2, s->y2);
}

/* Makes gradients and planes of a triangle whose edges are known, but for its velocity. */
void smear_setup(struct setup *s, uint64_t area);

/* Finds the level of a texture that has some: so many times smaller that there is still a texel for each pixel. Of the whole
 * triangle, so that it is the same in every tile row and band. Then smear_setup_shrink. */
void smear_setup_level(struct setup *s, uint64_t area, struct smear_raster_draw *smaller);

/* Where the level is not the largest the draw becomes `smaller`, a copy with that level of the texture. */
void smear_setup_shrink(struct setup *s, struct smear_raster_draw *smaller);

/* Makes the planes of its velocity: velocity.c. */
void smear_setup_velocity(struct setup *s);

#endif
