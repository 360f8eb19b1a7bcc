/* SPDX-License-Identifier: MIT */
/* test_jumps.c - what jumps in a file is joined by no path: held keys, two keys at almost the same time, ends of a loop that do
 * not meet, of nodes, cameras and morph weights. Random files by the thousand, each against one that says the same without
 * jumps: as the reader poses it, as it looks, and as an actor of the converted model plays it. Motion without jumps stays as it
 * is, to the bit. */
#include "tests/host.h"
#include "tests/ref/accuracy.h"
#include "tests/ref/glb.h"

#include "tools/convert/build.h"
#include "tools/model/channel.h"
#include "tools/scenes/present.h"

/* ------------------------------------------------------------------ files */

enum { CORNERS = 8, VERTICES = 14, INDICES = 42, TARGETS = 2, MOST_NODES = 6, MOST_KEYS = 8, WIDTH = 320, HEIGHT = 240 };

/* What channels of a file may do. */
struct kinds {
    bool held, pairs, closes, mixed;    /* closes: the last key is the first */
};

/* A GLB in the making. */
struct file {
    uint8_t bin[1 << 15];
    size_t size;
    char views[1 << 14], accessors[1 << 14], nodes[1 << 12], samplers[1 << 14], channels[1 << 14];
    int accessor_count, channel_count;
};

static int add_accessor(struct file *f, int component, const char *type, int count, const void *data, size_t bytes)
{
    memcpy(f->bin + f->size, data, bytes);
    append(f->views, sizeof f->views, "%s{'buffer':0,'byteOffset':%zu,'byteLength':%zu}", f->accessor_count > 0 ? "," : "",
           f->size, bytes);
    append(f->accessors, sizeof f->accessors, "%s{'bufferView':%d,'componentType':%d,'type':'%s','count':%d}",
           f->accessor_count > 0 ? "," : "", f->accessor_count, component, type, count);
    f->size += (bytes + 3) / 4 * 4;
    return f->accessor_count++;
}

/* And two crumbs far from it, so that its steps reach beyond where its targets lead. */
static void add_cube(struct file *f)
{
    static const uint16_t corner[INDICES] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                              2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5, 8, 9, 10, 11, 12, 13 };
    float position[VERTICES][3], color[VERTICES][4], target[TARGETS][VERTICES][3];
    for (int v = 0; v < VERTICES; v++) {
        for (int k = 0; k < 3; k++) {
            position[v][k] = v >= CORNERS ? (v < 11 ? 4.0f : -4.0f) + 0.01f * (float)(v % 3 == k)
                           : (v >> k & 1) != 0 ? 0.6f : -0.6f;
            color[v][k] = (v >> k & 1) != 0 ? 1.0f : 0.2f;
            for (int t = 0; t < TARGETS; t++)
                target[t][v][k] = v < CORNERS ? (float)uniform(-0.5, 0.5) : 0.0f;
        }
        color[v][3] = 1.0f;
    }
    add_accessor(f, 5126, "VEC3", VERTICES, position, sizeof position);
    add_accessor(f, 5126, "VEC4", VERTICES, color, sizeof color);
    add_accessor(f, 5123, "SCALAR", INDICES, corner, sizeof corner);
    for (int t = 0; t < TARGETS; t++)
        add_accessor(f, 5126, "VEC3", VERTICES, target[t], sizeof target[t]);
}

static void random_value(const char *path, bool held, float *out)
{
    if (path[0] == 'r') {
        double q[4], length = 0;
        for (int k = 0; k < 4; k++) {
            q[k] = uniform(-1, 1);
            length += q[k] * q[k];
        }
        for (int k = 0; k < 4; k++)
            out[k] = (float)(q[k] / sqrt(length + 1e-9));
        return;
    }
    const bool scales = path[0] == 's', weighs = path[0] == 'w';
    const double low = scales ? 0.3 : weighs ? 0 : -2, high = scales ? 1.3 : weighs ? 1 : 2;
    const double times = held && scales && chance(4) ? 0 : 1;          /* a picture that is shown or not */
    for (int k = 0; k < 3; k++)
        out[k] = (float)(times * uniform(low, high));
}

/* Keys of one path of a node; now and then at times of frames, as they are exported. */
static void add_channel(struct file *f, int node, const char *path, const struct kinds *kinds)
{
    static const char *const name[] = { "STEP", "LINEAR", "CUBICSPLINE" };
    const int width = path[0] == 'r' ? 4 : path[0] == 'w' ? TARGETS : 3, keys = between(1, MOST_KEYS);
    const int mode = kinds->held && (!kinds->mixed || chance(2)) ? 0 : path[0] == 'r' || chance(2) ? 1 : 2;
    const bool on_frames = chance(2);
    float time[MOST_KEYS], value[MOST_KEYS][3][4] = { { { 0 } } }, packed[MOST_KEYS * 12];
    double at = chance(2) ? 0 : uniform(0, 0.2);
    bool was_pair = true;
    for (int key = 0, n = 0; key < keys; key++) {
        time[key] = (float)(on_frames ? floor(at * 30 + 0.5) / 30 : at);
        if (key > 0 && !was_pair && kinds->pairs && chance(3)) {
            was_pair = true;
            time[key] = time[key - 1] + 0.0002f;
        } else {
            was_pair = false;
        }
        at += uniform(0.05, 0.3);
        random_value(path, mode == 0, value[key][1]);
        if (kinds->closes && key == keys - 1)
            memcpy(value[key][1], value[0][1], sizeof value[key][1]);
        for (int k = 0; k < width && mode == 2; k++) {
            value[key][0][k] = (float)uniform(-1, 1);
            value[key][2][k] = (float)uniform(-1, 1);
        }
        for (int part = mode == 2 ? 0 : 1; part < (mode == 2 ? 3 : 2); part++)
            for (int k = 0; k < width; k++)
                packed[n++] = value[key][part][k];
    }
    const int values = (mode == 2 ? 3 : 1) * keys, floats = values * width;
    const int input = add_accessor(f, 5126, "SCALAR", keys, time, (size_t)keys * 4);
    const int output = add_accessor(f, 5126, path[0] == 'r' ? "VEC4" : path[0] == 'w' ? "SCALAR" : "VEC3",
                                    path[0] == 'w' ? floats : values, packed, (size_t)floats * 4);
    append(f->samplers, sizeof f->samplers, "%s{'input':%d,'output':%d,'interpolation':'%s'}", f->channel_count > 0 ? "," : "",
           input, output, name[mode]);
    append(f->channels, sizeof f->channels, "%s{'sampler':%d,'target':{'node':%d,'path':'%s'}}", f->channel_count > 0 ? "," : "",
           f->channel_count, node, path);
    f->channel_count++;
}

/* A camera's node, and cubes on nodes that hang on each other. */
static void add_nodes(struct file *f, const struct kinds *kinds)
{
    const int count = between(2, MOST_NODES);
    int parent[MOST_NODES] = { -1, -1 };
    for (int i = 2; i < count; i++)
        parent[i] = chance(2) ? -1 : between(1, i - 1);
    append(f->nodes, sizeof f->nodes, "{'translation':[0,0,9],'children':[%d]}", count);
    for (int i = 1; i < count; i++) {
        append(f->nodes, sizeof f->nodes, ",{'mesh':0,'translation':[%.3f,%.3f,%.3f]", uniform(-2, 2), uniform(-2, 2),
               uniform(-2, 2));
        for (int k = i + 1, n = 0; k < count; k++)
            if (parent[k] == i)
                append(f->nodes, sizeof f->nodes, "%s%d", n++ > 0 ? "," : ",'children':[", k);
        for (int k = i + 1; k < count; k++)
            if (parent[k] == i) {
                append(f->nodes, sizeof f->nodes, "]");
                break;
            }
        append(f->nodes, sizeof f->nodes, "}");
    }
    append(f->nodes, sizeof f->nodes, ",{'camera':0}],'scenes':[{'nodes':[0");
    for (int i = 1; i < count; i++) {
        if (parent[i] < 0)
            append(f->nodes, sizeof f->nodes, ",%d", i);
        static const char *const path[] = { "translation", "rotation", "scale", "weights" };
        for (int k = 0; k < 4; k++)
            if (chance(2) || i == 1)
                add_channel(f, i, path[k], kinds);
    }
    append(f->nodes, sizeof f->nodes, "]}],'scene':0");
    if (chance(2))
        add_channel(f, count, chance(2) ? "translation" : "rotation", kinds);
}

/* Draws a file that the reader reads. */
static bool random_model(const struct kinds *kinds, struct model *out)
{
    static struct file f;
    static char text[1 << 16];
    struct failure failure = { "" };
    f = (struct file){ .size = 0 };
    add_cube(&f);
    add_nodes(&f, kinds);
    text[0] = '\0';
    append(text, sizeof text,
           "{'asset':{'version':'2.0'},'buffers':[{'byteLength':%zu}],'bufferViews':[%s],'accessors':[%s],'materials':[{"
           "'extensions':{'KHR_materials_unlit':{}},'doubleSided':true}],'extensionsUsed':['KHR_materials_unlit'],"
           "'meshes':[{'weights':[0,0],'primitives':[{'attributes':{'POSITION':0,'COLOR_0':1},'indices':2,'material':0,"
           "'targets':[{'POSITION':3},{'POSITION':4}]}]}],'cameras':[{'type':'perspective','perspective':"
           "{'yfov':0.8,'znear':0.1,'zfar':1000}}],'nodes':[%s,'animations':[{'name':'a','samplers':[%s],'channels':[%s]}]}",
           f.size, f.views, f.accessors, f.nodes, f.samplers, f.channels);
    size_t size;
    uint8_t *glb = glb_make(text, f.bin, f.size, &size);
    const bool ok = model_parse(glb, size, NULL, out, &failure);
    free(glb);
    if (!ok)
        say("    %s\n", failure.text);
    return CHECK(ok);
}

/* ------------------------------------------------------------------ instants */

/* A frame: when it is, and what its poses are. */
struct moment {
    double time, fps;
    bool loop, shutter_poses;
    smear_exposure exposure;
};

/* Half of all frames are at times of keys that frames were exported at. */
static struct moment random_moment(const struct model *m)
{
    static const double rate[] = { 10, 15, 24, 30, 60 };
    struct moment out = { .fps = rate[between(0, 4)], .loop = chance(2), .shutter_poses = chance(3),
                          .exposure = (smear_exposure)between(0, 2) };
    const double last = m->clip[0].duration * (out.loop ? 3 : 1.2);
    out.time = chance(2) ? floor(uniform(0, last) * 30 + 0.5) / 30 : uniform(0, last);
    return out;
}

static double in_clip(const struct model *m, const struct moment *at, double time)
{
    const double duration = m->clip[0].duration, rest = at->loop && duration > 0 ? fmod(time, duration) : time;
    return rest < 0 && at->loop ? rest + duration : rest;
}

static struct present_options options_of(const struct moment *at)
{
    return (struct present_options){ .fps = at->fps, .shutter_degrees = 180, .exposure = at->exposure,
                                     .shutter_poses = at->shutter_poses, .method = SMEAR_AUTO };
}

/* The middle of the shutter's poses, or the frame's own time. */
static double now_of(const struct moment *at)
{
    const struct present_options o = options_of(at);
    double open, close;
    present_exposure(at->time, &o, &open, &close);
    return at->shutter_poses ? (open + close) / 2 : at->time;
}

/* A model as it is shown. */
struct shown {
    struct scene scene;
    struct presenter *presenter;
};

static bool show(struct model *m, const struct moment *at, struct shown *out)
{
    struct failure f = { "" };
    const struct scene_view view = { .clip = 0, .loop = at->loop, .camera = 0, .aspect = 4.0 / 3.0 };
    *out = (struct shown){ .presenter = NULL };
    const bool ok = scene_from_model(m, &view, &out->scene, &f) && (out->presenter = presenter_new(&out->scene, &f)) != NULL;
    if (!ok)
        say("    %s\n", f.text);
    return CHECK(ok);
}

static void close_shown(struct shown *s)
{
    presenter_free(s->presenter);
    scene_free(&s->scene);
}

static bool same_place(const smear_transform *a, const smear_transform *b)
{
    return (a == NULL) == (b == NULL) && (a == NULL || memcmp(a, b, sizeof *a) == 0);
}

static bool same_positions(const int16_t *a, const int16_t *b)
{
    return (a == NULL) == (b == NULL) && (a == NULL || memcmp(a, b, 3 * VERTICES * sizeof *a) == 0);
}

static bool same_frames(const struct presented *a, const struct presented *b)
{
    bool ok = a->draw_count == b->draw_count && a->frame.cut == b->frame.cut
           && memcmp(a->camera, b->camera, sizeof a->camera) == 0;
    for (int i = 0; ok && i < a->draw_count; i++) {
        const smear_draw *p = &a->draw[i], *q = &b->draw[i];
        ok = same_place(p->now, q->now) && same_place(p->open, q->open) && same_place(p->close, q->close) && p->cut == q->cut
          && same_positions(p->mesh->position, q->mesh->position) && same_positions(p->open_position, q->open_position)
          && same_positions(p->close_position, q->close_position);
    }
    return ok;
}

/* ------------------------------------------------------------------ held keys */

/* Every held channel stays as it is at this time of the clip. */
static void hold_all(struct model *m, double time)
{
    for (int i = 0; i < m->clip[0].channel_count; i++) {
        struct model_channel *c = &m->clip[0].channel[i];
        float now[4];
        int key = c->key_count - 1;
        if (c->interpolation != MODEL_STEP)
            continue;
        while (key > 0 && (double)c->time[key] > time)
            key--;
        memcpy(now, c->value + key * c->width, (size_t)c->width * sizeof *now);
        for (int k = 0; k < c->key_count; k++)
            memcpy(c->value + k * c->width, now, (size_t)c->width * sizeof *now);
    }
}

static int count(int usual)
{
    return is_thorough() ? 20 * usual : usual;
}

/* Two models that draw alike at this moment. */
static bool draw_alike(struct model *a, struct model *b, const struct moment *at)
{
    struct failure f = { "" };
    struct shown s, t;
    bool ok = show(a, at, &s) && show(b, at, &t);
    const struct present_options o = options_of(at);
    const struct presented *p = ok ? presenter_frame(s.presenter, at->time, &o, &f) : NULL;
    const struct presented *q = ok ? presenter_frame(t.presenter, at->time, &o, &f) : NULL;
    if (!ok)
        return false;
    ok = p != NULL && q != NULL ? same_frames(p, q) : p == q;
    close_shown(&s);
    close_shown(&t);
    return ok;
}

static void test_held_keys_jump_without_a_path(void)
{
    for (int i = 0; i < count(1500); i++) {
        const struct kinds kinds = { .held = true, .mixed = i % 3 != 0, .pairs = i % 2 != 0, .closes = i % 5 == 0 };
        struct model m, held;
        random_state = 1000u + (uint32_t)i;
        END_UNLESS(random_model(&kinds, &m));
        random_state = 1000u + (uint32_t)i;
        random_model(&kinds, &held);
        const struct moment at = random_moment(&m);
        hold_all(&held, in_clip(&m, &at, now_of(&at)));
        const bool ok = CHECK(draw_alike(&m, &held, &at));
        if (!ok)
            say("    file %d, %g s, %g frames a second\n", i, at.time, at.fps);
        model_free(&m);
        model_free(&held);
        if (!ok)
            return;
    }
}

/* ------------------------------------------------------------------ pictures */

static bool draw_picture(struct model *m, const struct moment *at, bool cut, struct shot *out)
{
    const struct shot_options look = { .width = WIDTH, .height = HEIGHT };
    struct shown s;
    struct present_options o = options_of(at);
    o.cut = cut;
    if (!show(m, at, &s))
        return false;
    struct subject subject = { .name = "jumps", .width = WIDTH, .height = HEIGHT, .time = at->time, .fps = at->fps,
                               .scene = s.scene, .presenter = s.presenter };
    const bool ok = CHECK(shot_take(&subject, &o, &look, out));
    close_shown(&s);
    return ok;
}

/* Where held keys are all that moves, nothing does in any one frame: it is the sharp one, but for the pixels of an edge that lies
 * between two rows, which what is given poses rounds in its own way. */
static void test_a_frame_in_which_all_jumps_is_sharp(void)
{
    const struct kinds kinds = { .held = true };
    int seen = 0;
    for (int i = 0; i < count(150); i++) {
        struct shot a OWNED(shot_free) = { 0 }, b = { 0 };
        struct model m OWNED(model_free) = { 0 };
        double sum = 0;
        random_state = 70000u + (uint32_t)i;
        END_UNLESS(random_model(&kinds, &m));
        struct moment at = random_moment(&m);
        at.time = (double)m.clip[0].channel[0].time[m.clip[0].channel[0].key_count / 2] + 0.3 * (i % 2) / at.fps;
        const bool ok = draw_picture(&m, &at, false, &a) && draw_picture(&m, &at, true, &b);
        for (size_t k = 0; ok && k < 3 * WIDTH * HEIGHT; k++) {
            sum += (double)(a.rgb[k] - b.rgb[k]) * (a.rgb[k] - b.rgb[k]);
            seen += a.rgb[k] != 0;
        }
        if (!CHECK(sqrt(sum / (3 * WIDTH * HEIGHT)) <= 4.0))
            say("    file %d, %g s, %g frames a second\n", i, at.time, at.fps);
        shot_free(&b);
    }
    CHECK(seen > 100000);
}

/* ------------------------------------------------------------------ no jump */

static bool same_instants(const struct scene_instant *a, const struct scene_instant *b)
{
    bool ok = a->draw_count == b->draw_count && memcmp(a->camera.pose, b->camera.pose, sizeof a->camera.pose) == 0;
    for (int i = 0; ok && i < a->draw_count; i++)
        ok = memcmp(a->draw[i].world, b->draw[i].world, sizeof a->draw[i].world) == 0
          && memcmp(a->draw[i].position, b->draw[i].position, 3 * VERTICES * sizeof(float)) == 0;
    return ok;
}

static void test_motion_without_jumps_is_posed_as_ever(void)
{
    for (int i = 0; i < count(1500); i++) {
        struct kinds kinds = { .closes = i % 2 != 0 };
        struct failure f = { "" };
        struct model m;
        struct shown s;
        struct scene_instant own = { 0 }, joined = { 0 };
        random_state = 20000u + (uint32_t)i;
        END_UNLESS(random_model(&kinds, &m));
        struct moment at = random_moment(&m);
        at.loop = at.loop && kinds.closes;
        bool ok = show(&m, &at, &s);
        for (int pose = -3; ok && pose <= 1; pose++) {
            const double time = at.time + pose / at.fps;
            const bool is_own = scene_pose(&s.scene, time, &own, &f);
            ok = CHECK_EQ(is_own, scene_pose_joined(&s.scene, time, at.time, &joined, &f));
            ok = ok && (!is_own || CHECK(same_instants(&own, &joined)));
        }
        scene_instant_free(&s.scene, &own);
        scene_instant_free(&s.scene, &joined);
        close_shown(&s);
        model_free(&m);
        if (!ok)
            return;
    }
}

/* ------------------------------------------------------------------ two keys at a time, ends that do not meet */

/* A key on a line of time that knows no laps. */
struct entry {
    double time, value[3][4];   /* arrives, is, leaves */
    int lap, last_lap;          /* it belongs to: two, where ends meet */
    bool jumps;                 /* from here to the next */
};

struct line {
    int count;
    struct entry entry[7 * (MOST_KEYS + 3)];
};

static struct entry entry_of(const struct model_channel *c, int key, int lap, double end)
{
    struct entry e = { .time = (double)c->time[key] + lap * end, .lap = lap, .last_lap = lap };
    for (int part = 0; part < 3; part++)
        for (int k = 0; k < c->width; k++)
            e.value[part][k] = c->interpolation == MODEL_CUBICSPLINE ? (double)c->value[(3 * key + part) * c->width + k]
                             : part == 1 ? (double)c->value[key * c->width + k] : 0;
    e.jumps = key + 1 < c->key_count && c->time[key + 1] - c->time[key] < 0.0005f;
    return e;
}

static bool meets(const struct model_channel *c)
{
    const struct entry first = entry_of(c, 0, 0, 0), last = entry_of(c, c->key_count - 1, 0, 0);
    for (int k = 0; k < c->width; k++)
        if (first.value[1][k] != last.value[1][k])
            return false;
    return true;
}

/* The keys of seven laps, or of one that does not start again; where ends meet they are one key. */
static void unroll(const struct model_channel *c, bool loop, double end, struct line *line)
{
    line->count = 0;
    for (int lap = loop ? -3 : 0; lap <= (loop ? 3 : 0); lap++) {
        bool is_first = lap > -3;
        for (int key = -1; key <= c->key_count; key++) {
            const bool is_edge = key < 0 || key == c->key_count, starts = key < 0;
            if (is_edge && (!loop || (starts ? c->time[0] <= 0 : (double)c->time[key - 1] >= end)))
                continue;
            struct entry e = entry_of(c, starts ? 0 : is_edge ? key - 1 : key, lap, end);
            if (is_edge) {
                e.time = (starts ? lap : lap + 1) * end;
                e.jumps = false;
                memset(e.value[0], 0, sizeof e.value[0]);
                memset(e.value[2], 0, sizeof e.value[2]);
            }
            if (key == 0)               /* what is held before and behind all keys neither arrives nor leaves */
                memset(e.value[0], 0, sizeof e.value[0]);
            if (key == c->key_count - 1)
                memset(e.value[2], 0, sizeof e.value[2]);
            struct entry *before = line->count > 0 ? &line->entry[line->count - 1] : NULL;
            if (loop && is_first && before != NULL) {
                is_first = false;
                before->jumps = !meets(c) || e.jumps;
                if (meets(c)) {
                    memcpy(before->value[2], e.value[2], sizeof e.value[2]);
                    before->last_lap = lap;
                    continue;
                }
            }
            line->entry[line->count++] = e;
        }
    }
}

/* The entry on the other side of `about`, in time and in value. */
static struct entry other_side(const struct model_channel *c, const struct entry *about, const struct entry *e)
{
    struct entry out = { .time = 2 * about->time - e->time };
    const double *a = about->value[1];
    for (int part = 0; part < 3; part++) {
        const double *v = e->value[2 - part];
        for (int k = 0; k < c->width; k++)
            out.value[part][k] = part == 1 ? 2 * a[k] - v[k] : v[k];
    }
    if (c->path == MODEL_ROTATION) {    /* a b' a, where b' is b's inverse */
        const double *b = e->value[1];
        double ab[4], length = a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3];
        const double way[4] = { a[0] * b[3] - a[3] * b[0] - a[1] * b[2] + a[2] * b[1],
                                a[1] * b[3] - a[3] * b[1] - a[2] * b[0] + a[0] * b[2],
                                a[2] * b[3] - a[3] * b[2] - a[0] * b[1] + a[1] * b[0],
                                a[3] * b[3] + a[0] * b[0] + a[1] * b[1] + a[2] * b[2] };
        ab[0] = way[3] * a[0] + way[0] * a[3] + way[1] * a[2] - way[2] * a[1];
        ab[1] = way[3] * a[1] - way[0] * a[2] + way[1] * a[3] + way[2] * a[0];
        ab[2] = way[3] * a[2] + way[0] * a[1] - way[1] * a[0] + way[2] * a[3];
        ab[3] = way[3] * a[3] - way[0] * a[0] - way[1] * a[1] - way[2] * a[2];
        for (int k = 0; k < 4; k++)
            out.value[1][k] = ab[k] / length;
    }
    return out;
}

/* Makes the channel one that goes on beyond the jumps around `now` as it does at them. False where `now` is amid a jump. */
static bool straighten(struct model_channel *c, bool loop, double end, double now)
{
    static struct line line, out;
    int at = 0, first, last;
    unroll(c, loop, end, &line);
    while (at + 1 < line.count && line.entry[at + 1].time <= now)
        at++;
    if (line.entry[at].jumps && now > line.entry[at].time && now < line.entry[at + 1].time)
        return false;
    for (first = at; first > 0 && !line.entry[first - 1].jumps;)
        first--;
    for (last = at; last + 1 < line.count && !line.entry[last].jumps;)
        last++;
    struct entry *a = &line.entry[first], *b = &line.entry[last];
    if (first > 0)
        memcpy(a->value[0], a->value[2], sizeof a->value[0]);
    if (last + 1 < line.count)
        memcpy(b->value[2], b->value[0], sizeof b->value[2]);
    out.count = 0;
    for (int k = last; first > 0 && k > first; k--)
        if (line.entry[k].lap <= a->lap && a->lap <= line.entry[k].last_lap)
            out.entry[out.count++] = other_side(c, a, &line.entry[k]);
    for (int k = first; k <= last; k++)
        out.entry[out.count++] = line.entry[k];
    for (int k = last - 1; last + 1 < line.count && k >= first; k--)
        if (line.entry[k].lap <= b->last_lap && b->last_lap <= line.entry[k].last_lap)
            out.entry[out.count++] = other_side(c, b, &line.entry[k]);
    const int parts = c->interpolation == MODEL_CUBICSPLINE ? 3 : 1;
    float *time = calloc((size_t)out.count, sizeof *time);
    float *value = calloc((size_t)(out.count * parts * c->width), sizeof *value);
    for (int i = 0; i < out.count && time != NULL && value != NULL; i++) {
        time[i] = (float)out.entry[i].time;
        for (int part = 0; part < parts; part++)
            for (int k = 0; k < c->width; k++)
                value[(i * parts + part) * c->width + k] = (float)out.entry[i].value[parts == 1 ? 1 : part][k];
    }
    free(c->time);
    free(c->value);
    c->time = time;
    c->value = value;
    c->key_count = out.count;
    return CHECK(time != NULL && value != NULL);
}

static bool close_poses(const struct model *m, const struct model_pose *a, const struct model_pose *b)
{
    bool ok = true;
    for (int k = 0; ok && k < 16 * m->node_count; k++)
        ok = CHECK_CLOSE(a->node_world[k], b->node_world[k], 2e-3);
    for (int i = 0; ok && i < a->draw_count; i++)
        for (int k = 0; ok && k < 3 * VERTICES; k++)
            ok = CHECK_CLOSE((double)a->draw[i].position[k], (double)b->draw[i].position[k], 2e-3);
    return ok;
}

static void test_motion_goes_on_beyond_a_jump_as_on_its_near_side(void)
{
    int jumped = 0;
    for (int i = 0; i < count(1500); i++) {
        const struct kinds kinds = { .pairs = i % 3 != 0, .closes = i % 2 != 0 };
        struct failure f = { "" };
        struct model m, straight;
        struct model_pose plain = { 0 }, joined = { 0 }, want = { 0 };
        random_state = 40000u + (uint32_t)i;
        END_UNLESS(random_model(&kinds, &m));
        random_state = 40000u + (uint32_t)i;
        random_model(&kinds, &straight);
        const struct moment at = random_moment(&m);
        const double now = in_clip(&m, &at, at.time);
        bool ok = true, is_amid = false;
        for (int k = 0; k < m.clip[0].channel_count; k++)
            is_amid = !straighten(&straight.clip[0].channel[k], at.loop, m.clip[0].duration, now) || is_amid;
        for (int pose = -2; ok && !is_amid && pose <= 1; pose++) {
            const double apart = pose / at.fps;
            if (at.loop && fabs(apart) > 2 * m.clip[0].duration)
                continue;
            ok = CHECK(model_pose(&m, 0, at.time + apart, at.loop, &plain, &f))
              && CHECK(model_pose_joined(&m, 0, at.time + apart, at.time, at.loop, &joined, &f))
              && CHECK(model_pose(&straight, 0, now + apart, false, &want, &f)) && close_poses(&m, &joined, &want);
            for (int k = 0, apart_now = 0; k < 16 * m.node_count && ok; k++)
                if (fabs(plain.node_world[k] - joined.node_world[k]) > 0.1 && apart_now++ == 0)
                    jumped++;
            if (!ok)
                say("    file %d, pose %d at %g s of %g, %g frames a second\n", i, pose, at.time, m.clip[0].duration, at.fps);
        }
        model_pose_free(&plain);
        model_pose_free(&joined);
        model_pose_free(&want);
        model_free(&m);
        model_free(&straight);
        if (!ok)
            return;
    }
    CHECK(jumped > 300);
}

/* ------------------------------------------------------------------ actors */

/* Where a vertex of a draw is in one of its poses, in world units. */
static void device_point(double out[3], const smear_draw *draw, const smear_transform *place, const int16_t *position, int vertex)
{
    const smear_mesh *mesh = draw->mesh;
    for (int row = 0; row < 3; row++) {
        out[row] = place->origin[row] / 65536.0;
        for (int k = 0; k < 3; k++)
            out[row] += place->basis[3 * row + k] / 16777216.0
                      * ldexp((double)(position[3 * vertex + k] + mesh->offset[k]) * mesh->scale, -mesh->shift);
    }
}

/* The largest distance in one pose of the actor from where the file has it, world units. */
static double farthest(const struct conversion *c, smear_actor *actor, int pose, const struct model_pose *file)
{
    double largest = 0;
    for (int i = 0; i < c->model.draw_count; i++) {
        smear_draw draw;
        if (!CHECK_EQ(smear_actor_draw(actor, i, &draw), SMEAR_OK))
            return INFINITY;
        const smear_transform *place = pose == 0 ? draw.now : pose == 1 ? draw.open : draw.close;
        const int16_t *position = pose == 1 ? draw.open_position : pose == 2 ? draw.close_position : NULL;
        if (!CHECK(place != NULL))
            return INFINITY;
        for (int k = 0; k < c->origin_count[i]; k++) {
            const struct convert_origin *o = &c->origin[i][k];
            const struct model_draw *from = &file->draw[o->draw];
            double there[3], here[3], sum = 0;
            const double in_file[3] = { (double)from->position[3 * o->vertex], (double)from->position[3 * o->vertex + 1],
                                        (double)from->position[3 * o->vertex + 2] };
            transform_double(there, from->world, in_file);
            const int16_t *at = position != NULL ? position : draw.mesh->position;
            device_point(here, &draw, place, at, o->mesh_vertex);
            for (int axis = 0; axis < 3; axis++)
                sum += (here[axis] - there[axis]) * (here[axis] - there[axis]);
            largest = fmax(largest, sqrt(sum));
        }
    }
    return largest;
}

/* Whether a key lies so near one of these times that ticks may put it on the other side. */
static bool is_near_a_key(const struct model *m, bool loop, const int32_t *time, int times)
{
    const double end = m->clip[0].duration, slack = 4 / 65536.0;
    for (int k = 0; k < times; k++) {
        const double at = loop && end > 0 ? fmod(time[k] / 65536.0, end) : time[k] / 65536.0;
        for (int i = 0; i < m->clip[0].channel_count; i++)
            for (int key = 0; key < m->clip[0].channel[i].key_count; key++)
                if (fabs((double)m->clip[0].channel[i].time[key] - at) < slack + 0.0003)
                    return true;
        if (loop && (at < slack || end - at < slack))
            return true;
    }
    return false;
}

static bool play_alike(const struct model *m, const struct conversion *c, const struct moment *at, smear_actor *actor)
{
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    struct failure f = { "" };
    int32_t time[3];
    bool ok = true;
    for (int k = 0; k < 3; k++)
        time[k] = (int32_t)floor((at->time - k / at->fps + 4 * m->clip[0].duration) * 65536);
    if (!at->loop)
        for (int k = 0; k < 3; k++)
            time[k] = (int32_t)floor(fmax(at->time - k / at->fps, 0) * 65536);
    if (is_near_a_key(m, at->loop, time, 3))
        return true;
    for (int k = 2; k >= 0; k--) {
        const smear_play play = { .loop = at->loop, .time = time[k] };
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
    }
    for (int k = 0; k < 3 && ok; k++) {
        ok = CHECK(model_pose_joined(m, 0, time[k] / 65536.0, time[0] / 65536.0, at->loop, &pose, &f));
        const double px = ok ? farthest(c, actor, k, &pose) * c->pixels_per_unit : 0;
        ok = ok && CHECK(px < 2.0);          /* keys 0.2 ms apart are at one time there */
        if (!ok)
            say("    pose %d at %g s of %g, %g frames a second%s: off by %.2f px\n", k, time[k] / 65536.0, m->clip[0].duration,
                at->fps, at->loop ? ", looped" : "", px);
    }
    return ok;
}

static void test_an_actor_jumps_as_the_file_does(void)
{
    for (int i = 0; i < count(400); i++) {
        const struct kinds kinds = { .held = i % 4 != 0, .mixed = true, .pairs = i % 2 != 0, .closes = i % 3 == 0 };
        const int clip = 0;
        const struct convert_options o = { .clip = &clip, .clip_count = 1, .scale = 1, .texture_edge = 128, .colors = 256,
                                           .influences = 4, .clip_error_px = 0.02, .rows = 240, .fov_degrees = 45 };
        struct failure f = { "" };
        struct conversion c;
        struct model m;
        random_state = 90000u + (uint32_t)i;
        END_UNLESS(random_model(&kinds, &m));
        bool ok = convert_model(&m, &o, &c, &f);
        if (!ok)
            say("    file %d: %s\n", i, f.text);
        else {
            const size_t bytes = smear_actor_memory(&c.model, 3);
            void *memory = malloc(bytes);
            smear_actor *actor = NULL;
            ok = CHECK(memory != NULL) && CHECK_EQ(smear_actor_init(&actor, &c.model, 3, memory, bytes), SMEAR_OK);
            for (int k = 0; k < 8 && ok; k++) {
                const struct moment at = random_moment(&m);
                ok = play_alike(&m, &c, &at, actor);
            }
            if (!ok)
                say("    file %d\n", i);
            free(memory);
            conversion_free(&c);
        }
        model_free(&m);
        REQUIRE(ok);
    }
}

#include "build/suites/jumps.h"
