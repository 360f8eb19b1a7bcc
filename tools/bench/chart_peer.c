/* SPDX-License-Identifier: MIT */
/* chart_peer.c - what TGX needs for six of the scenes: the fastest rasterizer for small machines that we
 * know, in C++ and floating point. It draws sharp frames; their mean is the motion blur that its users
 * would write.
 *
 * Its conditions: gcc -O2, x86-64, callgrind; 320x240, encoded light, XRGB8888, textures without filter,
 * a depth buffer of 16 bits, meshes in strips. The mean of N is of the middles of N parts of an exposure of 180
 * degrees, every instant posed exactly, summed by vectors. Error: against 256 such instants of a
 * renderer in double precision. Sharp frames and means of 8 are counted; what each frame more takes is
 * the same in both, which gives those of 4 and 16. */
#include "tools/bench/chart.h"

#include "tools/bench/sheet.h"

#include <string.h>

const char *const chart_peer_name[PEER_SETTINGS] = { "sharp", "mean of 4", "mean of 8", "mean of 16" };

const struct chart_peer chart_peer[PEER_FRAMES] = {
    { "translate", { 2.71, 11.3, 22.0, 43.4 }, { 8.1, 2.4, 1.4, 0.93 } },
    { "cross",     { 3.25, 13.5, 26.2, 52.0 }, { 11.7, 3.3, 1.8, 1.02 } },
    { "pan",       { 5.43, 22.2, 43.7, 86.8 }, { 19.1, 4.9, 2.4, 1.28 } },
    { "arena",     { 3.48, 14.4, 28.1, 55.7 }, { 10.2, 2.7, 1.4, 0.96 } },
    { "roll",      { 5.63, 23.0, 45.3, 90.1 }, { 20.3, 6.3, 3.1, 1.42 } },
    { "race-4",    { 8.45, 34.3, 67.9, 135.2 }, { 16.1, 4.1, 2.3, 1.34 } },
};

const struct chart_peer *chart_peer_of(int kind)
{
    for (int i = 0; i < PEER_FRAMES; i++)
        if (strcmp(chart_peer[i].kind, kinds[kind].name) == 0)
            return &chart_peer[i];
    return NULL;
}

bool chart_peer_mean(const struct chart *chart, int condition, enum chart_set set, int setting, double *cost,
                     double *rmse)
{
    double each[PEER_FRAMES], error[PEER_FRAMES];
    int n = 0;
    for (int k = 0; k < ALL_KINDS; k++) {
        const struct chart_peer *peer = chart_peer_of(k);
        const struct chart_value *ours = &chart->value[condition][k][chart_none];
        if (peer == NULL || !chart_set_has(set, k))
            continue;
        if (!ours->known)
            return false;
        each[n] = 1e6 * peer->instructions[setting] / ours->instructions;
        error[n++] = peer->rmse[setting];
    }
    if (n == 0)
        return false;
    *cost = geometric_mean(each, n);
    *rmse = geometric_mean(error, n);
    return true;
}
