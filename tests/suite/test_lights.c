/* SPDX-License-Identifier: MIT */
/* test_lights.c - smear_scene.lights against double precision, vertex by vertex and face by face: rotations, scales, shears, lamps near
 * and far, highlights. Lights that reach nothing change no bit; workers, rooms and methods none either. Host only. */
#include "smear_scene.h"

#include "geometry/vertex.h"
#include "tests/rig.h"

enum { LOOKS = 20000 };

/* ------------------------------------------------------------------ one triangle under lights */

struct case_of_light {
    int16_t position[9];
    int8_t normal[9];
    uint16_t index[3];
    smear_mesh mesh;
    smear_material material;
    smear_transform pose;
    smear_light light;
    smear_lights lights;
    smear_camera camera;
    bool has_normals, back;
};

/* The basis and what turns normals, in doubles. */
static void matrix_of(double m[9], double cofactor[9], const smear_transform *t)
{
    for (int i = 0; i < 9; i++)
        m[i] = t->basis[i] / 16777216.0;
    double det = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactor[3 * i + j] = m[3 * i1 + j1] * m[3 * i2 + j2] - m[3 * i1 + j2] * m[3 * i2 + j1];
        }
    for (int j = 0; j < 3; j++)
        det += m[j] * cofactor[j];
    for (int i = 0; i < 9 && det < 0; i++)
        cofactor[i] = -cofactor[i];
}

static void times_matrix(double out[3], const double m[9], const double v[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}

/* The light of channels by the words of smear_scene.h. */
static void want_of(double want[3], const struct case_of_light *c, int corner)
{
    double m[9], cofactor[9], n[3], p[3], world[3], at[3];
    matrix_of(m, cofactor, &c->pose);
    const double scale = (c->mesh.scale > 0 ? c->mesh.scale : 1) * pow(2, -c->mesh.shift);
    if (c->has_normals) {
        for (int i = 0; i < 3; i++) {
            n[i] = c->normal[3 * corner + i];
            p[i] = (c->position[3 * corner + i] + c->mesh.offset[i]) * scale;
        }
    } else {
        double u[3], v[3];
        for (int i = 0; i < 3; i++) {
            u[i] = c->position[3 + i] - c->position[i];
            v[i] = c->position[6 + i] - c->position[i];
            p[i] = ((c->position[i] + c->position[3 + i] + c->position[6 + i]) / 3.0 + c->mesh.offset[i]) * scale;
        }
        cross3(n, u, v);
    }
    times_matrix(world, cofactor, n);
    unit3(world);
    times_matrix(at, m, p);
    double way[3], sun[3], second[3], half[3], squares = 0;
    for (int i = 0; i < 3; i++) {
        world[i] = c->back ? -world[i] : world[i];
        at[i] += c->pose.origin[i] / 65536.0;
        way[i] = (c->lights.lamp[i] / 65536.0 - at[i]) / (c->lights.reach / 65536.0);
        squares += way[i] * way[i];
        sun[i] = c->light.direction[i];
        second[i] = c->lights.direction[i];
    }
    unit3(sun);
    unit3(second);
    for (int i = 0; i < 3; i++)
        half[i] = sun[i] + c->camera.pose.basis[3 * i + 2] / 16777216.0;
    unit3(half);
    const double lamp = c->lights.reach > 0 && squares < 1 ? 6.69 * fmax(0, dot3(world, way)) * pow(1 - squares, 8) : 0;
    const int shine = c->material.shine == 0 ? 5 : c->material.shine > 10 ? 10 : c->material.shine;
    const double on_top = dot3(world, sun) > 0
                        ? c->material.gloss / 255.0 * pow(fmax(0, dot3(world, half)), pow(2, shine)) : 0;
    for (int i = 0; i < 3; i++) {
        const double light = c->light.ambient[i] + c->light.diffuse[i] * fmax(0, dot3(world, sun))
                           + c->lights.diffuse[i] * fmax(0, dot3(world, second)) + c->lights.lamp_diffuse[i] * lamp;
        want[i] = fmin(1, light_of(c->material.color[i]) * fmin(1, light / 65535) + c->light.diffuse[i] / 65535.0 * on_top);
    }
}

/* What the library makes of it. Returns false where it has nothing to add to the sun. */
static bool got_of(double got[3], const struct case_of_light *c, int corner)
{
    struct smear_lights_used used;
    struct smear_sun sun;
    static struct smear_assembly d;
    struct smear_color color;
    smear_sun_make(&sun, &c->light);
    c->lights.shader->begin(&used, &c->lights, &sun, &c->camera);
    d = (struct smear_assembly){ .mesh = &c->mesh, .material = &c->material, .at.position = c->mesh.position };
    smear_shading_make(&d.shading, &c->pose, &c->material, c->has_normals, TRANSFER_LINEAR, &sun);
    const bool lit = used.by->draw(&d.lights, &used, &d, &c->pose);
    d.shading.lit = lit ? 2 : 1;
    const struct smear_face face = smear_face_of(&d, 0, c->back);
    if (!lit)
        smear_shade(&color, &d.shading, NULL, NULL,
                    c->has_normals ? smear_light_normal(&d.shading, c->normal + 3 * corner) : face.cosine);
    else if (c->has_normals)
        d.lights.vertex(&color, &d, (uint32_t)corner, &face);
    else
        used.by->face(&color, &d, &face);
    for (int i = 0; i < 3; i++)
        got[i] = color.channel[i] / 65535.0;
    return lit;
}

/* A normal of 127 whose rounding the reference has, too. */
static void random_normal(int8_t n[3])
{
    double v[3], length;
    do {
        for (int i = 0; i < 3; i++)
            v[i] = uniform(-1, 1);
        length = dot3(v, v);
    } while (length < 0.1 || length > 1);
    unit3(v);
    for (int i = 0; i < 3; i++)
        n[i] = (int8_t)lrint(127 * v[i]);
}

static struct case_of_light random_case(void)
{
    struct case_of_light c = { .index = { 0, 1, 2 }, .has_normals = chance(2), .back = chance(4) };
    const double units = pow(10, uniform(-1, 2));
    const int steps = 1 << between(5, 14);
    double far;
    const double scale = chance(3) ? 1 : pow(10, uniform(-1, 0.7));
    random_rotation(c.pose.basis, scale);
    for (int k = between(0, 8), i = 0; i < 3 && k < 3; i++)         /* longer along an axis of the object */
        c.pose.basis[3 * i + k] = (int32_t)(c.pose.basis[3 * i + k] * (k == 0 ? -1.6 : 0.6));
    for (int i = 0; i < 9; i++)
        c.position[i] = (int16_t)between(-steps, steps);
    for (int i = 0; i < 3; i++) {
        random_normal(c.normal + 3 * i);
        c.pose.origin[i] = q16(uniform(-20, 20));
        c.light.direction[i] = q16(uniform(-1, 1));
        c.light.ambient[i] = (uint16_t)between(0, 10000);
        c.light.diffuse[i] = (uint16_t)between(0, 40000);
        c.lights.direction[i] = q16(uniform(-1, 1));
        c.lights.diffuse[i] = (uint16_t)(chance(2) ? between(0, 40000) : 0);
        c.lights.lamp_diffuse[i] = (uint16_t)between(0, 65535);
        c.material.color[i] = (uint8_t)between(20, 255);
        c.mesh.offset[i] = chance(2) ? between(-steps, steps) : 0;
    }
    c.material.color[3] = 255;
    c.material.gloss = (uint8_t)(chance(2) ? between(0, 255) : 0);
    c.material.shine = (uint8_t)between(0, 7);
    c.mesh.shift = (int8_t)between(0, 12);
    c.mesh.scale = (int32_t)fmax(1, units * pow(2, c.mesh.shift) / steps);
    c.mesh.vertex_count = 3;
    c.mesh.triangle_count = 1;
    random_rotation(c.camera.pose.basis, 1);
    /* The lamp lies about a corner, at a part of its reach. */
    far = uniform(0.02, 1.1);
    c.lights.shader = &smear_lights_shader;
    double m[9], cofactor[9], p[3], at[3], away[3];
    matrix_of(m, cofactor, &c.pose);
    for (int i = 0; i < 3; i++) {
        p[i] = (c.position[i] + c.mesh.offset[i]) * (double)c.mesh.scale * pow(2, -c.mesh.shift);
        away[i] = uniform(-1, 1);
    }
    times_matrix(at, m, p);
    const double size = steps * (double)c.mesh.scale * pow(2, -c.mesh.shift) * (fabs(m[0]) + fabs(m[1]) + fabs(m[2]));
    c.lights.reach = q16(fmin(fmax(pow(10, uniform(-1.5, 1.5)) * size, 0.05), 1000));
    unit3(away);
    for (int i = 0; i < 3; i++)
        c.lights.lamp[i] = q16(fmin(fmax((c.pose.origin[i] + away[i] * far * c.lights.reach) / 65536.0 + at[i], -30000), 30000));
    return c;
}

static void aim(struct case_of_light *c)
{
    c->mesh.position = c->position;
    c->mesh.normal = c->has_normals ? c->normal : NULL;
    c->mesh.index = c->index;
}

static void test_light_is_that_of_double_precision_within_a_code_and_a_half(void)
{
    random_state = 43;
    double worst = 0, sum = 0;
    int lit = 0;
    for (int n = 0; n < LOOKS && test_state.failures_here == 0; n++) {
        struct case_of_light c = random_case();
        double want[3], got[3];
        aim(&c);
        lit += got_of(got, &c, 0);
        want_of(want, &c, 0);
        for (int i = 0; i < 3; i++) {
            const double off = fabs(code_of(got[i]) - code_of(want[i]));
            worst = fmax(worst, off);
            sum += off * off;
            if (getenv("SMEAR_LIGHTS") != NULL && off > 1.5)
                printf("%d: %g, got %g want %g, normals %d back %d gloss %d shine %d reach %g scale %d shift %d\n", n, off,
                       code_of(got[i]), code_of(want[i]), c.has_normals, c.back, c.material.gloss, c.material.shine,
                       c.lights.reach / 65536.0, (int)c.mesh.scale, c.mesh.shift);
            else if (getenv("SMEAR_LIGHTS") == NULL)
                CHECK(off <= 1.5);
        }
    }
    if (getenv("SMEAR_LIGHTS") != NULL)
        printf("worst %g rms %g lit %d\n", worst, sqrt(sum / (3.0 * LOOKS)), lit);
}

/* ------------------------------------------------------------------ whole frames */

enum { WIDTH = 96, HEIGHT = 64, PIXELS = WIDTH * HEIGHT, ALL_METHODS = (1 << SMEAR_METHOD_COUNT) - 2 };

static smear_desc desc_of_all(void)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .tile = 8, .reach = 6,
                         .methods = (uint16_t)(ALL_METHODS & ~(1u << SMEAR_DEFAULT_METHOD)) };
}

/* Draws the busy scene; the caller frees what it is given. */
static uint8_t *lit_picture(int method, bool still, const smear_lights *lights, uint8_t gloss)
{
    const smear_desc desc = desc_of_all();
    const smear_scene more = { .lights = lights };
    struct scene s;
    uint8_t *picture = NULL;
    RIG(r, &desc, false);
    CHECK_EQ(render_scene(&r, 0.1, method), SMEAR_OK);
    make_scene(&s, 0.2, method);
    for (int i = 0; i < SCENE_DRAWS; i++)
        s.material[i].gloss = gloss;
    s.frame.scene = lights != NULL ? &more : NULL;
    s.frame.cut = still;
    picture = rig_copy(&r, &s.frame, s.draw, SCENE_DRAWS);
    return picture;
}

static bool are_same(uint8_t *a, uint8_t *b)
{
    const bool same = a != NULL && b != NULL && memcmp(a, b, PIXELS * 4) == 0;
    free(a);
    free(b);
    return same;
}

static const smear_lights near_lamp = { .shader = &smear_lights_shader, .direction = { -65536, 65536, 0 },
                                        .diffuse = { 9000, 12000, 15000 }, .lamp_diffuse = { 60000, 40000, 20000 },
                                        .lamp = { 0, 65536, -4 * 65536 }, .reach = 9 * 65536 };

static void test_lights_that_reach_nothing_change_nothing(void)
{
    smear_lights far_lamp = near_lamp;
    far_lamp.lamp[1] = 20000 * 65536;
    memset(far_lamp.diffuse, 0, sizeof far_lamp.diffuse);
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++)
        CHECK(are_same(lit_picture(method, false, NULL, 200), lit_picture(method, false, &far_lamp, 0)));
    CHECK(!are_same(lit_picture(SMEAR_NONE, false, NULL, 0), lit_picture(SMEAR_NONE, false, &near_lamp, 0)));
    CHECK(!are_same(lit_picture(SMEAR_NONE, false, &far_lamp, 200), lit_picture(SMEAR_NONE, false, &far_lamp, 0)));
}

static void test_what_stands_still_is_lit_alike_by_any_method(void)
{
    for (int method = SMEAR_NONE + 1; method < SMEAR_METHOD_COUNT; method++)
        CHECK(are_same(lit_picture(SMEAR_NONE, true, &near_lamp, 120), lit_picture(method, true, &near_lamp, 120)));
}

#include "build/suites/lights.h"
