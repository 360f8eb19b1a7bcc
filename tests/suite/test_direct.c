/* SPDX-License-Identifier: MIT */
/* test_direct.c - sharp frames drawn as the display's pixels are those that were drawn as working
 * pixels and converted. A context with a window never draws directly. */
#include "smear_overlay.h"

#include "filter/probe.h"
#include "base/pixel.h"
#include "raster/texture.h"
#include "tools/scenes/present.h"

#include "tests/context_rig.h"

enum { WIDTH = 150, HEIGHT = 110, PIXELS = WIDTH * HEIGHT };

/* Whether the frame was drawn directly; -1 on errors. */
static int draw(uint16_t *out, const struct presented *frame, const smear_desc *base)
{
    smear_desc desc = presented_desc(frame, WIDTH, HEIGHT);
    desc.methods = base->methods;
    desc.band_rows = base->band_rows;
    desc.format = base->format;
    desc.display.dither = base->display.dither;
    desc.max_triangles = base->max_triangles != 0 ? base->max_triangles : desc.max_triangles;
    RIG(r, &desc, false);
    const bool ok = CHECK_EQ(presented_submit(frame, r.ctx), SMEAR_OK) && CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
    memcpy(out, r.picture, PIXELS * sizeof *out);
    return ok ? smear_probe(r.ctx).direct : -1;
}

/* How many of `count` frames were drawn directly; all must equal those through the window. `overlay`: or null. */
static int compare_under(const char *name, int count, bool texels_565, smear_desc desc, const smear_overlay *overlay)
{
    static uint16_t direct[PIXELS], window[PIXELS];
    struct failure f = { "" };
    struct scene scene OWNED(scene_free) = { 0 };
    int drawn = 0;
    if (!CHECK(scene_builtin(name, &scene, &f)))
        return 0;
    struct presenter *presenter = presenter_new(&scene, &f);
    for (int i = 0; i < count && CHECK(presenter != NULL); i++) {
        struct present_options options = { .fps = scene.fps, .shutter_degrees = 180, .method = SMEAR_NONE,
                                           .clear = 0x6f9ac3, .light = (smear_light_space)(i & 1),
                                           .texels_565 = texels_565 };
        const struct presented *const shown = presenter_frame(presenter, 5 * i / scene.fps, &options, &f);
        if (!CHECK(shown != NULL))
            break;
        struct presented frame = *shown;
        frame.frame.overlay = overlay;
        memset(direct, 0x55, sizeof direct);
        desc.methods = SMEAR_SET(SMEAR_NONE);
        drawn += draw(direct, &frame, &desc) == 1;
        smear_desc other = desc;
        other.methods = SMEAR_SET(SMEAR_RECONSTRUCT);
        other.band_rows = 0;
        memset(window, 0xaa, sizeof window);
        CHECK_EQ(draw(window, &frame, &other), 0);
        int differ = 0;
        for (int k = 0; k < PIXELS; k++)
            differ += direct[k] != window[k];
        CHECK_EQ(differ, 0);
    }
    presenter_free(presenter);
    return drawn;
}

static int compare(const char *name, int count, bool texels_565, smear_desc desc)
{
    return compare_under(name, count, texels_565, desc, NULL);
}

static void test_every_kind_of_span(void)
{
    static const char *const name[] = { "peer/A", "peer/B64", "peer/B256", "peer/C", "peer/D", "peer/E", "peer/N",
                                        "suite/textured", "suite/fence_fg", "suite/near", "suite/arena" };
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        smear_desc desc = { .format = SMEAR_RGB565, .display.dither = SMEAR_DITHER_NONE, .band_rows = i & 1 ? 16 : 112 };
        CHECK_EQ(compare(name[i], 2, true, desc), 2);
    }
}

static void test_either_byte_order(void)
{
    smear_desc desc = { .format = SMEAR_RGB565_SWAPPED, .display.dither = SMEAR_DITHER_NONE, .band_rows = 24 };
    CHECK_EQ(compare("peer/B64", 2, true, desc), 2);
    CHECK_EQ(compare("suite/swarm", 2, true, desc), 2);
}

static void test_a_frame_in_parts(void)
{
    smear_desc desc = { .format = SMEAR_RGB565, .display.dither = SMEAR_DITHER_NONE, .band_rows = 8, .max_triangles = 500 };
    CHECK_EQ(compare("peer/E", 2, true, desc), 2);
}

/* What goes on through rows of the frame that are drawn as working pixels, since something lies over them, goes on below. */
static void test_rows_through_the_window_among_others(void)
{
    static const char *const name[] = { "peer/B64", "peer/E", "suite/textured", "suite/arena" };
    const smear_overlay_item item[2] = { { .x = 20, .y = 30, .width = 40, .height = 3, .color = { 255, 200, 0, 255 } },
                                         { .x = 90, .y = 64, .width = 9, .height = 20, .color = { 0, 90, 255, 128 } } };
    const smear_overlay overlay = { item, 2, NULL };
    for (size_t i = 0; i < sizeof name / sizeof *name; i++)
        for (int rows = 8; rows <= 16; rows += 8) {
            const smear_desc desc = { .format = SMEAR_RGB565, .display.dither = SMEAR_DITHER_NONE, .band_rows = (int16_t)rows };
            CHECK_EQ(compare_under(name[i], 2, true, desc, &overlay), 2);
        }
}

static void test_only_where_nothing_is_rounded_twice(void)
{
    const smear_desc desc = { .format = SMEAR_RGB565, .display.dither = SMEAR_DITHER_NONE };
    smear_desc other = desc;
    CHECK_EQ(compare("peer/B64", 1, false, desc), 0);       /* texels of 8 bits */
    CHECK_EQ(compare("peer/E", 1, false, desc), 1);
    other.display.dither = SMEAR_DITHER_ORDERED;
    CHECK_EQ(compare("peer/E", 1, true, other), 0);
    other = desc;
    other.format = SMEAR_RGB555;
    CHECK_EQ(compare("peer/E", 1, true, other), 0);
}

/* A texel of 16 bits becomes a working pixel and the same 16 bits again. */
static void test_texels_of_the_display_stay(void)
{
    uint16_t texel;
    const smear_texture texture = { .texels = &texel, .width = 1, .height = 1, .format = SMEAR_TEXEL_565 };
    struct smear_sampler sampler;
    const struct smear_texture_run run = { 0, 0, 0 };
    int differ = 0;
    smear_sampler_make(&sampler, &texture, 15, false, false);
    for (uint32_t i = 0; i < 65536; i++) {
        uint32_t pixel;
        texel = (uint16_t)i;
        smear_sample(&pixel, &sampler, &run, 0, 1);
        differ += rgb565_nearest(pixel) != i;
    }
    CHECK_EQ(differ, 0);
}

#include "build/suites/direct.h"
