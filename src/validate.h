/* SPDX-License-Identifier: MIT */
/* validate.h - whether what the application asks for is valid, and its defaults. */
#ifndef SMEAR_VALIDATE_H
#define SMEAR_VALIDATE_H

#include "smear.h"

#include "base/base.h"

/* X(name, text): in the order of their numbers, which go down from SMEAR_ERR_FIELD - 1. Texts name the field first. */
#define SMEAR_FAULTS(X) \
    X(DESC_WIDTH, "desc.width: not 1 to 2048") \
    X(DESC_HEIGHT, "desc.height: not 1 to 2048") \
    X(DESC_TRIANGLES, "desc.max_triangles: above 2^24") \
    X(DESC_DRAWS, "desc.max_draws: out of range") \
    X(DESC_METHODS, "desc.methods: unknown here") \
    X(DESC_TILE, "desc.tile: not 8 to 64 (some methods: 4), a power of two, or below reach") \
    X(DESC_REACH, "desc.reach: not 1 to 64") \
    X(DESC_STRIP, "desc.strip: not 1 to 64 tiles") \
    X(DESC_BAND_ROWS, "desc.band_rows: below 2, or not what pages or tiles take") \
    X(DESC_BANDS, "desc.bands: above 2") \
    X(DESC_FORMAT, "desc.format: unknown here") \
    X(DESC_WORKERS, "desc.workers: above 8, or above 1 here") \
    X(DESC_VERTEX_CACHE, "desc.vertex_cache: not 16 to 4096, a power of two") \
    X(DESC_CACHE_STATIC, "desc.reuse.cache_static: above 1, or no method can") \
    X(DESC_BUFFER_AGE, "desc.reuse.buffer_age: above 7, or no method can") \
    X(DESC_ONE_POSE, "desc.reuse.one_pose: above 1") \
    X(DESC_PASSES, "desc.filter.passes: above 3, or no method can") \
    X(DESC_SCATTER, "desc.filter.scatter: above 1, or not with these methods") \
    X(DESC_DITHER, "desc.display.dither: unknown here, or not with this format or reuse.buffer_age") \
    X(DESC_DOUBLED, "desc.display.doubled: above 3, or not compiled in") \
    X(DESC_FLUSH, "desc.flush: missing") \
    X(DESC_INSPECT, "desc.debug.inspect: not compiled in") \
    X(FRAME_CAMERA, "frame.camera: missing, no rotation, or a length out of range") \
    X(FRAME_OPEN, "frame.open: as frame.camera") \
    X(FRAME_CLOSE, "frame.close: as frame.camera") \
    X(FRAME_METHOD, "frame.method: unknown, or not in desc.methods") \
    X(FRAME_LIGHT_SPACE, "frame.light_space: unknown here") \
    X(FRAME_SAMPLES, "frame.samples: above 1024, or what the method takes") \
    X(FRAME_LIGHT, "frame.light: no direction") \
    X(FRAME_FOG, "frame.fog: planes out of order or too near each other, or not compiled in") \
    X(FRAME_DEGREES, "frame.shutter.degrees: above 3600") \
    X(FRAME_EXPOSURE, "frame.shutter.exposure: unknown") \
    X(FRAME_MODE, "frame.shutter.mode: unknown here") \
    X(FRAME_PATH, "frame.shutter.path: unknown here") \
    X(FRAME_REFERENCE, "frame.shutter.reference_hz: above 1000") \
    X(FRAME_TIME, "frame.shutter.frame_us: above 1000000, or missing") \
    X(FRAME_US, "frame.shutter.us: not compiled in") \
    X(FRAME_CURVE, "frame.shutter.curve: closed throughout") \
    X(FRAME_KIND, "frame.filter.kind: unknown, or not in desc.methods") \
    X(FRAME_WEIGHTS, "frame.filter.weights: unknown here") \
    X(FRAME_STEP, "frame.filter.camera_step: not 1, 2 or 4") \
    X(FRAME_PASSES, "frame.filter.pingpong.passes: above desc.filter.passes") \
    X(FRAME_TAPS, "frame.filter.pingpong.taps: not 2 to 64") \
    X(FRAME_BASE, "frame.filter.pingpong.base: not 2 to 64") \
    X(FRAME_JITTER, "frame.filter.pingpong.jitter: above 128") \
    X(FRAME_SPREAD, "frame.filter.pingpong.spread: above 1") \
    X(FRAME_ROTATION, "frame.scale.rotation: above 16128, or not compiled in") \
    X(FRAME_TRANSLATION, "frame.scale.translation: as rotation") \
    X(FRAME_OBJECT, "frame.scale.object: as rotation") \
    X(FRAME_LAYER, "frame.layer: too many, or a bad one") \
    X(FRAME_EDGES, "frame.edges: above 1, not with this method or desc.reuse, or not compiled in") \
    X(FRAME_SCENE, "frame.scene: what was not compiled in") \
    X(FRAME_LIGHTS, "frame.scene.lights: no shader, or a negative reach") \
    X(FRAME_OVERLAY, "frame.overlay: without items, or not compiled in") \
    X(ITEM_SCALE, "overlay.item.scale: above 8") \
    X(ITEM_IMAGE, "overlay.item.image: without pixels or palette, or out of range") \
    X(ITEM_CELL, "overlay.item.cell: not below image.cells") \
    X(ITEM_FONT, "overlay.item.font: missing, or as image") \
    X(ITEM_SHAPE, "overlay.item.shape: without its functions") \
    X(FRAME_POINTS, "overlay.points: without points, or with smear_filter_begin") \
    X(POINT_SIZE, "overlay.point.size: negative") \
    X(POINT_MODE, "overlay.point.mode: unknown") \
    X(DRAW_ID, "draw.id: twice in this frame") \
    X(DRAW_MESH, "draw.mesh: missing, or a value out of range") \
    X(DRAW_MESH_COLORS, "draw.mesh: colours, normals: not compiled in") \
    X(DRAW_MATERIAL, "draw.material: out of range, or not compiled in") \
    X(DRAW_POSITION, "draw.open_position: not compiled in") \
    X(DRAW_MOTION, "draw.motion: unknown") \
    X(DRAW_BILLBOARD, "draw.billboard: unknown here") \
    X(DRAW_PATH, "draw.path: unknown here")

#define SMEAR_FAULT_NUMBER_(name, text) FAULT_NUMBER_##name,
enum { SMEAR_FAULTS(SMEAR_FAULT_NUMBER_) SMEAR_FAULT_COUNT };
#undef SMEAR_FAULT_NUMBER_

/* What a function returns: FAULT(DESC_WIDTH). */
#define FAULT(name) (SMEAR_ERR_FIELD - 1 - (int)FAULT_NUMBER_##name)

/* Fill in defaults. They return SMEAR_OK, or the number of the field that is out of range or was not compiled in. */
int smear_resolve_desc(smear_desc *d);
int smear_resolve_frame(smear_frame *f, const smear_desc *d);

/* Return SMEAR_OK or the number of what is wrong. */
int smear_check_cameras(const smear_frame *f);
int smear_check_fog(const smear_frame *f);
int smear_check_layers(const smear_frame *f);
int smear_check_overlay(const smear_overlay *overlay);
int smear_check_draw(const smear_draw *draw);

#endif
