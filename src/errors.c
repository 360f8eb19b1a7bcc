/* SPDX-License-Identifier: MIT */
/* errors.c - results in words. */
#include "base/base.h"
#include "faults.h"

#if SMEAR_WITH_ERROR_TEXT

static const char *text_of_kind(int result)
{
    switch (result) {
    case SMEAR_OK: return "no error";
    case SMEAR_ERR_MEMORY: return "memory: fewer bytes than smear_memory_size says, or not 8-byte aligned";
    case SMEAR_ERR_ORDER: return "a call out of turn";
    case SMEAR_ERR_FULL: return "more draws in a frame than desc.max_draws";
    default: return result < 0 ? "a required argument is missing" : "no error of smear's";
    }
}

const char *smear_error_text(int result)
{
#define TEXT(name, text) text,
    static const char *const texts[SMEAR_FAULT_COUNT] = { SMEAR_FAULTS(TEXT) };
#undef TEXT
    const int number = result < SMEAR_ERR_FIELD && result > SMEAR_ERR_FIELD - 1 - SMEAR_FAULT_COUNT
                     ? SMEAR_ERR_FIELD - 1 - result : -1;
    return number >= 0 ? texts[number] : text_of_kind(result);
}

#else

const char *smear_error_text(int result)
{
    (void)result;
    return "see smear_result";
}

#endif
