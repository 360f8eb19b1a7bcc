/* SPDX-License-Identifier: MIT */
/* tiny.c - the smallest firmware that blurs: a toy aeroplane on 96x64 pixels of an SSD1331, in 12 kB of RAM.
 *
 *     tiny FRAME OUT.ppm [sharp]      draws frame FRAME and writes it
 *     tiny cost                       instructions per frame, where there is a clock
 *
 * A mean of 8 instants, band by band (SMEAR_SET_ACCUMULATE_BANDS): no window, no lists of what moves, sums of 4 rows.
 * The same program draws the same frames on a host with the whole library. */
#include "platform/platform.h"
#include "platform/tiny.h"
#include "platform/tiny_plane.h"

#include "platform/print.h"

#include <stdbool.h>

enum { WIDTH = 96, HEIGHT = 64, LOOP = 32, QUARTERS = 4 };

/* Exactly what the desc below wants on a 32-bit machine, and what a host with all of the library wants. */
#ifndef TINY_MEMORY
#define TINY_MEMORY 65536
#endif
static uint64_t memory[TINY_MEMORY / 8];

static bool is_writing;

/* ------------------------------------------------------------------ poses */

/* Cosine and sine of k quarter frames of a turn, q24, by steps of one:
 * the multiples stay exact enough for a loop. */
struct turn {
    int32_t cosine, sine;
};

static struct turn turn_by(struct turn step, int k)
{
    struct turn t = { 1 << 24, 0 };
    for (; k > 0; k--) {
        int32_t c = (int32_t)(((int64_t)t.cosine * step.cosine - (int64_t)t.sine * step.sine) >> 24);
        t.sine = (int32_t)(((int64_t)t.cosine * step.sine + (int64_t)t.sine * step.cosine) >> 24);
        t.cosine = c;
    }
    return t;
}

/* Where the aeroplane and its propeller are after `quarter` quarters of a frame. */
static void pose(smear_transform *plane, smear_transform *blade, int quarter)
{
    /* 11.25, 1.25 degrees */
    static const struct turn propeller = { 16456498, 3266472 }, roll = { 16773186, 366055 };
    static const smear_transform identity = SMEAR_IDENTITY;
    struct turn r = turn_by(roll, quarter), p = turn_by(propeller, quarter & 31);
    *plane = identity;
    /* It rolls to and fro, and flies past. */
    int32_t tilt = r.sine >> 1;
    plane->basis[4] = plane->basis[8] = (1 << 24) - (tilt >> 9) * (tilt >> 16);
    plane->basis[5] = -tilt;
    plane->basis[7] = tilt;
    plane->origin[0] = (quarter - LOOP * QUARTERS * 3 / 4) * 5200;
    plane->origin[1] = 98304 + (r.sine >> 10);
    plane->origin[2] = 0;
    *blade = *plane;
    blade->basis[4] = blade->basis[8] = p.cosine;
    blade->basis[5] = -p.sine;
    blade->basis[7] = p.sine;
}

/* ------------------------------------------------------------------ frames */

/* Rows of RGB565 as they go to an SSD1331, high byte first; to the file as a PPM has them. */
static int flush(void *user, const smear_band *band)
{
    const uint8_t *p = band->pixels;
    uint8_t rgb[3 * 16];
    (void)user;
    if (!is_writing)
        return 0;
    for (uint32_t i = 0; i < band->size / 2; i += 16) {
        for (uint32_t k = 0; k < 16; k++, p += 2) {
            uint32_t r = p[0] >> 3, g = (p[0] & 7u) << 3 | p[1] >> 5, b = p[1] & 31u;
            rgb[3 * k] = (uint8_t)(r << 3 | r >> 2);
            rgb[3 * k + 1] = (uint8_t)(g << 2 | g >> 4);
            rgb[3 * k + 2] = (uint8_t)(b << 3 | b >> 2);
        }
        if (tiny_file_write(rgb, sizeof rgb) != 0)
            return -1;
    }
    return 0;
}

/* A band of 4 rows sees at most 44 of the 134 triangles. */
static const smear_desc desc = {
    .width = WIDTH, .height = HEIGHT, .methods = SMEAR_SET_ACCUMULATE_BANDS, .band_rows = 4,
    .format = SMEAR_RGB565_SWAPPED, .display.dither = SMEAR_DITHER_NONE, .max_draws = 3, .max_triangles = 32,
    .vertex_cache = 16, .flush = flush
};

static __attribute__((noinline)) int submit(smear_context *ctx, int frame, bool sharp)
{
    static const smear_material paint = { 0 },
                                blade_paint = { .color = { 30, 30, 34, 255 }, .double_sided = 1 },
                                grass = { .color = { 92, 128, 60, 255 }, .unlit = 1 };
    static const smear_camera camera = {
        /* 48 degrees to its side */
        .pose = { { 11226149, 0, 12467901, 0, 1 << 24, 0, -12467901, 0, 11226149 },
                  { 150978, 98304, 135942 } },
        .focal = 131072, .near_plane = 1 << 15
    };
    static const smear_frame frames[2] = {
        { .camera = &camera, .method = SMEAR_ACCUMULATE, .light_space = SMEAR_LIGHT_ENCODED, .shutter.poses = 1,
          .samples = 8, .clear = 0x9cc4e8 },
        { .camera = &camera, .method = SMEAR_NONE, .light_space = SMEAR_LIGHT_ENCODED, .shutter.poses = 1,
          .clear = 0x9cc4e8 }
    };
    smear_transform plane[3], blade[3];         /* now, at shutter open and at shutter close */
    const smear_draw draws[3] = {
        { .mesh = &ground_mesh, .material = &grass },
        { .mesh = &plane_mesh, .material = &paint, .now = &plane[0], .open = &plane[1], .close = &plane[2] },
        { .mesh = &blade_mesh, .material = &blade_paint, .now = &blade[0], .open = &blade[1],
          .close = &blade[2] }
    };
    pose(&plane[0], &blade[0], frame * QUARTERS + 1);       /* 180 degrees are two quarters */
    pose(&plane[1], &blade[1], frame * QUARTERS);
    pose(&plane[2], &blade[2], frame * QUARTERS + 2);
    int result = smear_begin(ctx, &frames[sharp]);
    for (int i = 0; i < 3 && result == SMEAR_OK; i++)
        result = smear_submit(ctx, &draws[i]);
    return result;
}

static __attribute__((noinline)) bool has_dropped(const smear_context *ctx)
{
    smear_stats stats;
    smear_get_stats(ctx, &stats);
    return stats.triangles_dropped != 0;
}

static int draw(smear_context *ctx, int frame, bool sharp)
{
    int result = submit(ctx, frame, sharp);
    if (result == SMEAR_OK)
        result = smear_render(ctx);
    return result == SMEAR_OK && has_dropped(ctx) ? SMEAR_ERR_FULL : result;
}

/* ------------------------------------------------------------------ the program */

static int failed(const char *what, int result)
{
    platform_print("tiny: ");
    platform_print(what);
    print_signed(result);
    platform_print("\n");
    return 1;
}

static int write_frame(smear_context *ctx, int frame, const char *path, bool sharp)
{
    static const char header[] = "P6\n96 64\n255\n";
    if (tiny_file_open(path) != 0)
        return failed("cannot open the file", 0);
    is_writing = true;
    int result = tiny_file_write(header, sizeof header - 1);
    if (result == 0)
        result = draw(ctx, frame, sharp);
    if (tiny_file_close() != 0 || result != 0)
        return failed("no frame: ", result);
    return 0;
}

static int print_cost(smear_context *ctx)
{
    for (int sharp = 1; sharp >= 0; sharp--) {
        uint32_t sum = 0, most = 0;
        for (int frame = 0; frame < LOOP; frame++) {
            platform_clock_start();
            uint32_t start = platform_clock();
            int result = draw(ctx, frame, sharp);
            uint32_t cost = platform_clock_count(platform_clock() - start);
            if (result != SMEAR_OK)
                return failed("no frame: ", result);
            sum += cost / LOOP;
            most = cost > most ? cost : most;
        }
        platform_print(sharp ? "sharp   " : "blurred ");
        print_decimal(sum);
        platform_print(" ");
        platform_print(platform_clock_unit);
        platform_print(" per frame, at most ");
        print_decimal(most);
        platform_print("\n");
    }
    return 0;
}

int main(int argc, char **argv)
{
    smear_context *ctx;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    if (result != SMEAR_OK)
        return failed("bytes of memory wanted: ", (int)smear_memory_size(&desc));
    if (argc == 2 && argv[1][0] == 'c') {
        result = print_cost(ctx);
    } else if (argc >= 3) {
        int frame = 0;
        for (const char *digit = argv[1]; *digit >= '0' && *digit <= '9'; digit++)
            frame = (frame * 10 + (*digit - '0')) % LOOP;
        result = write_frame(ctx, frame, argv[2], argc > 3);
    } else {
        result = failed("usage: tiny FRAME OUT.ppm [sharp] | tiny cost ", 0);
    }
    uint32_t stack = platform_stack_used();
    if (stack == UINT32_MAX)
        return failed("stack overflow ", 0);
    if (stack > 0) {
        platform_print("stack ");
        print_decimal(stack);
        platform_print("\n");
    }
    return result;
}
