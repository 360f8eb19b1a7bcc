/* SPDX-License-Identifier: MIT */
/* guess.h - what somebody may have meant who wrote a name that there is not. */
#ifndef SMEAR_TOOLS_GUESS_H
#define SMEAR_TOOLS_GUESS_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { GUESS_LETTERS = 40 };    /* of names that are compared; longer ones are nobody's slip */

/* The nearest name so far: `distance` letters are left out, added, changed or swapped with their neighbour. */
struct guess {
    const char *word, *best;
    int distance;
};

static inline int guess_smallest(int a, int b)
{
    return a < b ? a : b;
}

/* The least number of slips that make one word of the other. */
static inline int guess_distance(const char *a, const char *b)
{
    int n = (int)strlen(a), m = (int)strlen(b), row[3][GUESS_LETTERS + 1];
    for (int k = 0; k <= m; k++)
        row[0][k] = row[1][k] = k;
    for (int i = 1; i <= n; i++) {
        int *now = row[i % 3], *before = row[(i + 2) % 3], *first = row[(i + 1) % 3];
        now[0] = i;
        for (int k = 1; k <= m; k++) {
            now[k] = guess_smallest(guess_smallest(before[k] + 1, now[k - 1] + 1), before[k - 1] + (a[i - 1] != b[k - 1]));
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
                now[k] = guess_smallest(now[k], first[k - 2] + 1);
        }
    }
    return row[n % 3][m];
}

/* Takes a name into account: a slip in three letters is the most that is believed, and the first of equals stays. */
static inline void guess_try(struct guess *g, const char *name)
{
    size_t length = strlen(g->word), other = strlen(name);
    if (length > GUESS_LETTERS || other > GUESS_LETTERS || length == 0 || other == 0)
        return;
    int distance = guess_distance(g->word, name), most = (int)(length < other ? length : other) / 3;
    if (distance <= most && (g->best == NULL || distance < g->distance)) {
        g->best = name;
        g->distance = distance;
    }
}

#endif
