/* SPDX-License-Identifier: MIT */
/* smear_config.h - what is decided when the library is compiled. Each choice can be given with -D, or a
 * whole set with -DSMEAR_CONFIG_FILE='"my_config.h"'. No choice changes a pixel of what is there: it leaves code out. */
#ifndef SMEAR_CONFIG_H
#define SMEAR_CONFIG_H

#ifdef SMEAR_CONFIG_FILE
#include SMEAR_CONFIG_FILE
#endif

/* 1: every fixed-point operation that must not overflow is checked, and a broken promise stops the
 * program (SMEAR_ASSERT). 0: no checks, no cost. `make CHECK=1` sets it. */
#ifndef SMEAR_CHECK
#define SMEAR_CHECK 0
#endif

/* What is compiled in: 1, or 0 to leave it out. `make footprint` prints what each saves. A context refuses
 * what was left out; SMEAR_AUTO takes what is there, and zero means what is there: without SMEAR_WITH_SUBFRAMES desc.methods means
 * SMEAR_RECONSTRUCT, without that SMEAR_NONE; without _LINEAR light is encoded, without _CURVES paths are lines, without _DITHER
 * nothing is dithered. Only the format must be named where _RGB is 0, as it says how flush reads its bytes.
 * -DSMEAR_WITH_ALL=0 leaves out everything that is not named. Link with --gc-sections, or the library as an archive. */
#ifndef SMEAR_WITH_ALL
#define SMEAR_WITH_ALL 1
#endif

/* Methods. SMEAR_NONE is always there. */
#ifndef SMEAR_WITH_ACCUMULATE
#define SMEAR_WITH_ACCUMULATE SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_RECONSTRUCT          /* the filter, velocities; without it there is no window */
#define SMEAR_WITH_RECONSTRUCT SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_FILTERS              /* SMEAR_CAMERA, SMEAR_PINGPONG, SMEAR_HALF, other
                                         * weights, camera_step, scatter */
#define SMEAR_WITH_FILTERS (SMEAR_WITH_ALL && SMEAR_WITH_RECONSTRUCT)
#endif
#ifndef SMEAR_WITH_LAYERS               /* SMEAR_OBJECT, SMEAR_LAYERED */
#define SMEAR_WITH_LAYERS (SMEAR_WITH_ALL && SMEAR_WITH_RECONSTRUCT)
#endif
#ifndef SMEAR_WITH_SUBFRAMES            /* without it there is nothing that looks at
                                         * several instants: no temporal methods */
#define SMEAR_WITH_SUBFRAMES SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_LINES                /* SMEAR_SET_SKETCH: targets beyond SMEAR_DRAFT */
#define SMEAR_WITH_LINES (SMEAR_WITH_ALL && SMEAR_WITH_SUBFRAMES)
#endif
#ifndef SMEAR_WITH_TIMEMASK             /* needs SMEAR_WITH_SUBFRAMES, which draws what it cannot */
#define SMEAR_WITH_TIMEMASK (SMEAR_WITH_ALL && SMEAR_WITH_SUBFRAMES)
#endif
#ifndef SMEAR_WITH_DAMAGE               /* desc.reuse */
#define SMEAR_WITH_DAMAGE (SMEAR_WITH_ALL && SMEAR_WITH_SUBFRAMES)
#endif

/* Surfaces. */
#ifndef SMEAR_WITH_TEXTURE
#define SMEAR_WITH_TEXTURE SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_GOURAUD              /* colours and normals of vertices; else those of faces only */
#define SMEAR_WITH_GOURAUD SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_ALPHA                /* cutouts and blended draws */
#define SMEAR_WITH_ALPHA SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_DEFORM               /* draws whose positions differ from pose to pose */
#define SMEAR_WITH_DEFORM SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_LINEAR               /* linear light, and its tables of 4.6 kB */
#define SMEAR_WITH_LINEAR SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_VIEWS                /* cameras without perspective, draws that turn with the camera */
#define SMEAR_WITH_VIEWS SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_FOG                  /* frame.fog, frame.edges */
#define SMEAR_WITH_FOG SMEAR_WITH_ALL
#endif

/* What a frame and a context may have. */
#ifndef SMEAR_WITH_SCALES               /* frame.scale; frame.shutter.us, .mode: shutters
                                         * at another rate than the frames' */
#define SMEAR_WITH_SCALES SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_BOUNDS               /* smear_mesh.bounds; smear_texture.levels: without it
                                         * textures show their largest picture */
#define SMEAR_WITH_BOUNDS SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_CURVES               /* paths that are no lines: SMEAR_PATH_CURVE, _ORIGIN, _SCREW */
#define SMEAR_WITH_CURVES (SMEAR_WITH_ALL && (SMEAR_WITH_ACCUMULATE || SMEAR_WITH_RECONSTRUCT || SMEAR_WITH_SUBFRAMES))
#endif
#ifndef SMEAR_WITH_WORKERS              /* desc.workers > 1 */
#define SMEAR_WITH_WORKERS SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_OVERLAY              /* smear_overlay.h: boxes, sprites, text, points */
#define SMEAR_WITH_OVERLAY SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_SKY                  /* smear_scene.h: its sky */
#define SMEAR_WITH_SKY SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_LIGHTS               /* its lights beside frame.light */
#define SMEAR_WITH_LIGHTS SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_DEBUG                /* what smear_error_text says; desc.debug.inspect, which
                                         * tests and tools look at */
#define SMEAR_WITH_DEBUG SMEAR_WITH_ALL
#endif

/* Output. Formats that are never dithered do not need SMEAR_WITH_DITHER; the others, without it, have
 * neither SMEAR_DITHER_ORDERED nor SMEAR_DITHER_BLUE. */
#ifndef SMEAR_WITH_RGB565               /* in both byte orders */
#define SMEAR_WITH_RGB565 SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_RGB                  /* other colours: SMEAR_XRGB8888, SMEAR_RGB555, SMEAR_RGB332 */
#define SMEAR_WITH_RGB SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_GREY                 /* SMEAR_L8, SMEAR_L4, and SMEAR_L1 in both packings */
#define SMEAR_WITH_GREY SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_DITHER               /* ordered */
#define SMEAR_WITH_DITHER SMEAR_WITH_ALL
#endif
#ifndef SMEAR_WITH_DISPLAY              /* desc.display.doubled; SMEAR_DITHER_DIFFUSE where there are greys,
                                         * SMEAR_DITHER_BLUE where there is dither */
#define SMEAR_WITH_DISPLAY SMEAR_WITH_ALL
#endif

/* The module of smear_model.h. */
#ifndef SMEAR_WITH_MODEL
#define SMEAR_WITH_MODEL SMEAR_WITH_ALL
#endif

#if SMEAR_WITH_TIMEMASK && !SMEAR_WITH_SUBFRAMES
#error "SMEAR_WITH_TIMEMASK needs SMEAR_WITH_SUBFRAMES"
#endif
#if SMEAR_WITH_LINES && !SMEAR_WITH_SUBFRAMES
#error "SMEAR_WITH_LINES needs SMEAR_WITH_SUBFRAMES"
#endif
#if SMEAR_WITH_DAMAGE && !SMEAR_WITH_SUBFRAMES
#error "SMEAR_WITH_DAMAGE needs SMEAR_WITH_SUBFRAMES"
#endif
#if (SMEAR_WITH_FILTERS || SMEAR_WITH_LAYERS) && !SMEAR_WITH_RECONSTRUCT
#error "SMEAR_WITH_FILTERS and _LAYERS need SMEAR_WITH_RECONSTRUCT, whose velocities they read"
#endif

/* Called with SMEAR_STAGE_ASSEMBLE before draws become lists of triangles, with SMEAR_STAGE_DRAW before
 * these are drawn: where little memory is fast, the code that comes next may be brought there. */
#define SMEAR_STAGE_ASSEMBLE 0
#define SMEAR_STAGE_DRAW 1
#ifndef SMEAR_ENTER_STAGE
#define SMEAR_ENTER_STAGE(stage) ((void)0)
#endif

/* Called by smear_init for parts of its memory, with the desc, the part, its address (or null, while memory is only measured)
 * and its bytes; returns where it shall lie, at a multiple of 8. A port whose memories differ in speed returns an address
 * in a fast one. Colour, depth, instants and bands of 16 bits per pixel and more are written by 16 and 32 bits, by memcpy and
 * by memset. */
#define SMEAR_PART_CONTEXT 0            /* the context itself */
#define SMEAR_PART_COLOR 1              /* of the rows that are drawn: 32 bits per pixel */
#define SMEAR_PART_DEPTH 2              /* of these: 16 bits */
#define SMEAR_PART_INSTANTS 3           /* of a strip, one at a time, and finished pixels: 32 bits */
#define SMEAR_PART_SUMS 4               /* of a strip's instants, with a depth and a list */
#define SMEAR_PART_BAND 5               /* rows in the display's format */
#define SMEAR_PART_SEGMENTS 6           /* what triangles of one draw share */
#define SMEAR_PART_TRIANGLES 7          /* these, and vertices */
#define SMEAR_PART_DRAWS 8              /* as they were submitted */
#define SMEAR_PART_LINES 9              /* of sketches, rows behind lines: 32 bits per pixel, then 16 */
#ifndef SMEAR_PLACE
#define SMEAR_PLACE(desc, part, address, bytes) (address)
#endif

/* 1 where the stack lies in faster memory than the arena, and 2 kB more of it are there: what the loop over
 * triangles needs at every turn is kept on the stack meanwhile, the vertex cache with it. */
#ifndef SMEAR_FAST_STACK
#define SMEAR_FAST_STACK 0
#endif

/* 1 when the core multiplies 32 x 32 to 64 bits in an instruction. 0 builds high products from 16-bit
 * halves instead of calling the compiler's 64-bit multiply; the bits are the same. */
#ifndef SMEAR_HAS_MUL64
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__) || (defined(__thumb__) && !defined(__thumb2__))
#define SMEAR_HAS_MUL64 0
#else
#define SMEAR_HAS_MUL64 1
#endif
#endif

/* 1 when the core counts leading zeros in an instruction. */
#ifndef SMEAR_HAS_CLZ
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__) || defined(__ARM_ARCH_4T__)
#define SMEAR_HAS_CLZ 0
#else
#define SMEAR_HAS_CLZ 1
#endif
#endif

/* 1 when the core divides in an instruction. 0 takes reciprocals where two quotients have one
 * divisor; the bits are the same. */
#ifndef SMEAR_HAS_DIVIDE
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_4T__)
#define SMEAR_HAS_DIVIDE 0
#else
#define SMEAR_HAS_DIVIDE 1
#endif
#endif

#endif
