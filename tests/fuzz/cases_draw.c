/* SPDX-License-Identifier: MIT */
/* cases_draw.c - draws cases of the generator, each twice: by other workers, in other parts, at another address, some of them with
 * pixels that are not doubled or meshes without bounds. What displays show must be equal, and every call of a valid case must succeed.
 * A finding ends the program, and says where it was. */

#include "tests/fuzz/cases.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

char now_at[80]; /* "valid 123, frame 2": what a crash says */
bool talks;

/* The memory sanitizer is there: what nobody wrote is known, and no band may show it. */
void __msan_check_mem_is_initialized(const volatile void *bytes, size_t count) __attribute__((weak));

static void require(bool ok, const char *what)
{
    if (ok)
        return;
    fprintf(stderr, "finding: %s: %s\n", now_at, what);
    abort();
}

/* ------------------------------------------------------------------ a context and its display */

enum { AGE_MAX = 7,
       FILTER_WIDTH = 2048,
       GUARD = 64,
       PATTERN = 0xa5 };

struct rig {
    smear_context *ctx;
    smear_desc desc;
    uint8_t *block;                 /* the context's memory ends where it does, or before GUARD bytes where nobody else watches */
    size_t bytes;                   /* of the context */
    uint8_t *shown[AGE_MAX], *into; /* bytes of buffers that are shown, rows from top to bottom */
    size_t pitch, rows;
    int frame, next_row, next_column, band, fail_at;
    bool boundless;                 /* draws meshes without their bounds */
    uint32_t seen;
};

/* The display's size. */
static int columns_of(const smear_desc *d)
{
    return d->width << ((d->display.doubled & SMEAR_DOUBLED_X) != 0);
}

static int lines_of(const smear_desc *d)
{
    return d->height << ((d->display.doubled & SMEAR_DOUBLED_Y) != 0);
}

static const uint8_t bits_of[] = { 32, 16, 16, 16, 8, 8, 4, 1, 8 };

static size_t pitch_of(const smear_desc *d)
{
    return ((size_t)columns_of(d) * bits_of[d->format] + 7) / 8;
}

static size_t rows_of(const smear_desc *d, int rows)
{
    return d->format == SMEAR_L1_PAGES ? ((size_t)rows + 7) / 8 : (size_t)rows;
}

static int take_band(void *user, const smear_band *band)
{
    struct rig *r = user;
    const int columns = columns_of(&r->desc);
    require(band->width > 0 && band->height > 0 && band->x >= 0 && band->x + band->width <= columns
                && band->y >= 0 && band->y + band->height <= lines_of(&r->desc),
            "a band lies beside the frame");
    if (r->desc.reuse.buffer_age)
        require(band->y > r->next_row || (band->y == r->next_row && band->x >= r->next_column), "bands are out of order");
    else
        require(band->y == r->next_row && band->x == 0 && band->width == columns, "bands are out of order");
    require(r->fail_at < 0 || r->band <= r->fail_at, "a band comes after one that was refused");
    r->next_row = r->desc.reuse.buffer_age ? band->y : band->y + band->height;
    r->next_column = band->x + band->width;
    if (__msan_check_mem_is_initialized != NULL)
        __msan_check_mem_is_initialized(band->pixels, band->size);
    const size_t left = r->pitch * (size_t)band->x / (size_t)columns, rows = rows_of(&r->desc, band->height);
    require(band->size == band->stride * rows && left + band->stride <= r->pitch, "a band has another size");
    for (size_t y = 0; y < rows; y++)
        memcpy(r->into + (rows_of(&r->desc, band->y) + y) * r->pitch + left, (const uint8_t *)band->pixels + y * band->stride,
               band->stride);
    if (r->band++ == r->fail_at)
        return -42; /* a refused band counts as sent */
    if (r->desc.bands == 2)
        smear_band_done(r->ctx);
    return r->band % 7; /* what is not negative goes on */
}

static void rest(void *user)
{
    (void)user;
    sched_yield();
}

static void look_at_row(void *user, int y, const uint32_t *color, const uint16_t *depth, const int32_t *velocity)
{
    struct rig *r = user;
    require(y >= 0 && y < r->desc.height, "a row lies beside the frame");
    for (int x = 0; x < r->desc.width; x++)
        r->seen = ((r->seen ^ color[x]) * 16777619u + depth[x] * 3u + (uint32_t)velocity[2 * x]) * 5u + (uint32_t)velocity[2 * x + 1];
}

static uint32_t ticks(void *user)
{
    struct rig *r = user;
    return (uint32_t)r->band;
}

/* The address sanitizer is there: it knows where blocks end. */
void __sanitizer_set_death_callback(void (*callback)(void)) __attribute__((weak));

static size_t guard_size(void)
{
    return __sanitizer_set_death_callback == NULL ? GUARD : 0;
}

static void check_guards(const struct rig *r)
{
    const uint8_t *begin = (const uint8_t *)r->ctx, *end = begin + r->bytes;
    bool intact = true;
    for (const uint8_t *b = r->block; b < begin; b++)
        intact = intact && *b == PATTERN;
    for (size_t i = 0; i < guard_size(); i++)
        intact = intact && end[i] == PATTERN;
    require(intact, "bytes beside the context have changed");
}

/* False where the desc is refused, or takes more than a test has. `offset`: of the memory, in steps of 8 bytes. */
static bool rig_open(struct rig *r, const smear_desc *desc, bool wild, int offset, bool inspects)
{
    *r = (struct rig){ .desc = *desc, .fail_at = -1 };
    r->desc.flush = take_band;
    r->desc.idle = rest;
    r->desc.user = r;
    if (offset & 1)
        r->desc.debug.clock = ticks;
    if (inspects)
        r->desc.debug.inspect = look_at_row;
    const size_t bytes = smear_memory_size(&r->desc);
    smear_context *none = NULL;
    if (bytes == 0) {
        require(wild, "a valid desc is refused");
        static uint64_t block[4096];
        memset(block, PATTERN, sizeof block);
        require(smear_init(&none, &r->desc, block, sizeof block) != SMEAR_OK && none == NULL, "a desc without a size is taken");
        for (size_t i = 0; i < sizeof block; i++)
            require(((const uint8_t *)block)[i] == PATTERN, "a refused desc has changed memory");
        return false;
    }
    if (bytes > 48u << 20)
        return false;
    r->bytes = bytes;
    r->block = malloc(8 * (size_t)offset + bytes + guard_size());
    uint8_t *memory = r->block + 8 * offset;
    require(r->block != NULL, "out of memory");
    if (__msan_check_mem_is_initialized == NULL)
        memset(r->block, PATTERN, 8 * (size_t)offset + bytes + guard_size());
    require(smear_init(&r->ctx, &r->desc, memory, bytes - 1) == -(int)bytes, "a byte too little is taken");
    require(smear_init(&r->ctx, &r->desc, memory, bytes) == SMEAR_OK, "smear_init fails");
    r->pitch = pitch_of(desc);
    r->rows = rows_of(desc, lines_of(desc));
    for (int i = 0; i < (desc->reuse.buffer_age > 1 ? desc->reuse.buffer_age : 1); i++)
        r->shown[i] = calloc(r->rows, r->pitch);
    return true;
}

static void rig_close(struct rig *r)
{
    free(r->block);
    for (int i = 0; i < AGE_MAX; i++)
        free(r->shown[i]);
}

struct core {
    smear_context *ctx;
    int worker;
    pthread_t thread;
    pthread_barrier_t *ready; /* all cores are there when the frame begins, else one draws a small one alone */
};

static void *core_main(void *argument)
{
    struct core *core = argument;
    pthread_barrier_wait(core->ready);
    smear_work(core->ctx, core->worker);
    return NULL;
}

static int render(struct rig *r)
{
    struct core core[SMEAR_LAYERS_MAX];
    pthread_barrier_t ready;
    const int others = r->desc.workers > 1 ? r->desc.workers - 1 : 0;
    pthread_barrier_init(&ready, NULL, (unsigned)others + 1);
    for (int i = 0; i < others; i++) {
        core[i] = (struct core){ .ctx = r->ctx, .worker = i + 1, .ready = &ready };
        require(pthread_create(&core[i].thread, NULL, core_main, &core[i]) == 0, "no threads");
    }
    pthread_barrier_wait(&ready);
    const int result = smear_render(r->ctx);
    for (int i = 0; i < others; i++)
        pthread_join(core[i].thread, NULL);
    pthread_barrier_destroy(&ready);
    return result;
}

/* What is refused changes not a byte of a context: of a wild case, all of them are compared. (The memory sanitizer knows that not all
 * have been written.) */
static uint8_t *before;

static bool compares_bytes(const struct rig *r, const struct fuzz_case *c)
{
    return c->wild && r->bytes < 1u << 18 && __msan_check_mem_is_initialized == NULL;
}

static void keep_bytes(const struct rig *r, const struct fuzz_case *c)
{
    if (!compares_bytes(r, c))
        return;
    before = realloc(before, r->bytes);
    require(before != NULL, "out of memory");
    memcpy(before, r->ctx, r->bytes);
}

static int compare_bytes(const struct rig *r, const struct fuzz_case *c, int result)
{
    if (result != SMEAR_OK && compares_bytes(r, c))
        require(memcmp(before, r->ctx, r->bytes) == 0, "a refused call has changed the context");
    return result;
}

/* Draws a frame of the case; returns the first error. */
static int rig_frame(struct rig *r, const struct fuzz_case *c)
{
    const int age = r->desc.reuse.buffer_age > 1 ? r->desc.reuse.buffer_age : 1;
    r->next_row = r->band = r->next_column = 0;
    r->seen = 0;
    r->into = r->shown[r->frame++ % age];
    keep_bytes(r, c);
    int result = compare_bytes(r, c, smear_begin(r->ctx, &c->frame)), error = SMEAR_OK;
    if (result != SMEAR_OK)
        return result;
    for (int i = 0; i < c->draws; i++) {
        static smear_mesh mesh[CASE_DRAWS];     /* the library reads them when it renders */
        smear_draw draw = c->draw[i];
        if (r->boundless && draw.mesh != NULL) {
            mesh[i] = *draw.mesh;
            memset(mesh[i].bounds, 0, sizeof mesh[i].bounds);
            draw.mesh = &mesh[i];
        }
        keep_bytes(r, c);
        const int submitted = compare_bytes(r, c, smear_submit(r->ctx, &draw));
        error = error == SMEAR_OK ? submitted : error;
    }
    result = render(r);
    if (__msan_check_mem_is_initialized == NULL)
        check_guards(r);
    return error != SMEAR_OK ? error : result;
}

/* ------------------------------------------------------------------ cases */

static void check_stats(const struct rig *r, const struct fuzz_case *c, struct counts *counts)
{
    smear_stats s;
    smear_get_stats(r->ctx, &s);
    counts->parts += s.parts_added != 0;
    require(s.pixels == (uint32_t)(r->desc.width * r->desc.height), "statistics count other pixels");
    if (!c->wild)
        require(s.triangles_dropped == 0, "triangles were dropped");
    require(s.fill.segments.used <= s.fill.segments.room && s.fill.geometry.used <= s.fill.geometry.room
                && s.fill.draws.used <= s.fill.draws.room,
            "more is used than there is room for");
}

/* Whether another arena may draw another picture: a budget is shared among parts. */
static bool has_budget(const struct fuzz_case *c)
{
    return c->frame.budget != 0;
}

/* Returns what the display shows at (x, y). */
static uint32_t pixel_at(const struct rig *r, int x, int y)
{
    const int bits = bits_of[r->desc.format];
    uint32_t pixel = 0;
    if (r->desc.format == SMEAR_L1_PAGES)
        return r->into[(size_t)(y / 8) * r->pitch + (size_t)x] >> (y % 8) & 1u;
    const uint8_t *at = r->into + (size_t)y * r->pitch + (size_t)(x * bits / 8);
    if (bits < 8)
        return (uint32_t)*at >> (8 - bits - x * bits % 8) & ((1u << bits) - 1u);
    memcpy(&pixel, at, (size_t)bits / 8);
    return pixel;
}

/* Whether `a` shows each pixel of `b`, which is not doubled, as often as it should. */
static bool doubles_picture(const struct rig *a, const struct rig *b)
{
    const int dx = columns_of(&a->desc) != a->desc.width, dy = lines_of(&a->desc) != a->desc.height;
    for (int y = 0; y < lines_of(&a->desc); y++)
        for (int x = 0; x < columns_of(&a->desc); x++)
            if (pixel_at(a, x, y) != pixel_at(b, x >> dx, y >> dy))
                return false;
    return true;
}

static bool same_picture(const struct rig *a, const struct rig *b)
{
    if (a->desc.display.doubled != b->desc.display.doubled)
        return doubles_picture(a, b);
    for (size_t i = 0; i < a->pitch * a->rows; i++)
        if (a->into[i] != b->into[i]) {
            if (talks)
                fprintf(stderr, "byte %zu of row %zu: %02x, %02x\n", i % a->pitch, i / a->pitch, a->into[i], b->into[i]);
            return false;
        }
    return true;
}

/* What two contexts say of the same frame. */
static void check_same(const struct rig *a, const struct rig *b)
{
    smear_stats s, t;
    smear_get_stats(a->ctx, &s);
    smear_get_stats(b->ctx, &t);
    const bool whole = s.parts_added == 0 && t.parts_added == 0;
    const bool keeps = a->desc.reuse.cache_static || a->desc.reuse.buffer_age || b->desc.reuse.cache_static || b->desc.reuse.buffer_age;
    const bool bytes = !keeps && a->desc.display.doubled == b->desc.display.doubled;
    require(a->seen == b->seen || !a->desc.debug.inspect, "another desc inspects another frame");
    require(memcmp(s.tiles, t.tiles, sizeof s.tiles) == 0 && s.tiles_complex == t.tiles_complex, "another desc counts other tiles");
    require(s.triangles_in == t.triangles_in, "another desc is given other triangles");
    require(s.samples == t.samples || !whole, "another desc takes other samples");
    require(s.crc32 == t.crc32 || !bytes, "another desc has another sum");
}

static void explain(const struct fuzz_case *c, const struct rig *r, int result)
{
    smear_stats s;
    smear_get_stats(r->ctx, &s);
    fprintf(stderr, "%s: %dx%d methods %04x tile %d reach %d strip %d bands %d of %d rows format %d workers %d triangles %u "
                    "cache %d reuse %d %d\n  method %d light %d samples %d poses %d: %d %s; in %u drawn %u dropped %u parts %u\n",
            now_at, r->desc.width, r->desc.height, r->desc.methods, r->desc.tile, r->desc.reach, r->desc.strip, r->desc.bands,
            r->desc.band_rows, r->desc.format, r->desc.workers, (unsigned)r->desc.max_triangles, r->desc.vertex_cache,
            r->desc.reuse.cache_static, r->desc.reuse.buffer_age, c->frame.method, c->frame.light_space, c->frame.samples,
            c->frame.shutter.poses, result, smear_error_text(result), (unsigned)s.triangles_in, (unsigned)s.triangles_drawn,
            (unsigned)s.triangles_dropped, (unsigned)s.parts_added);
}

/* Errors that a valid frame may have: a band that was refused, or an arena that is too small for the method. */
static void check_result(const struct fuzz_case *c, const struct rig *r, int result)
{
    require(c->wild || r->fail_at < 0 || r->band <= r->fail_at || result == -42, "what a band answers is lost");
    if (c->wild || (result == -42 && r->fail_at >= 0) || (result == SMEAR_ERR_ROOM && (c->desc.methods & SMEAR_SET(SMEAR_TIMEMASK)) != 0))
        return;
    require(result == SMEAR_OK, smear_error_text(result));
}

/* Calls out of turn. */
static void misuse(struct rig *r, struct fuzz_case *c)
{
    smear_stats stats;
    require(smear_submit(r->ctx, &c->draw[0]) != SMEAR_OK, "a draw is taken before a frame is begun");
    require(smear_render(r->ctx) == SMEAR_ERR_ORDER, "nothing is rendered");
    require(smear_begin(NULL, &c->frame) != SMEAR_OK && smear_begin(r->ctx, NULL) != SMEAR_OK, "null is taken");
    if (smear_begin(r->ctx, &c->frame) == SMEAR_OK) {
        require(smear_submit(r->ctx, NULL) != SMEAR_OK, "null is submitted");
        require(smear_filter_row(r->ctx, NULL, NULL, NULL) != SMEAR_OK, "null is filtered");
        (void)smear_submit(r->ctx, &c->draw[1]);
        (void)smear_submit(r->ctx, &c->draw[1]);
    }
    smear_work(r->ctx, 0);
    smear_work(r->ctx, 99);
    smear_get_stats(r->ctx, &stats);
    for (int i = -200; i < 10; i++)
        require(smear_error_text(i) != NULL, "an error has no text");
}

/* The filter alone, over noise. */
static void filter_frame(struct rig *r, struct fuzz_case *c)
{
    static uint32_t color[FILTER_WIDTH], depth[FILTER_WIDTH];
    static int16_t velocity[2 * FILTER_WIDTH];
    struct source *s = &c->source;
    r->next_row = r->band = r->next_column = 0;
    r->fail_at = -1;
    keep_bytes(r, c);
    if (compare_bytes(r, c, smear_filter_begin(r->ctx, &c->frame)) != SMEAR_OK)
        return;
    const int shift = source_range(s, 0, 15), far = source_range(s, 0, 31);
    for (int y = 0; y < r->desc.height; y++) {
        for (int x = 0; x < r->desc.width; x++) {
            color[x] = source_word(s);
            depth[x] = source_word(s) >> far;
            velocity[2 * x] = (int16_t)((int16_t)source_word(s) >> shift);
            velocity[2 * x + 1] = (int16_t)((int16_t)source_word(s) >> shift);
        }
        require(smear_filter_row(r->ctx, color, depth, velocity) == SMEAR_OK, "smear_filter_row fails");
    }
    require(r->desc.reuse.buffer_age || r->next_row == lines_of(&r->desc), "rows are missing");
}

static uint32_t add_bytes(uint32_t sum, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        sum = (sum ^ bytes[i]) * 16777619u;
    return sum;
}

static void spoil_frame(struct fuzz_case *c)
{
    while (c->wild && !source_chance(&c->source, 3))
        case_spoil_frame(c);
}

static const char *const mode_names[] = { "valid", "wild", "valid", "valid", "many", "parts" };

/* The desc has room for all of a case. Returns one that has not. */
static smear_desc in_parts(struct fuzz_case *c)
{
    smear_desc other = c->desc;
    other.max_triangles = (uint32_t)source_range(&c->source, 1, source_chance(&c->source, 2) ? 12 : 400);
    c->desc.max_triangles = 20000;
    if (c->mesh[0].vertex_count > 1000) /* minutes, else */
        other.max_triangles += 2000;
    if (source_chance(&c->source, 2))
        other.reuse.cache_static = other.reuse.buffer_age = 0;
    return other;
}

/* So that every build draws the same: arenas count bytes, of which pointers have more or fewer. */
static void make_comparable(struct fuzz_case *c)
{
    if ((c->desc.methods & SMEAR_SET(SMEAR_TIMEMASK)) != 0)
        c->desc.max_triangles = HUGE_ROOM;
}

/* Case `number` is made. */
static uint32_t draw_case(struct fuzz_case *c, struct counts *counts, uint64_t number, enum mode mode)
{
    const bool wild = mode == MODE_WILD, threads = mode == MODE_THREADS, many = mode == MODE_MANY;
    struct rig a, b;
    uint32_t sum = 2166136261u;
    if (wild && source_chance(&c->source, 8))
        case_spoil_desc(c);
    if (threads)
        c->desc.workers = (uint8_t)source_range(&c->source, 2, 8);
    if (mode == MODE_SUMS)
        make_comparable(c);
    smear_desc other = many ? case_many_other(c) : mode == MODE_PARTS ? in_parts(c) : case_other_desc(c);
    if (threads)
        other.workers = (uint8_t)source_range(&c->source, 2, 8);
    if (number % 2 == 0 && !wild)
        other.display.doubled = SMEAR_DOUBLED_NONE;
    const int offset = source_range(&c->source, 0, 5);
    const bool inspects = offset == 2;
    const bool open = rig_open(&a, &c->desc, wild, offset, inspects);
    const bool two = open && !wild && mode != MODE_SUMS && rig_open(&b, &other, false, source_range(&c->source, 0, 5), inspects);
    b.boundless = two && number % 3 == 0;
    counts->cases++;
    counts->refused += !open;
    bool lost = false;
    for (int k = 0; k < c->frames && open; k++) {
        snprintf(now_at, sizeof now_at, "%s %llu, frame %d", mode_names[mode], (unsigned long long)number, k);
        case_frame(c, k);
        spoil_frame(c);
        if (mode == MODE_SUMS || many)
            c->frame.budget = 0;
        c->frame.refresh |= lost;
        if (c->wild && source_chance(&c->source, 20))
            misuse(&a, c);
        a.fail_at = source_chance(&c->source, 12) ? source_range(&c->source, 0, 4) : -1;
        const int result = rig_frame(&a, c);
        lost = result != SMEAR_OK;
        counts->frames++;
        counts->errors += result != SMEAR_OK;
        if (talks)
            explain(c, &a, result);
        check_result(c, &a, result);
        if (result == SMEAR_OK) {
            check_stats(&a, c, counts);
            require(a.desc.reuse.buffer_age || a.next_row == lines_of(&a.desc), "rows are missing");
            sum = add_bytes(sum, a.into, a.pitch * a.rows);
        }
        if (two) {
            const int again = rig_frame(&b, c);
            counts->frames++;
            if (talks)
                explain(c, &b, again);
            check_result(c, &b, again);
            if (again == SMEAR_OK)
                check_stats(&b, c, counts);
            if (result == SMEAR_OK && again == SMEAR_OK && !has_budget(c)) {
                require(same_picture(&a, &b), "another desc draws another picture");
                check_same(&a, &b);
                counts->compared++;
            }
        }
        if (a.desc.workers <= 1 && source_chance(&c->source, 10)) {
            filter_frame(&a, c);
            lost = true;
        }
    }
    if (open)
        rig_close(&a);
    if (two)
        rig_close(&b);
    case_free(c);
    return sum;
}

uint32_t run_case(struct counts *counts, uint64_t number, enum mode mode)
{
    static struct fuzz_case c;
    snprintf(now_at, sizeof now_at, "%s %llu", mode_names[mode], (unsigned long long)number);
    if (mode == MODE_MANY)
        case_make_many(&c, number);
    else
        case_make(&c, number, mode == MODE_WILD);
    return draw_case(&c, counts, number, mode);
}

void run_bytes(const uint8_t *bytes, size_t size, enum mode mode)
{
    static struct fuzz_case c;
    struct counts counts = { 0, 0, 0, 0, 0, 0 };
    snprintf(now_at, sizeof now_at, "bytes, %s", mode_names[mode]);
    case_make_of_bytes(&c, bytes, size, mode == MODE_WILD);
    draw_case(&c, &counts, 0, mode);
}
