/* SPDX-License-Identifier: MIT */
/* arena.c - platform.h's memory, as the linker script laid it out: the arena from link_arena_start to
 * link_arena_end, the stack as stack.h says. */
#include "platform/platform.h"
#include "platform/common/stack.h"

extern uint64_t link_arena_start[], link_arena_end[];

void *platform_arena(size_t *bytes)
{
    *bytes = (size_t)((uintptr_t)link_arena_end - (uintptr_t)link_arena_start);
    return link_arena_start;
}

uint32_t platform_stack_used(void)
{
    const uint32_t *lowest = link_stack_limit;
    while (lowest < link_stack_top && *lowest == STACK_PAINT)
        lowest++;
    if (lowest == link_stack_limit)
        return UINT32_MAX;
    return (uint32_t)((uintptr_t)link_stack_top - (uintptr_t)lowest);
}
