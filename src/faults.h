/* SPDX-License-Identifier: MIT */
/* faults.h - what may be wrong with an argument: a number and a sentence each. */
#ifndef SMEAR_FAULTS_H
#define SMEAR_FAULTS_H

#include "smear.h"

/* X(name, text): in the order of their numbers, which go down from SMEAR_ERR_FIELD - 1. Texts name the field first. */
#define SMEAR_FAULTS(X) \
    X(DESC_WIDTH, "desc.width: not 1 to 2048 pixels") \
    X(DESC_HEIGHT, "desc.height: not 1 to 2048 pixels") \
    X(DESC_TRIANGLES, "desc.max_triangles: more than 16777216") \
    X(DESC_DRAWS, "desc.max_draws: out of range") \
    X(DESC_METHODS, "desc.methods: not a set of methods that were compiled in") \
    X(DESC_TILE, "desc.tile: not 8, 16, 32 or 64 (4 with SMEAR_NONE, SMEAR_ACCUMULATE and plain filters), or below the reach") \
    X(DESC_REACH, "desc.reach: not 1 to 64 pixels") \
    X(DESC_STRIP, "desc.strip: not 1 to 64 tiles wide") \
    X(DESC_BAND_ROWS, "desc.band_rows: less than 2, no multiple of 8 for OLED pages, or no tile where methods want one") \
    X(DESC_BANDS, "desc.bands: more than 2") \
    X(DESC_FORMAT, "desc.format: unknown, or not compiled in") \
    X(DESC_WORKERS, "desc.workers: more than 8, more than one where that was not compiled in or in smear_filter_begin") \
    X(DESC_VERTEX_CACHE, "desc.vertex_cache: no power of two from 16 to 4096") \
    X(DESC_CACHE_STATIC, "desc.reuse.cache_static: not 0 or 1, without a temporal method, or not compiled in") \
    X(DESC_BUFFER_AGE, "desc.reuse.buffer_age: more than 7, without a temporal method, or not compiled in") \
    X(DESC_PASSES, "desc.filter.passes: more than 3, without a method that filters, or not compiled in") \
    X(DESC_SCATTER, "desc.filter.scatter: not 0 or 1, or with temporal methods, SMEAR_PINGPONG or SMEAR_HALF") \
    X(DESC_DITHER, "desc.dither: unknown, or not compiled in") \
    X(DESC_FLUSH, "desc.flush: missing") \
    X(DESC_INSPECT, "desc.debug.inspect: not compiled in") \
    X(FRAME_CAMERA, "frame.camera: missing, no rotation, or without focal or half_height, near_plane or far_plane") \
    X(FRAME_OPEN, "frame.open: no valid camera") \
    X(FRAME_CLOSE, "frame.close: no valid camera") \
    X(FRAME_METHOD, "frame.method: unknown, or not in desc.methods") \
    X(FRAME_LIGHT_SPACE, "frame.light_space: unknown, or not compiled in") \
    X(FRAME_SAMPLES, "frame.samples: more than 1024, or than the method adds up") \
    X(FRAME_LIGHT, "frame.light: without a direction") \
    X(FRAME_DEGREES, "frame.shutter.degrees: more than 3600") \
    X(FRAME_EXPOSURE, "frame.shutter.exposure: unknown") \
    X(FRAME_MODE, "frame.shutter.mode: unknown, or not compiled in") \
    X(FRAME_REFERENCE, "frame.shutter.reference_hz: more than 1000") \
    X(FRAME_TIME, "frame.shutter.frame_us: more than 1000000, or missing where shutter.us or shutter.mode wants it") \
    X(FRAME_US, "frame.shutter.us: not compiled in") \
    X(FRAME_CURVE, "frame.shutter.curve: closed throughout") \
    X(FRAME_KIND, "frame.filter.kind: unknown, or not in desc.methods") \
    X(FRAME_WEIGHTS, "frame.filter.weights: unknown, or not compiled in") \
    X(FRAME_STEP, "frame.filter.camera_step: not 1, 2 or 4, or not compiled in") \
    X(FRAME_PASSES, "frame.filter.pingpong.passes: more than 3, or than desc.filter.passes") \
    X(FRAME_TAPS, "frame.filter.pingpong.taps: not 2 to 64") \
    X(FRAME_BASE, "frame.filter.pingpong.base: not 2 to 64") \
    X(FRAME_JITTER, "frame.filter.pingpong.jitter: more than 128") \
    X(FRAME_SPREAD, "frame.filter.pingpong.spread: not 0 or 1") \
    X(FRAME_ROTATION, "frame.scale.rotation: more than 16128, or not compiled in") \
    X(FRAME_TRANSLATION, "frame.scale.translation: more than 16128, or not compiled in") \
    X(FRAME_OBJECT, "frame.scale.object: more than 16128, or not compiled in") \
    X(FRAME_LAYER, "frame.layer: more than 8, without a mask, of another method, or with a bad camera or shutter") \
    X(DRAW_ID, "draw.id: submitted already in this frame, or ids were not compiled in") \
    X(DRAW_MESH, "draw.mesh: missing, without positions or indices, or a value out of range") \
    X(DRAW_MESH_COLORS, "draw.mesh: colours and normals of vertices were not compiled in") \
    X(DRAW_MATERIAL, "draw.material: alpha or texture out of range, or not compiled in") \
    X(DRAW_POSITION, "draw.open_position: deformation was not compiled in") \
    X(DRAW_MOTION, "draw.motion: unknown") \
    X(DRAW_BILLBOARD, "draw.billboard: unknown, or not compiled in")

#define SMEAR_FAULT_NUMBER_(name, text) FAULT_NUMBER_##name,
enum { SMEAR_FAULTS(SMEAR_FAULT_NUMBER_) SMEAR_FAULT_COUNT };
#undef SMEAR_FAULT_NUMBER_

/* What a function returns: FAULT(DESC_WIDTH). */
#define FAULT(name) (SMEAR_ERR_FIELD - 1 - (int)FAULT_NUMBER_##name)

#endif
