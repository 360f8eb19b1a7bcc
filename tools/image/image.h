/* SPDX-License-Identifier: MIT */
/* image.h - pictures in memory, the files they come from and go to, and the distance between two.
 *
 * Two plain structs: 8-bit RGBA for what is seen, float planes for what is measured. Loaders take bytes
 * in memory (so that embedded pictures and fuzzers use the same code); *_load and *_save take paths. */
#ifndef SMEAR_TOOLS_IMAGE_H
#define SMEAR_TOOLS_IMAGE_H

#include "../failure.h"

#include <stddef.h>
#include <stdint.h>

/* width x height pixels, top row first, 4 bytes R G B A each (straight alpha), no padding. */
struct image {
    int width, height;
    uint8_t *rgba;              /* malloc'ed; null when empty */
};

/* width x height, `channels` 1 or 3 interleaved floats, top row first in memory. */
struct float_image {
    int width, height, channels;
    float *value;               /* malloc'ed; null when empty */
};

/* Largest accepted edge; larger headers are refused before anything is allocated. */
enum { IMAGE_MAX_EDGE = 16384 };

bool image_alloc(struct image *image, int width, int height, struct failure *f);   /* opaque black */
void image_free(struct image *image);
bool float_image_alloc(struct float_image *image, int width, int height, int channels,
                       struct failure *f);                                           /* zeros */
void float_image_free(struct float_image *image);

/* The whole file; refuses files above max_bytes. The result has a NUL after its last byte. */
bool file_read(const char *path, size_t max_bytes, uint8_t **bytes, size_t *size, struct failure *f);

/* Writes to a temporary name beside `path` and renames it, so that no partial file is ever seen. */
bool file_write(const char *path, const uint8_t *bytes, size_t size, struct failure *f);

/* --- reading; formats are told by content, never by name --- */
bool png_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f);
bool ppm_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f);  /* P2 P3 P5 P6, maxval <= 65535 */
bool pfm_decode(const uint8_t *bytes, size_t size, struct float_image *out, struct failure *f);
bool image_load(const char *path, struct image *out, struct failure *f);           /* PNG or PPM */

/* --- writing --- */
/* Into memory: *bytes is malloc'ed, for the caller to free. */
bool png_encode(const struct image *image, uint8_t **bytes, size_t *size, struct failure *f);
bool ppm_encode(const struct image *image, uint8_t **bytes, size_t *size, struct failure *f);
bool pfm_encode(const struct float_image *image, uint8_t **bytes, size_t *size, struct failure *f);
/* Into files. */
bool png_save(const char *path, const struct image *image, struct failure *f);     /* RGB when all opaque */
bool ppm_save(const char *path, const struct image *image, struct failure *f);     /* P6 */
bool pfm_save(const char *path, const struct float_image *image, struct failure *f); /* bottom row first, scale -1.0 */

/* Animations: begin, add each frame (all of one size), end; or cancel, which leaves no file.
 * delay_ms is per frame. GIF: LZW, one local palette of up to 256 colours per frame chosen for that frame
 * (exact when the frame has at most 256 colours), ordered dither only when it is not exact, loops forever,
 * unchanged borders cropped away. APNG: true colour, loops forever, changed rectangle only. */
struct animation_writer;
struct animation_writer *gif_begin(const char *path, int width, int height, struct failure *f);
struct animation_writer *apng_begin(const char *path, int width, int height, struct failure *f);
bool animation_add(struct animation_writer *w, const struct image *frame, int delay_ms,
                   struct failure *f);
bool animation_end(struct animation_writer *w, struct failure *f);     /* frees w in any case */
void animation_cancel(struct animation_writer *w);

/* crc32 as in zlib; start with 0. */
uint32_t crc32_update(uint32_t crc, const void *bytes, size_t size);

/* --- distance between two pictures of one size, colour only --- */
struct image_distance {
    double rmse;        /* root mean square error over R, G, B in codes (1/255) */
    double psnr;        /* dB of 255; infinity when equal */
    double ssim;        /* mean SSIM of luma, 11x11 Gaussian sigma 1.5, C1 = 0.01^2, C2 = 0.03^2 */
    double flip;        /* mean LDR-FLIP at pixels_per_degree */
};
bool image_compare(const struct image *a, const struct image *b, double pixels_per_degree,
                   struct image_distance *out, struct failure *f);
/* |a - b| per channel, scaled by `gain` and clamped, for looking at. */
bool image_difference(const struct image *a, const struct image *b, int gain, struct image *out,
                      struct failure *f);

#endif
