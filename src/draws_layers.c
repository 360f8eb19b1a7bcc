/* SPDX-License-Identifier: MIT */
/* draws_layers.c - which draws are blurred as layers, and how they move. */
#include "draws.h"

#include "layers/groups.h"

SMEAR_NOINLINE void smear_draws_find_layers(struct smear_context *c, const struct smear_instant *middle)
{
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    const struct smear_instant open = smear_instant_at(&c->shot, -65536), close = smear_instant_at(&c->shot, 65536);
    struct smear_layers *l = c->layers;
    smear_groups_begin(l);
    for (uint32_t i = 0; i < c->draw_count; i++)
        smear_groups_find_layer(l, i, &c->submitted[i].draw);
    for (uint32_t i = 0; i < c->draw_count; i++) {
        const smear_draw *draw = &c->submitted[i].draw;
        struct smear_draw_poses poses;
        struct smear_placement key[2], at;
        if (l->layer_of[i] == SMEAR_NO_LAYER || c->raster_draw[i].alpha == SMEAR_BLEND)
            continue;
        const struct smear_layer_setting *setting = &l->setting[l->layer_of[i]];
        poses_of(&poses, c, i);
        const bool moves = setting->layer.method != SMEAR_NONE && poses_differ(&poses);
        if (moves && !c->raster_draw[i].moves) {        /* before the layer's camera alone */
            c->raster_draw[i].moves = true;
            c->stats.draws_moved++;
        }
        if (!moves && !setting->has_camera && !setting->layer.over)
            continue;
        smear_draw_poses_place(&key[0], &poses, &c->shot, draw->mesh, moves ? &open : &smear_instant_now);
        smear_draw_poses_place(&key[1], &poses, &c->shot, draw->mesh, moves ? &close : &smear_instant_now);
        smear_draw_poses_place(&at, &poses, &c->shot, draw->mesh, moves ? middle : &smear_instant_now);
        smear_groups_add(l, i, draw, key, &at, &c->assembler.viewport, moves);
    }
    smear_groups_end(l, c->draw_count);
}
