/* SPDX-License-Identifier: MIT */
/* span_side.h - where a triangle's row begins and ends. */
#ifndef SMEAR_KERNELS_SPAN_SIDE_H
#define SMEAR_KERNELS_SPAN_SIDE_H

#include "base/base.h"

struct span_side {
    int32_t left, right;        /* as the frame shows them; there may be none */
    int32_t edge;               /* right, wherever that is */
};

#endif
