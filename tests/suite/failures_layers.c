/* SPDX-License-Identifier: MIT */
/* failures_layers.c - known failures of object and layered: bounds that their numbers must not exceed. What turns or has no
 * one velocity is blurred by taps, rotation follows the chord; beyond the margin of a layer's rows nothing is known. */
#include "tests/suite/failures.h"

#include <string.h>

/* Rows by their number, those beyond the catalogue by their name. */
static const struct {
    int number;
    const char *name;
    int measure;
    double object, layered;
} known[] = {
    { 1, NULL, 0, 13, 13 },
    { 1, NULL, 1, 4.4, 4.4 },
    { 1, NULL, 2, 14, 14 },
    { 2, NULL, 0, 7.7, 8 },
    { 2, NULL, 1, 2.3, 2.3 },
    { 2, NULL, 2, 2.2, 2.3 },
    { 3, NULL, 0, 0, 58 },
    { 4, NULL, 1, 2.4, 8.2 },
    { 6, NULL, 0, 36, 110 },
    { 6, NULL, 1, 9.2, 28 },
    { 8, NULL, 0, 0, 0.073 },
    { 9, NULL, 0, 110, 110 },
    { 10, NULL, 1, 0, 6.1 },
    { 11, NULL, 0, 8.2, 8.2 },
    { 14, NULL, 0, 0, 7.7 },
    { 15, NULL, 0, 8.9, 8.9 },
    { 17, NULL, 0, 5.3, 7.1 },
    { 18, NULL, 0, 13, 13 },
    { 19, NULL, 1, 6, 6 },
    { 20, NULL, 1, 2.4, 3.3 },
    { 21, NULL, 0, 0, 9 },
    { 22, NULL, 1, 0, 66 },
    { 23, NULL, 0, 2, 1.6 },
    { 26, NULL, 2, 7.6, 7.9 },
    { 27, NULL, 1, 4.4, 4.4 },
    { 29, NULL, 1, 6.1, 6.1 },
    { 32, NULL, 0, 2.6, 2.6 },
    { 35, NULL, 0, 0, 4.1 },
    { 37, NULL, 0, 6.4, 6.6 },
    { 37, NULL, 1, 13, 18 },
    { 38, NULL, 0, 9, 9 },
    { 38, NULL, 1, 18, 18 },
    { 39, NULL, 0, 8.1, 8.1 },
    { 39, NULL, 1, 46, 46 },
    { 40, NULL, 0, 7.7, 7.7 },
    { 40, NULL, 1, 15, 15 },
    { 0, "every scene of the catalogue", 1, 42, 42 },
    { 0, "trailing and leading exposures", 0, 0, 4.1 },
    { 0, "trailing and leading exposures", 1, 0, 4.1 },
};

double fail_layer_known(const struct fail_row *row, int measure, int method)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (known[i].number != row->number || known[i].measure != measure
            || (row->number == 0 && strcmp(known[i].name, row->name) != 0))
            continue;
        return method == OBJECT ? known[i].object : method == LAYERED ? known[i].layered : 0.0;
    }
    return 0.0;
}
