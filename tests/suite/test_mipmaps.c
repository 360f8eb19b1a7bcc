/* SPDX-License-Identifier: MIT */
/* test_mipmaps.c - smaller pictures behind a texture: which one triangles show, and that it is the same however the frame is
 * cut. Host only. */
#include "smear_math.h"

#include "tests/rig.h"

enum { EDGE = 64, LEVELS = 6, TEXELS = (4 * EDGE * EDGE - 1) / 3 };

static const uint32_t level_color[LEVELS + 1] = { 0xff0000, 0x00ff00, 0x0000ff, 0xffff00, 0xff00ff, 0x00ffff, 0xffffff };

/* Each level has a colour of its own; or a grain. Texels of 32 bits, 16 or 8. */
static void make_texture(smear_texture *t, void *texels, uint32_t *palette, smear_texel_format format, bool grain)
{
    uint32_t at = 0;
    for (int level = 0; level <= LEVELS; level++) {
        const uint32_t size = EDGE >> level;
        const uint32_t c = level_color[level];
        for (uint32_t i = 0; i < size * size; i++, at++) {
            const uint32_t rgb = grain ? c ^ (i * 2654435761u >> 8 & 0x7f7f7fu) : c;
            if (format == SMEAR_TEXEL_8888)
                ((uint32_t *)texels)[at] = 0xff000000u | rgb;
            else if (format == SMEAR_TEXEL_565)
                ((uint16_t *)texels)[at] = (uint16_t)((rgb >> 8 & 0xf800u) | (rgb >> 5 & 0x7e0u) | (rgb >> 3 & 31u));
            else
                ((uint8_t *)texels)[at] = (uint8_t)level;
        }
        palette[level] = 0xff000000u | c;
    }
    *t = (smear_texture){ .texels = texels, .palette = format == SMEAR_TEXEL_PALETTE8 ? palette : NULL, .width = EDGE,
                          .height = EDGE, .format = (uint8_t)format, .levels = LEVELS };
}

/* The colour in the middle of a square that is so many pixels wide, 10 away from the eye. */
static uint32_t shown(struct rig *r, const smear_texture *t, double pixels, int method, double travel, bool bilinear)
{
    const smear_material material = { .texture = t, .unlit = 1, .bilinear = bilinear };
    const smear_camera camera = { .pose = SMEAR_IDENTITY, .half_height = q16(64.0 / pixels), .near_plane = SMEAR_Q16(1),
                                  .far_plane = SMEAR_Q16(100) };
    const smear_frame frame = { .camera = &camera, .method = (uint8_t)method, .light_space = SMEAR_LIGHT_ENCODED,
                                .shutter = { .degrees = 360 } };
    const smear_transform now = pose_at(0, 0, -10, 0, 0), open = pose_at(-travel, 0, -10, 0, 0);
    const smear_draw draw = { .id = 1, .mesh = &square, .material = &material, .now = &now, .open = &open };
    rig_forget_output(r);
    rig_frame(r, &frame, &draw, 1);         /* the camera stands still */
    rig_forget_output(r);
    if (!CHECK_EQ(rig_frame(r, &frame, &draw, 1), SMEAR_OK))
        return 0;
    const uint8_t *p = r->picture + 4 * (32 * 64 + 32);
    return (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
}

static smear_desc desc_of(void)
{
    return (smear_desc){ .width = 64, .height = 64, .tile = 16, .reach = 8, .format = SMEAR_XRGB8888,
                         .methods = SMEAR_SET_TEMPORAL | SMEAR_SET(SMEAR_NONE) | SMEAR_SET(SMEAR_RECONSTRUCT) };
}

static void test_triangles_show_the_picture_whose_texels_are_as_large_as_pixels(void)
{
    static uint32_t texels[TEXELS], palette[256];
    const smear_desc desc = desc_of();
    RIG(r, &desc, false);
    for (int format = SMEAR_TEXEL_8888; format <= SMEAR_TEXEL_PALETTE8; format++) {
        smear_texture t;
        make_texture(&t, texels, palette, (smear_texel_format)format, false);
        for (int level = 0; level <= LEVELS; level++) {
            const uint32_t want = level_color[level];
            /* A texel is a pixel at 64 >> level pixels: a little less than that, and a little more than half of it. */
            for (int edge = 0; edge < 2; edge++) {
                const double pixels = (EDGE >> level) * (edge != 0 ? 0.53 : 0.96);
                if (pixels < 2.5)
                    continue;
                const uint32_t got = shown(&r, &t, pixels, SMEAR_NONE, 0, false);
                if (!CHECK((got & 0xf8f8f8u) == (want & 0xf8f8f8u)))
                    printf("    format %d, %g pixels: %06x, not %06x\n", format, pixels, (unsigned)got, (unsigned)want);
            }
        }
        t.levels = 2;
        CHECK_EQ(shown(&r, &t, 5, SMEAR_NONE, 0, false) & 0xf8f8f8u, level_color[2] & 0xf8f8f8u);
        CHECK_EQ(shown(&r, &t, 100, SMEAR_NONE, 0, false) & 0xf8f8f8u, level_color[0] & 0xf8f8f8u);
        t.levels = LEVELS;
        CHECK_EQ(shown(&r, &t, 30, SMEAR_SUBFRAMES, 0.2, false) & 0xf8f8f8u, level_color[1] & 0xf8f8f8u);
        CHECK_EQ(shown(&r, &t, 30, SMEAR_RECONSTRUCT, 0.2, false) & 0xf8f8f8u, level_color[1] & 0xf8f8f8u);
        /* Only nearest texels that repeat. */
        CHECK_EQ(shown(&r, &t, 10, SMEAR_NONE, 0, true) & 0xf8f8f8u, level_color[0] & 0xf8f8f8u);
        t.wrap_v = SMEAR_CLAMP;
        CHECK_EQ(shown(&r, &t, 10, SMEAR_NONE, 0, false) & 0xf8f8f8u, level_color[0] & 0xf8f8f8u);
    }
}

static void test_levels_that_cannot_be_are_refused(void)
{
    static uint32_t texels[TEXELS], palette[256];
    static const struct { uint16_t width, height; uint8_t levels; bool ok; } tried[] = {
        { 64, 64, 6, true }, { 64, 64, 7, false }, { 64, 1, 6, true }, { 1, 64, 7, false }, { 1, 1, 0, true }, { 1, 1, 1, false },
        { 48, 64, 1, false }, { 64, 63, 1, false }, { 48, 63, 0, true }, { 64, 64, 255, false }
    };
    const smear_desc desc = desc_of();
    struct scene s;
    RIG(r, &desc, false);
    make_scene(&s, 0, SMEAR_NONE);
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        smear_texture t;
        make_texture(&t, texels, palette, SMEAR_TEXEL_8888, false);
        t.width = tried[i].width;
        t.height = tried[i].height;
        t.levels = tried[i].levels;
        const smear_material m = { .texture = &t };
        const smear_draw draw = { .mesh = &square, .material = &m, .now = &s.pose[3] };
        CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
        CHECK_EQ(smear_error_kind(smear_submit(r.ctx, &draw)), tried[i].ok ? SMEAR_OK : SMEAR_ERR_ARG);
    }
}

#include "build/suites/mipmaps.h"
