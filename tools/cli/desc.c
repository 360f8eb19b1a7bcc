/* SPDX-License-Identifier: MIT */
/* desc.c - see desc.h. Fields have the names that they have in smear_desc. */
#include "tools/cli/desc.h"

#include "tools/options/arguments.h"
#include "tools/options/options.h"
#include "tools/scenes/methods.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* A field, and the names of its values where they are no numbers. */
struct field {
    const char *name;
    uint8_t offset, size;
    const char *const *values;
};

#define FIELD(member, values) { #member, (uint8_t)offsetof(smear_desc, member), sizeof ((smear_desc *)0)->member, values }
static const struct field fields[] = {
    FIELD(width, NULL), FIELD(height, NULL), FIELD(max_triangles, NULL), FIELD(max_draws, NULL), FIELD(tile, NULL),
    FIELD(reach, NULL), FIELD(strip, NULL), FIELD(band_rows, NULL), FIELD(bands, NULL), FIELD(format, option_formats),
    FIELD(workers, NULL), FIELD(vertex_cache, NULL), FIELD(reuse.cache_static, NULL), FIELD(reuse.buffer_age, NULL),
    FIELD(reuse.one_pose, NULL), FIELD(filter.passes, NULL), FIELD(filter.scatter, NULL), FIELD(display.dither, option_dithers),
    FIELD(display.doubled, option_doubles)
};

/* Adds methods joined by plus signs; accumulate stands for that of the whole frame. */
static bool read_methods(smear_desc *desc, char *value)
{
    for (char *name = strtok(value, "+"); name != NULL; name = strtok(NULL, "+")) {
        const struct method *method = method_named(name);
        if (method == NULL && strcmp(name, "accumulate_bands") != 0)
            return false;
        desc->methods = (uint16_t)(desc->methods | (method != NULL ? SMEAR_SET(method->method) : SMEAR_SET_ACCUMULATE_BANDS));
    }
    return true;
}

static bool read_field(void *to, const char *name, const char *value)
{
    char copy[32];
    long number;
    if (value == NULL)
        return false;
    if (strcmp(name, "methods") == 0) {
        snprintf(copy, sizeof copy, "%s", value);
        return read_methods(to, copy);
    }
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        const struct field *f = &fields[i];
        if (strcmp(f->name, name) != 0)
            continue;
        if (f->values != NULL && (number = read_name(value, f->values)) < 0)
            return false;
        if (f->values == NULL && !read_integer(value, 0, f->size == 1 ? UINT8_MAX : f->size == 2 ? INT16_MAX : INT32_MAX, &number))
            return false;
        const uint8_t narrow = (uint8_t)number;
        const uint16_t middle = (uint16_t)number;
        const uint32_t wide = (uint32_t)number;
        memcpy((char *)to + f->offset, f->size == 1 ? (const void *)&narrow : f->size == 2 ? (const void *)&middle : &wide, f->size);
        return true;
    }
    return false;
}

const char *desc_read(smear_desc *desc, const char *text)
{
    return read_list(text, read_field, desc) ? NULL : "needs fields of smear_desc, as width=240,height=240,methods=auto+none";
}

static int flush(void *user, const smear_band *band)
{
    (void)user, (void)band;
    return 0;
}

const char *desc_print_memory(const smear_desc *desc)
{
    smear_context *ctx;
    smear_desc asked = *desc;
    asked.flush = flush;
    const int result = smear_init(&ctx, &asked, NULL, 0);
    const size_t bytes = smear_memory_needed(result);
    if (bytes == 0)
        return smear_error_text(result);
    printf("static uint64_t memory[%zu];    /* %zu bytes with pointers of %zu; where they have 4, boards need a little less */\n",
           (bytes + 7) / 8, bytes, sizeof(void *));
    return NULL;
}
