/* SPDX-License-Identifier: MIT */
/* fuzz_jpeg.c - libFuzzer target for JPEG pictures. Bytes that begin like a JPEG file are one; any others choose a file of
 * all that a reader has to know (tests/ref/jpeg_case.h), and places where it is changed: so mutations reach the scans behind
 * the headers.
 *
 * What is read has pixels, and is read the same from memory that ends with the file; what is not is refused with a reason. */
#include "tests/fuzz/require.h"
#include "tests/random.h"
#include "tests/ref/jpeg_case.h"

#include "tools/image/image.h"

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

/* Four bytes for the file, then four for each change: where, and what to. */
static void check_changed(const uint8_t *data, size_t size)
{
    struct jpeg_case c;
    size_t end;
    if (size < 4)
        return;
    memcpy(&random_state, data, 4);
    jpeg_case_make(&c, 40);
    struct buffer file = jpeg_case_write(&c, &end);
    jpeg_case_free(&c);
    for (data += 4, size -= 4; size >= 4; data += 4, size -= 4) {
        const size_t at = ((size_t)data[0] << 8 | data[1]) % file.size;
        file.data[at] = data[3] % 2 == 0 ? data[2] : (uint8_t)(file.data[at] ^ data[2]);
    }
    uint8_t *exact = malloc(file.size);
    require(exact != NULL);
    memcpy(exact, file.data, file.size);
    check_file(exact, file.size);
    free(exact);
    buffer_free(&file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size >= 2 && data[0] == 0xff && data[1] == 0xd8)
        check_file(data, size);
    else
        check_changed(data, size);
    return 0;
}
