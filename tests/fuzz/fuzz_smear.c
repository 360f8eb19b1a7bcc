/* SPDX-License-Identifier: MIT */
/* fuzz_smear.c - libFuzzer target: bytes decide what the generator of frames (cases.h) leaves to chance. The first says whether the
 * case is to be wild, or valid and the same by other workers, in other parts. */
#include "tests/fuzz/cases.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > 0)
        run_bytes(data + 1, size - 1, data[0] & 1 ? MODE_WILD : MODE_VALID);
    return 0;
}
