/* SPDX-License-Identifier: MIT */
/* peers.c - the scenes peer/A .. peer/N by which software rasterizers are compared: same
 * geometry, same frames, same texture as every other renderer that was measured. Frame k is the
 * instant k/30.
 *
 * All of them: camera at the origin along -z, 60 degrees, near 0.25, far 64, clear (16, 24, 48);
 * unlit but for those called -lit, which have normals and the library's default light; one draw
 * (G: 169), whose model-view is T(t) Rx(ax) Ry(ay) T(p). Colours are given as display codes. */
#include "tools/scenes/builtin.h"

#include "tools/scenes/build.h"
#include "tools/scenes/color.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* ------------------------------------------------------------------ common */

static uint32_t hash(uint32_t x, uint32_t y)
{
    uint32_t h = x * 73856093u ^ y * 19349663u;
    h ^= h >> 13;
    h *= 2654435761u;
    return h >> 16;
}

static double rnd(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

static void hash_color(uint32_t a, uint32_t b, float out[4])
{
    uint32_t h = hash(a, b);
    color_from_codes(64 + (h & 127), 64 + (h >> 4 & 127), 64 + (h >> 8 & 127), out);
}

static const struct image *peer_texture(struct stage *stage, int size)
{
    struct image *image = stage_image(stage, size, size);
    for (int y = 0; image != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            uint32_t c = (uint32_t)(16 * x / size ^ 16 * y / size) & 1;
            uint32_t h = hash((uint32_t)x, (uint32_t)y) & 31;
            uint32_t r = 64 + 128 * c + h, g = 40 + (uint32_t)(160 * x / size) + h;
            uint32_t b = 40 + (uint32_t)(160 * y / size) + h;
            stage_texel(image, x, y, r << 16 | g << 8 | b);
        }
    return image;
}

static const struct scene_surface *peer_surface(struct build *b, const struct image *texture)
{
    const bool lit = (b->parts & BUILD_NORMAL) != 0;
    struct scene_surface *surface = build_finish(b);
    if (surface != NULL) {
        surface->material.unlit = !lit;
        surface->material.image = texture;
    }
    return surface;
}

static void finish_peer(struct build *b, const struct image *texture)
{
    struct stage *stage = b->stage;
    stage_add(stage, peer_surface(b, texture));
}

static uint32_t point(struct build *b, double x, double y, double z, double u, double v)
{
    return build_vertex(b, vec3(x, y, z), vec3(0, 0, 0), u, v);
}

/* nu x nv squares with four vertices each, over o + a i/nu + b j/nv; each shows the whole
 * texture. */
static void patch(struct build *b, struct vec3 o, struct vec3 along, struct vec3 up, int nu, int nv)
{
    for (int j = 0; j < nv; j++)
        for (int i = 0; i < nu; i++) {
            uint32_t q[4];
            for (int k = 0; k < 4; k++) {
                int right = k == 1 || k == 2, high = k >= 2;
                struct vec3 p = vec3_add(o, vec3_add(vec3_scale(along, (double)(i + right) / nu),
                                                     vec3_scale(up, (double)(j + high) / nv)));
                q[k] = point(b, p.x, p.y, p.z, right ? 0.98 : 0.02, high ? 0.98 : 0.02);
            }
            build_triangle(b, q[0], q[1], q[2]);
            build_triangle(b, q[0], q[2], q[3]);
        }
}

static void place_draw(struct scene_instant *out, int draw, struct vec3 t, double ax, double ay, struct vec3 p)
{
    struct xform turn = xform_mul(xform_turn_x(ax), xform_turn_y(ay));
    stage_place(out, draw, xform_mul(xform_move(t.x, t.y, t.z),
                                     xform_mul(turn, xform_move(p.x, p.y, p.z))));
}

static void place(struct scene_instant *out, struct vec3 t, double ax, double ay, struct vec3 p)
{
    place_draw(out, 0, t, ax, ay, p);
}

/* ------------------------------------------------------------------ A: 70,000 Gouraud triangles */

enum { A_RINGS = 175, A_COLUMNS = 200 };

static uint32_t bumpy_vertex(struct build *b, double theta, double phi, double u, double v)
{
    double r = 1 + 0.08 * sin(5 * theta) * cos(4 * phi) + 0.03 * sin(11 * theta) * cos(9 * phi);
    return point(b, r * sin(theta) * cos(phi), r * cos(theta), r * sin(theta) * sin(phi), u, v);
}

static uint32_t a_vertex(struct build *b, double theta, double phi)
{
    return bumpy_vertex(b, theta, phi, 0, 0);
}

/* Index of column j, which wraps, of ring i = 1..175; the top pole is vertex 0. */
static uint32_t a_ring(int i, int j)
{
    return (uint32_t)(1 + (i - 1) * A_COLUMNS + j % A_COLUMNS);
}

static struct vec3 position_of(const struct build *b, uint32_t v)
{
    const float *p = b->position + 3 * (size_t)v;
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

/* Normals of vertices: the sums of their triangles', weighed by area. */
static void find_normals(struct build *b)
{
    for (int i = 0; i < 3 * b->vertex_count; i++)
        b->normal[i] = 0;
    for (int t = 0; t < b->triangle_count; t++) {
        const uint32_t *v = b->index + 3 * (size_t)t;
        struct vec3 o = position_of(b, v[0]);
        struct vec3 n = vec3_cross(vec3_sub(position_of(b, v[1]), o),
                                   vec3_sub(position_of(b, v[2]), o));
        for (int k = 0; k < 3; k++) {
            float *sum = b->normal + 3 * (size_t)v[k];
            sum[0] += (float)n.x;
            sum[1] += (float)n.y;
            sum[2] += (float)n.z;
        }
    }
}

/* Light is part of the vertex colours: the scene measures interpolation, not lighting. */
static void a_colors(struct build *b)
{
    struct vec3 light = vec3_unit(vec3(0.4, 0.7, 0.6));
    find_normals(b);
    for (int i = 0; i < b->vertex_count; i++) {
        const float *sum = b->normal + 3 * (size_t)i;
        struct vec3 n = vec3_unit(vec3((double)sum[0], (double)sum[1], (double)sum[2]));
        double shade = 0.2 + 0.8 * fmax(0, vec3_dot(n, light));
        color_from_codes(floor(255 * shade), floor(200 * shade), floor(140 * shade),
                         b->vertex_color + 4 * (size_t)i);
    }
}

static void a_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    uint32_t top = a_vertex(&b, 0, 0);
    for (int i = 1; i <= A_RINGS; i++)
        for (int j = 0; j < A_COLUMNS; j++)
            a_vertex(&b, PI * i / (A_RINGS + 1), 2 * PI * j / A_COLUMNS);
    uint32_t bottom = a_vertex(&b, PI, 0);

    for (int j = 0; j < A_COLUMNS; j++)
        build_triangle(&b, top, a_ring(1, j + 1), a_ring(1, j));
    for (int i = 1; i < A_RINGS; i++)
        for (int j = 0; j < A_COLUMNS; j++) {
            build_triangle(&b, a_ring(i, j), a_ring(i, j + 1), a_ring(i + 1, j));
            build_triangle(&b, a_ring(i, j + 1), a_ring(i + 1, j + 1), a_ring(i + 1, j));
        }
    for (int j = 0; j < A_COLUMNS; j++)
        build_triangle(&b, bottom, a_ring(A_RINGS, j), a_ring(A_RINGS, j + 1));
    if (!b.failed)
        a_colors(&b);
    finish_peer(&b, NULL);
}

static void a_move(double time, struct scene_instant *out)
{
    place(out, vec3(0, 0, -2.5), 0.35, 0.3 + 0.1 * (time * 30), vec3(0, 0, 0));
}

/* ------------------------------------------------------------------ B: a textured room */

static void b_build(struct stage *stage, int texture_size)
{
    struct build b = build_begin(stage, BUILD_UV);
    patch(&b, vec3(-6, 0, 6), vec3(12, 0, 0), vec3(0, 0, -12), 8, 8);
    patch(&b, vec3(-6, 4, -6), vec3(12, 0, 0), vec3(0, 0, 12), 8, 8);
    patch(&b, vec3(-6, 0, -6), vec3(12, 0, 0), vec3(0, 4, 0), 8, 4);
    patch(&b, vec3(6, 0, 6), vec3(-12, 0, 0), vec3(0, 4, 0), 8, 4);
    patch(&b, vec3(-6, 0, 6), vec3(0, 0, -12), vec3(0, 4, 0), 8, 4);
    patch(&b, vec3(6, 0, -6), vec3(0, 0, 12), vec3(0, 4, 0), 8, 4);

    uint32_t state = 12345;
    for (int j = 0; j < 5; j++)
        for (int i = 0; i < 5; i++) {
            double cx = -4.4 + 2.2 * i, cz = -4.4 + 2.2 * j;
            double hw = 0.40 + 0.26 * rnd(&state), w = 2 * hw, h = 1.0 + 2.4 * rnd(&state);
            double x0 = cx - hw, x1 = cx + hw, z0 = cz - hw, z1 = cz + hw;
            patch(&b, vec3(x0, 0, z1), vec3(w, 0, 0), vec3(0, h, 0), 2, 2);
            patch(&b, vec3(x1, 0, z0), vec3(-w, 0, 0), vec3(0, h, 0), 2, 2);
            patch(&b, vec3(x1, 0, z1), vec3(0, 0, -w), vec3(0, h, 0), 2, 2);
            patch(&b, vec3(x0, 0, z0), vec3(0, 0, w), vec3(0, h, 0), 2, 2);
            patch(&b, vec3(x0, h, z1), vec3(w, 0, 0), vec3(0, 0, -w), 2, 2);
        }
    finish_peer(&b, peer_texture(stage, texture_size));
}

static void b64_build(struct stage *stage)
{
    b_build(stage, 64);
}

static void b256_build(struct stage *stage)
{
    b_build(stage, 256);
}

static void b_move(double time, struct scene_instant *out)
{
    place(out, vec3(0, 0, 0), 0.18, 0.785398 + 0.06 * (time * 30 - 3.5), vec3(5.75, -2.3, -5.75));
}

/* ------------------------------------------------------------------ C: twenty layers over the
 * whole screen */

static void c_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_UV);
    double c = cos(25 * PI / 180), s = sin(25 * PI / 180);
    for (int k = 0; k < 20; k++) {
        double d = 12 - 0.5 * k, u0 = -0.8 * d, u1 = 1.6 * d, v0 = -1.1 * d, v1 = 1.1 * d;
        uint32_t q0 = point(&b, u0 * c, v0, -d - u0 * s, 0.02, 0.02);
        uint32_t q1 = point(&b, u1 * c, v0, -d - u1 * s, 0.98, 0.02);
        uint32_t q2 = point(&b, u1 * c, v1, -d - u1 * s, 0.98, 0.98);
        uint32_t q3 = point(&b, u0 * c, v1, -d - u0 * s, 0.02, 0.98);
        build_triangle(&b, q0, q1, q2);
        build_triangle(&b, q0, q2, q3);
    }
    finish_peer(&b, peer_texture(stage, 256));
}

static void c_move(double time, struct scene_instant *out)
{
    place(out, vec3(0, 0, 0), 0, 0.004 * (time * 30), vec3(0, 0, 0));
}

/* ------------------------------------------------------------------ D: 51,200 flat triangles of
 * a pixel or two */

enum { D_EDGE = 161 };

static void d_triangle(struct build *b, int a, int c, int d)
{
    hash_color((uint32_t)(d % D_EDGE), (uint32_t)(d / D_EDGE), b->color);
    build_triangle(b, (uint32_t)a, (uint32_t)c, (uint32_t)d);
}

static void d_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    for (int j = 0; j < D_EDGE; j++)
        for (int i = 0; i < D_EDGE; i++) {
            double x = -1.5 + 3.0 * i / 160, y = -1.12 + 2.24 * j / 160;
            point(&b, x, y, 0.15 * sin(6 * x) * cos(7 * y), 0, 0);
        }
    for (int row = 0; row < D_EDGE - 1; row++)
        for (int column = 0; column < D_EDGE - 1; column++) {
            int a = row * D_EDGE + column;
            d_triangle(&b, a, a + 1, a + D_EDGE + 1);
            d_triangle(&b, a, a + D_EDGE + 1, a + D_EDGE);
        }
    finish_peer(&b, NULL);
}

static void d_move(double time, struct scene_instant *out)
{
    place(out, vec3(0, 0, -2), 0.02 * (time * 30), 0, vec3(0, 0, 0));
}

/* ------------------------------------------------------------------ E: 64 icosahedra, flat */

static const uint8_t icosahedron[20][3] = {
    {0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8},
    {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1},
};

static void e_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    double g = (1 + sqrt(5.0)) / 2;
    const double base[12][3] = {
        {-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
        {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1},
    };
    double scale = 0.62 / sqrt(1 + g * g);
    uint32_t state = 777;
    for (uint32_t object = 0; object < 64; object++) {
        double z = -2.6 - 6 * rnd(&state);
        double x = (2 * rnd(&state) - 1) * 0.62 * -z;
        double y = (2 * rnd(&state) - 1) * 0.45 * -z;
        double turn = 6.28 * rnd(&state), c = cos(turn), s = sin(turn);
        uint32_t first = 0;
        for (int i = 0; i < 12; i++) {
            double px = base[i][0] * scale, py = base[i][1] * scale, pz = base[i][2] * scale;
            uint32_t v = point(&b, x + px * c + pz * s, y + py, z + 5 - px * s + pz * c, 0, 0);
            if (i == 0)
                first = v;
        }
        for (uint32_t face = 0; face < 20; face++) {
            hash_color(object, face, b.color);
            build_triangle(&b, first + icosahedron[face][0], first + icosahedron[face][1],
                           first + icosahedron[face][2]);
        }
    }
    finish_peer(&b, NULL);
}

static void e_move(double time, struct scene_instant *out)
{
    place(out, vec3(0, 0, -5), 0.02 * (time * 30), 0.03 * (time * 30), vec3(0, 0, 0));
}

/* ------------------------------------------------------------------ F: 10,500 small textured
 * triangles, on the surface of A */

enum { F_RINGS = 75, F_COLUMNS = 70 };

/* The seam has vertices of its own, and so has each triangle at a pole. */
static uint32_t f_corner(int ring, int column)
{
    return (uint32_t)(ring * (F_COLUMNS + 1) + column);
}

static void f_make(struct stage *stage, unsigned parts)
{
    struct build b = build_begin(stage, parts);
    for (int i = 0; i <= F_RINGS + 1; i++)
        for (int j = 0; j <= F_COLUMNS; j++)
            bumpy_vertex(&b, PI * i / (F_RINGS + 1), 2 * PI * (j % F_COLUMNS) / F_COLUMNS,
                         0.02 + 0.96 * j / F_COLUMNS, 0.02 + 0.96 * i / (F_RINGS + 1));
    for (int i = 0; i <= F_RINGS; i++)
        for (int j = 0; j < F_COLUMNS; j++) {
            if (i < F_RINGS)
                build_triangle(&b, f_corner(i + 1, j), f_corner(i, j + 1), f_corner(i + 1, j + 1));
            if (i > 0)
                build_triangle(&b, f_corner(i, j), f_corner(i, j + 1), f_corner(i + 1, j));
        }
    if (!b.failed && (parts & BUILD_NORMAL) != 0)
        find_normals(&b);
    finish_peer(&b, peer_texture(stage, 256));
}

static void f_build(struct stage *stage)
{
    f_make(stage, BUILD_UV);
}

static void f_lit_build(struct stage *stage)
{
    f_make(stage, BUILD_UV | BUILD_NORMAL);
}

/* ------------------------------------------------------------------ G: 169 towers of 360 textured
 * triangles */

enum { G_ROWS = 8, G_SIDES = 24, G_EDGE = 13 };

static void g_make(struct stage *stage, unsigned parts)
{
    struct build b = build_begin(stage, parts);
    for (int i = 0; i < G_ROWS; i++)
        for (int j = 0; j <= G_SIDES; j++) {
            double a = 2 * PI * (j % G_SIDES) / G_SIDES;
            point(&b, 0.35 * cos(a), i / 7.0, 0.35 * sin(a), 0.02 + 0.96 * j / G_SIDES, 0.02 + 0.96 * i / 7.0);
        }
    for (int i = 0; i < G_ROWS - 1; i++)
        for (int j = 0; j < G_SIDES; j++) {
            uint32_t here = (uint32_t)(i * (G_SIDES + 1) + j), above = here + G_SIDES + 1;
            build_triangle(&b, here, above, here + 1);
            build_triangle(&b, here + 1, above, above + 1);
        }
    uint32_t top = point(&b, 0, 1, 0, 0.5, 0.5);
    for (int j = 0; j < G_SIDES; j++) {
        double a = 2 * PI * j / G_SIDES;
        point(&b, 0.35 * cos(a), 1, 0.35 * sin(a), 0.5 + 0.48 * cos(a), 0.5 + 0.48 * sin(a));
    }
    for (uint32_t j = 0; j < G_SIDES; j++)
        build_triangle(&b, top, top + 1 + (j + 1) % G_SIDES, top + 1 + j);
    if (!b.failed && (parts & BUILD_NORMAL) != 0)
        find_normals(&b);
    const struct scene_surface *tower = peer_surface(&b, peer_texture(stage, 256));
    for (int i = 0; i < G_EDGE * G_EDGE; i++)
        stage_add(stage, tower);
}

static void g_build(struct stage *stage)
{
    g_make(stage, BUILD_UV);
}

static void g_lit_build(struct stage *stage)
{
    g_make(stage, BUILD_UV | BUILD_NORMAL);
}

static void g_move(double time, struct scene_instant *out)
{
    for (int j = 0; j < G_EDGE; j++)
        for (int i = 0; i < G_EDGE; i++)
            place_draw(out, j * G_EDGE + i, vec3(0, -1.2, -5), 0.35, 0.2 + 0.1 * (time * 30),
                       vec3(1.2 * (i - 6), 0, 1.2 * (j - 6)));
}

/* ------------------------------------------------------------------ N: a floor that passes
 * behind the camera */

static void n_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_UV);
    uint32_t q0 = point(&b, -20, -0.5, 20, 0.02, 0.02), q1 = point(&b, 20, -0.5, 20, 0.98, 0.02);
    uint32_t q2 = point(&b, 20, -0.5, -20, 0.98, 0.98), q3 = point(&b, -20, -0.5, -20, 0.02, 0.98);
    build_triangle(&b, q0, q1, q2);
    build_triangle(&b, q0, q2, q3);
    finish_peer(&b, peer_texture(stage, 256));
}

static void n_move(double time, struct scene_instant *out)
{
    place(out, vec3(0, 0, 0), 0.1, 0.1 + 0.3 * (time * 30), vec3(0, 0, 0));
}

/* ------------------------------------------------------------------ */

#define PEER_CLEAR 0x101830u

static const struct stage_kind peer_kinds[] = {
    {"peer/A", 320, 240, 0, PEER_CLEAR, a_build, a_move},
    {"peer/B64", 320, 240, 0, PEER_CLEAR, b64_build, b_move},
    {"peer/B256", 320, 240, 0, PEER_CLEAR, b256_build, b_move},
    {"peer/C", 320, 240, 0, PEER_CLEAR, c_build, c_move},
    {"peer/D", 320, 240, 0, PEER_CLEAR, d_build, d_move},
    {"peer/E", 320, 240, 0, PEER_CLEAR, e_build, e_move},
    {"peer/F", 320, 240, 0, PEER_CLEAR, f_build, a_move},
    {"peer/F-lit", 320, 240, 0, PEER_CLEAR, f_lit_build, a_move},
    {"peer/G", 320, 240, 0, PEER_CLEAR, g_build, g_move},
    {"peer/G-lit", 320, 240, 0, PEER_CLEAR, g_lit_build, g_move},
    {"peer/N", 320, 240, 0, PEER_CLEAR, n_build, n_move},
};

bool peer_make(const char *name, struct scene *out, struct failure *f)
{
    return stage_open(peer_kinds, sizeof peer_kinds / sizeof *peer_kinds, name, out, f);
}
