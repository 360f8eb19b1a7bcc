/* SPDX-License-Identifier: MIT */
/* errors.c - results in words. */
#include "base/base.h"
#include "faults.h"

#if SMEAR_WITH_DEBUG

/* One after the other, each with its end: the kinds from SMEAR_OK down to SMEAR_ERR_ROOM, the faults, too little memory. */
#define TEXT(name, text) text "\0"
static const char texts[] = "no error\0"
                            "a required argument is missing\0"
                            "memory: too little, or not 8-byte aligned\0"
                            "a call out of turn\0"
                            "more draws than desc.max_draws\0"
                            "desc.max_triangles: too few for a time mask\0" SMEAR_FAULTS(TEXT)
                            "memory: too little, or not 8-byte aligned: minus this number of bytes is enough\0"
                            "unknown error";
#undef TEXT

/* How many are kinds; how many there are before the last two. */
enum { KINDS = 1 - SMEAR_ERR_ROOM, TEXTS = KINDS + (int)SMEAR_FAULT_COUNT };

const char *smear_error_text(int result)
{
    int number = result <= SMEAR_ERR_NEEDS ? TEXTS : TEXTS + 1;
    if (result <= 0 && result >= SMEAR_ERR_ROOM)
        number = -result;
    else if (result < SMEAR_ERR_FIELD && result >= SMEAR_ERR_FIELD - (int)SMEAR_FAULT_COUNT)
        number = (int)KINDS + SMEAR_ERR_FIELD - 1 - result;
    const char *text = texts;
    while (number-- > 0)
        while (*text++ != '\0')
            ;
    return text;
}

#else

const char *smear_error_text(int result)
{
    (void)result;
    return "see smear_result";
}

#endif
