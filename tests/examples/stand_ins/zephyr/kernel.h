/* SPDX-License-Identifier: MIT */
/* A stand-in for Zephyr's header of the kernel. */
#include <stdio.h>

#define printk printf
