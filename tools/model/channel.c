/* SPDX-License-Identifier: MIT */
/* channel.c - see channel.h. Equations of interpolation are those of glTF 2.0, appendix C. */
#include "tools/model/channel.h"

#include "tools/model/exact.h"

#include <math.h>

int channel_find_key(const struct model_channel *c, double t)
{
    int low = 0, high = c->key_count - 1;
    while (low < high) {
        int middle = low + (high - low + 1) / 2;
        if ((double)c->time[middle] <= t)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

/* A key's value; CUBICSPLINE keys are in-tangent, value, out-tangent. */
static const float *key_value(const struct model_channel *c, int key)
{
    size_t width = (size_t)c->width, index = (size_t)key;
    return c->interpolation == MODEL_CUBICSPLINE ? c->value + (3 * index + 1) * width :
                                                   c->value + index * width;
}

static void hermite(const struct model_channel *c, int key, double t, double seconds, double *out)
{
    const float *from = key_value(c, key), *to = key_value(c, key + 1);
    const float *leave = from + c->width, *arrive = to - c->width;
    double t2 = t * t, t3 = t2 * t;
    for (int i = 0; i < c->width; i++)
        out[i] = (2 * t3 - 3 * t2 + 1) * (double)from[i] +
                 seconds * (t3 - 2 * t2 + t) * (double)leave[i] +
                 (3 * t2 - 2 * t3) * (double)to[i] + seconds * (t3 - t2) * (double)arrive[i];
}

static void read_quaternion(double out[4], const float *value)
{
    for (int i = 0; i < 4; i++)
        out[i] = (double)value[i];
    exact_normalize4(out);
}

/* The channel's values at t; rotations come out with length 1. */
static void sample(const struct model_channel *c, double t, double *out)
{
    int last = c->key_count - 1, key = 0;
    bool hold = true;
    if (t >= (double)c->time[last]) {
        key = last;
    } else if (t > (double)c->time[0]) {
        key = channel_find_key(c, t);
        hold = c->interpolation == MODEL_STEP;
    }
    const float *from = key_value(c, key);
    if (hold) {
        for (int i = 0; i < c->width; i++)
            out[i] = (double)from[i];
    } else {
        double start = (double)c->time[key], seconds = (double)c->time[key + 1] - start;
        double part = (t - start) / seconds;
        const float *to = key_value(c, key + 1);
        if (c->interpolation == MODEL_CUBICSPLINE) {
            hermite(c, key, part, seconds, out);
        } else if (c->path == MODEL_ROTATION) {
            double a[4], b[4];
            read_quaternion(a, from);
            read_quaternion(b, to);
            exact_slerp(out, a, b, part);
        } else {
            for (int i = 0; i < c->width; i++)
                out[i] = (1 - part) * (double)from[i] + part * (double)to[i];
        }
    }
    if (c->path == MODEL_ROTATION)
        exact_normalize4(out);
}

/* ------------------------------------------------------------------ jumps */

/* A pair of keys that nobody has sampled motion at, seconds; and how much farther away the keys beside it are. */
static const double jump_seconds = 0.0005, jump_apart = 8;

/* How near ends are that meet: of the range of the values; of rotations, of a quaternion's length. */
static const double meets = 1.0 / 1024;

static double gap(const struct model_channel *c, int key)
{
    return key < 0 || key + 1 >= c->key_count ? INFINITY : (double)c->time[key + 1] - (double)c->time[key];
}

bool channel_jumps(const struct model_channel *c, int key)
{
    const double seconds = gap(c, key);
    return c->interpolation == MODEL_STEP
        || (seconds < jump_seconds && seconds * jump_apart <= fmin(gap(c, key - 1), gap(c, key + 1)));
}

/* Whether the last key is the first one: the clip starts again without a jump. */
static bool ends_meet(const struct model_channel *c)
{
    const bool turns = c->path == MODEL_ROTATION;
    const int last = c->key_count - 1, axes = c->path == MODEL_WEIGHTS ? 1 : c->width;
    double range = 0, first_turn[4], last_turn[4], dot = 0;
    if (turns) {
        read_quaternion(first_turn, key_value(c, 0));
        read_quaternion(last_turn, key_value(c, last));
        for (int i = 0; i < 4; i++)
            dot += first_turn[i] * last_turn[i];
        for (int i = 0; i < 4; i++)
            if (fabs(last_turn[i] - (dot < 0 ? -first_turn[i] : first_turn[i])) > meets)
                return false;
        return true;
    }
    for (int axis = 0; axis < axes; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (int key = 0; key <= last; key++)
            for (int i = axis; i < c->width; i += axes) {
                low = fmin(low, (double)key_value(c, key)[i]);
                high = fmax(high, (double)key_value(c, key)[i]);
            }
        range = fmax(range, high - low);
    }
    for (int i = 0; i < c->width; i++)
        if (fabs((double)key_value(c, last)[i] - (double)key_value(c, 0)[i]) > range * meets)
            return false;
    return true;
}

/* The first key on the way from key `from` towards `time` behind which the channel jumps; or -1. */
static int find_jump(const struct model_channel *c, int from, double time)
{
    int key = from;
    for (; key > 0 && (double)c->time[key] > time; key--)
        if (channel_jumps(c, key - 1))
            return key;
    for (; key + 1 < c->key_count && (double)c->time[key] < time; key++)
        if (channel_jumps(c, key))
            return key;
    return -1;
}

/* The motion on this side of key `near` goes on beyond it: what is `beyond` seconds behind it stands as far from the key's
 * value as what is so long before it, on the other side. */
static void reflect(const struct model_channel *c, int near, double at, double beyond, double *out)
{
    double time = at - beyond;
    const int next = find_jump(c, near, time);
    sample(c, next >= 0 ? (double)c->time[next] : time, out);
    if (c->path == MODEL_ROTATION) {
        double turn[4], before[4] = { out[0], out[1], out[2], out[3] };
        read_quaternion(turn, key_value(c, near));
        exact_slerp(out, before, turn, 2);
    } else {
        for (int i = 0; i < c->width; i++)
            out[i] = 2 * (double)key_value(c, near)[i] - out[i];
    }
}

void channel_join(const struct model_channel *c, const struct channel_way *way, double *out)
{
    const int last = c->key_count - 1, key = channel_find_key(c, way->now);
    const bool is_past = way->along < way->now;
    const bool is_between = key < last && way->now > (double)c->time[key] && channel_jumps(c, key);
    if (c->interpolation == MODEL_STEP || is_between || way->along == way->now) {
        sample(c, way->now, out);
        return;
    }
    int near = find_jump(c, key, way->along);
    if (near >= 0) {
        reflect(c, near, (double)c->time[near], way->along - (double)c->time[near], out);
        return;
    }
    if (!way->starts_again) {
        sample(c, way->time, out);
        return;
    }
    const int end = is_past ? 0 : last;
    if (!ends_meet(c)) {
        const double at = is_past ? 0 : way->end;
        reflect(c, end, at, way->along - at, out);
    } else if ((near = find_jump(c, last - end, way->time)) >= 0) {
        reflect(c, near, (double)c->time[near], way->time - (double)c->time[near], out);
    } else {
        sample(c, way->time, out);
    }
}
