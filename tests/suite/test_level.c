/* SPDX-License-Identifier: MIT */
/* test_level.c - meshes whose vertices have normals or colours that are the same within every triangle: they are found, and
 * drawn as flat ones are (smear_segment.flat), to the bit as by their vertices. Host only. */
#include "filter/probe.h"
#include "geometry/vertex.h"

#include "tests/rig.h"

#if SMEAR_FIND_FLAT

/* ------------------------------------------------------------------ a ball of facets */

enum { RINGS = 6, AROUND = 8, FACETS = 2 * RINGS * AROUND - 2 * AROUND, CORNERS = 3 * FACETS };

/* Every facet has three vertices of its own, and one normal and one colour. */
static int16_t ball_position[3 * CORNERS], ball_uv[2 * CORNERS];
static int8_t ball_normal[3 * CORNERS];
static uint8_t ball_color[4 * CORNERS], ball_face_color[4 * (FACETS + 1)];
static uint16_t ball_index[3 * (FACETS + 1)];

static void corner_at(double out[3], int ring, int around)
{
    const double pi = 3.14159265358979, down = pi * ring / RINGS, along = 2 * pi * around / AROUND;
    out[0] = sin(down) * sin(along);
    out[1] = cos(down);
    out[2] = sin(down) * cos(along);
}

static int add_facet(int facet, const int ring[3], const int around[3])
{
    double p[3][3], middle[3] = { 0, 0, 0 }, length = 0;
    for (int i = 0; i < 3; i++) {
        corner_at(p[i], ring[i], around[i]);
        for (int k = 0; k < 3; k++)
            middle[k] += p[i][k] / 3;
    }
    for (int k = 0; k < 3; k++)
        length += middle[k] * middle[k];
    for (int i = 0; i < 3; i++) {
        const int at = 3 * facet + i;
        for (int k = 0; k < 3; k++) {
            ball_position[3 * at + k] = (int16_t)lrint(p[i][k] * 256);
            ball_normal[3 * at + k] = (int8_t)lrint(middle[k] / sqrt(length) * 127);
            ball_color[4 * at + k] = (uint8_t)(facet * (53 + 40 * k) + 31);
        }
        ball_color[4 * at + 3] = 255;
        ball_uv[2 * at] = (int16_t)(around[i] * 4096);
        ball_uv[2 * at + 1] = (int16_t)(ring[i] * 4096);
        ball_index[at] = (uint16_t)at;
    }
    return facet + 1;
}

/* The last triangle, of vertices of two facets and without an area, is never drawn. */
static void make_ball(void)
{
    int facet = 0;
    for (int r = 0; r < RINGS; r++)
        for (int a = 0; a < AROUND; a++) {
            if (r + 1 < RINGS)
                facet = add_facet(facet, (const int[]){ r, r + 1, r + 1 }, (const int[]){ a, a, a + 1 });
            if (r > 0)
                facet = add_facet(facet, (const int[]){ r, r + 1, r }, (const int[]){ a, a + 1, a + 1 });
        }
    CHECK_EQ(facet, FACETS);
    ball_index[3 * FACETS] = ball_index[3 * FACETS + 2] = 0;
    ball_index[3 * FACETS + 1] = 3;
    for (int i = 0; i < 4 * (FACETS + 1); i++)
        ball_face_color[i] = (uint8_t)(i % 4 == 3 ? 255 : 255 - i * 7 % 128);
}

static smear_mesh ball(bool normals, bool colors, bool face_colors)
{
    return (smear_mesh){ .position = ball_position, .normal = normals ? ball_normal : NULL, .uv = ball_uv, .uv_shift = 15,
                         .color = colors ? ball_color : NULL, .face_color = face_colors ? ball_face_color : NULL,
                         .index = ball_index, .triangle_count = FACETS, .vertex_count = CORNERS, .shift = STEP };
}

/* ------------------------------------------------------------------ found */

static void test_a_mesh_is_level_where_every_facet_has_one_normal_and_one_colour(void)
{
    make_ball();
    smear_mesh bare = ball(false, false, false), normals = ball(true, false, false), colors = ball(false, true, false),
               both = ball(true, true, false);
    CHECK(!smear_vertex_is_flat(&bare, true));         /* is flat as it is */
    CHECK(smear_vertex_is_flat(&normals, true));
    CHECK(!smear_vertex_is_flat(&normals, false));     /* nobody looks at them: likewise */
    CHECK(smear_vertex_is_flat(&colors, true));
    CHECK(smear_vertex_is_flat(&both, true));
    for (int k = 0; k < 7; k++) {       /* a component of a vertex other by one step */
        const int vertex = 3 * (FACETS / 2) + k % 3;
        if (k < 3)
            ball_normal[3 * vertex + k]--;
        else
            ball_color[4 * vertex + k - 3]--;
        CHECK(!smear_vertex_is_flat(&both, true));
        CHECK_EQ(smear_vertex_is_flat(&both, false), k < 3);
        CHECK_EQ(smear_vertex_is_flat(&normals, true), k >= 3);
        CHECK_EQ(smear_vertex_is_flat(&colors, true), k < 3);
        if (k < 3)
            ball_normal[3 * vertex + k]++;
        else
            ball_color[4 * vertex + k - 3]++;
    }
    both.triangle_count = FACETS + 1;
    CHECK(!smear_vertex_is_flat(&both, true));
    both.triangle_count = FACETS;
    for (int i = 0; i < 3; i++) {       /* a vertex that the mesh has not */
        const uint16_t kept = ball_index[CORNERS - 3 + i];
        ball_index[CORNERS - 3 + i] = CORNERS;
        CHECK(!smear_vertex_is_flat(&both, true));
        ball_index[CORNERS - 3 + i] = kept;
    }
}

/* ------------------------------------------------------------------ drawn */

static const uint8_t methods[] = { SMEAR_NONE, SMEAR_ACCUMULATE, SMEAR_RECONSTRUCT, SMEAR_SUBFRAMES, SMEAR_TIMEMASK,
                                   SMEAR_AUTO, SMEAR_OBJECT, SMEAR_LAYERED };

/* As a whole; of facets of a pixel; cut by the near plane; in a mirror. */
static smear_transform place_of(int kind, int frame)
{
    smear_transform pose = kind == 1 ? pose_at(0.3 * frame, 0, -9, 0.2, 0.3)
                         : kind == 2 ? pose_at(0.1 * frame, 0.2, -1.02, 0.2, 0.3)
                                     : pose_at(0.2 * frame, 0.1, -2.5, 0.4 + 0.1 * frame, 0.3);
    for (int i = 0; i < 9 && kind == 3; i += 3)
        pose.basis[i] = -pose.basis[i];
    return pose;
}

/* The picture of the second of two frames; whether its draw was level, and what its geometry took. */
struct taken {
    uint8_t *picture;
    bool level;
    uint32_t words, drawn, split;
};

static struct taken take(const smear_desc *desc, uint8_t method, uint8_t light, int kind, const smear_mesh *mesh,
                         const smear_material *material)
{
    struct taken t = { 0 };
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_frame frame = { .camera = &camera, .method = method, .light_space = light, .clear = 0x204060, .samples = 8 };
    RIG(r, desc, false);
    for (int i = 0; i < 2; i++) {
        const smear_transform pose = place_of(kind, i);
        const smear_draw draw = { .id = 1, .mesh = mesh, .material = material, .now = &pose };
        free(t.picture);
        t.picture = rig_copy(&r, &frame, &draw, 1);
    }
    smear_stats stats;
    smear_get_stats(r.ctx, &stats);
    t.level = smear_probe(r.ctx).rows->bins.segment[0].flat != 0;
    t.words = smear_probe(r.ctx).rows->bins.vertex_words;
    t.drawn = stats.triangles_drawn;
    t.split = stats.parts_added;
    return t;
}

/* Draws the mesh, then with a triangle that nobody sees but that is not level. */
static void compare(const smear_desc *desc, uint8_t method, uint8_t light, int kind, smear_mesh mesh,
                    const smear_material *material)
{
    const size_t size = (size_t)desc->width * (size_t)desc->height * 4;
    struct taken level = take(desc, method, light, kind, &mesh, material);
    mesh.triangle_count++;
    struct taken uneven = take(desc, method, light, kind, &mesh, material);
    /* Texels are lit by the code of a colour, not by the light of its vertices. */
    const bool textured = material->texture != NULL && mesh.uv != NULL;
    const bool wants = (light == SMEAR_LIGHT_ENCODED || !textured) && material->alpha == SMEAR_OPAQUE
                    && (mesh.color != NULL || (mesh.normal != NULL && !material->unlit));
    bool ok = CHECK_EQ(level.level, wants) && CHECK(!uneven.level) && CHECK_EQ(level.words, uneven.words)
           && CHECK_EQ(level.drawn, uneven.drawn) && CHECK_EQ(level.split, uneven.split) && CHECK(level.drawn > 0);
    if (level.picture != NULL && uneven.picture != NULL)
        ok = CHECK(memcmp(level.picture, uneven.picture, size) == 0) && ok;
    if (!ok)
        CHECK_EQ(method * 1000 + kind * 100 + light * 10 + material->unlit, -1);        /* which it was */
    free(level.picture);
    free(uneven.picture);
}

static smear_desc desc_of_all(void)
{
    return (smear_desc){ .width = 64, .height = 48, .reach = 8, .max_triangles = 400, .max_draws = 2,
                         .methods = SMEAR_SET_FILTERS | SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_ACCUMULATE),
                         .format = SMEAR_XRGB8888 };
}

static void test_level_draws_are_to_the_bit_what_their_vertices_give(void)
{
    const smear_desc desc = desc_of_all();
    make_ball();
    make_checker();
    for (unsigned m = 0; m < sizeof methods; m++)
        for (int kind = 0; kind < 4; kind++)
            for (int i = 0; i < 16; i++) {
                const smear_material material = { .unlit = (i & 4) != 0, .color = { 200, 255, 180, 255 },
                                                  .texture = (i & 8) != 0 ? &checker_texture : NULL };
                const smear_mesh mesh = ball((i & 3) != 1, (i & 3) != 0, (i & 3) == 3);
                compare(&desc, methods[m], SMEAR_LIGHT_ENCODED, kind, mesh, &material);
                compare(&desc, methods[m], SMEAR_LIGHT_LINEAR, kind, mesh, &material);
            }
}

/* Half of the ball is gone: its inside is seen, lit from behind. */
static void test_level_draws_seen_from_behind_are_what_their_vertices_give(void)
{
    const smear_desc desc = desc_of_all();
    const smear_material material = { .double_sided = 1 };
    make_ball();
    smear_mesh mesh = ball(true, true, false);
    memmove(ball_index, ball_index + 3 * (FACETS / 2), sizeof ball_index - 3 * (FACETS / 2) * sizeof *ball_index);
    mesh.triangle_count = FACETS - FACETS / 2;
    for (unsigned m = 0; m < sizeof methods; m++)
        for (int kind = 0; kind < 4; kind++) {
            compare(&desc, methods[m], SMEAR_LIGHT_ENCODED, kind, mesh, &material);
            compare(&desc, methods[m], SMEAR_LIGHT_LINEAR, kind, mesh, &material);
        }
}

static void test_level_draws_find_as_much_room_as_others(void)
{
    smear_desc desc = desc_of_all();
    const smear_material material = { 0 };
    desc.max_triangles = 20;
    make_ball();
    const smear_mesh mesh = ball(true, true, false);
    struct taken t = take(&desc, SMEAR_NONE, SMEAR_LIGHT_ENCODED, 0, &mesh, &material);
    CHECK(t.level);
    CHECK(t.split > 0);
    free(t.picture);
    for (unsigned m = 0; m < sizeof methods; m++)
        if (methods[m] != SMEAR_TIMEMASK)               /* which needs all of a tile's at once */
            compare(&desc, methods[m], SMEAR_LIGHT_ENCODED, 0, mesh, &material);
}

/* Alpha may be interpolated. */
static void test_only_opaque_draws_are_level(void)
{
    const smear_desc desc = desc_of_all();
    make_ball();
    for (unsigned m = 0; m < sizeof methods; m++)
        for (uint8_t alpha = SMEAR_OPAQUE; alpha <= SMEAR_BLEND; alpha++)
            for (uint8_t light = SMEAR_LIGHT_LINEAR; light <= SMEAR_LIGHT_ENCODED; light++) {
                const smear_material material = { .alpha = alpha, .color = { 255, 255, 255, 190 } };
                compare(&desc, methods[m], light, 0, ball(true, true, false), &material);
            }
}

#endif

#include "build/suites/level.h"
