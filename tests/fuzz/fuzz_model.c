/* SPDX-License-Identifier: MIT */
/* fuzz_model.c - libFuzzer target: any bytes are a model or a clear failure (check_model.h).
 *
 * Input that begins with byte 1 is JSON, a NUL and a BIN chunk, which are wrapped into a GLB
 * here, so that a mutation need not keep GLB's lengths right. Anything else goes to model_parse
 * as it is. Seeds are in tests/fuzz/corpus/model. */
#include "tests/fuzz/check_model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    unsigned choice = 0;
    uint8_t *glb = NULL;
    for (size_t i = 0; i < size; i++)
        choice = choice * 31 + data[i];
    if (size > 0 && data[0] == 1) {
        const uint8_t *nul = memchr(data, '\0', size);
        const size_t text_size = nul == NULL ? size - 1 : (size_t)(nul - data) - 1, bin = nul == NULL ? 0 : size - text_size - 2;
        data = glb = glb_of(data + 1, text_size, nul == NULL ? NULL : nul + 1, bin, &size);
    }
    check_file(data, size, choice);
    free(glb);
    return 0;
}
