/* SPDX-License-Identifier: MIT */
/* accuracy.c - see accuracy.h. Reads the library's own window (src/filter/probe.h), so that a filter can
 * be compared on the very velocities it read. */
#include "tests/ref/accuracy.h"

#include "tests/host.h"

#include "filter/probe.h"
#include "tools/player/crew.h"

#include <dirent.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <time.h>

/* ------------------------------------------------------------------ figures */

void say(const char *format, ...)
{
    char line[400];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    test_print(line);
}

bool check_bar(double got, double bar, const char *subject, const char *what, const char *file,
               int line)
{
    if (got <= bar)
        return true;
    test_state.failures_here++;
    say("  %s:%d: %s: %s is %.5g, bar %.5g\n", file, line, subject, what, got, bar);
    return false;
}

double cpu_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

bool is_thorough(void)
{
    const char *value = getenv("SMEAR_THOROUGH");
    return value != NULL && value[0] != '\0' && value[0] != '0';
}

/* A failed step of a test: says why and counts. */
static bool broken(const struct subject *s, const struct failure *f)
{
    test_state.failures_here++;
    say("  %s: %s\n", s->name, f->text);
    return false;
}

/* ------------------------------------------------------------------ subjects */

const char *const suite_kind[SUITE_KINDS] = {
    "suite/translate", "suite/propeller", "suite/cross", "suite/fence_obj", "suite/enter",
    "suite/near", "suite/long", "suite/skin", "suite/swarm", "suite/teleport", "suite/morph",
    "suite/cubic",
    "suite/pan", "suite/dolly", "suite/roll", "suite/fence_fg", "suite/textured", "suite/arena",
    "suite/subpixel",
    "suite/still",
};

const char *const trial_kind[TRIAL_KINDS] = {
    "test/floor256", "test/floor1000", "test/soup", "test/room", "test/slivers", "test/boxes",
    "test/leaves", "test/terrain", "test/ortho",
};

static bool subject_ready(struct subject *s, struct failure *f)
{
    s->presenter = presenter_new(&s->scene, f);
    return s->presenter != NULL;
}

bool subject_open(struct subject *s, const char *name)
{
    struct failure f = {{0}};
    *s = (struct subject){0};
    snprintf(s->name, sizeof s->name, "%s", name);
    if (!scene_builtin(name, &s->scene, &f))
        return broken(s, &f);
    s->width = s->scene.width;
    s->height = s->scene.height;
    s->time = s->scene.time;
    s->fps = s->scene.fps;
    if (subject_ready(s, &f))
        return true;
    scene_free(&s->scene);
    return broken(s, &f);
}

bool subject_open_file(struct subject *s, const char *path, int width, int height)
{
    struct failure f = {{0}};
    const char *slash = strrchr(path, '/');
    *s = (struct subject){.width = width, .height = height, .is_file = true, .fps = 30.0};
    snprintf(s->name, sizeof s->name, "%s", slash != NULL ? slash + 1 : path);
    if (!model_load(path, &s->model, &f))
        return broken(s, &f);
    struct scene_view view = {.clip = s->model.clip_count > 0 ? 0 : MODEL_CLIP_NONE, .loop = true,
                              .camera = s->model.camera_count > 0 ? 0 : -1,
                              .aspect = (double)width / height};
    if (s->model.clip_count > 0)
        s->time = 0.5 * s->model.clip[0].duration;
    if (!scene_from_model(&s->model, &view, &s->scene, &f)) {
        model_free(&s->model);
        return broken(s, &f);
    }
    if (subject_ready(s, &f))
        return true;
    scene_free(&s->scene);
    model_free(&s->model);
    return broken(s, &f);
}

void subject_close(struct subject *s)
{
    presenter_free(s->presenter);
    scene_free(&s->scene);
    if (s->is_file)
        model_free(&s->model);
    *s = (struct subject){0};
}

/* A scene that moves in its own way. */
struct wrapped {
    struct scene inner;
    double speed, time;
};

/* m turned about the vertical through `centre`. */
static void turn_about(double m[16], const double centre[3], double angle)
{
    double c = cos(angle), s = sin(angle);
    for (int column = 0; column < 4; column++) {
        double *v = m + 4 * column, x = v[0], z = v[2];
        if (column == 3) {
            x -= centre[0];
            z -= centre[2];
        }
        v[0] = c * x + s * z;
        v[2] = c * z - s * x;
        if (column == 3) {
            v[0] += centre[0];
            v[2] += centre[2];
        }
    }
}

static bool circling_pose(struct scene *scene, double time, struct scene_instant *out,
                          struct failure *f)
{
    struct wrapped *w = scene->data;
    if (!scene_pose_joined(&w->inner, time, out->now, out, f))
        return false;
    struct scene_camera *camera = &out->camera;
    double far_plane = camera->zfar > 0.0 ? camera->zfar : 8.0 * camera->znear;
    double middle = 0.5 * (camera->znear + far_plane), centre[3];
    for (int i = 0; i < 3; i++)
        centre[i] = camera->pose[12 + i] - middle * camera->pose[8 + i];
    turn_about(camera->pose, centre, w->speed * (time - w->time));
    return true;
}

static bool held_pose(struct scene *scene, double time, struct scene_instant *out,
                      struct failure *f)
{
    struct wrapped *w = scene->data;
    (void)time;
    return scene_pose(&w->inner, w->time, out, f);
}

static void wrapped_instant_free(struct scene *scene, struct scene_instant *instant)
{
    struct wrapped *w = scene->data;
    scene_instant_free(&w->inner, instant);
}

static void wrapped_destroy(struct scene *scene)
{
    struct wrapped *w = scene->data;
    scene_free(&w->inner);
    free(w);
}

static bool wrap(struct subject *s, double speed,
                 bool (*pose)(struct scene *, double, struct scene_instant *, struct failure *))
{
    struct wrapped *w = malloc(sizeof *w);
    if (w == NULL)
        return false;
    *w = (struct wrapped){.inner = s->scene, .speed = speed, .time = s->time};
    s->scene.pose = pose;
    s->scene.instant_free = wrapped_instant_free;
    s->scene.destroy = wrapped_destroy;
    s->scene.data = w;
    return true;
}

bool subject_circle(struct subject *s, double radians_per_second)
{
    return wrap(s, radians_per_second, circling_pose);
}

bool subject_hold(struct subject *s)
{
    return wrap(s, 0.0, held_pose);
}

/* ------------------------------------------------------------------ files */

const char *asset_folder(void)
{
    static const char *const beside = "../shared/assets";
    const char *set = getenv("SMEAR_ASSETS");
    struct stat s;
    if (set != NULL && set[0] != '\0')
        return set;
    return stat(beside, &s) == 0 && S_ISDIR(s.st_mode) ? beside : NULL;
}

static bool has_suffix(const char *name, const char *suffix)
{
    size_t n = strlen(name), k = strlen(suffix);
    return n >= k && strcmp(name + n - k, suffix) == 0;
}

static bool is_model_name(const char *name)
{
    return has_suffix(name, ".glb") || has_suffix(name, ".gltf") || has_suffix(name, ".obj");
}

enum { MAX_ASSETS = 500, MAX_FOLDERS = 100 };

static char *path_join(const char *folder, const char *name)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path != NULL)
        snprintf(path, size, "%s/%s", folder, name);
    return path;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Adds a folder's models to `list` and its folders to `folder`. */
static bool list_folder(const char *path, char **list, int *count, char **folder, int *folders)
{
    DIR *dir = opendir(path);
    if (dir == NULL)
        return false;
    for (struct dirent *e; (e = readdir(dir)) != NULL;) {
        struct stat s;
        char *joined = e->d_name[0] != '.' ? path_join(path, e->d_name) : NULL;
        if (joined == NULL || stat(joined, &s) != 0)
            free(joined);
        else if (S_ISDIR(s.st_mode) && *folders < MAX_FOLDERS)
            folder[(*folders)++] = joined;
        else if (is_model_name(e->d_name) && *count < MAX_ASSETS)
            list[(*count)++] = joined;
        else
            free(joined);
    }
    closedir(dir);
    return true;
}

char **asset_list(const char *root)
{
    char **list = calloc(MAX_ASSETS + 1, sizeof *list), *folder[MAX_FOLDERS];
    int count = 0, folders = 0;
    if (list == NULL || !list_folder(root, list, &count, folder, &folders)) {
        free(list);
        return NULL;
    }
    for (int i = 0; i < folders; i++) {
        list_folder(folder[i], list, &count, folder, &folders);
        free(folder[i]);
    }
    qsort(list, (size_t)count, sizeof *list, by_name);
    return list;
}

void asset_list_free(char **list)
{
    for (char **at = list; at != NULL && *at != NULL; at++)
        free(*at);
    free(list);
}

/* ------------------------------------------------------------------ pictures */

/* The library's `user`: where its picture goes. */
struct taking {
    smear_context *ctx;
    struct shot *shot;
    const struct presented *presented;
};

static void store_rgb(uint8_t *out, uint32_t pixel)
{
    out[0] = (uint8_t)(pixel >> 16);
    out[1] = (uint8_t)(pixel >> 8);
    out[2] = (uint8_t)pixel;
}

static int take_band(void *user, const smear_band *band)
{
    struct shot *shot = ((struct taking *)user)->shot;
    for (int y = 0; y < band->height; y++) {
        const uint32_t *row = (const uint32_t *)band->pixels + (size_t)y * (band->stride / 4);
        uint8_t *out = shot->rgb + 3 * (size_t)(band->y + y) * (size_t)shot->width;
        for (int x = 0; x < shot->width; x++)
            store_rgb(out + 3 * x, row[x]);
    }
    return 0;
}

static void look_at_row(void *user, int y, const uint32_t *color, const uint16_t *depth,
                        const int32_t *velocity)
{
    struct taking *taking = user;
    struct shot *shot = taking->shot;
    const struct smear_window *w = &smear_probe(taking->ctx).rows->window;
    size_t row = (size_t)y * (size_t)shot->width, slot = (size_t)(window_ring_row(w, y) * w->width);
    for (size_t x = 0; x < (size_t)shot->width; x++) {
        store_rgb(shot->sharp + 3 * (row + x), color[x]);
        shot->depth[row + x] = depth[x];
        shot->distance[row + x] = (float)presented_depth(taking->presented, depth[x]);
        for (size_t i = 0; i < 2; i++) {
            size_t from = 2 * (slot + x) + i, to = 2 * (row + x) + i;
            shot->velocity[to] = (float)velocity[2 * x + i] / 256.0f;
            shot->packed[to] = w->velocity8 != NULL ? w->velocity8[from] : w->velocity16[from];
        }
    }
}

static bool shot_alloc(struct shot *shot, int width, int height, bool look)
{
    size_t n = (size_t)width * (size_t)height;
    *shot = (struct shot){.width = width, .height = height};
    shot->rgb = calloc(n, 3);
    if (!look)
        return shot->rgb != NULL;
    shot->sharp = calloc(n, 3);
    shot->depth = calloc(n, sizeof *shot->depth);
    shot->distance = calloc(n, sizeof *shot->distance);
    shot->velocity = calloc(n, 2 * sizeof *shot->velocity);
    shot->packed = calloc(n, 2 * sizeof *shot->packed);
    return shot->rgb != NULL && shot->sharp != NULL && shot->depth != NULL
        && shot->distance != NULL && shot->velocity != NULL && shot->packed != NULL;
}

void shot_free(struct shot *shot)
{
    free(shot->rgb);
    free(shot->sharp);
    free(shot->depth);
    free(shot->distance);
    free(shot->velocity);
    free(shot->packed);
    *shot = (struct shot){0};
}

static bool draw_presented(const struct presented *p, smear_desc *desc, struct taking *taking,
                           struct failure *f)
{
    size_t bytes = smear_memory_size(desc);
    void *memory = bytes != 0 ? malloc(bytes) : NULL;
    if (memory == NULL)
        return fail(f, "the library has no such frame (%d x %d)", desc->width, desc->height);
    struct crew *crew = crew_start(desc->workers, f);
    int result = smear_init(&taking->ctx, desc, memory, bytes);
    if (result == SMEAR_OK)
        result = presented_submit(p, taking->ctx);
    if (result == SMEAR_OK)
        result = crew_render(crew, taking->ctx);
    if (result == SMEAR_OK)
        smear_get_stats(taking->ctx, &taking->shot->stats);
    crew_stop(crew);
    free(memory);
    return result == SMEAR_OK || fail(f, "the library refuses the frame: %s", smear_error_text(result));
}

bool shot_draw(struct subject *s, const struct presented *p, const struct shot_options *o, struct shot *out)
{
    struct failure f = {{0}};
    const int width = o->width != 0 ? o->width : s->width, height = o->height != 0 ? o->height : s->height;
    struct taking taking = {.shot = out, .presented = p};
    smear_desc desc = presented_desc(p, width, height);
    desc.reach = (int16_t)o->reach;
    desc.tile = (int16_t)o->tile;
    desc.filter.scatter = o->scatter;
    desc.workers = (uint8_t)(o->workers > 1 ? o->workers : 1);
    desc.format = SMEAR_XRGB8888;
    desc.debug.crc = 1;
    desc.methods |= SMEAR_SET(SMEAR_RECONSTRUCT);
    if (p->frame.method == SMEAR_AUTO && p->frame.target >= SMEAR_DRAFT)
        desc.methods |= SMEAR_SET_SKETCH;
    desc.flush = take_band;
    desc.debug.inspect = o->look ? look_at_row : NULL;
    desc.idle = crew_idle;
    desc.user = &taking;
    /* A full list costs time only, but for a single row of tiles that does not fit it. */
    desc.max_triangles = o->triangles != 0 ? (uint32_t)o->triangles : 5 * desc.max_triangles;
    bool room = shot_alloc(out, width, height, o->look);
    out->orthographic = p->orthographic;
    out->near_plane = p->near_plane;
    out->far_plane = p->far_plane;
    if (!room)
        fail(&f, "no memory for a picture");
    else if (draw_presented(p, &desc, &taking, &f))
        return true;
    shot_free(out);
    return broken(s, &f);
}

bool shot_take(struct subject *s, const struct present_options *present, const struct shot_options *o, struct shot *out)
{
    struct failure f = {{0}};
    const struct presented *p = presenter_frame(s->presenter, s->time, present, &f);
    *out = (struct shot){0};
    return p != NULL ? shot_draw(s, p, o, out) : broken(s, &f);
}

struct present_options subject_options(const struct subject *s)
{
    return (struct present_options){.fps = s->fps, .shutter_degrees = 180.0,
                                    .clear = s->scene.clear};
}

/* ------------------------------------------------------------------ reference */

static bool pose_and_draw(struct subject *s, const struct present_options *present,
                          const struct ref_options *o, struct scene_instant instant[3],
                          struct ref_frame *out, struct failure *f)
{
    double open = s->time - 1.0 / s->fps, close = s->time;
    if (present->shutter_poses)
        present_exposure(s->time, present, &open, &close);
    if (!scene_pose(&s->scene, s->time, &instant[0], f)
        || !scene_pose_joined(&s->scene, open, s->time, &instant[1], f)
        || !scene_pose_joined(&s->scene, close, s->time, &instant[2], f))
        return false;
    return ref_draw(&instant[0], &instant[1], &instant[2], o, out, f);
}

bool reference_take(struct subject *s, const struct present_options *present, int width, int height,
                    struct ref_frame *out)
{
    struct failure f = {{0}};
    struct scene_instant instant[3];
    struct ref_options o = {.width = width, .height = height, .clear = present->clear,
                            .encoded = present->light == SMEAR_LIGHT_ENCODED,
                            .motion = present->motion, .motion_count = present->motion_count};
    if (present->shutter_poses)
        o.velocity_scale = 360.0 / present->shutter_degrees;
    memset(instant, 0, sizeof instant);
    bool ok = pose_and_draw(s, present, &o, instant, out, &f);
    for (int i = 0; i < 3; i++)
        scene_instant_free(&s->scene, &instant[i]);
    return ok || broken(s, &f);
}

double rmse_to_truth(const uint8_t *rgb, const struct ref_truth *truth)
{
    double sum = 0.0;
    size_t n = 3 * (size_t)truth->width * (size_t)truth->height;
    for (size_t i = 0; i < n; i++) {
        double d = rgb[i] - truth->code[i];
        sum += d * d;
    }
    return sqrt(sum / (double)n);
}

int picture_difference(const uint8_t *a, const uint8_t *b, int pixels, int *differing)
{
    int worst = 0;
    *differing = 0;
    for (int i = 0; i < pixels; i++, a += 3, b += 3) {
        int here = 0;
        for (int k = 0; k < 3; k++)
            here = abs(a[k] - b[k]) > here ? abs(a[k] - b[k]) : here;
        *differing += here > 0;
        worst = here > worst ? here : worst;
    }
    return worst;
}

struct remembered {
    char name[80];
    struct ref_truth_options by;
    struct ref_truth truth;
    struct remembered *next;
};

static struct remembered *memory;

static bool is_same(const struct ref_truth_options *a, const struct ref_truth_options *b)
{
    return a->width == b->width && a->height == b->height && fabs(a->time - b->time) < 1e-9 && fabs(a->fps - b->fps) < 1e-9
        && fabs(a->shutter_degrees - b->shutter_degrees) < 1e-9 && a->exposure == b->exposure && a->instants == b->instants
        && a->encoded == b->encoded;
}

const struct ref_truth *truth_of(struct subject *s, const struct present_options *present, int instants)
{
    static const enum ref_exposure exposure[] = {
        [SMEAR_CENTRED] = REF_CENTRED, [SMEAR_TRAILING] = REF_TRAILING, [SMEAR_LEADING] = REF_LEADING
    };
    struct failure f = {{0}};
    const struct ref_truth_options o = {.width = s->width, .height = s->height, .time = s->time, .fps = present->fps,
                                        .shutter_degrees = present->shutter_degrees, .exposure = exposure[present->exposure],
                                        .instants = instants, .encoded = present->light == SMEAR_LIGHT_ENCODED, .threads = 1};
    for (struct remembered *r = memory; r != NULL; r = r->next)
        if (strcmp(r->name, s->name) == 0 && is_same(&r->by, &o))
            return &r->truth;
    struct remembered *r = calloc(1, sizeof *r);
    if (r == NULL || !ref_truth(&s->scene, &o, &r->truth, &f)) {
        free(r);
        broken(s, &f);
        return NULL;
    }
    memcpy(r->name, s->name, sizeof r->name);
    r->by = o;
    r->next = memory;
    memory = r;
    return &r->truth;
}

void truth_forget(void)
{
    while (memory != NULL) {
        struct remembered *r = memory;
        memory = r->next;
        ref_truth_free(&r->truth);
        free(r);
    }
}
