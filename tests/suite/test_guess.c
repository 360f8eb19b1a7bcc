/* SPDX-License-Identifier: MIT */
/* test_guess.c - what a misspelt name may have meant (tools/guess.h), against the definition, and by slips made on purpose. */
#include "tests/host.h"

#include "tools/guess.h"
#include "tools/scenes/scene.h"

/* By trying all: the least of leaving out, adding, changing, and swapping neighbours that are not touched again. */
static int slowly(const char *a, const char *b)
{
    if (*a == '\0' || *b == '\0')
        return (int)(strlen(a) + strlen(b));
    int best = slowly(a + 1, b + 1) + (*a != *b);
    best = guess_smallest(best, slowly(a + 1, b) + 1);
    best = guess_smallest(best, slowly(a, b + 1) + 1);
    if (a[1] != '\0' && b[1] != '\0' && a[0] == b[1] && a[1] == b[0])
        best = guess_smallest(best, slowly(a + 2, b + 2) + 1);
    return best;
}

static void test_distances_are_the_least_number_of_slips(void)
{
    random_state = 1;
    for (int n = 0; n < 3000; n++) {
        char word[2][8];
        for (int i = 0; i < 2; i++) {
            int length = between(0, 6);
            for (int k = 0; k < length; k++)
                word[i][k] = (char)('a' + between(0, 2));
            word[i][length] = '\0';
        }
        CHECK_EQ(guess_distance(word[0], word[1]), slowly(word[0], word[1]));
    }
}

/* One slip in a name of three letters or more. */
static void slip(const char *name, char out[GUESS_LETTERS + 2])
{
    int length = (int)strlen(name), at = between(0, length - 1);
    snprintf(out, GUESS_LETTERS + 2, "%s", name);
    switch (between(0, 3)) {
    case 0: memmove(out + at, out + at + 1, (size_t)(length - at)); break;
    case 1: memmove(out + at + 1, out + at, (size_t)(length - at + 1)); break;
    case 2: out[at] = (char)('a' + between(0, 25)); break;
    default:
        at = at > 0 ? at : 1;
        out[at] = name[at - 1];
        out[at - 1] = name[at];
    }
}

static void test_a_slip_in_a_scene_is_understood(void)
{
    random_state = 2;
    for (int n = 0; n < 3000; n++) {
        const char *name = scene_catalog[between(0, scene_catalog_count - 1)].name;
        char word[GUESS_LETTERS + 2];
        struct guess guess = { .word = word };
        if (strlen(name) < 4 || strlen(name) >= GUESS_LETTERS)
            continue;
        slip(name, word);
        for (int i = 0; i < scene_catalog_count; i++)
            guess_try(&guess, scene_catalog[i].name);
        CHECK(guess.best != NULL && guess.distance <= 1 && guess_distance(word, guess.best) <= guess_distance(word, name));
    }
    struct guess nothing = { .word = "frobnicate" };
    for (int i = 0; i < scene_catalog_count; i++)
        guess_try(&nothing, scene_catalog[i].name);
    CHECK(nothing.best == NULL);
}

#include "build/suites/guess.h"
