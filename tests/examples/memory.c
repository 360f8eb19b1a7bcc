/* SPDX-License-Identifier: MIT */
/* memory.c - prints the table of methods and their memory for README.md. The constant and the size at run time agree. */
#include <smear_memory.h>
#include <stdio.h>

/* The tile is the default one; as it is given, 64-bit machines count bands as boards have them. */
#define SCREEN(set) 240, 240, 600, 16, set, 16, 0, 0, 0, 0, SMEAR_RGB565

struct row {
    const char *name, *what;
    size_t constant;
    smear_desc desc;
};

#define ROW(name, set, what) { name, what, SMEAR_MEMORY(SCREEN(set)), SMEAR_DESC(SCREEN(set)) }

static int flush(void *user, const smear_band *band)
{
    (void)user, (void)band;
    return 0;
}

int main(void)
{
    struct row rows[] = {
        ROW("SMEAR_AUTO", SMEAR_SET(SMEAR_AUTO),
            "the default: draws what moves at a few moments of the exposure, and fills the gaps between them"),
        ROW("SMEAR_SUBFRAMES", SMEAR_SET(SMEAR_SUBFRAMES), "a moment for each half pixel of travel; slower, closer to the truth"),
        ROW("SMEAR_TIMEMASK", SMEAR_SET(SMEAR_TIMEMASK), "works out when each triangle covers each pixel; the cleanest streaks"),
        ROW("SMEAR_OBJECT", SMEAR_SET(SMEAR_OBJECT), "smears each object along one line; a long one costs no more"),
        ROW("SMEAR_RECONSTRUCT", SMEAR_SET(SMEAR_RECONSTRUCT), "filters a sharp picture, as large game engines do"),
        ROW("SMEAR_ACCUMULATE", SMEAR_SET_ACCUMULATE_BANDS, "the mean of sharp pictures; memory of `SMEAR_SET_ACCUMULATE_BANDS`; slowest"),
        ROW("SMEAR_NONE", SMEAR_SET(SMEAR_NONE), "no blur"),
    };
    printf("| method | what it does | memory |\n|---|---|---|\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        rows[i].desc.flush = flush;
        if (smear_memory_size(&rows[i].desc) > rows[i].constant)
            return 1;
        printf("| `%s` | %s | %u kB |\n", rows[i].name, rows[i].what, (unsigned)((rows[i].constant + 999) / 1000));
    }
    return 0;
}
