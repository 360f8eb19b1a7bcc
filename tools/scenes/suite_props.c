/* SPDX-License-Identifier: MIT */
/* suite_props.c - sets and movers of the quality suite. Most of it is flat or Gouraud shaded, as
 * scenes on small machines are. */
#include "tools/scenes/builtin.h"
#include "tools/scenes/suite.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

double suite_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

double suite_lap(double time, double period, int *lap)
{
    double laps = floor(time / period + 0.5);
    *lap = (int)fmod(laps, 1e6);
    return time - laps * period;
}

void suite_cut(struct scene_instant *out, int draw, int lap)
{
    out->draw[draw].epoch = lap;
}

/* ------------------------------------------------------------------ sets */

struct palette {
    uint32_t dark, light;           /* slabs */
    uint32_t solid[8];
};

static const struct palette soft = {
    0x7c8470, 0x8e967f,
    {0xc8b48c, 0x9aa7b4, 0xb58f7c, 0x8fb09a, 0xd2c4a0, 0x7d8ea8, 0xb9a2b6, 0xa3b86c},
};
static const struct palette bold = {
    0x39414f, 0xc9ccd0,
    {0xf4e9c8, 0x232a3a, 0xe4572e, 0x17bebb, 0xffc914, 0x76b041, 0x4b2e83, 0xfafafa},
};

static double between(uint32_t *state, double low, double high)
{
    return low + (high - low) * suite_random(state);
}

/* One of a box, a pyramid, a column and a ball on the ground at x, z. */
static void solid(struct build *b, uint32_t *state, double x, double z, double size)
{
    double height = size * between(state, 0.8, 2.4), half = size * between(state, 0.35, 0.6);
    int kind = (int)(suite_random(state) * 4);
    b->at = xform_mul(xform_move(x, 0, z), xform_turn_y(2 * PI * suite_random(state)));
    if (kind == 0) {
        build_box(b, vec3(-half, 0, -half), vec3(half, height, half));
    } else if (kind == 1) {
        build_drum(b, half * 1.3, 0, 0, height, 5);
    } else if (kind == 2) {
        build_drum(b, half * 0.7, half * 0.6, 0, height * 1.2, 9);
    } else {
        b->at = xform_mul(b->at, xform_move(0, half, 0));
        build_ball(b, half, 10, 7);
    }
    b->at = xform_identity();
}

/* Slabs of two shades around the origin, each with its own corners so that colours stay apart. */
static void slabs(struct build *b, double half, int count, const struct palette *palette)
{
    double edge = 2 * half / count;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++) {
            double x = -half + edge * i, z = -half + edge * j;
            build_color(b, (i + j) & 1 ? palette->dark : palette->light);
            build_quad(b, vec3(x, 0, z + edge), vec3(x + edge, 0, z + edge),
                       vec3(x + edge, 0, z), vec3(x, 0, z));
        }
}

int suite_yard(struct stage *stage, uint32_t seed)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    b.at = xform_turn_y(0.11);
    slabs(&b, 9.3, 10, &soft);
    b.at = xform_identity();
    build_color(&b, 0x93a0ac);
    build_box(&b, vec3(-11.3, -0.5, -7.4), vec3(11.1, 3.1, -7.0));
    for (int i = 0; i < 7; i++) {
        build_color(&b, soft.solid[(i + 1) & 7]);
        build_box(&b, vec3(-9.9 + 3.13 * i, 0, -7.0), vec3(-9.3 + 3.13 * i, 3.6, -6.6));
    }
    for (int i = 0; i < 13; i++) {
        double x = -5.6 + 0.93 * i + between(&seed, -0.3, 0.3), z = between(&seed, -5.6, -1.6);
        build_color(&b, soft.solid[i * 3 & 7]);
        solid(&b, &seed, x, z, between(&seed, 0.6, 1.1));
    }
    return stage_add(stage, build_finish(&b));
}

int suite_round(struct stage *stage, uint32_t seed, int count, double near, bool is_bold)
{
    const struct palette *palette = is_bold ? &bold : &soft;
    struct build b = build_begin(stage, BUILD_COLOR);
    b.at = xform_turn_y(0.17);
    slabs(&b, 24.1, is_bold ? 26 : 16, palette);
    for (int i = 0; i < count; i++) {
        double bearing = 2 * PI * (i + 0.7 * suite_random(&seed)) / count;
        double away = near + (22 - near) * pow(suite_random(&seed), 1.3);
        build_color(&b, palette->solid[i * 5 & 7]);
        b.at = xform_identity();
        solid(&b, &seed, away * sin(bearing), away * cos(bearing), 0.5 + 0.13 * away);
    }
    return stage_add(stage, build_finish(&b));
}

/* ------------------------------------------------------------------ movers */

/* Gouraud: the colour changes from slice to slice. */
const struct scene_surface *suite_ball(struct stage *stage, double radius, uint32_t a, uint32_t c)
{
    struct build b = build_begin(stage, BUILD_COLOR | BUILD_NORMAL);
    build_color(&b, a);
    build_ball(&b, radius, 14, 9);
    float other[4];
    build_color(&b, c);
    memcpy(other, b.color, sizeof other);
    for (int i = 0; i < b.vertex_count; i++)
        if (i % 14 / 2 % 2 == 1)
            memcpy(b.vertex_color + 4 * (size_t)i, other, sizeof other);
    return build_finish(&b);
}

const struct scene_surface *suite_crate(struct stage *stage, double half, const struct image *image)
{
    struct build b = build_begin(stage, BUILD_NORMAL | BUILD_UV);
    build_box(&b, vec3(-half, -half, -half), vec3(half, half, half));
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.image = image;
    return s;
}

/* A toy aeroplane, nose to +x, 3 m long. */
const struct scene_surface *suite_plane(struct stage *stage, uint32_t hull, uint32_t wings)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    double profile[10] = {0.05, -1.5, 0.22, -0.9, 0.36, 0.1, 0.30, 0.9, 0, 1.5};
    b.at = xform_turn_z(-PI / 2);
    build_color(&b, hull);
    build_lathe(&b, profile, 5, 8);
    build_color(&b, 0x2b3a55);
    b.at = xform_move(0.45, 0.25, 0);
    build_ball(&b, 0.24, 8, 5);
    b.at = xform_identity();
    build_color(&b, wings);
    struct vec3 span[3 * 4];
    for (int i = 0; i < 3; i++) {
        double z = 1.7 * (i - 1), back = i == 1 ? -0.35 : -0.45, front = i == 1 ? 0.55 : -0.10;
        double low = i == 1 ? -0.02 : 0.02, high = i == 1 ? 0.09 : 0.07;
        span[4 * i] = vec3(back, low, z);
        span[4 * i + 1] = vec3(front, low, z);
        span[4 * i + 2] = vec3(front, high, z);
        span[4 * i + 3] = vec3(back, high, z);
    }
    build_loft(&b, span, 3, 4);
    build_color(&b, hull);
    build_box(&b, vec3(-1.5, 0.03, -0.6), vec3(-1.1, 0.08, 0.6));
    build_color(&b, wings);
    build_box(&b, vec3(-1.5, 0.05, -0.03), vec3(-1.05, 0.75, 0.03));
    return build_finish(&b);
}

/* A saloon on the ground, nose to +x, 2.4 m long. */
const struct scene_surface *suite_car(struct stage *stage, uint32_t paint)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, paint);
    build_box(&b, vec3(-1.2, 0.22, -0.52), vec3(1.2, 0.62, 0.52));
    build_color(&b, 0x9fc4de);
    struct vec3 cabin[2 * 4] = {
        vec3(0.55, 0.62, 0.48), vec3(0.55, 0.62, -0.48), vec3(-0.85, 0.62, -0.48),
        vec3(-0.85, 0.62, 0.48), vec3(0.20, 1.02, 0.38), vec3(0.20, 1.02, -0.38),
        vec3(-0.65, 1.02, -0.38), vec3(-0.65, 1.02, 0.38),
    };
    build_loft(&b, cabin, 2, 4);
    build_color(&b, 0x1c1d22);
    for (int i = 0; i < 4; i++) {
        struct xform at = xform_move(i & 1 ? 0.75 : -0.75, 0.26, i & 2 ? 0.50 : -0.50);
        b.at = xform_mul(at, xform_turn_x(PI / 2));
        build_drum(&b, 0.26, 0.26, -0.08, 0.08, 8);
    }
    return build_finish(&b);
}

/* ------------------------------------------------------------------ helpers */

const struct image *suite_tiles(struct stage *stage, int size, int tiles, uint32_t a, uint32_t c)
{
    struct image *image = stage_image(stage, size, size);
    uint32_t state = 4711;
    for (int y = 0; image != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            uint32_t pick = (x * tiles / size + y * tiles / size) & 1 ? a : c, rgb = 0;
            double grain = between(&state, 0.86, 1.0);
            for (int shift = 0; shift <= 16; shift += 8)
                rgb |= (uint32_t)((pick >> shift & 255) * grain) << shift;
            stage_texel(image, x, y, rgb);
        }
    return image;
}

static struct vec3 read3(const float *from, uint32_t i)
{
    return vec3((double)from[3 * i], (double)from[3 * i + 1], (double)from[3 * i + 2]);
}

void suite_normals(const struct scene_surface *surface, const float *position, float *normal)
{
    memset(normal, 0, (size_t)surface->vertex_count * 3 * sizeof *normal);
    for (int t = 0; t < surface->triangle_count; t++) {
        const uint32_t *v = surface->index + 3 * (size_t)t;
        struct vec3 o = read3(position, v[0]);
        struct vec3 n = vec3_cross(vec3_sub(read3(position, v[1]), o),
                                   vec3_sub(read3(position, v[2]), o));
        for (int k = 0; k < 3; k++) {
            normal[3 * v[k]] += (float)n.x;
            normal[3 * v[k] + 1] += (float)n.y;
            normal[3 * v[k] + 2] += (float)n.z;
        }
    }
}

/* ------------------------------------------------------------------ all kinds */

/* Finds the scenes of the quality suite in the tables of its files. Each scene is as hard as its namesake of the study that picked the
 * methods: the RMSE of the sharp frame against 256 instants of a centred shutter of 180 degrees, encoded light, 8-bit codes, is within
 * 20 % of the study's (test_scenes.c holds them to it): scene ours study scene ours study scene ours study translate 9.30 9.01 fence_fg
 * 33.28 30.60 swarm 18.63 17.43 propeller 13.02 13.27 fence_obj 10.98 11.47 still 0.00 0.00 pan 18.99 19.72 enter 10.01 10.90 teleport
 * 3.15 3.06 dolly 11.09 11.82 near 9.51 9.71 textured 26.70 27.83 roll 22.85 24.67 long 18.61 17.26 morph 3.65 3.91 cross 13.10 13.87
 * subpixel 1.33 1.41 cubic 5.48 5.29 skin 6.61 6.78 arena 10.08 11.10. */

bool suite_make(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < suite_object_count; i++)
        if (strcmp(suite_object_kinds[i].name, name) == 0)
            return stage_open(suite_object_kinds, suite_object_count, name, out, f);
    return stage_open(suite_camera_kinds, suite_camera_count, name, out, f);
}
