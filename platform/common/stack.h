/* SPDX-License-Identifier: MIT */
/* stack.h - the stack grows down from link_stack_top to link_stack_limit (of the linker script). The
 * start-up code paints it, so that platform_stack_used can tell how far it was used. */
#ifndef SMEAR_STACK_H
#define SMEAR_STACK_H

#include <stdint.h>

#define STACK_PAINT 0x5ac35ac3u

extern uint32_t link_stack_top[], link_stack_limit[];

#endif
