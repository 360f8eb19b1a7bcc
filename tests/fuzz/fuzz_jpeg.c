/* SPDX-License-Identifier: MIT */
/* fuzz_jpeg.c - libFuzzer target for JPEG pictures: what is read has pixels, what is not is refused with a reason. Its corpus is
 * tests/data/jpeg. */
#include "tests/fuzz/require.h"

#include "tools/image/image.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_file(const uint8_t *bytes, size_t size)
{
    struct image image;
    struct failure f = { "" };
    const bool ok = jpeg_decode(bytes, size, &image, &f);
    require(ok == (f.text[0] == '\0') && ok == (image.rgba != NULL));
    require(!ok || (image.width >= 1 && image.width <= IMAGE_MAX_EDGE && image.height >= 1 && image.height <= IMAGE_MAX_EDGE));
    image_free(&image);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *exact = malloc(size + (size == 0));
    require(exact != NULL);
    memcpy(exact, data, size);
    check_file(exact, size);
    free(exact);
    return 0;
}
