/* SPDX-License-Identifier: MIT */
/* planes.c - see planes.h. */
#include "tools/player/planes.h"

static void take_row(void *user, int y, const uint32_t *color, const uint16_t *depth,
                     const int32_t *velocity)
{
    struct planes *planes = user;
    int width = planes->depth.width;
    float *d = planes->depth.value + (size_t)y * (size_t)width;
    float *v = planes->velocity.value + (size_t)y * (size_t)width * 3;
    (void)color;
    for (int x = 0; x < width; x++, v += 3) {
        d[x] = (float)presented_depth(planes->presented, depth[x]);
        v[0] = (float)(velocity[2 * x] / 256.0);
        v[1] = (float)(velocity[2 * x + 1] / 256.0);
        v[2] = 0.0f;
    }
}

bool planes_open(struct planes *planes, int width, int height, struct failure *f)
{
    const struct device_setup setup = { .width = width, .height = height, .threads = 1,
                                        .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .format = SMEAR_XRGB8888, .inspect = take_row,
                                        .inspect_user = planes };
    *planes = (struct planes){ .presented = NULL };
    return float_image_alloc(&planes->depth, width, height, 1, f) &&
           float_image_alloc(&planes->velocity, width, height, 3, f) &&
           device_open(&planes->device, &setup, f);
}

void planes_close(struct planes *planes)
{
    device_close(&planes->device);
    float_image_free(&planes->depth);
    float_image_free(&planes->velocity);
}

bool planes_draw(struct planes *planes, const struct presented *presented, struct failure *f)
{
    /* Only the filter has velocities; a centred exposure has the frame's own instant amid. */
    struct presented drawn = *presented;
    drawn.frame.method = SMEAR_RECONSTRUCT;
    drawn.frame.filter = (smear_filter){ .flags = SMEAR_PUBLISHED };    /* velocities of vertices, not of blocks by depth */
    drawn.frame.shutter.exposure = SMEAR_CENTRED;
    drawn.frame.shutter.path = SMEAR_PATH_LINE;     /* velocities of curves belong to the exposure */
    drawn.frame.samples = 1;
    drawn.frame.edges = SMEAR_EDGES_HARD;
    drawn.draw_count -= drawn.has_backdrop ? 1 : 0;     /* a background has no distance */
    planes->presented = &drawn;
    bool ok = device_fit(&planes->device, &drawn, f) && device_draw(&planes->device, &drawn, f);
    planes->presented = NULL;
    return ok;
}
