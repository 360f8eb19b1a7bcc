/* SPDX-License-Identifier: MIT */
/* choose.c - the rules by which a tile gets its method. */
#include "choose.h"

#include "smear.h"

#include "fixmath.h"

/* One per half pixel of travel, at least 2: even a motion of less than a pixel needs them, where edges are hard. */
static int32_t instants_for(const struct smear_tile_load *load, int32_t most)
{
    return min_i32(max_i32((load->travel + load->bend + 7) >> 3, 2), most);
}

static void choose_timemask(struct smear_tile_choice *choice, int32_t slots, int32_t bend, int32_t edge, int32_t tap)
{
    choice->method = TILE_TIMEMASK;
    choice->timemask = (struct smear_timemask_settings){ slots <= 8 ? 8 : slots <= 16 ? 16 : 32, bend, edge, tap };
}

/* Means along the ways of pixels of the sharp picture take over its aliasing: edges and thin things come out a fraction of
 * a pixel wrong. Over texels that is nothing new, and taps along the way of a texture are dear for every other method. */
static bool wants_smooth(const struct smear_chooser *chooser, const struct smear_tile_load *load)
{
    return chooser->target >= SMEAR_DRAFT || (load->flags & PATH_TEXTURED) != 0;
}

void smear_choose(struct smear_tile_choice *choice, const struct smear_chooser *chooser,
                  const struct smear_tile_load *load)
{
    bool closed_form = (load->flags & (PATH_SUBFRAMES | TILE_BLENDED)) == 0;
    if (load->count == 0 && (load->flags & PATH_SUBFRAMES) == 0) {
        choice->method = TILE_COPY;
    } else if (chooser->method == SMEAR_SUBFRAMES) {
        choice->method = TILE_SUBFRAMES;
        choice->instants = instants_for(load, chooser->samples);
    } else if (chooser->method == SMEAR_TIMEMASK) {
        if (closed_form) {
            choose_timemask(choice, chooser->samples, 16, 6, 256);
        } else {
            choice->method = TILE_SUBFRAMES;
            choice->instants = instants_for(load, chooser->samples);
        }
    } else if (chooser->has_window && (load->flags & (PATH_SUBFRAMES | TILE_BLENDED)) == 0
               && load->travel >= 8 * 16 && wants_smooth(chooser, load)) {
        choice->method = TILE_SMOOTH;
        choice->tolerance = max_i32(min_i32(chooser->target * 2, 256), load->travel * 16 / 24);
        choice->taps = max_i32(load->travel >> 4, 8);
    } else if (closed_form) {
        choose_timemask(choice, chooser->target >= SMEAR_DRAFT ? 8 : chooser->target >= SMEAR_BALANCED ? 16 : 32,
                        min_i32(chooser->target, 128), chooser->target >= SMEAR_BALANCED ? 2 : 5, 512);
    } else {
        choice->method = TILE_SUBFRAMES;
        choice->instants = instants_for(load, chooser->target >= SMEAR_BALANCED ? 16 : 32);
    }
}
