/* SPDX-License-Identifier: MIT */
/* poor.h - base/fixmath.h and what it includes for two cores, whatever the target: one with a wide multiply and a leading zero count
 * under plain names, one without with poor_ before them. */
#ifndef SMEAR_TESTS_UNIT_POOR_H
#define SMEAR_TESTS_UNIT_POOR_H

#undef SMEAR_HAS_MUL64
#undef SMEAR_HAS_CLZ
#define SMEAR_HAS_MUL64 1
#define SMEAR_HAS_CLZ 1
#include "base/fixmath.h"

#undef SMEAR_FIXED_H
#undef SMEAR_FIXMATH_H
#undef SMEAR_HAS_MUL64
#undef SMEAR_HAS_CLZ
#define SMEAR_HAS_MUL64 0
#define SMEAR_HAS_CLZ 0
#define add_wrap poor_add_wrap
#define sub_wrap poor_sub_wrap
#define mul_wrap poor_mul_wrap
#define shl_wrap poor_shl_wrap
#define mulh_i32 poor_mulh_i32
#define mulh_u32 poor_mulh_u32
#define mul_shift poor_mul_shift
#define scale_sat poor_scale_sat
#define magnitude poor_magnitude
#define narrow_sat poor_narrow_sat
#define mul_wide poor_mul_wide
#define cross_wide poor_cross_wide
#define dot_wide poor_dot_wide
#define count_leading_zeros poor_count_leading_zeros
#define count_leading_zeros_64 poor_count_leading_zeros_64
#define recip_norm poor_recip_norm
#define recip_norm_precise poor_recip_norm_precise
#define divide_floor poor_divide_floor
#define ratio_q30 poor_ratio_q30
#define sqrt_floor_64 poor_sqrt_floor_64
#define sqrt_by_bits poor_sqrt_by_bits
#define sqrt_by_reciprocals poor_sqrt_by_reciprocals
#define sqrt_q3 poor_sqrt_q3
#include "base/fixmath.h"
#undef add_wrap
#undef sub_wrap
#undef mul_wrap
#undef shl_wrap
#undef mulh_i32
#undef mulh_u32
#undef mul_shift
#undef scale_sat
#undef magnitude
#undef narrow_sat
#undef mul_wide
#undef cross_wide
#undef dot_wide
#undef count_leading_zeros
#undef count_leading_zeros_64
#undef recip_norm
#undef recip_norm_precise
#undef divide_floor
#undef ratio_q30
#undef sqrt_floor_64
#undef sqrt_by_bits
#undef sqrt_by_reciprocals
#undef sqrt_q3

#endif
