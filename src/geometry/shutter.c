/* SPDX-License-Identifier: MIT */
/* shutter.c - inverts the integral of the openness: every time sample lets the same light through. */
#include "geometry/path.h"

#include "smear.h"

#include "base/fixmath.h"

/* Returns the light up to point i of the table, in units of 1/2 x openness x step. */
static uint32_t light_to(const uint8_t *openness, int i)
{
    uint32_t sum = 0;
    for (int k = 0; k < i; k++)
        sum += (uint32_t)openness[k] + openness[k + 1];
    return sum;
}

/* Returns when light_q8 of the light a + b has come through an interval that opens from a to b, q16 of the interval.
 * The light up to time u is 2 a u + (b - a) u^2; u is found by bisection. */
static int32_t time_in_interval(int32_t a, int32_t b, uint32_t light_q8)
{
    int32_t low = 0, high = 65536;
    while (high - low > 1) {
        int32_t u = (low + high) >> 1;
        int64_t through = 2 * (int64_t)a * u + ((int64_t)(b - a) * u * u >> 16);     /* q16 */
        if (through >> 8 <= (int64_t)light_q8)
            low = u;
        else
            high = u;
    }
    return low;
}

bool smear_shutter_make(struct smear_shutter_times *shutter, const uint8_t *openness)
{
    const int steps = SMEAR_SHUTTER_POINTS - 1;
    const uint32_t all = openness != NULL ? light_to(openness, steps) : 0;
    if (openness != NULL && all == 0)
        return false;
    for (int sample = 0; sample <= SHUTTER_SAMPLES; sample++)
        shutter->time[sample] = sample * (SHUTTER_CLOSE / SHUTTER_SAMPLES);
    if (openness == NULL)
        return true;
    for (int sample = 1; sample < SHUTTER_SAMPLES; sample++) {
        uint32_t wanted_q8 = (all * (uint32_t)sample << 8) / SHUTTER_SAMPLES, before = 0;
        int i = 0;
        while (i < steps - 1 && (before + openness[i] + openness[i + 1]) << 8 <= wanted_q8) {
            before += (uint32_t)openness[i] + openness[i + 1];
            i++;
        }
        int32_t in = time_in_interval(openness[i], openness[i + 1], wanted_q8 - (before << 8));
        shutter->time[sample] = (i * 65536 + in) / steps;
    }
    return true;
}

int32_t smear_shutter_instant(const struct smear_shutter_times *shutter, int32_t i, int32_t n)
{
    /* Counted in samples, q16: (i + 1/2) 32 / n. */
    uint32_t at = (uint32_t)(2 * i + 1) * (SHUTTER_SAMPLES << 15) / (uint32_t)n;
    uint32_t sample = at >> 16, rest = at & 0xffffu;
    int32_t begin = shutter->time[sample], length = shutter->time[sample + 1] - begin;
    return begin + (int32_t)((uint32_t)length * rest >> 16);
}

bool smear_shutter_is_box(const struct smear_shutter_times *shutter)
{
    for (int sample = 0; sample < SHUTTER_SAMPLES; sample++)
        if (shutter->time[sample] != sample * (SHUTTER_CLOSE / SHUTTER_SAMPLES))
            return false;
    return true;
}
