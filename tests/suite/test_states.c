/* SPDX-License-Identifier: MIT */
/* test_states.c - every public function in every state of a context, from every callback: what is out of turn is refused, and
 * changes not a byte of the context (nor does what is wild: tests/fuzz/cases_draw.c). And what a context knows of ids. Host only. */
#include "tests/rig.h"

enum { WIDTH = 48, HEIGHT = 40 };

/* ------------------------------------------------------------------ calls */

/* As the table of include/README.md has them. */
enum state { IDLE, BEGUN, FILTERING, DRAWING, STATES };

static struct scene scene;
static smear_frame filtered;            /* for smear_filter_begin */

static int call_begin(smear_context *c) { return smear_begin(c, &scene.frame); }

/* Of a mesh of its own, so that it has no id which the frame may have already. */
static int call_submit(smear_context *c)
{
    smear_draw draw = scene.draw[1];
    draw.id = 0;
    return smear_submit(c, &draw);
}

static int call_render(smear_context *c) { return smear_render(c); }
static int call_filter_begin(smear_context *c) { return smear_filter_begin(c, &filtered); }

static int call_filter_row(smear_context *c)
{
    static const uint32_t color[WIDTH], depth[WIDTH];
    static const int16_t velocity[2 * WIDTH];
    return smear_filter_row(c, color, depth, velocity);
}

static int call_get_stats(smear_context *c)
{
    smear_stats stats;
    smear_get_stats(c, &stats);
    return SMEAR_OK;
}

/* Of an index that no other core has. */
static int call_work(smear_context *c)
{
    smear_work(c, 0);
    smear_work(c, 8);
    return SMEAR_OK;
}

/* smear_band_done counts bands that were handed out: where none was, it is the application's error. */
static int call_band_done(smear_context *c)
{
    (void)c;
    return SMEAR_OK;
}

static const struct call {
    const char *name;
    int (*make)(smear_context *c);
    int result[STATES];
} calls[] = {
    { "smear_begin", call_begin, { SMEAR_OK, SMEAR_OK, SMEAR_OK, SMEAR_ERR_ORDER } },
    { "smear_submit", call_submit, { SMEAR_ERR_ORDER, SMEAR_OK, SMEAR_ERR_ORDER, SMEAR_ERR_ORDER } },
    { "smear_render", call_render, { SMEAR_ERR_ORDER, SMEAR_OK, SMEAR_ERR_ORDER, SMEAR_ERR_ORDER } },
    { "smear_filter_begin", call_filter_begin, { SMEAR_OK, SMEAR_OK, SMEAR_OK, SMEAR_ERR_ORDER } },
    { "smear_filter_row", call_filter_row, { SMEAR_ERR_ORDER, SMEAR_ERR_ORDER, SMEAR_OK, SMEAR_ERR_ORDER } },
    { "smear_get_stats", call_get_stats, { 0 } },
    { "smear_work", call_work, { 0 } },
    { "smear_band_done", call_band_done, { 0 } }
};

enum { CALLS = sizeof calls / sizeof *calls };

/* ------------------------------------------------------------------ what is refused changes nothing */

static uint8_t *snapshot;

static void take_snapshot(const struct rig *r)
{
    snapshot = realloc(snapshot, r->bytes);
    memcpy(snapshot, r->block + GUARD, r->bytes);
}

static bool is_unchanged(const struct rig *r) { return memcmp(snapshot, r->block + GUARD, r->bytes) == 0; }

/* Makes a call; true where it did what it is to do in the state. */
static bool check_call(struct rig *r, const struct call *call, enum state state)
{
    take_snapshot(r);
    const int result = call->make(r->ctx);
    const bool ok = CHECK_EQ(result, call->result[state]) && CHECK(result == SMEAR_OK || is_unchanged(r));
    if (!ok) {
        test_print(call->name);
        test_print("\n");
    }
    return ok;
}

/* ------------------------------------------------------------------ states between frames */

static smear_desc desc_of(int method, uint32_t triangles)
{
    smear_desc d = small_desc(WIDTH, HEIGHT);
    d.methods = (uint16_t)(SMEAR_SET(SMEAR_RECONSTRUCT) | SMEAR_SET(method));
    d.max_triangles = triangles;
    d.tile = 8;
    return d;
}

/* A shutter that is no box tells whether another call's has taken its place. */
static void make_scenes(int method)
{
    static const uint8_t curve[SMEAR_SHUTTER_POINTS] = { 0, 255, 255, 200, 100, 50, 20, 10, 5 };
    make_scene(&scene, 0.3, method);
    scene.frame.shutter.curve = curve;
    filtered = (smear_frame){ .camera = &scene.camera, .method = SMEAR_RECONSTRUCT };
}

/* Brings a context into a state, with half of the scene submitted where it is begun. */
static void enter(struct rig *r, enum state state)
{
    rig_forget_output(r);
    if (state == BEGUN) {
        CHECK_EQ(smear_begin(r->ctx, &scene.frame), SMEAR_OK);
        for (int i = 0; i < SCENE_DRAWS / 2; i++)
            CHECK_EQ(smear_submit(r->ctx, &scene.draw[i]), SMEAR_OK);
    } else if (state == FILTERING) {
        CHECK_EQ(smear_filter_begin(r->ctx, &filtered), SMEAR_OK);
        for (int y = 0; y < HEIGHT / 2; y++)
            CHECK_EQ(call_filter_row(r->ctx), SMEAR_OK);
    }
}

/* Goes on from there to the end of the frame; the picture is in the rig. */
static void finish(struct rig *r, enum state state)
{
    if (state == BEGUN) {
        for (int i = SCENE_DRAWS / 2; i < SCENE_DRAWS; i++)
            CHECK_EQ(smear_submit(r->ctx, &scene.draw[i]), SMEAR_OK);
        CHECK_EQ(smear_render(r->ctx), SMEAR_OK);
    } else if (state == FILTERING) {
        for (int y = HEIGHT / 2; y < HEIGHT; y++)
            CHECK_EQ(call_filter_row(r->ctx), SMEAR_OK);
    } else {
        CHECK_EQ(rig_frame(r, &scene.frame, scene.draw, SCENE_DRAWS), SMEAR_OK);
    }
}

/* Two contexts go through the same frames; one is called out of turn. */
static void check_state(enum state state, const struct call *call)
{
    const smear_desc desc = desc_of(SMEAR_AUTO, 400);
    struct rig called, left;
    make_scenes(SMEAR_AUTO);
    if (rig_begin(&called, &desc, false) && rig_begin(&left, &desc, false)) {
        CHECK_EQ(render_scene(&called, 0, SMEAR_AUTO), SMEAR_OK);
        CHECK_EQ(render_scene(&left, 0, SMEAR_AUTO), SMEAR_OK);
        enter(&called, state);
        enter(&left, state);
        check_call(&called, call, state);
        if (call->result[state] == SMEAR_ERR_ORDER) {
            finish(&called, state);
            finish(&left, state);
            CHECK(called.picture_size == left.picture_size);
            same_picture(&called, left.picture);
        }
        CHECK_EQ(render_scene(&called, 0.6, SMEAR_AUTO), SMEAR_OK);     /* it stays usable */
    }
    rig_end(&called);
    rig_end(&left);
}

static void test_every_call_in_every_state_is_taken_or_refused_as_the_table_says(void)
{
    for (enum state state = IDLE; state < DRAWING; state++)
        for (int i = 0; i < CALLS; i++)
            check_state(state, &calls[i]);
}

/* A new function has a line in `calls`, and in the table of include/README.md. */
static void test_every_function_of_a_context_is_among_them(void)
{
    static const char *const headers[] = { "include/smear.h", "include/smear_methods.h", "include/smear_stats.h" };
    char line[400];
    int found = 0;
    for (size_t k = 0; k < sizeof headers / sizeof *headers; k++) {
        FILE *header = fopen(headers[k], "r");
        REQUIRE(header != NULL);
        while (fgets(line, sizeof line, header) != NULL) {
            char *open = strchr(line, '('), *context = strstr(line, "smear_context *");
            if (open == NULL || context == NULL || context > open + 14 || strstr(line, "smear_init") != NULL || line[1] == '*')
                continue;
            *open = '\0';
            const char *name = strrchr(line, ' ') + 1;
            bool known = false;
            for (int i = 0; i < CALLS; i++)
                known = known || strcmp(name + (*name == '*'), calls[i].name) == 0;
            CHECK(known);
            found++;
        }
        fclose(header);
    }
    CHECK_EQ(found, CALLS);
}

/* ------------------------------------------------------------------ callbacks */

/* What calls from within a frame. */
enum callback { FLUSH, IDLE_CALL, INSPECT, CLOCK, CALLBACKS };

static struct rig *drawing;
static enum callback calls_from;
static int called_from[CALLBACKS];

/* A call that is taken calls back itself: once is enough. */
static void call_all(enum callback from)
{
    static bool within;
    called_from[from]++;
    if (within || from != calls_from || called_from[from] > 30)
        return;
    within = true;
    for (int i = 0; i < CALLS; i++)
        check_call(drawing, &calls[i], DRAWING);
    within = false;
}

/* With two bands, the first of a pair is sent as soon as somebody waits for it. */
static int waits_for;

static int flush_and_call(void *user, const smear_band *band)
{
    call_all(FLUSH);
    waits_for++;
    return take_band(user, band);
}

static void idle_and_call(void *user)
{
    struct rig *r = user;
    call_all(IDLE_CALL);
    for (; waits_for != 0; waits_for--)
        smear_band_done(r->ctx);
}

static void inspect_and_call(void *user, int y, const uint32_t *color, const uint16_t *depth, const int32_t *velocity)
{
    (void)user, (void)y, (void)color, (void)depth, (void)velocity;
    call_all(INSPECT);
}

static uint32_t clock_and_call(void *user)
{
    (void)user;
    call_all(CLOCK);
    return 0;
}

/* A frame whose callbacks call has the picture of one whose callbacks do not. */
static void check_callbacks(smear_desc desc, int method)
{
    struct rig r, quiet;
    make_scenes(method);
    const bool ok = rig_begin(&quiet, &desc, false);
    desc.bands = 2;
    desc.flush = flush_and_call;
    desc.idle = idle_and_call;
    desc.debug.clock = clock_and_call;
    if (rig_begin(&r, &desc, false) && ok) {
        drawing = &r;
        waits_for = 0;
        CHECK_EQ(rig_frame(&r, &scene.frame, scene.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK_EQ(rig_frame(&quiet, &scene.frame, scene.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK(r.picture_size == quiet.picture_size);
        same_picture(&r, quiet.picture);
        CHECK_EQ(smear_filter_begin(r.ctx, &filtered), SMEAR_OK);
        for (int y = 0; y < HEIGHT; y++)
            CHECK_EQ(call_filter_row(r.ctx), SMEAR_OK);
    }
    rig_end(&r);
    rig_end(&quiet);
}

static void test_callbacks_are_refused_what_changes_the_context(void)
{
    static const uint8_t methods[] = { SMEAR_NONE, SMEAR_ACCUMULATE, SMEAR_RECONSTRUCT, SMEAR_SUBFRAMES, SMEAR_AUTO, SMEAR_CAMERA,
                                       SMEAR_PINGPONG, SMEAR_HALF, SMEAR_OBJECT, SMEAR_LAYERED };
    for (unsigned m = 0; m < sizeof methods; m++)
        for (uint32_t triangles = 6; triangles <= 400; triangles += 394) {      /* of several fills; at once */
            memset(called_from, 0, sizeof called_from);
            for (calls_from = FLUSH; calls_from < CALLBACKS; calls_from++)
                if (calls_from != INSPECT)
                    check_callbacks(desc_of(methods[m], triangles), methods[m]);
            CHECK(called_from[FLUSH] > 5 && called_from[IDLE_CALL] > 5 && called_from[CLOCK] > 5);
        }
}

/* Rigs inspect by themselves: this one by hand. */
static void test_inspectors_are_refused_it_too(void)
{
    smear_desc desc = desc_of(SMEAR_RECONSTRUCT, 400);
    make_scenes(SMEAR_RECONSTRUCT);
    memset(called_from, 0, sizeof called_from);
    calls_from = INSPECT;
    RIG(r, &desc, true);
    drawing = &r;
    r.desc.debug.inspect = inspect_and_call;
    CHECK_EQ(smear_init(&r.ctx, &r.desc, r.block + GUARD, r.bytes), SMEAR_OK);
    CHECK_EQ(rig_frame(&r, &scene.frame, scene.draw, SCENE_DRAWS), SMEAR_OK);
    CHECK_EQ(called_from[INSPECT], HEIGHT);
}

/* ------------------------------------------------------------------ ids */

enum { IDS = 6, POOL = 3 * IDS, ID_FRAMES = 12 };

/* Where an id is in a frame: it moves evenly, so that one that is not known is another picture. */
static smear_transform place_of(uint32_t id, int k)
{
    return pose_at(-1.5 + 0.18 * id + 0.25 * k * (id % 3), -0.8 + 0.27 * (id % 7), -5, 0.1 * k * (id % 2), 0);
}

/* Which ids a frame has: mostly those of the last one, or some others, or all others. */
static int choose_ids(uint32_t id[IDS], int count)
{
    const uint32_t turn = random_u32() % 3;
    if (turn == 0 || count == 0) {
        const uint32_t first = random_u32() % POOL;
        count = chance(2) ? IDS : 1 + (int)(random_u32() % IDS);
        for (int i = 0; i < count; i++)
            id[i] = 1 + (first + (uint32_t)i) % POOL;
    } else if (turn == 1) {
        id[random_u32() % (uint32_t)count] = 1 + random_u32() % POOL;
    }
    return count;
}

/* Begins a frame, submits what is not twice in it, and renders it, or not. */
static void draw_ids(struct rig *r, const uint32_t id[IDS], int count, int k, uint32_t flags)
{
    smear_frame frame = scene.frame;
    frame.cut = flags % 8 == 0;
    rig_forget_output(r);
    CHECK_EQ(smear_begin(r->ctx, &frame), SMEAR_OK);
    for (int i = 0; i < count; i++) {
        const smear_transform now = place_of(id[i], k);
        const smear_draw draw = { .id = id[i], .mesh = &cube, .now = &now, .cut = flags >> (3 + i) & 7 ? 0 : 1 };
        bool again = false;
        for (int j = 0; j < i; j++)
            again = again || id[j] == id[i];
        CHECK_EQ(smear_error_kind(smear_submit(r->ctx, &draw)), again ? SMEAR_ERR_ARG : SMEAR_OK);
    }
    if (flags >> 24 & 7)
        CHECK_EQ(smear_render(r->ctx), SMEAR_OK);
}

/* Contexts for as many draws as there are, and for four times as many, know as much of ids. */
static void check_ids(bool one_pose)
{
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .max_triangles = 300, .max_draws = IDS, .reuse.one_pose = one_pose };
    struct rig full, ample;
    uint32_t id[IDS];
    int count = 0;
    make_scene(&scene, 0, SMEAR_AUTO);
    const bool ok = rig_begin(&full, &desc, false);
    desc.max_draws = 4 * POOL;
    if (rig_begin(&ample, &desc, false) && ok)
        for (int k = 0; k < ID_FRAMES; k++) {
            count = choose_ids(id, count);
            const uint32_t flags = random_u32();
            draw_ids(&full, id, count, k, flags);
            draw_ids(&ample, id, count, k, flags);
            CHECK(full.picture_size == ample.picture_size);
            same_picture(&full, ample.picture);
        }
    rig_end(&full);
    rig_end(&ample);
}

static void test_as_many_ids_are_known_as_a_frame_may_have_whichever_they_are(void)
{
    random_state = 7;
    for (int n = 0; n < 400; n++)
        check_ids(n % 4 == 0);
}

#include "build/suites/states.h"
