/* SPDX-License-Identifier: MIT */
/* store.c - see store.h. */
#include "tests/unit/store.h"

uint32_t *pool;
struct smear_bins geometry;
struct smear_segment segment[STORE_SEGMENTS];
struct smear_raster_draw draw[STORE_SEGMENTS];
struct smear_raster_frame frame;
struct smear_shutter_times shutter;

void store_begin(uint32_t *words, uint32_t count, int segments, int32_t width, int32_t height, bool linear)
{
    pool = words;
    geometry = (struct smear_bins){
        .pool = pool, .pool_words = count, .segment = segment, .segment_count = (uint32_t)segments,
        .segment_limit = (uint32_t)segments
    };
    for (int i = 0; i < segments; i++) {
        segment[i] = (struct smear_segment){
            .draw = (uint16_t)i, .stride = VERTEX_BASE_WORDS, .shade = SHADE_FLAT
        };
        draw[i] = (struct smear_raster_draw){ .alpha = SMEAR_OPAQUE, .cutoff = 128 };
    }
    frame = (struct smear_raster_frame){
        .bins = &geometry, .draw = draw, .width = width, .height = height, .transfer = linear, .velocity_scale = 32768,
        .inspect_scale = 65536, .reach_q3 = 15 * 8
    };
    for (int i = 0; i <= SHUTTER_SAMPLES; i++)
        shutter.time[i] = i * (SHUTTER_CLOSE / SHUTTER_SAMPLES);
}

/* With so many words of motion. */
static struct smear_segment *lay_out(int at, bool uv, bool color, int motion_words, enum smear_shade_mode shade)
{
    struct smear_segment *s = &segment[at];
    int words = VERTEX_BASE_WORDS;
    s->uv = s->color = s->motion = 0;
    if (uv)
        s->uv = (uint8_t)words++;
    if (color) {
        s->color = (uint8_t)words;
        words += 2;
    }
    if (motion_words != 0) {
        s->motion = (uint8_t)words;
        words += motion_words;
    }
    s->shade = (uint8_t)shade;
    s->stride = (uint8_t)words;
    return s;
}

void set_layout(int at, bool uv, bool color, int moves, enum smear_shade_mode shade)
{
    lay_out(at, uv, color, moves * MOTION_WORDS, shade)->moves = (uint8_t)moves;
}

void set_path_layout(int at, bool uv, bool color, bool path, enum smear_shade_mode shade)
{
    lay_out(at, uv, color, path ? PATH_WORDS : 0, shade)->path = path;
}

uint16_t store_vertex(int at)
{
    uint32_t word = geometry.vertex_words;
    geometry.vertex_words += segment[at].stride;
    for (uint32_t i = word; i < geometry.vertex_words; i++)
        pool[i] = 0;
    return (uint16_t)word;
}

void link_in(uint32_t *head, uint32_t *last, uint32_t triangle)
{
    if (*head == SMEAR_NO_TRIANGLE)
        *head = triangle;
    else
        bins_triangle(&geometry, *last)->next = triangle;
    *last = triangle;
}

int64_t edge_value(const int32_t *a, const int32_t *b, int32_t x, int32_t y)
{
    return (int64_t)(b[0] - a[0]) * (y - a[1]) - (int64_t)(b[1] - a[1]) * (x - a[0]);
}
