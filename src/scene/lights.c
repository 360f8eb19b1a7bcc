/* SPDX-License-Identifier: MIT */
/* lights.c - a second directional light, a lamp and highlights, per vertex: geometry/lights.h.
 *
 * A draw looks at its lights from its own object space, so that a vertex is lit where the mesh has it. The lamp's light has no
 * square root: it goes with the way to the lamp along the normal, which is longer the farther the lamp is, and with a power of
 * 1 - (distance / reach)^2, which falls off faster. */
#include "geometry/lights.h"

#include "base/fixmath.h"
#include "geometry/vertex.h"

#if SMEAR_WITH_LIGHTS

/* More bits of a lamp's place while it is turned. */
enum { FINE = 4 };

/* ------------------------------------------------------------------ numbers of any size, once per draw */

/* m 2^e, m >= 2^31 or 0: m in the lower word, e in the upper one. Structs would be returned in memory. */
typedef uint64_t real_number;

static inline real_number real_make(uint32_t m, int e) { return (uint64_t)(uint32_t)e << 32 | m; }
static inline uint32_t real_m(real_number a) { return (uint32_t)a; }
static inline int real_e(real_number a) { return (int)(int32_t)(uint32_t)(a >> 32); }

static real_number real_of(uint64_t x, int e)
{
    if (x == 0)
        return 0;
    const int zeros = count_leading_zeros_64(x);
    return real_make((uint32_t)(x << zeros >> 32), e + 32 - zeros);
}

static SMEAR_NOINLINE real_number real_times(real_number a, real_number b)
{
    return real_of((uint64_t)real_m(a) * real_m(b), real_e(a) + real_e(b));
}

/* Returns 2^by / a, for a > 0. */
static real_number real_over(real_number a, int by) { return real_of(recip_norm_precise(real_m(a)), by - 61 - real_e(a)); }

/* Returns x r, within +-2^28. */
static int32_t times_real(int64_t x, real_number r)
{
    const real_number p = real_times(real_of(magnitude(x), 0), r);
    const int e = real_e(p);
    const int32_t size = real_m(p) == 0 || e <= -32 ? 0 : e > -4 ? 1 << 28 : (int32_t)(real_m(p) >> -e);
    return x < 0 ? -size : size;
}

/* ------------------------------------------------------------------ frames, and where a draw sees their lamp */

static const struct smear_lights_used *begin(struct smear_lights_used *used, const smear_lights *lights, const struct smear_sun *sun,
                                             const smear_camera *camera)
{
    used->by = lights->shader;
    struct smear_sun towards;
    smear_light second = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } }, half = second;
    for (int i = 0; i < 3; i++) {
        second.direction[i] = lights->direction[i];
        half.direction[i] = sun->direction[i] + (camera->pose.basis[3 * i + 2] >> 10);
    }
    smear_sun_make(&towards, &second);
    for (int i = 0; i < 3; i++) {
        used->word[LIGHTS_SECOND + i] = towards.direction[i];
        used->word[LIGHTS_DIFFUSE + i] = lights->diffuse[i];
        used->word[LIGHTS_LAMP + i] = lights->lamp[i];
        used->word[LIGHTS_LAMP_DIFFUSE + i] = lights->lamp_diffuse[i];
    }
    used->word[LIGHTS_REACH] = lights->reach;
    smear_sun_make(&towards, &half);
    for (int i = 0; i < 3; i++)
        used->word[LIGHTS_HALF + i] = towards.direction[i];
    return used;
}

/* Cuts a place off where nothing is reached. */
static inline int32_t within(int64_t x) { return (int32_t)(x > 1 << 29 ? 1 << 29 : x < -(1 << 29) ? -(1 << 29) : x); }

/* Takes the lamp's reach in units of any size, and returns the power of two that makes 13 to 14 bits of it. */
static int set_reach(struct smear_lights_seen *l, real_number reach)
{
    l->reach = (int32_t)(real_m(reach) >> 18);
    l->square = (real_m(reach) >> 16) * (real_m(reach) >> 16) >> 4;
    l->share = 0xffffffffu / (l->square >> 12) - 1u;
    return -18 - real_e(reach);
}

/* Returns where along an axis of the world a place of the mesh, in thirds of steps, lies. */
static int32_t units_along(const struct smear_lights_seen *l, int axis, const int32_t p[3])
{
    const int32_t *m = l->step + 3 * axis;
    const int64_t along = dot_wide(m, 1, p, 1) >> l->down;
    return within(along);
}

/* Whether the box of a mesh's positions, in object space, comes within the lamp's reach. Finds out whether all ways have 15 bits. */
static bool is_reached(struct smear_lights_seen *l, const struct smear_assembly *d)
{
    const int16_t *b = d->mesh->bounds;
    const bool known = d->at.position == d->mesh->position && (b[0] | b[1] | b[2] | b[3] | b[4] | b[5]) != 0;
    bool near = l->up == 0;
    for (int i = 0; i < 3; i++) {
        const int32_t least = l->lamp[i] - (shl_wrap(known ? b[3 + i] : 32767, l->up) >> l->down);
        const int32_t most = l->lamp[i] - (shl_wrap(known ? b[i] : -32768, l->up) >> l->down);
        if (least > l->reach || most < -l->reach)
            return false;
        near = near && least > -32768 && most < 32768;
    }
    l->near = near;
    return true;
}

/* Returns the length of a column of a basis, all of which have one. */
static real_number length_of(const smear_transform *object)
{
    const int32_t *b = object->basis;
    return real_of(max_u32(sqrt_floor_64((uint64_t)dot_wide(b, 3, b, 3)), 1), 0);
}

/* Turns a vector of the world to an axis of object space. */
static int32_t turned(const smear_transform *object, int axis, const int32_t v[3], real_number over_length)
{
    return times_real(dot_wide(object->basis + axis, 3, v, 1), over_length);
}

/* Finds the lamp from a draw's object space, whose unit is a power of two of the mesh's steps, so that vertices are where they are. */
static bool place_even(struct smear_lights_seen *l, const struct smear_lights_used *used, const struct smear_assembly *d,
                       const smear_transform *object)
{
    const real_number length = length_of(object);
    int32_t way[3];
    real_number steps = real_over(real_times(length, real_of((uint32_t)max_i32(d->mesh->scale, 1), -8 - d->mesh->shift)), 0);
    const int up = set_reach(l, real_times(real_of((uint32_t)used->word[LIGHTS_REACH], 0), steps));
    if (up > 15)
        return false;           /* a step is beyond the reach */
    l->up = (uint8_t)max_i32(up, 0);
    l->down = (uint8_t)clamp_i32(-up, 0, 31);
    steps += (uint64_t)(uint32_t)(up + FINE) << 32;
    for (int i = 0; i < 3; i++)
        way[i] = times_real((int64_t)used->word[LIGHTS_LAMP + i] - object->origin[i], steps);
    for (int i = 0; i < 3; i++) {
        const int64_t offset = mul_wide(d->mesh->offset[i], 1 << l->up) >> l->down;
        l->lamp[i] = within((turned(object, i, way, real_over(length, 0)) >> FINE) - offset);
    }
    return is_reached(l, d);
}

/* Finds it in the world. */
static bool place_uneven(struct smear_lights_seen *l, const struct smear_lights_used *used, const smear_mesh *mesh,
                         const smear_transform *object)
{
    uint64_t largest = 1;
    const int up = set_reach(l, real_of((uint32_t)used->word[LIGHTS_REACH], 0));
    const real_number units = real_of(1, up);
    real_number steps = real_times(units, real_of((uint32_t)max_i32(mesh->scale, 1), -8 - mesh->shift));
    steps = real_times(steps, real_make(0xaaaaaaabu, -33));      /* a third */
    for (int i = 0; i < 9; i++)
        largest |= magnitude(object->basis[i]);
    const int down = -4 - real_e(real_times(steps, real_of(largest, 0)));
    if (down < 0)
        return false;
    l->down = (uint8_t)min_i32(down, 40);
    steps += (uint64_t)l->down << 32;
    for (int i = 0; i < 9; i++)
        l->step[i] = times_real(object->basis[i], steps);
    const int32_t offset[3] = { 3 * mesh->offset[0], 3 * mesh->offset[1], 3 * mesh->offset[2] };
    for (int i = 0; i < 3; i++)
        l->lamp[i] = times_real((int64_t)used->word[LIGHTS_LAMP + i] - object->origin[i], units) - units_along(l, i, offset);
    return true;
}

/* ------------------------------------------------------------------ light */

/* What falls on a place, q16. */
struct fall {
    uint32_t sun, second, lamp;
    uint32_t half;          /* the square of the cosine from where highlights lie */
};

/* Returns the lamp's light on what has a way to it of that square: t (1 - t^2)^8 of its reach, where it faces it, in the scale of
 * `along`, how much of the way lies along the normal. */
static inline uint32_t lamp_light(const struct smear_lights_seen *l, uint32_t square, uint32_t along)
{
    if (square >= l->square)
        return 0;
    uint32_t power = ((l->square - square) >> 12) * l->share >> 16;
    power = power * power >> 16;
    power = power * power >> 16;
    power = power * power >> 16;
    return (along * power >> 16) * l->gain >> 10;
}

static inline bool is_beyond(int32_t way, int32_t reach) { return (uint32_t)(way + reach) > 2u * (uint32_t)reach; }

/* Returns 2^7 times the cosine, q16, of a vertex's normal and a direction in object space. */
SMEAR_INLINE int32_t along_vertex(const int32_t n[3], const int32_t direction[3])
{
    return n[0] * direction[0] + n[1] * direction[1] + n[2] * direction[2];
}

static inline int32_t along_normal(const int32_t n[3], const int32_t v[3]) { return n[0] * v[0] + n[1] * v[1] + n[2] * v[2]; }

/* Finds the lamp's light on a vertex with a normal, in object space. */
static SMEAR_NOINLINE uint32_t lamp_on_any(const struct smear_lights_seen *l, const int16_t p[3], const int32_t n[3])
{
    int32_t way[3];
    for (int i = 0; i < 3; i++) {
        way[i] = l->lamp[i] - (shl_wrap(p[i], l->up) >> l->down);
        if (is_beyond(way[i], l->reach))
            return 0;
    }
    const int32_t along = along_normal(n, way);
    return along > 0 ? lamp_light(l, (uint32_t)along_normal(way, way), (uint32_t)along >> 5) : 0;
}

/* The same where ways have 15 bits from every vertex, in steps of the mesh or coarser units. A call has registers enough. */
static SMEAR_NOINLINE uint32_t lamp_on_near(const struct smear_lights_seen *l, const int16_t p[3], const int8_t n[3])
{
    const uint32_t down = l->down;
    int32_t way = l->lamp[0] - (p[0] >> down), along = n[0] * way;
    uint32_t square = (uint32_t)(way * way);        /* of up to 30 bits */
    way = l->lamp[1] - (p[1] >> down);
    along += n[1] * way;
    square += (uint32_t)(way * way);
    way = l->lamp[2] - (p[2] >> down);
    along += n[2] * way;
    square += (uint32_t)(way * way);
    return along > 0 ? lamp_light(l, square, (uint32_t)along >> 5) : 0;
}

/* Turns a normal of 14 bits to the world, where its length is 2^14. */
static void turn_normal(int32_t out[3], const struct smear_shading *s, const int32_t n[3])
{
    int32_t w[3];
    for (int i = 0; i < 3; i++) {
        const int32_t *m = s->normal_matrix[i];
        w[i] = (m[0] * n[0] + m[1] * n[1] + m[2] * n[2]) >> 1;
    }
    smear_unit_direction(out, w);
}

/* Finds the light on a place, in thirds of steps, with a normal of 14 bits, but the sun's, in the world. */
static void light_place(struct fall *f, const struct smear_lights_seen *l, const struct smear_shading *s, const int32_t p[3],
                        const int32_t normal[3])
{
    int32_t n[3], way[3];
    turn_normal(n, s, normal);
    f->second = (uint32_t)clamp_i32(along_normal(n, l->second) >> 12, 0, 65536);
    const uint32_t c = (uint32_t)clamp_i32(along_normal(n, l->half) >> 12, 0, 65535);
    f->half = c * c >> 16;
    f->lamp = 0;
    for (int i = 0; l->has_lamp && i < 3; i++) {
        way[i] = l->lamp[i] - units_along(l, i, p);
        if (is_beyond(way[i], l->reach))
            return;
    }
    const int32_t along = l->has_lamp ? along_normal(n, way) : 0;
    if (along > 0)
        f->lamp = lamp_light(l, (uint32_t)along_normal(way, way), (uint32_t)along >> 12);
}

/* Finds the light on a face: that of its middle. */
static void light_face(struct fall *f, const struct smear_lights_seen *l, const struct smear_assembly *d, const struct smear_face *face)
{
    const uint16_t *index = d->mesh->index + 3 * face->triangle;
    const int16_t *a = d->at.position + 3 * index[0], *b = d->at.position + 3 * index[face->back ? 2 : 1],
                  *c = d->at.position + 3 * index[face->back ? 1 : 2];
    int32_t u[3], v[3], middle[3], n[3];
    for (int i = 0; i < 3; i++) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        middle[i] = a[i] + b[i] + c[i];
    }
    smear_face_normal(n, u, v);
    f->sun = face->cosine;
    light_place(f, l, &d->shading, middle, n);
}

/* ------------------------------------------------------------------ colours */

/* Returns the share of the sun that a highlight has, q16. */
static uint32_t highlight(const struct smear_lights_seen *l, const struct fall *f)
{
    uint32_t c = f->half;
    if (f->sun == 0)
        return 0;
    for (int i = 0; i < l->shine - 1 && c != 0; i++)
        c = c * c >> 16;
    return c * (l->gloss * 257u) >> 16;
}

/* Returns the sum of all lights of a channel, q16: not above one. */
SMEAR_INLINE uint32_t sum_of(const struct smear_assembly *d, const struct fall *f, int channel)
{
    const struct smear_shading *s = &d->shading;
    const struct smear_lights_seen *l = &d->lights;
    uint32_t light = (uint32_t)s->sun->ambient[channel] + ((uint32_t)s->sun->diffuse[channel] * f->sun >> 16);
    if (l->has_second)
        light += (uint32_t)l->used->word[LIGHTS_DIFFUSE + channel] * f->second >> 16;
    if (l->has_lamp)
        light += (uint32_t)l->used->word[LIGHTS_LAMP_DIFFUSE + channel] * f->lamp >> 16;
    return min_u32(light, 65536u);
}

/* Shades as smear_shade, under a light that is white and known. */
static SMEAR_NOINLINE void put_color(struct smear_color *out, const struct smear_shading *s, const uint8_t color[4],
                                     const uint8_t face_color[4], uint32_t light)
{
    for (int i = 0; i < 3; i++)
        out->channel[i] = shading_value(s, shading_channel(s, i, color, face_color) * light >> 16);
    out->channel[3] = shading_alpha(s, color, face_color);
}

/* Shades a colour: as smear_shade, but of all lights, and with the highlight on top of it. */
SMEAR_INLINE void shade(struct smear_color *out, const struct smear_assembly *d, const struct fall *f, const uint8_t color[4],
                        const uint8_t face_color[4])
{
    const struct smear_shading *s = &d->shading;
    const uint32_t on_top = d->lights.gloss != 0 ? highlight(&d->lights, f) : 0;
    uint32_t light = sum_of(d, f, 0);
    for (int i = 0; i < 3; i++) {
        if (!d->lights.is_white)
            light = sum_of(d, f, i);
        const uint32_t more = on_top != 0 ? (uint32_t)s->sun->diffuse[i] * on_top >> 16 : 0;
        out->channel[i] = shading_value(s, (shading_channel(s, i, color, face_color) * light >> 16) + more);
    }
    out->channel[3] = shading_alpha(s, color, face_color);
}

static void shade_middle(struct smear_color *out, const struct smear_assembly *d, const struct smear_face *face)
{
    struct fall f;
    light_face(&f, &d->lights, d, face);
    shade(out, d, &f, face->vertex_color, face->color);
}

/* Shades a vertex from the world. */
static SMEAR_RARE void shade_uneven(struct smear_color *out, const struct smear_assembly *d, uint32_t index, const struct smear_face *face)
{
    const smear_mesh *mesh = d->mesh;
    const struct smear_lights_seen *l = &d->lights;
    struct fall f;
    if (mesh->normal != NULL) {
        const int8_t *n = mesh->normal + 3 * index;
        const int16_t *p = d->at.position + 3 * index;
        int8_t turned[3];
        int32_t place[3], normal[3];
        for (int i = 0; i < 3; i++) {
            turned[i] = face->back ? (int8_t)-max_i32(n[i], -127) : n[i];
            normal[i] = turned[i] * 128;
            place[i] = 3 * p[i];
        }
        f.sun = smear_light_normal(&d->shading, turned);
        light_place(&f, l, &d->shading, place, normal);
    } else {
        light_face(&f, l, d, face);
    }
    shade(out, d, &f, mesh->color != NULL ? mesh->color + 4 * index : NULL, face->color);
}

/* Finds a vertex's normal as it is seen. */
SMEAR_INLINE void take_normal(int32_t n[3], const struct smear_assembly *d, uint32_t index, bool back)
{
    const int8_t *normal = d->mesh->normal + 3 * index;
    for (int i = 0; i < 3; i++)
        n[i] = back ? -max_i32(normal[i], -127) : normal[i];
}

/* Shades a vertex under any lights. */
static void shade_any(struct smear_color *out, const struct smear_assembly *d, uint32_t index, const struct smear_face *face)
{
    const struct smear_shading *s = &d->shading;
    const struct smear_lights_seen *l = &d->lights;
    struct fall f = { 0, 0, 0, 0 };
    int32_t n[3];
    take_normal(n, d, index, face->back);
    f.sun = (uint32_t)clamp_i32(along_vertex(n, s->direction) >> 7, 0, 65536);
    f.second = (uint32_t)clamp_i32(along_vertex(n, l->second) >> 7, 0, 65536);
    if (l->has_lamp)
        f.lamp = lamp_on_any(l, d->at.position + 3 * index, n);
    if (l->gloss != 0) {        /* normals have lengths of 126 to 128, of which high powers are far apart */
        const uint32_t c = (uint32_t)max_i32(along_vertex(n, l->half) >> 8, 0);
        f.half = min_u32((c * c >> 14) * (uint32_t)(2 * 127 * 127 - n[0] * n[0] - n[1] * n[1] - n[2] * n[2]) / (127 * 127), 65535u);
    }
    shade(out, d, &f, d->mesh->color != NULL ? d->mesh->color + 4 * index : NULL, face->color);
}

/* Shades a vertex under white lights, whose colours are in `white` and `gain`: what most draws see, so that it counts. */
SMEAR_INLINE void shade_white(struct smear_color *out, const struct smear_assembly *d, uint32_t index, const struct smear_face *face,
                              bool has_lamp)
{
    const struct smear_lights_seen *l = &d->lights;
    if (face->back) {
        shade_any(out, d, index, face);
        return;
    }
    const int8_t *normal = l->normal + 3 * index;
    const int32_t n0 = normal[0], n1 = normal[1], n2 = normal[2];
    const int32_t sun = n0 * l->white[0] + n1 * l->white[1] + n2 * l->white[2];
    const int32_t second = !has_lamp || l->has_second ? n0 * l->white[3] + n1 * l->white[4] + n2 * l->white[5] : 0;
    uint32_t light = (uint32_t)l->ambient;
    if (sun > 0)
        light += (uint32_t)sun >> 7;
    if (second > 0)
        light += (uint32_t)second >> 7;
    if (has_lamp)
        light += lamp_on_near(l, l->position + 3 * index, normal);
    put_color(out, &d->shading, l->color != NULL ? l->color + 4 * index : NULL, face->color, min_u32(light, 65536u));
}

static void shade_second(struct smear_color *out, const struct smear_assembly *d, uint32_t index, const struct smear_face *face)
{
    shade_white(out, d, index, face, false);
}

static void shade_near(struct smear_color *out, const struct smear_assembly *d, uint32_t index, const struct smear_face *face)
{
    shade_white(out, d, index, face, true);
}

/* ------------------------------------------------------------------ draws */

static bool see(struct smear_lights_seen *l, const struct smear_lights_used *used, const struct smear_assembly *d,
                const smear_transform *object)
{
    const struct smear_shading *s = &d->shading;
    if (!s->lit)
        return false;
    l->used = used;
    l->even = SMEAR_VERTEX_COLORS_MOST && d->mesh->normal != NULL && s->even;
    l->gloss = d->material->gloss;
    l->shine = (uint8_t)(d->material->shine == 0 ? 5 : min_i32(d->material->shine, 10));
    l->near = false;
    l->has_lamp = used->word[LIGHTS_REACH] > 0 && (l->even ? place_even(l, used, d, object) : place_uneven(l, used, d->mesh, object));
    if (l->has_lamp)            /* 6.69 2^26 / reach, in terms of what lamp_light is given */
        l->gain = (l->even ? 113123353u : 112239411u) / (uint32_t)l->reach;
    const int32_t *second = used->word + LIGHTS_DIFFUSE, *lamp = used->word + LIGHTS_LAMP_DIFFUSE;
    l->has_second = (second[0] | second[1] | second[2]) != 0;
    l->is_white = s->sun->white && second[0] == second[1] && second[0] == second[2] && lamp[0] == lamp[1] && lamp[0] == lamp[2];
    for (int i = 0; i < 3; i++) {
        l->second[i] = used->word[LIGHTS_SECOND + i];
        l->half[i] = used->word[LIGHTS_HALF + i];
    }
    const real_number finer = real_over(length_of(object), 9);      /* q14 to q23 */
    for (int i = 0; l->even && i < 3; i++) {
        l->second[i] = turned(object, i, used->word + LIGHTS_SECOND, finer) / 127;
        l->half[i] = turned(object, i, used->word + LIGHTS_HALF, finer) / 127;
    }
    l->vertex = !l->even ? shade_uneven : shade_any;
    if (l->even && l->is_white && l->gloss == 0 && l->near == l->has_lamp) {
        for (int i = 0; i < 3; i++) {
            l->white[i] = mul_shift(s->direction[i], s->sun->diffuse[0], 16);
            l->white[3 + i] = mul_shift(l->second[i], second[0], 16);
        }
        l->ambient = s->sun->ambient[0];
        l->normal = d->mesh->normal;
        l->position = d->at.position;
        l->color = d->mesh->color;
        l->gain = (l->gain >> 4) * (uint32_t)lamp[0] >> 12;
        l->vertex = l->has_lamp ? shade_near : shade_second;
    }
    return l->has_lamp || l->has_second || l->gloss != 0;
}

const struct smear_shader smear_lights_shader = { begin, see, shade_middle };

#endif
