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

/* What is read, and what is wrong with it. */
struct reading {
    smear_desc *desc;
    char wrong[280];
};

/* Adds methods joined by plus signs; accumulate_bands is the one whose memory differs from the method's of its name,
 * and sketch is SMEAR_SET_SKETCH. */
static bool read_methods(struct reading *r, char *value)
{
    for (char *name = strtok(value, "+"); name != NULL; name = strtok(NULL, "+")) {
        const struct method *method = method_named(name);
        const bool is_sketch = strcmp(name, "sketch") == 0;
        if (method == NULL && !is_sketch && strcmp(name, "accumulate_bands") != 0) {
            for (int i = 0; i < method_count; i++)
                read_near(name, method_list[i].name);
            snprintf(r->wrong, sizeof r->wrong, "methods: there is no %.40s, but %s, and accumulate_bands, and sketch, joined by +", name,
                     method_names());
            return false;
        }
        r->desc->methods = (uint16_t)(r->desc->methods | (method != NULL ? SMEAR_SET(method->method)
                                                          : is_sketch ? SMEAR_SET_SKETCH : SMEAR_SET_ACCUMULATE_BANDS));
    }
    return true;
}

static const struct field *find_field(const char *name)
{
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        if (strcmp(fields[i].name, name) == 0)
            return &fields[i];
    return NULL;
}

static bool say_no_field(struct reading *r, const char *name)
{
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        read_near(name, fields[i].name);
    read_near(name, "methods");
    snprintf(r->wrong, sizeof r->wrong, "%.40s is no field of smear_desc", name);
    return false;
}

static bool say_no_value(struct reading *r, const struct field *f, long most)
{
    int used = snprintf(r->wrong, sizeof r->wrong, "%s needs ", f->name);
    if (f->values == NULL)
        snprintf(r->wrong + used, sizeof r->wrong - (size_t)used, "a number from 0 to %ld", most);
    for (const char *const *name = f->values; name != NULL && *name != NULL; name++)
        used += snprintf(r->wrong + used, sizeof r->wrong - (size_t)used, "%s%s", name[0],
                         name[1] == NULL ? "" : name[2] == NULL ? " or " : ", ");
    return false;
}

static bool read_field(void *to, const char *name, const char *value)
{
    struct reading *r = to;
    char copy[LIST_PART];
    const bool is_methods = strcmp(name, "methods") == 0;
    const struct field *f = find_field(name);
    if (f == NULL && !is_methods)
        return say_no_field(r, name);
    if (value == NULL || *value == '\0') {
        snprintf(r->wrong, sizeof r->wrong, "%s needs %s value", name, value == NULL ? "an equals sign and a" : "a");
        return false;
    }
    if (is_methods) {
        snprintf(copy, sizeof copy, "%s", value);
        return read_methods(r, copy);
    }
    const long most = f->size == 1 ? UINT8_MAX : f->size == 2 ? INT16_MAX : INT32_MAX;
    long number = -1;
    if (f->values != NULL ? (number = read_name(value, f->values)) < 0 : !read_integer(value, 0, most, &number))
        return say_no_value(r, f, most);
    const uint8_t narrow = (uint8_t)number;
    const uint16_t middle = (uint16_t)number;
    const uint32_t wide = (uint32_t)number;
    memcpy((char *)r->desc + f->offset, f->size == 1 ? (const void *)&narrow : f->size == 2 ? (const void *)&middle : &wide, f->size);
    return true;
}

const char *desc_read(smear_desc *desc, const char *text)
{
    static struct reading r;
    r = (struct reading){ .desc = desc };
    if (read_list(text, read_field, &r))
        return NULL;
    return r.wrong[0] != '\0' ? r.wrong : "needs fields of smear_desc, as width=240,height=240,methods=auto+none";
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
