/* SPDX-License-Identifier: MIT */
/* @WHAT@ display.h draws it in the terminal. The first argument: so many frames [300]. */
#include "@NAME@.h"
#include <stdlib.h>
#include <time.h>

int main(int argc, char **argv)
{
    const long frames = argc > 1 ? atol(argv[1]) : 300;
    int result = @NAME@_begin();
    for (long i = 0; i < frames && result == SMEAR_OK; i++) {
        const clock_t begun = clock();
        result = @NAME@_frame();
        while (clock() - begun < CLOCKS_PER_SEC / 30)
            ;                           /* C has nothing to sleep by */
    }
    if (result != SMEAR_OK)
        fprintf(stderr, "%s\n", smear_error_text(result));
    return result != SMEAR_OK;
}
