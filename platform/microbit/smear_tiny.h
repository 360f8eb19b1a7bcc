/* SPDX-License-Identifier: MIT */
/* smear_tiny.h - what the smallest firmware compiles of the library: flat faces, sharp or as a mean of instants, RGB565.
 * Given as SMEAR_CONFIG_FILE. */
#define SMEAR_WITH_ALL 0
#define SMEAR_WITH_ACCUMULATE 1
#define SMEAR_WITH_RGB565 1
