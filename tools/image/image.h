/* SPDX-License-Identifier: MIT */
/* image.h - pictures in memory, the files they come from and go to, and the distance between two.
 *
 * Two plain structs: 8-bit RGBA for what is seen, float planes for what is measured. Loaders take
 * bytes in memory (so that embedded pictures and fuzzers use the same code); *_load and *_save take
 * paths. */
#ifndef SMEAR_TOOLS_IMAGE_H
#define SMEAR_TOOLS_IMAGE_H

#include "tools/failure.h"

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

/* Largest accepted edge, picture and file; what is larger is refused before anything is allocated. */
enum { IMAGE_MAX_EDGE = 16384, IMAGE_MAX_PIXELS = 1 << 24, IMAGE_MAX_BYTES = 256 << 20 };

/* Opaque black. */
bool image_alloc(struct image *image, int width, int height, struct failure *f);
void image_free(struct image *image);
/* Zeros. */
bool float_image_alloc(struct float_image *image, int width, int height, int channels,
                       struct failure *f);
void float_image_free(struct float_image *image);

/* Edges within 1..IMAGE_MAX_EDGE, no more than IMAGE_MAX_PIXELS; two pictures that exist and have one size. */
bool image_check_size(long width, long height, struct failure *f);
bool image_check_same_size(const struct image *a, const struct image *b, struct failure *f);

/* The whole file; refuses files above max_bytes. The result has a NUL after its last byte. */
bool file_read(const char *path, size_t max_bytes, uint8_t **bytes, size_t *size,
               struct failure *f);

/* Likewise a picture's, which is refused by its first bytes where it begins like none. */
bool image_read(const char *path, uint8_t **bytes, size_t *size, struct failure *f);

/* Writes to a temporary name beside `path` and renames it, so that no partial file is ever seen. */
bool file_write(const char *path, const uint8_t *bytes, size_t size, struct failure *f);

/* --- reading; formats are told by content, never by name ---
 *
 * On failure the picture is empty and nothing is left to free. More than 8 bits per sample are
 * rounded to 8. */

/* Every colour type, depth and interlace. Codes come out as they are in the file: gamma and colour
 * profiles are ignored. */
bool png_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f);

/* Baseline and progressive, grey, YCbCr and RGB. Orientation is ignored, too. */
bool jpeg_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f);

/* P2, P3, P5 and P6 with maxval up to 65535. */
bool ppm_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f);

/* Either byte order; the size of the scale is ignored. */
bool pfm_decode(const uint8_t *bytes, size_t size, struct float_image *out, struct failure *f);

/* PNG or PPM, by content. */
bool image_load(const char *path, struct image *out, struct failure *f);

/* --- writing ---
 *
 * The *_encode functions write into memory: *bytes is malloc'ed, for the caller to free. */

/* RGB when all pixels are opaque, else RGBA. */
bool png_encode(const struct image *image, uint8_t **bytes, size_t *size, struct failure *f);
bool png_save(const char *path, const struct image *image, struct failure *f);

/* P6; alpha is dropped. */
bool ppm_encode(const struct image *image, uint8_t **bytes, size_t *size, struct failure *f);
bool ppm_save(const char *path, const struct image *image, struct failure *f);

/* Bottom row first, scale -1.0 (little-endian). */
bool pfm_encode(const struct float_image *image, uint8_t **bytes, size_t *size, struct failure *f);
bool pfm_save(const char *path, const struct float_image *image, struct failure *f);

/* Animations: begin (null on failure), add each frame (all of one size), end; or cancel, which
 * leaves no file. After a frame could not be written, end fails and leaves no file too. delay_ms is
 * per frame, 0..600000. Both loop for ever and hold only what changes.
 *
 * GIF: one palette of up to 256 colours per frame, chosen for that frame; exact when the pixels
 * that change have at most 256 colours (255 when some inside their rectangle do not change), else
 * with an ordered dither. Delays are rounded to 10 ms, at least 20, so that the whole keeps its
 * length. Translucent pixels are shown on black.
 *
 * APNG: true colour, exact. A frame with alpha fails unless the first one has alpha too. */
struct animation_writer;
struct animation_writer *gif_begin(const char *path, int width, int height, struct failure *f);
struct animation_writer *apng_begin(const char *path, int width, int height, struct failure *f);
bool animation_add(struct animation_writer *w, const struct image *frame, int delay_ms,
                   struct failure *f);
bool animation_end(struct animation_writer *w, struct failure *f);     /* frees w in any case */
void animation_cancel(struct animation_writer *w);                     /* null is allowed */

/* crc32 as in zlib; start with 0. */
uint32_t crc32_update(uint32_t crc, const void *bytes, size_t size);

/* --- distance between two pictures of one size, colour only --- */
struct image_distance {
    double rmse;        /* root mean square error over R, G, B in codes (1/255) */
    double psnr;        /* dB of 255; infinity when equal */
    double ssim;        /* mean SSIM of luma, 11x11 Gaussian sigma 1.5, C1 = 0.01^2, C2 = 0.03^2,
                         * over the windows inside the picture */
    double flip;        /* mean LDR-FLIP at pixels_per_degree, 0..1 */
};

/* A display at 0.7 m whose 3840 pixels span 0.7 m, FLIP's own default. */
#define IMAGE_PIXELS_PER_DEGREE 67.0

/* pixels_per_degree is 1..1000. */
bool image_compare(const struct image *a, const struct image *b, double pixels_per_degree,
                   struct image_distance *out, struct failure *f);
/* |a - b| per channel, scaled by `gain` and clamped, for looking at. */
bool image_difference(const struct image *a, const struct image *b, int gain, struct image *out,
                      struct failure *f);

#endif
