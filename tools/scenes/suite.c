/* SPDX-License-Identifier: MIT */
/* suite.c - finds the scenes of the quality suite in the tables of its files.
 *
 * Each scene is as hard as its namesake of the study that picked the methods: the RMSE of the sharp
 * frame against 256 instants of a centred shutter of 180 degrees, encoded light, 8-bit codes, is
 * within 20 % of the study's (test_scenes.c holds them to it):
 *
 *     scene       ours  study     scene       ours  study     scene       ours  study
 *     translate   9.30   9.01     fence_fg   33.28  30.60     swarm      18.63  17.43
 *     propeller  13.02  13.27     fence_obj  10.98  11.47     still       0.00   0.00
 *     pan        18.99  19.72     enter      10.01  10.90     teleport    3.15   3.06
 *     dolly      11.09  11.82     near        9.51   9.71     textured   26.70  27.83
 *     roll       22.85  24.67     long       18.61  17.26     morph       3.65   3.91
 *     cross      13.10  13.87     subpixel    1.33   1.41     cubic       5.48   5.29
 *                                 skin        6.61   6.78     arena      10.08  11.10
 */
#include "tools/scenes/builtin.h"

#include "tools/scenes/suite.h"

#include <string.h>

bool suite_make(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < suite_object_count; i++)
        if (strcmp(suite_object_kinds[i].name, name) == 0)
            return stage_open(suite_object_kinds, suite_object_count, name, out, f);
    return stage_open(suite_camera_kinds, suite_camera_count, name, out, f);
}
