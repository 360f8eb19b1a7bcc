/* SPDX-License-Identifier: MIT */
/* groups.h - which draws are blurred as layers, and which of them move alike: the groups of layer.h. */
#ifndef SMEAR_GROUPS_H
#define SMEAR_GROUPS_H

#include "geometry/assemble.h"
#include "layers/layer.h"

/* Call before the draws of a frame are looked at. */
void smear_groups_begin(struct smear_layers *l);

/* Finds the layer of draw number `index`. */
void smear_groups_find_layer(struct smear_layers *l, uint32_t index, const smear_draw *draw);

/* Takes in a draw of a blurred layer: finds its displacement from its places at shutter open and close. One that does
 * not move on the screen stays with the static scene, but for those of layers that lie over it. */
void smear_groups_add(struct smear_layers *l, uint32_t index, const smear_draw *draw, const struct smear_placement key[2],
                      const struct smear_placement *middle, const struct smear_viewport *viewport, bool moves);

/* Call after the last of `draw_count` draws: it orders groups, and draws by groups. */
void smear_groups_end(struct smear_layers *l, uint32_t draw_count);

/* Assembles a draw of a group into lists of its own. Returns false where there is no room. */
bool smear_groups_assemble(struct smear_layers *l, struct smear_assembler *assembler, const struct smear_assembly *a);

/* Finds each group's part of the moving triangles' list, from `head` on. */
void smear_groups_list(struct smear_layers *l, const struct smear_bins *bins, uint32_t head);

/* Does so where a tile row is drawn from several fills of the store: begins, adds triangles of a group, from `head` on, and
 * ends. A group that has none keeps no head. */
void smear_groups_list_begin(struct smear_layers *l);
void smear_groups_list_add(struct smear_group *group, const struct smear_bins *bins, uint32_t head);
void smear_groups_list_end(struct smear_layers *l);

/* Finds where groups lie in part behind others that are merged before them; returns false where none does. `reach` is
 * that of filters. */
bool smear_groups_find_mixed(struct smear_layers *l, int32_t reach);

#endif
