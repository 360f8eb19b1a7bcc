/* SPDX-License-Identifier: MIT */
/* failures_known.c - known failures of camera, pingpong, half, other weights of reconstruct, object and layered: bounds that their
 * numbers must not exceed. camera knows no object's motion, so whatever moves an object fails as `none` does. Of object and layered, what
 * turns or has no one velocity is blurred by taps, rotation follows the chord; beyond the margin of a layer's rows nothing is known. */
#include "tests/suite/failures.h"

#include <string.h>

/* Rows by their number, those beyond the catalogue by their name. */
static const struct {
    int number;
    const char *name;
    int measure;
    double at_most[METHODS - CAMERA];           /* CAMERA, PINGPONG, HALF_SIZE, JIMENEZ, OBJECT, LAYERED */
} known[] = {
    { 1, NULL, 0, { 30, 13, 15, 14, 13, 13 } },
    { 1, NULL, 1, { 18, 14, 12, 8, 4.4, 4.4 } },
    { 1, NULL, 2, { 30, 15, 16, 16, 14, 14 } },
    { 2, NULL, 0, { 15, 8, 8.7, 8, 7.7, 8 } },
    { 2, NULL, 1, { 2.2, 2.3, 2.3, 2.3, 2.3, 2.3 } },
    { 2, NULL, 2, { 2.2, 2.2, 2.4, 2.3, 2.2, 2.3 } },
    { 3, NULL, 0, { 59, 58, 59, 59, 0, 58 } },
    { 4, NULL, 1, { 19, 8.1, 9.7, 8.4, 2.4, 8.2 } },
    { 5, NULL, 0, { 0, 0, 150, 0, 0, 0 } },
    { 6, NULL, 0, { 35, 35, 13, 35, 36, 110 } },
    { 6, NULL, 1, { 38, 22, 31, 24, 9.2, 28 } },
    { 7, NULL, 1, { 8.5, 5.3, 4.9, 4.2, 0, 0 } },
    { 8, NULL, 0, { 0.5, 0.078, 0.14, 0, 0, 0.073 } },
    { 9, NULL, 0, { 110, 0, 110, 15, 110, 110 } },
    { 10, NULL, 0, { 0, 1.5, 0.98, 1.7, 0, 0 } },
    { 10, NULL, 1, { 12, 6.6, 7.2, 6.8, 0, 6.1 } },
    { 11, NULL, 0, { 13, 8.1, 9.4, 8.4, 8.2, 8.2 } },
    { 14, NULL, 0, { 26, 8.2, 26, 16, 0, 7.7 } },
    { 15, NULL, 0, { 9.1, 8.8, 8.9, 8.8, 8.9, 8.9 } },
    { 15, NULL, 1, { 3, 0, 3.2, 0, 0, 0 } },
    { 16, NULL, 0, { 14, 0, 3.7, 3.1, 0, 0 } },
    { 17, NULL, 0, { 4.2, 3.4, 4.9, 3.7, 5.3, 7.1 } },
    { 18, NULL, 0, { 13, 13, 13, 13, 13, 13 } },
    { 19, NULL, 1, { 0, 8.4, 15, 13, 6, 6 } },
    { 20, NULL, 0, { 0, 0, 17, 7.1, 0, 0 } },
    { 20, NULL, 1, { 27, 3.1, 16, 5.2, 2.4, 3.3 } },
    { 21, NULL, 0, { 35, 6.7, 30, 0, 0, 9 } },
    { 22, NULL, 0, { 83, 0, 0, 0, 0, 0 } },
    { 22, NULL, 1, { 520, 65, 160, 17, 0, 66 } },
    { 23, NULL, 0, { 1.7, 2, 3.4, 1.2, 2, 1.6 } },
    { 23, NULL, 1, { 1.2, 0, 0, 0, 0, 0 } },
    { 26, NULL, 1, { 0, 0, 23, 0, 0, 0 } },
    { 26, NULL, 2, { 16, 14, 15, 9.5, 7.6, 7.9 } },
    { 27, NULL, 1, { 5.7, 5.6, 5.8, 5.9, 4.4, 4.4 } },
    { 28, NULL, 0, { 2.9, 0, 2.4, 0, 0, 0 } },
    { 29, NULL, 1, { 6.1, 6.5, 19, 7.7, 6.1, 6.1 } },
    { 32, NULL, 0, { 5.9, 3, 4.5, 3.1, 2.6, 2.6 } },
    { 35, NULL, 0, { 32, 4.1, 9.9, 4.1, 0, 4.1 } },
    { 37, NULL, 0, { 49, 5.5, 20, 7.7, 6.4, 6.6 } },
    { 37, NULL, 1, { 72, 12, 27, 22, 13, 18 } },
    { 38, NULL, 0, { 27, 11, 14, 13, 9, 9 } },
    { 38, NULL, 1, { 45, 19, 23, 21, 18, 18 } },
    { 39, NULL, 0, { 25, 9.6, 15, 9.7, 8.1, 8.1 } },
    { 39, NULL, 1, { 62, 46, 48, 46, 46, 46 } },
    { 40, NULL, 0, { 31, 8.7, 12, 11, 7.7, 7.7 } },
    { 40, NULL, 1, { 58, 16, 22, 20, 15, 15 } },
    { 0, "every scene of the catalogue", 0, { 0, 1.1, 1.1, 1.1, 0, 0 } },
    { 0, "every scene of the catalogue", 1, { 0, 0, 75, 0, 42, 42 } },
    { 0, "trailing and leading exposures", 0, { 29, 3.9, 13, 5.2, 0, 4.1 } },
    { 0, "trailing and leading exposures", 1, { 29, 3.9, 13, 5.2, 0, 4.1 } },
};

double fail_known(const struct fail_row *row, int measure, int method)
{
    for (size_t i = 0; i < sizeof known / sizeof *known && method >= CAMERA; i++)
        if (known[i].number == row->number && known[i].measure == measure
            && (row->number != 0 || strcmp(known[i].name, row->name) == 0))
            return known[i].at_most[method - CAMERA];
    return row->measure[measure].known[method];
}
