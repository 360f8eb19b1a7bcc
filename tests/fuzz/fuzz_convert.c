/* SPDX-License-Identifier: MIT */
/* fuzz_convert.c - libFuzzer target: whatever model the loader takes converts, or is refused with a reason; and what
 * comes out of it is a blob that passes its own check.
 *
 * The first two bytes choose options, the rest is a model as fuzz_model.c takes it (without the wrapping). */
#include "tests/fuzz/require.h"
#include "tools/convert/convert.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_result(const struct conversion *c)
{
    struct failure f = { { 0 } };
    uint8_t *bytes;
    size_t size;
    require(convert_to_header(c, "m", "m.glb", &bytes, &size, &f));
    require(size > 0 && bytes[size - 1] == '\n');
    free(bytes);
    require(convert_to_blob(c, &bytes, &size, &f));
    require(smear_mesh_check(bytes, size) == SMEAR_OK);
    free(bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct model model;
    struct conversion c;
    struct failure f = { { 0 } };
    uint8_t *keep;
    int clip[8];
    if (size < 3 || !model_parse(data + 2, size - 2, NULL, &model, &f))
        return 0;
    struct convert_options o = {
        .clip = clip, .scale = data[0] & 1 ? 1 : 0.01, .fit = data[0] & 2 ? 10 : 0, .z_up = data[0] & 4,
        .texture = (enum convert_texture)((data[0] >> 3) % 5), .texture_edge = 1 << (data[1] & 7), .colors = 16,
        .flat = data[0] & 64, .influences = 1 + (data[1] >> 3 & 3), .clip_error_px = data[1] & 32 ? 1 : 0.1,
        .rows = 240, .fov_degrees = 45, .mipmaps = (data[0] & 2) != 0
    };
    for (; o.clip_count < model.clip_count && o.clip_count < 8; o.clip_count++)
        clip[o.clip_count] = o.clip_count;
    keep = calloc((size_t)model.node_count + 1, 1);
    require(keep != NULL);
    memset(keep, data[1] >> 7, (size_t)model.node_count);
    o.keep = keep;
    if (convert_model(&model, &o, &c, &f)) {
        check_result(&c);
        conversion_free(&c);
    } else {
        require(f.text[0] != '\0');
    }
    free(keep);
    model_free(&model);
    return 0;
}
