/* SPDX-License-Identifier: MIT */
/* target_golden.c - draws every golden frame: the library gives the same bits on every target.
 *
 * Prints a line `TAPE FRAME CRC` per frame, what is wrong beside it, and a summary. Fails on a
 * wrong or unknown CRC, on an error of the library, and when nothing was drawn. A tape too large
 * for the machine is skipped, and that is said. Where something was left out (smear_config.h) a tape
 * that needs it must be refused; one that leaves it to zero is drawn, but zero means something else. */
#include "platform/platform.h"
#include "platform/play.h"
#include "platform/print.h"

#include <stdbool.h>

struct tally {
    uint32_t right, wrong, skipped, refused, otherwise;
};

static bool has_format(const smear_desc *d)
{
    static const bool has[] = {
        SMEAR_WITH_RGB, SMEAR_WITH_RGB565, SMEAR_WITH_RGB565, SMEAR_WITH_RGB, SMEAR_WITH_RGB,
        SMEAR_WITH_GREY, SMEAR_WITH_GREY, SMEAR_WITH_GREY, SMEAR_WITH_GREY
    };
    bool dithered = d->format != SMEAR_XRGB8888 && d->format != SMEAR_L8 && d->display.dither > SMEAR_DITHER_NONE;
    return has[d->format] && (!dithered || (SMEAR_WITH_DITHER && SMEAR_WITH_DISPLAY));
}

/* Whether zeros of a tape mean something else, as what they mean elsewhere was left out. */
static bool is_drawn_otherwise(const struct tape *tape)
{
    const smear_desc *d = tape->desc;
    bool otherwise = !SMEAR_WITH_DITHER && d->display.dither == SMEAR_DITHER_ORDERED && d->format != SMEAR_XRGB8888
                  && d->format != SMEAR_L8;
    for (int i = 0; i < tape->frame_count; i++) {
        const smear_frame *f = tape->frame[i].frame;
        otherwise = otherwise || (!SMEAR_WITH_LINEAR && f->light_space == SMEAR_LIGHT_LINEAR)
                 || (!SMEAR_WITH_FILTERS && (f->method == SMEAR_RECONSTRUCT || f->method == SMEAR_DEFAULT_METHOD)
                     && (d->methods & SMEAR_SET(SMEAR_RECONSTRUCT)) != 0 && !(f->filter.flags & SMEAR_PUBLISHED))
                 || (!SMEAR_WITH_CURVES && f->shutter.path == SMEAR_PATH_DEFAULT && f->method != SMEAR_NONE && !f->shutter.poses);
    }
    return otherwise;
}

#define SETS_OF_SUMS (SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_ACCUMULATE_BANDS)
#define SETS_OF_PORTS (SMEAR_SET_FILTERS & ~SMEAR_SET(SMEAR_RECONSTRUCT))

/* Whether a tape needs something that was left out. */
static bool is_refused(const struct tape *tape)
{
    const smear_desc *d = tape->desc;
    if (!has_format(d) || (d->workers > 1 && !SMEAR_WITH_WORKERS) || ((d->methods & SETS_OF_SUMS) != 0 && !SMEAR_WITH_ACCUMULATE)
        || ((d->methods & SMEAR_SET_TEMPORAL) != 0 && !SMEAR_WITH_SUBFRAMES)
        || ((d->methods & SMEAR_SET_SKETCH) != 0 && !SMEAR_WITH_LINES)
        || ((d->methods & SMEAR_SET(SMEAR_TIMEMASK)) != 0 && !SMEAR_WITH_TIMEMASK)
        || ((d->methods & SMEAR_SET_LAYERS) != 0 && !SMEAR_WITH_LAYERS)
        || ((d->methods & SMEAR_SET(SMEAR_RECONSTRUCT)) != 0 && !SMEAR_WITH_RECONSTRUCT)
        || (((d->methods & SETS_OF_PORTS) != 0 || d->filter.passes > 1 || d->filter.scatter) && !SMEAR_WITH_FILTERS))
        return true;
    for (int i = 0; i < tape->frame_count; i++) {
        const struct tape_frame *f = &tape->frame[i];
        uint8_t method = f->frame->method;
        if ((smear_method_is_filter(method) && !SMEAR_WITH_RECONSTRUCT) || (method == SMEAR_TIMEMASK && !SMEAR_WITH_TIMEMASK))
            return true;
        if (((smear_method_is_filter(method) && method != SMEAR_RECONSTRUCT) || f->frame->filter.camera_step != 0
             || f->frame->filter.weights != 0) && !SMEAR_WITH_FILTERS)
            return true;
        if (f->frame->shutter.path != SMEAR_PATH_DEFAULT && f->frame->shutter.path != SMEAR_PATH_LINE && !SMEAR_WITH_CURVES)
            return true;
        if ((f->frame->camera->half_height != 0 && !SMEAR_WITH_VIEWS)
            || ((f->frame->scale.rotation | f->frame->scale.translation | f->frame->scale.object) != 0 && !SMEAR_WITH_SCALES)
            || (f->frame->samples > 256 && method == SMEAR_SUBFRAMES && !SMEAR_WITH_LINEAR)
            || ((f->frame->shutter.mode != SMEAR_SHUTTER_NATIVE || f->frame->shutter.us != 0) && !SMEAR_WITH_SCALES))
            return true;
        for (int k = 0; k < f->draw_count; k++) {
            const smear_draw *draw = &f->draw[k];
            const smear_material *m = draw->material;
            if (draw->billboard != 0 && !SMEAR_WITH_VIEWS)
                return true;
            if (((draw->mesh->normal != NULL || draw->mesh->color != NULL) && !SMEAR_WITH_GOURAUD)
                || ((draw->open_position != NULL || draw->close_position != NULL) && !SMEAR_WITH_DEFORM))
                return true;
            if (m != NULL && ((m->texture != NULL && !SMEAR_WITH_TEXTURE) || (m->bilinear && !SMEAR_WITH_TEXTURE)
                              || (m->alpha != SMEAR_OPAQUE && !SMEAR_WITH_ALPHA)))
                return true;
        }
    }
    return false;
}

/* Prints what went otherwise than it should. */
static void say(const struct tape *tape, const char *what, int number)
{
    platform_print("# ");
    platform_print(tape->name);
    platform_print(what);
    print_signed(number);
    platform_print("\n");
}

static void print_frame(const struct tape *tape, int frame, uint32_t crc)
{
    platform_print(tape->name);
    platform_print(" ");
    print_signed(frame);
    platform_print(" ");
    print_hex(crc);
}

static void play_tape(const struct tape *tape, struct tally *tally)
{
    struct player player;
    smear_stats stats;
    size_t room, need = play_memory(tape);
    void *arena = platform_arena(&room);
    if (need > room) {
        platform_print("# ");
        platform_print(tape->name);
        platform_print(" skipped: needs ");
        print_decimal((uint32_t)need);
        platform_print(" bytes\n");
        tally->skipped++;
        return;
    }
    /* exactly as much as it asks for, so that an overrun is not into its own slack */
    int result = need == 0 ? SMEAR_ERR_ARG : play_start(&player, tape, arena, need, NULL);
    if (is_refused(tape)) {
        for (int i = 0; i < tape->frame_count && result == SMEAR_OK; i++)
            result = play_frame(&player, i, &stats);
        if (smear_error_kind(result) == SMEAR_ERR_ARG) {
            tally->refused++;
        } else {
            say(tape, " NOT REFUSED ", result);
            tally->wrong++;
        }
        return;
    }
    const bool otherwise = is_drawn_otherwise(tape);
    tally->otherwise += otherwise;
    for (int i = 0; i < tape->frame_count && result == SMEAR_OK; i++) {
        result = play_frame(&player, i, &stats);
        if (result != SMEAR_OK)
            break;
        if (otherwise)
            continue;
        print_frame(tape, i, stats.crc32);
        bool is_right = tape->crc != NULL && tape->crc[i] == stats.crc32;
        if (is_right)
            tally->right++;
        else
            tally->wrong++;
        if (!is_right) {
            platform_print(tape->crc != NULL ? " WRONG, want " : " NOT KNOWN");
            if (tape->crc != NULL)
                print_hex(tape->crc[i]);
        }
        platform_print("\n");
    }
    if (result != SMEAR_OK) {
        say(tape, " ERROR ", result);
        tally->wrong++;
    }
}

int main(void)
{
    struct tally tally = { 0, 0, 0, 0, 0 };
    for (int i = 0; i < tape_count; i++)
        play_tape(tape_list[i], &tally);
    platform_print("golden frames: ");
    print_decimal(tally.right);
    platform_print(" right, ");
    print_decimal(tally.wrong);
    platform_print(" wrong, ");
    print_decimal(tally.skipped);
    platform_print(" tapes skipped");
    if (tally.refused > 0) {
        platform_print(", ");
        print_decimal(tally.refused);
        platform_print(" refused");
    }
    if (tally.otherwise > 0) {
        platform_print(", ");
        print_decimal(tally.otherwise);
        platform_print(" drawn otherwise");
    }
    uint32_t stack = platform_stack_used();
    bool is_overflow = stack == UINT32_MAX;
    if (is_overflow) {
        platform_print("; STACK OVERFLOW");
    } else if (stack > 0) {
        platform_print("; stack ");
        print_decimal(stack);
        platform_print(" bytes");
    }
    platform_print("\n");
    return tally.wrong != 0 || tally.right == 0 || is_overflow;
}
