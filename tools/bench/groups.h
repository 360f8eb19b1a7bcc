/* SPDX-License-Identifier: MIT */
/* groups.h - every take has a number in a group, so that this program and its copy under callgrind
 * speak of the same one. */
#ifndef SMEAR_BENCH_GROUPS_H
#define SMEAR_BENCH_GROUPS_H

#include "tools/bench/take.h"

/* False when the group or the number does not exist. */
bool group_take(const char *group, int index, struct take *out);

/* Each group's own file. */
bool peers_take(int index, struct take *out);

#endif
