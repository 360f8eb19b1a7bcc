/* SPDX-License-Identifier: MIT */
/* test_near_sweep.c - random cameras that drive low over endless surfaces of one colour, and cubes that pass close by. A surface
 * without end looks the same however fast the camera goes along it; a cube is as the mean of exact instants has it.
 * SMEAR_CASES=5000 draws as many cases of each kind; SMEAR_FIRST=17 begins with that one, and names what is off. */
#include "tests/ref/sweep.h"

enum { PIXELS_MAX = 160 * 120, BYTES_MAX = PIXELS_MAX * 4, SIDE_MAX = 64, VERTICES_MAX = (SIDE_MAX + 1) * (SIDE_MAX + 1), DRAWS = 4 };

/* A case: lengths in units, speed in units per second, angles in degrees. */
struct drive {
    double near_plane, height, speed, fps, shutter, pitch, roll, heading, wall;
    double half;        /* of the height an orthographic camera sees; 0: it is none */
    int width, rows, side, cubes;
    double cube_from[DRAWS][3], cube_way[DRAWS][3]; /* in the middle, and from open to close, as the eye sees it */
};

static int16_t floor_position[3 * VERTICES_MAX];
static uint16_t floor_index[6 * SIDE_MAX * SIDE_MAX];

/* 10^uniform */
static double spread(double low, double high)
{
    return pow(10, uniform(log10(low), log10(high)));
}

static struct drive random_drive(void)
{
    static const int frames[] = { 5, 10, 15, 30, 60 }, sides[] = { 1, 1, 2, 8, 1, 2, 8, SIDE_MAX };
    const bool large = chance(8);
    struct drive d = { .width = large ? 160 : 80, .rows = large ? 120 : 60 };
    d.near_plane = spread(0.01, 1);
    d.height = spread(0.05, 5);
    d.speed = spread(1, 100);
    d.fps = frames[random_u32() % 5u];
    d.shutter = chance(2) ? 180 : spread(30, 720);
    d.pitch = uniform(-40, 10);
    d.roll = chance(3) ? uniform(-30, 30) : 0;
    d.side = sides[random_u32() % 8u];
    d.near_plane = fmin(d.near_plane, d.height * 0.8);
    if (chance(3))
        d.wall = uniform(1, 4);
    else if (chance(3))
        d.heading = uniform(-90, 90);
    d.half = chance(20) ? spread(1, 10) : 0;
    if (d.half > 0)
        d.roll = uniform(10, 30);      /* else the near plane ends all along a row of pixels */
    return d;
}

static void print_drive(const struct drive *d, uint32_t number)
{
    printf("  case %u: near %.3f height %.2f speed %.1f fps %g shutter %.0f pitch %.0f roll %.0f heading %.0f wall %.1f half %.1f side %d"
           " %d x %d\n",
           (unsigned)number, d->near_plane, d->height, d->speed, d->fps, d->shutter, d->pitch, d->roll, d->heading, d->wall, d->half,
           d->side, d->width, d->rows);
}

/* ------------------------------------------------------------------ pictures */

static void make_floor(int side)
{
    for (int i = 0; i <= side; i++)
        for (int j = 0; j <= side; j++) {
            int16_t *p = &floor_position[3 * (i * (side + 1) + j)];
            p[0] = (int16_t)(64000 * i / side - 32000);
            p[1] = 0;
            p[2] = (int16_t)(64000 * j / side - 32000);
        }
    uint16_t *at = floor_index;
    for (int i = 0; i < side; i++)
        for (int j = 0; j < side; j++) {
            const int a = i * (side + 1) + j, b = a + side + 1;
            const int corner[6] = { a, a + 1, b + 1, a, b + 1, b };
            for (int k = 0; k < 6; k++)
                *at++ = (uint16_t)corner[k];
        }
}

/* The camera where `part` of the exposure's way is behind it: -0.5 at open, 0.5 at close. */
static smear_camera camera_of(const struct drive *d, double part)
{
    const double degree = 3.14159265358979 / 180;
    const double cp = cos(d->pitch * degree), sp = sin(d->pitch * degree), cr = cos(d->roll * degree), sr = sin(d->roll * degree);
    const double way = d->speed / d->fps * d->shutter / 360 * part;
    const double basis[9] = { cr, -sr, 0, cp * sr, cp * cr, -sp, sp * sr, sp * cr, cp };
    smear_camera c = { .focal = 2 * 65536 * 4 / 5, .near_plane = q16(d->near_plane), .half_height = q16(d->half) };
    c.far_plane = (d->half > 0 ? 100 : 6000) * 65536;
    for (int i = 0; i < 9; i++)
        c.pose.basis[i] = q24(basis[i]);
    c.pose.origin[0] = q16(sin(d->heading * degree) * way);
    c.pose.origin[1] = q16(d->height);
    c.pose.origin[2] = q16(-cos(d->heading * degree) * way);
    return c;
}

/* Cubes travel with the camera, and beside. */
static smear_transform cube_of(const struct drive *d, int i, double part)
{
    const smear_camera c = camera_of(d, part);
    smear_transform t = SMEAR_IDENTITY;
    for (int k = 0; k < 3; k++)
        t.origin[k] = (k == 1 ? 0 : c.pose.origin[k]) + q16(d->cube_from[i][k] + d->cube_way[i][k] * part);
    return t;
}

/* Draws the picture of a method; `part`: when a sharp one is. */
static bool draw(struct rig *r, const struct drive *d, uint8_t method, int samples, double part, uint8_t *out)
{
    static const smear_material ground = { .color = { 204, 204, 51, 255 }, .unlit = 1, .double_sided = 1 };
    static const smear_material side = { .color = { 77, 128, 230, 255 }, .unlit = 1, .double_sided = 1 };
    static const smear_material box = { .color = { 220, 60, 40, 255 }, .unlit = 1 };
    static const smear_transform still = SMEAR_IDENTITY;
    const smear_mesh floor_mesh = { .position = floor_position, .vertex_count = (uint16_t)((d->side + 1) * (d->side + 1)),
                                    .index = floor_index, .triangle_count = (uint32_t)(2 * d->side * d->side), .shift = 3 };
    int16_t wall_position[24];
    static const uint16_t wall_index[] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };
    for (int i = 0; i < 8; i++) {
        const bool upper = i & 2, far = (i + 1) & 2;
        wall_position[3 * i] = (int16_t)lrint((i < 4 ? -8 : 8) * d->wall);
        wall_position[3 * i + 1] = (int16_t)(upper ? ceil(24 * d->height) : -8);
        wall_position[3 * i + 2] = far ? -32000 : 32000;
    }
    const smear_mesh walls = { .position = wall_position, .vertex_count = 8, .index = wall_index, .triangle_count = 4, .shift = 3 };
    const bool sharp = method == SMEAR_NONE;
    const smear_camera now = camera_of(d, sharp ? part : 0), open = camera_of(d, -0.5), close = camera_of(d, 0.5);
    smear_draw draws[2 + DRAWS] = { { .id = 1, .mesh = &floor_mesh, .material = &ground, .now = &still } };
    smear_transform pose[DRAWS][3];
    int count = 1;
    if (d->wall > 0)
        draws[count++] = (smear_draw){ .id = 2, .mesh = &walls, .material = &side, .now = &still };
    for (int i = 0; i < d->cubes; i++) {
        for (int k = 0; k < 3; k++)
            pose[i][k] = cube_of(d, i, sharp ? part : 0.5 * (k - 1));
        draws[count++] = (smear_draw){ .id = 3 + (uint32_t)i, .mesh = &cube, .material = &box, .now = &pose[i][1], .open = &pose[i][0],
                                       .close = &pose[i][2] };
    }
    const smear_frame frame = { .camera = &now, .open = sharp ? NULL : &open, .close = sharp ? NULL : &close, .method = method,
                                .samples = (uint16_t)samples, .light_space = SMEAR_LIGHT_ENCODED, .cut = sharp, .clear = 0x305070,
                                .shutter = { .poses = 1 } };
    if (!CHECK_EQ(rig_frame(r, &frame, draws, count), SMEAR_OK))
        return false;
    memcpy(out, r->picture, (size_t)(d->width * d->rows * 4));
    return true;
}

static bool begin(struct rig *r, const struct drive *d)
{
    smear_desc desc = small_desc(d->width, d->rows);
    desc.methods = SMEAR_SET_TEMPORAL;
    desc.max_triangles = 30u * (uint32_t)(d->side * d->side) + 2000u;
    make_floor(d->side);
    return rig_begin(r, &desc, false);
}

/* The mean of sharp pictures, evenly over the exposure. */
static bool draw_exact(struct rig *r, const struct drive *d, int instants, uint8_t *out)
{
    static uint32_t sum[BYTES_MAX];
    const int bytes = d->width * d->rows * 4;
    memset(sum, 0, sizeof sum);
    for (int i = 0; i < instants; i++) {
        if (!draw(r, d, SMEAR_NONE, 0, (i + 0.5) / instants - 0.5, out))
            return false;
        for (int k = 0; k < bytes; k++)
            sum[k] += out[k];
    }
    for (int k = 0; k < bytes; k++)
        out[k] = (uint8_t)((sum[k] + (uint32_t)instants / 2) / (uint32_t)instants);
    return true;
}

static bool same_color(const uint8_t *a, const uint8_t *b, int slack)
{
    return abs(a[0] - b[0]) <= slack && abs(a[1] - b[1]) <= slack && abs(a[2] - b[2]) <= slack;
}

/* Whether all pixels around one have its colour. */
static bool is_inside(const struct drive *d, const uint8_t *picture, int x, int y)
{
    const uint8_t *at = picture + 4 * (y * d->width + x);
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < d->rows; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < d->width; u++)
            if (!same_color(at, picture + 4 * (v * d->width + u), 0))
                return false;
    return true;
}

/* Pixels that are not as they are in the sharp picture, though no edge is beside them there. */
static int pixels_off(const struct drive *d, const uint8_t *sharp, const uint8_t *blurred)
{
    int off = 0;
    for (int y = 0; y < d->rows; y++)
        for (int x = 0; x < d->width; x++)
            off += !same_color(sharp + 4 * (y * d->width + x), blurred + 4 * (y * d->width + x), 1) && is_inside(d, sharp, x, y);
    return off;
}

/* ------------------------------------------------------------------ surfaces without end */

static void start_case(uint32_t number, uint32_t kind)
{
    random_state = number * 2654435761u + kind * 40503u + 1u;
    for (int i = 0; i < 4; i++)
        random_u32();
}

/* Methods, and the bars of each: how many of 1000 surfaces may be over half a code farther from the exact mean than the sharp picture,
 * and how far all; how far nine of ten cubes and all may be from the exact mean. Those over are one to three pixels, of 1.7 codes each at
 * 80x60, whose centres lie within 1/256 px of an edge: 64 instants by SMEAR_ACCUMULATE of the same three poses have 8 of 2000, 1.1 codes
 * at most, as they are rounded otherwise than exact poses. */
static const struct {
    uint8_t method, samples;
    const char *name;
    int over;
    double farthest, most_of_ten, most;
} by[] = {
    { SMEAR_AUTO, 0, "auto", 5, 1.5, 1.3, 2.6 },
    { SMEAR_SUBFRAMES, 0, "subframes", 5, 1.5, 1.2, 3 },
    { SMEAR_TIMEMASK, 16, "timemask", 5, 1.5, 1.5, 3 }
};

enum { METHODS = sizeof by / sizeof *by };

/* What a sweep found, of each method. */
struct found {
    int inside, over;           /* cases with a pixel off inside of surfaces; farther from the exact mean by half a code */
    double worst;               /* farther by so many codes at most */
};

static bool judge(struct found found[METHODS], struct rig *r, const struct drive *d, uint32_t number, bool tells)
{
    static uint8_t sharp[BYTES_MAX], blurred[BYTES_MAX], exact[BYTES_MAX];
    bool has_exact = false;
    if (!draw(r, d, SMEAR_NONE, 0, 0, sharp))
        return false;
    for (int m = 0; m < METHODS; m++) {
        if (!draw(r, d, by[m].method, by[m].samples, 0, blurred))
            return false;
        const int off = pixels_off(d, sharp, blurred);
        double error = rms_of(sharp, blurred, d->width * d->rows);
        if (error > 0.5) { /* what is seen may change a little where a surface ends: the exact mean tells */
            if (!has_exact && !draw_exact(r, d, 64, exact))
                return false;
            has_exact = true;
            error = rms_of(exact, blurred, d->width * d->rows) - rms_of(exact, sharp, d->width * d->rows);
        }
        found[m].inside += off != 0;
        found[m].over += error > 0.5;
        found[m].worst = fmax(found[m].worst, error);
        if (tells && (off != 0 || error > 0.5)) {
            printf("  %s: %d pixels off, %.2f codes farther\n", by[m].name, off, error);
            print_drive(d, number);
        }
    }
    return true;
}

static void test_endless_surfaces_look_the_same_however_fast_the_camera_goes(void)
{
    const struct sweep sweep = sweep_of(120, 4800);
    struct found found[METHODS] = { { 0, 0, 0 } };
    for (uint32_t i = sweep.first; i < sweep.first + sweep.count; i++) {
        struct rig r;
        start_case(i, 1);
        const struct drive d = random_drive();
        const bool ok = begin(&r, &d) && judge(found, &r, &d, i, sweep.tells);
        rig_end(&r);
        REQUIRE(ok);
    }
    for (int m = 0; m < METHODS; m++) {
        printf("  %s: of %u endless surfaces %d have a pixel off inside, %d are over half a code farther; worst %.2f\n", by[m].name,
               (unsigned)sweep.count, found[m].inside, found[m].over, found[m].worst);
        /* Of edges that lie on pixel centres a whole row may change sides. */
        CHECK(found[m].inside * 80 <= (int)sweep.count + 80);
        CHECK(found[m].over * 1000 <= by[m].over * (int)(sweep.count + 80));
        CHECK_CLOSE(found[m].worst, 0, by[m].farthest);
    }
}

/* ------------------------------------------------------------------ cubes */

static struct drive random_pass(void)
{
    struct drive d = random_drive();
    d.wall = d.half = 0;
    d.cubes = between(1, DRAWS);
    d.height = spread(0.3, 3);
    d.near_plane = fmin(d.near_plane, 0.5 * d.height);
    d.pitch = uniform(-15, 5);
    for (int i = 0; i < d.cubes; i++) {
        const double side = chance(2) ? 1 : -1;
        d.cube_from[i][0] = side * uniform(1.3, 4);
        d.cube_from[i][1] = 1;
        d.cube_from[i][2] = uniform(-8, 1);
        d.cube_way[i][0] = uniform(-0.3, 0.3);
        d.cube_way[i][2] = (chance(2) ? 1 : -1) * spread(0.2, 8);
    }
    return d;
}

static void test_cubes_that_pass_are_as_exact_instants_show_them(void)
{
    static double error[METHODS][SWEEP_MOST];
    static uint8_t exact[BYTES_MAX], blurred[BYTES_MAX];
    const struct sweep sweep = sweep_of(60, 2400);
    for (uint32_t i = sweep.first; i < sweep.first + sweep.count; i++) {
        struct rig r;
        start_case(i, 2);
        const struct drive d = random_pass();
        bool ok = begin(&r, &d) && draw_exact(&r, &d, 64, exact);
        for (int m = 0; m < METHODS && ok; m++) {
            ok = draw(&r, &d, by[m].method, by[m].samples, 0, blurred);
            error[m][i - sweep.first] = rms_of(exact, blurred, d.width * d.rows);
            if (sweep.tells && error[m][i - sweep.first] > by[m].most) {
                printf("  %s: %.2f codes from the exact mean\n", by[m].name, error[m][i - sweep.first]);
                print_drive(&d, i);
            }
        }
        rig_end(&r);
        REQUIRE(ok);
    }
    for (int m = 0; m < METHODS; m++) {
        printf("  %s: cubes that pass\n", by[m].name);
        sweep_check(error[m], sweep.count, "off the exact mean", by[m].most_of_ten, by[m].most);
    }
}

#include "build/suites/near_sweep.h"
