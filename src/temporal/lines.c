/* SPDX-License-Identifier: MIT */
/* lines.c - see lines.h.
 *
 *     for each row of blocks, for each run of blocks with the same displacement:
 *         taps    where its line meets pixels
 *         means   of the pixels there (kernels/line_means.h) */
#include "temporal/lines.h"

#include "base/pixel.h"
#include "kernels/line_means.h"

enum { BLOCK = LINE_BLOCK,
       LINE_BORDER = 4 };               /* so many pixels beside the frame's border share taps that are cut off there */

/* Distances from a pixel to its taps, px, and how far they reach. */
struct taps {
    int32_t log;                    /* there are 2^log */
    int32_t x[LINE_TAPS_MAX], y[LINE_TAPS_MAX];
    int32_t left, right, up, down;
    bool sparse;                    /* every fourth pixel tells what lies between, as the line is long and level */
};

bool smear_lines_turn(const struct smear_shot *shot, const smear_transform *open, const smear_transform *middle, int32_t parts, int32_t of)
{
    const int32_t times = shot_spans_exposure(shot) ? 2 << 4 : shot->half_exposure >> 19;       /* q4 */
    int64_t square = 0, product = 0;
    for (int i = 0; i < 9; i++) {
        const uint64_t both = (uint64_t)mul_wide(open->basis[i], open->basis[i]) + (uint64_t)mul_wide(middle->basis[i], middle->basis[i]);
        square += (int64_t)(both >> 22);
        product += mul_wide(open->basis[i], middle->basis[i]) >> 21;
    }
    return ((square - product) * (times * times) >> 8) * parts > square * of;
}

void smear_lines_make_flow(struct smear_flow *flow, const struct smear_shot *shot, const struct smear_window *w,
                           const smear_camera *camera)
{
    const struct smear_shutter_order at = smear_shot_order(shot);
    const struct smear_instant middle = smear_instant_middle(shot);
    const bool spans = shot_spans_exposure(shot);
    struct smear_reprojection r;
    smear_reproject_make(&r, &camera[at.middle], &camera[at.open], &camera[at.close], spans ? smear_instant_now.weight : middle.weight,
                         spans, w->width, w->height);
    smear_flow_make(flow, &r, spans ? 65536 : shot->half_exposure >> 7);
}

/* The part of the contrast that pictures leave of the squared error, q16: medians of some 300 frames of the suite, of models, rooms and
 * streets, of which nine of ten have at most 1.2 times the error that is told so with one picture, and 1.4 times with more. */
static const uint16_t left_of_contrast[LINE_PICTURES] = { 6600, 2930, 2000, 1600 };

/* Returns the squared error that pictures may have as foretold, in sixteenths of what is asked for: a sketch's second picture costs as
 * much as its first, and in encoded light, which the smallest machines draw in, one does where it errs by half as much again. A draft
 * that asks for the `last` of its pictures may have a bit more: instants cost twice as much. */
static uint64_t allowed(const struct smear_lines *lines, int32_t target, bool last)
{
    const bool is_linear = transfer_is_linear(lines->transfer);
    return target_is_sketch(target) ? (is_linear ? 23 : 36) : (is_linear ? 21u : 25u) + (last ? 2u : 0u);
}

enum { VALUES = 12 };                   /* per block: two pixels' three channels are compared with two others', and / 16 of both */

/* Returns how many pictures there are at least, or more than `most` where no number will do. There are two but of a sketch: what blocks
 * show is told by few of their pixels. Lines are straight, and err by the square of the angle that a camera turns by from picture to
 * picture, which is some 17 degrees at most for 4 codes. */
static int least_pictures(const struct smear_shot *shot, int32_t target, int most)
{
    enum { PARTS = 512,                 /* of a target, 1/4 codes, for a third of that angle's square */
           COARSEST = 64 };
    const struct smear_shutter_order at = smear_shot_order(shot);
    const int32_t part = min_i32(target >> 4, COARSEST);
    int k = target_is_sketch(target) ? 1 : 2;
    while (k <= most && smear_lines_turn(shot, &shot->camera[at.open].pose, &shot->camera[at.middle].pose, PARTS, part * k * k))
        k++;
    return k;
}

/* Returns how many pictures, k or more, a frame takes that is like the last one, if anything is known of it: more than there may be where
 * no number will do. */
static int pictures_for(const struct smear_lines *lines, int32_t target, int k)
{
    const uint64_t most = (uint64_t)target * (uint64_t)target * VALUES;
    /* One less than the last had must do well, as pictures would flicker between both. */
    while (k <= lines->most
           && (uint64_t)lines->contrast * left_of_contrast[k - 1]
                  > most * lines->blocks / 128 * (allowed(lines, target, false) * (k < lines->pictures ? 7 : 8)))
        k++;
    return k;
}

/* Finds n even instants of the exposure. */
static void find_instants(struct smear_instant *instant, const struct smear_shot *shot, int32_t n)
{
    for (int32_t k = 0; k < n; k++)
        instant[k] = n == 1 ? smear_instant_middle(shot) : smear_instant_at(shot, (2 * k + 1 - n) * 65536 / n);
}

void smear_lines_take(struct smear_lines *lines, const struct smear_shot *shot, int pictures)
{
    lines->pictures = (uint8_t)pictures;
    lines->picture = 0;
    find_instants(lines->instant, shot, pictures);
    find_instants(lines->mover_instant, shot, line_mover_pictures(lines));
}

bool smear_lines_begin(struct smear_lines *lines, const struct smear_shot *shot, const struct smear_window *w, int32_t target,
                       smear_transfer transfer, bool smooth)
{
    lines->most = smooth ? 1 : LINE_PICTURES;
    lines->takes_movers = !smooth;
    lines->room = (uint32_t)(w->width * w->height >> 7) * (uint32_t)target;     /* half a pixel for each code */
    lines->twice = lines->measures = false;
    lines->transfer = transfer;
    const int least = least_pictures(shot, target, lines->most), pictures = min_i32(pictures_for(lines, target, least), lines->most);
    if (least > lines->most) {
        lines_forget(lines);
        return false;
    }
    lines->movers = lines->behind = 0;
    lines->drawn = lines->finished = 0;
    lines_forget(lines);
    lines->error = 0;
    smear_lines_make_flow(&lines->flow, shot, w, shot->camera);
    smear_lines_take(lines, shot, pictures);
    return true;
}

static struct smear_line_seen *seen_at(const struct smear_lines *lines, const struct smear_window *w, int32_t x, int32_t y)
{
    return &lines->seen[((y & (LINE_ROWS_SEEN * w->tile - 1)) >> LINE_BLOCK_LOG2) * line_blocks(w->width) + (x >> LINE_BLOCK_LOG2)];
}

/* Returns what two blocks beside each other show that go unlike ways: the one hides and bares what is behind, and that has the contrast of
 * both, and more, as edges of what is nearer are told by few pixels. Bare ones go along. */
static uint32_t hidden(const struct smear_lines *lines, const struct smear_line_seen *a, const struct smear_line_seen *b)
{
    enum { ALIKE = 1, FAR = 64, EDGE = 512, PART_LOG2 = 3 };    /* px; an eighth of the contrast per pixel of the whole way */
    const int32_t apart = max_i32(abs_i32(a->x - b->x), abs_i32(a->y - b->y));
    if (apart <= ALIKE || a->depth == 0 || b->depth == 0)
        return 0;
    return ((uint32_t)a->contrast + b->contrast + EDGE) * (uint32_t)(min_i32(apart, FAR) * lines->pictures) >> PART_LOG2;
}

/* Returns the contrast of the blocks of a tile row, with what they hide from each other. */
static uint32_t contrast_of(const struct smear_lines *lines, const struct smear_window *w, int32_t y0, int32_t y1)
{
    uint32_t sum = 0;
    for (int32_t y = y0; y < y1; y += BLOCK) {
        const struct smear_line_seen *seen = seen_at(lines, w, 0, y), *left = seen;
        /* Of rows that are blurred no more is known. */
        const struct smear_line_seen *up = y > lines->finished * w->tile ? seen_at(lines, w, 0, y - BLOCK) : seen;
        for (int32_t x = 0; x < w->width; x += BLOCK, left = seen++, up++)
            sum += min_u32(seen->contrast + hidden(lines, seen, left) + hidden(lines, seen, up), UINT16_MAX);
    }
    return sum;
}

int smear_lines_needed(struct smear_lines *lines, const struct smear_window *w, int32_t y0, int32_t y1, int32_t target)
{
    const uint32_t all = (uint32_t)(line_blocks(w->width) * line_blocks(w->height)), contrast = contrast_of(lines, w, y0, y1);
    const uint32_t blocks = lines->blocks + (uint32_t)(line_blocks(w->width) * line_blocks(y1 - y0));
    const uint64_t error = lines->error + (uint64_t)contrast * left_of_contrast[lines->pictures - 1];
    /* Most frames have their contrast in the middle: what is below has less. */
    const uint64_t rest = (uint64_t)((lines->contrast + contrast) / blocks) * (all - blocks) * 3 / 4;
    int k = lines->pictures;
    for (; k <= lines->most; k++) {
        /* The rest may have what is left of the frame's error, or its own share if that is more. */
        const uint64_t each = (uint64_t)target * (uint64_t)target * VALUES * allowed(lines, target, k == lines->most) / 16;
        const uint64_t own = each * (all - blocks);
        if (rest * left_of_contrast[k - 1] <= (each * all > error + own ? each * all - error : own))
            break;
    }
    if (k == lines->pictures) {
        lines->contrast += contrast;
        lines->error = error;
        lines->blocks = blocks;
    }
    return k;
}

/* Adds the contrast of one pixel of each fourth block of columns [x, x1), `in` from its left, with those beside and below it. */
static void add_contrast(struct smear_line_seen *seen, const struct smear_window *w, int32_t in, int32_t x, int32_t x1, int32_t y)
{
    const uint32_t *const row = w->color + window_ring_row(w, y) * w->width;
    const uint32_t *const below = w->color + window_ring_row(w, y + 1) * w->width;
    for (; x < x1; x += 4 * BLOCK, seen += 4) {
        const int32_t at = min_i32(x + in, w->width - 2);
        if (at < x || ((row[at] ^ row[at + 1]) | (row[at] ^ below[at])) == 0)
            continue;
        const uint32_t square = pixel_square_between(row[at], row[at + 1]) + pixel_square_between(row[at], below[at]);
        seen->contrast = (uint16_t)(seen->contrast + (square >> 4));
    }
}

/* Adds that of two pixels of each block of a row of blocks, whose pixel rows end at `end`. Four beside each other look at other rows of
 * theirs, four below each other at other columns, so that edges along the screen's axes are met as often as others. */
static void look_at_contrast(struct smear_line_seen *seen, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y, int32_t end)
{
    const int32_t down = y >> LINE_BLOCK_LOG2, across = x0 >> LINE_BLOCK_LOG2;
    for (int32_t k = 0; k < BLOCK && y + 1 < end; k++) {
        const int32_t block = (k - 2 * down - across) & 3;      /* of four, from x0 on */
        add_contrast(seen + block, w, ((down + 2 * k) & 3) + (k & 4), x0 + block * BLOCK, x1, min_i32(y + k, end - 2));
    }
}

/* Notes the nearest of two pixels of each block in a row of them, or only of those that are bare so far. */
static void note_depth(struct smear_line_seen *seen, const uint16_t *depth, int32_t x0, int32_t x1, int32_t left, int32_t right, bool bare)
{
    for (int32_t x = x0; x < x1; x += BLOCK, seen++)
        if (!bare || seen->depth == 0) {
            const uint32_t nearest = max_u32(depth[min_i32(x + left, x1 - 1)], depth[min_i32(x + right, x1 - 1)]);
            seen->depth = (uint16_t)max_u32(nearest, seen->depth);
        }
}

void smear_lines_look(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    const bool first = lines->picture == 0;
    for (int32_t y = y0; y < y1; y += BLOCK) {
        struct smear_line_seen *const seen = seen_at(lines, w, x0, y);
        const int32_t end = min_i32(y + BLOCK, y1);
        if (first) {
            __builtin_memset(seen, 0, (size_t)line_blocks(x1 - x0) * sizeof *seen);
            look_at_contrast(seen, w, x0, x1, y, end);
        }
        for (int32_t v = y; v < end; v += BLOCK - 1)
            note_depth(seen, first ? window_depth(w, 0, v) : line_depth(lines, w, 0, v), x0, x1, 0, BLOCK - 1, false);
        /* Of blocks that are bare at their corners, those on the way from one to the other show what is small or thin. */
        for (int32_t v = y + 1; v < end - 1; v++)
            note_depth(seen, first ? window_depth(w, 0, v) : line_depth(lines, w, 0, v), x0, x1, v - y, v - y, true);
    }
}

void smear_lines_copy_depth(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1,
                            bool back)
{
    for (int32_t y = x0 < x1 ? y0 : y1; y < y1; y++) {
        uint16_t *const line = line_depth(lines, w, x0, y), *const window = window_depth(w, x0, y);
        __builtin_memcpy(back ? window : line, back ? line : window, (size_t)(x1 - x0) * sizeof *line);
    }
}

/* Returns a / n, n 1 .. LINE_PICTURES: quotients are calls where there is no instruction. */
static inline int32_t part_of(int32_t a, int n)
{
    const int32_t m = abs_i32(a);
    const int32_t part = n == 1 ? m : n == 2 ? m >> 1 : n == 4 ? m >> 2 : m < 65536 ? (int32_t)((uint32_t)m * 43691u >> 17) : m / n;
    return a < 0 ? -part : part;
}

int32_t smear_lines_displacement(int32_t out[2], int pictures, const struct smear_flow *flow, const struct smear_window *w, int32_t x,
                                 int32_t y, uint32_t depth)
{
    enum { STEP = 256 };
    const int32_t longest[2] = { 256 * w->width, 2 * 256 * w->reach };
    smear_flow_at(flow, x, y, smear_depth_units((uint16_t)depth), out);
    for (int i = 0; i < 2; i++)
        out[i] = part_of(out[i], pictures);
    const int32_t way = max_i32(abs_i32(out[0]), abs_i32(out[1]));
    for (int i = 0; i < 2; i++) {
        const int32_t most = longest[i], length = abs_i32(out[i]);
        if (length <= most)
            continue;
        out[1 - i] = (out[1 - i] >> 4) * (int32_t)(((uint32_t)most << 11) / (uint32_t)length) >> 7;
        out[i] = out[i] < 0 ? -most : most;
    }
    for (int i = 0; i < 2; i++)
        out[i] = (out[i] + STEP / 2) & -STEP;
    return way;
}

/* Places taps evenly on the way: no more than three quarters of a pixel apart, where there may be so many. */
static void place_taps(struct taps *t, int32_t x, int32_t y, int pictures)
{
    enum { LONG = 8 * 256,              /* so that four pixels beside each other on it are nearly alike; half of it for one picture */
           LEVEL_LOG2 = 1 };            /* and two lie between them across */
    const int32_t length = max_i32(abs_i32(x), abs_i32(y));
    const int32_t log = length * 2 <= 3 * 256 ? 0 : length <= 3 * 256 ? 2 : 3;       /* two would lie on the pixel itself */
    const int32_t n = 1 << log, down = log + 1 + 8, half = n << 8;
    for (int32_t k = 0; k < n; k++) {
        t->x[k] = (x * (2 * k + 1 - n) + half) >> down;
        t->y[k] = (y * (2 * k + 1 - n) + half) >> down;
    }
    t->log = log;
    t->sparse = length >= (pictures == 1 ? LONG / 2 : LONG) && abs_i32(y) << LEVEL_LOG2 <= length;
    t->left = min_i32(t->x[0], t->x[n - 1]);
    t->right = max_i32(t->x[0], t->x[n - 1]);
    t->up = min_i32(t->y[0], t->y[n - 1]);
    t->down = max_i32(t->y[0], t->y[n - 1]);
}

/* Blurs columns [x0, x1) of rows [y0, y1), as many at once as no tap meets the end of the ring in. Taps lie in the frame and in rows
 * that are drawn. */
static void blur_within(const struct smear_lines *lines, const struct smear_window *w, const struct taps *t, int32_t x0, int32_t x1,
                        int32_t y0, int32_t y1)
{
    int32_t at = window_ring_row(w, y0);
    struct line_block b = { .in_stride = w->width, .out_stride = w->width, .columns = x1 - x0, .log = t->log,
                            .sparse = t->sparse && ((x1 - x0) & (LINE_SPARSE - 1)) == 0 };
    for (int32_t y = y0; y < y1; y += b.rows) {
        b.rows = min_i32(y1 - y, w->ring - at);
        for (int k = 0; k < 1 << t->log; k++) {
            int32_t row = at + t->y[k];
            row += row < 0 ? w->ring : row >= w->ring ? -w->ring : 0;
            b.rows = min_i32(b.rows, w->ring - row);
            b.offset[k] = (row - at) * w->width + t->x[k];
        }
        b.in = w->color + at * w->width + x0;
        b.out = lines->row + (y & (w->tile - 1)) * w->width + x0;
        smear_line_means(&b, lines->transfer);
        at += b.rows;
        at -= at == w->ring ? w->ring : 0;
    }
}

/* Returns taps that lie so far aside, up and down at most. */
static struct taps taps_within(const struct taps *all, int32_t left, int32_t right, int32_t up, int32_t down)
{
    struct taps t = *all;
    for (int k = 0; k < 1 << t.log; k++) {
        t.x[k] = clamp_i32(t.x[k], left, right);
        t.y[k] = clamp_i32(t.y[k], up, down);
    }
    t.up = max_i32(t.up, up);
    t.down = min_i32(t.down, down);
    return t;
}

/* Blurs columns [x0, x1) of rows [y0, y1) of which all taps lie within the rows that there are. */
static void blur_columns(const struct smear_lines *lines, const struct smear_window *w, const struct taps *t, int32_t x0, int32_t x1,
                         int32_t y0, int32_t y1)
{
    for (int32_t x = x0, next; x < x1; x = next) {
        const int32_t inside = (min_i32(x1, w->width - t->right - t->sparse) - x) & (t->sparse ? -LINE_SPARSE : -1);
        if (x + t->left >= 0 && inside > 0) {
            next = x + inside;
            blur_within(lines, w, t, x, next, y0, y1);
            continue;
        }
        next = min_i32((x & -LINE_BORDER) + LINE_BORDER, x1);       /* the same ones, wherever x0 and x1 are */
        struct taps clamped = taps_within(t, -x, w->width - next, t->up, t->down);
        clamped.sparse = false;
        blur_within(lines, w, &clamped, x, next, y0, y1);
    }
}

void smear_lines_blur_blocks(const struct smear_lines *lines, const struct smear_window *w, const int32_t d[2], int32_t x0, int32_t x1,
                             int32_t y0, int32_t y1, int32_t first, int32_t end)
{
    struct taps t, within;
    place_taps(&t, d[0], d[1], lines->pictures);
    const int32_t top = clamp_i32(first - t.up, y0, y1), bottom = clamp_i32(end - t.down, top, y1);
    for (int32_t y = y0, next; y < y1; y = next) {
        next = y < top ? min_i32(y + LINE_BORDER, top) : y < bottom ? bottom : min_i32(y + LINE_BORDER, y1);
        const bool inside = y >= top && y < bottom;
        if (!inside)
            within = taps_within(&t, -w->width, w->width, first - y, end - next);
        blur_columns(lines, w, inside ? &t : &within, x0, x1, y, next);
    }
}

/* Finds how a block goes, and notes what of its contrast counts: what is left of a way that is cut off stays sharp, and a way that is
 * rounded to none leaves the more the longer it is. */
static void displace_block(const struct smear_lines *lines, const struct smear_window *w, struct smear_line_seen *seen, int32_t x,
                           int32_t y)
{
    enum { HALF = 128, CUT = 256 };     /* q8 px: more than what is rounded is cut off */
    int32_t d[2];
    const int32_t way = smear_lines_displacement(d, lines->pictures, &lines->flow, w, min_i32(x + BLOCK / 2, w->width - 1),
                                                 min_i32(y + BLOCK / 2, w->height - 1), seen->depth);
    const int32_t gone = max_i32(abs_i32(d[0]), abs_i32(d[1]));
    seen->x = (int16_t)(d[0] >> 8);
    seen->y = (int16_t)(d[1] >> 8);
    if (seen->contrast != 0 && (gone == 0 || way > gone + CUT))
        seen->contrast = (uint16_t)min_u32(seen->contrast * min_u32((uint32_t)way >> 4, UINT16_MAX) / ((uint32_t)max_i32(gone, HALF) >> 4),
                                           UINT16_MAX);
}

void smear_lines_displace(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    for (int32_t y = y0; y < y1; y += BLOCK) {
        struct smear_line_seen *seen = seen_at(lines, w, x0, y);
        for (int32_t x = x0; x < x1; x += BLOCK, seen++) {
            if (seen->depth == 0)       /* bare: it has no way of its own, and keeps the depth of what passes it instead */
                seen->contrast = 0;
            else
                displace_block(lines, w, seen, x, y);
        }
    }
}

/* Gives its way to the bare blocks of columns [x0, x1) of rows [y0, y1) that a block passes, half the way before and after. Of several the
 * nearest is seen. */
static void pass_bare(const struct smear_lines *lines, const struct smear_window *w, const struct smear_line_seen *seen, int32_t x,
                      int32_t y, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    int log = 0;
    while (max_i32(abs_i32(seen->x), abs_i32(seen->y)) > 2 * BLOCK << log)
        log++;
    for (int32_t k = -(1 << log); k <= 1 << log; k++) {
        const int32_t u = x + BLOCK / 2 + (seen->x * k >> (log + 1)), v = y + BLOCK / 2 + (seen->y * k >> (log + 1));
        struct smear_line_seen *const bare = u < x0 || u >= x1 || v < y0 || v >= y1 ? NULL : seen_at(lines, w, u, v);
        if (bare != NULL && bare->depth == 0 && bare->contrast < seen->depth) {       /* others read its depth meanwhile */
            bare->contrast = seen->depth;
            bare->x = seen->x;
            bare->y = seen->y;
        }
    }
}

/* Nothing but the clear colour is seen in a bare block: only what passes it shows how it goes. */
static void settle_bare(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    bool any = false;
    for (int32_t y = y0; y < y1; y += BLOCK) {
        struct smear_line_seen *seen = seen_at(lines, w, x0, y);
        for (int32_t x = x0; x < x1; x += BLOCK, seen++)
            any = any || seen->depth == 0;
    }
    for (int32_t y = any ? max_i32((y0 & -w->tile) - w->tile, 0) : lines->drawn; y < lines->drawn; y += BLOCK) {
        const struct smear_line_seen *seen = seen_at(lines, w, 0, y);
        for (int32_t x = 0; x < w->width; x += BLOCK, seen++)
            if (seen->depth != 0 && (seen->x | seen->y) != 0)
                pass_bare(lines, w, seen, x, y, x0, x1, y0, y1);
    }
}

void smear_lines_blur(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    settle_bare(lines, w, x0, x1, y0, y1);
    for (int32_t y = y0; y < y1; y += BLOCK) {
        const struct smear_line_seen *seen = seen_at(lines, w, x0, y);
        for (int32_t x = x0, right; x < x1; x = right) {
            const struct smear_line_seen *const first = seen++;
            const int32_t d[2] = { first->x * 256, first->y * 256 };
            for (right = x + BLOCK; right < x1 && seen->x == first->x && seen->y == first->y; right += BLOCK)
                seen++;
            smear_lines_blur_blocks(lines, w, d, x, min_i32(right, x1), y, min_i32(y + BLOCK, y1), 0, lines->drawn);
        }
    }
}
