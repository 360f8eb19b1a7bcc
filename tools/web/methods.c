/* SPDX-License-Identifier: MIT */
/* methods.c - host program: writes the list of methods for the page's scripts, from tools/scenes/methods.c. */
#include "tools/scenes/methods.h"

#include <stdio.h>

int main(void)
{
    printf("// samples: of draft, balanced, fine; 0: there are none to choose. curve, color: in the chart.\nconst METHODS = [\n");
    for (int i = 0; i < method_count; i++) {
        const struct method *m = &method_list[i];
        printf("    { name: \"%s\", label: \"%s\", hint: \"%s\", samples: [%d, %d, %d], curve: \"%s\", color: \"%s\" },\n", m->name,
               m->label, m->hint, m->samples[0], m->samples[1], m->samples[2], m->curve, m->color);
    }
    printf("];\n");
    return 0;
}
