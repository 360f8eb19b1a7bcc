/* SPDX-License-Identifier: MIT */
/* obj_material.c - MTL: diffuse colour and map, dissolve. The rest of a material is not shown. */
#include "tools/model/obj.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int mtl_find(struct mtl_library *library, struct model *model, const char *name)
{
    int number = text_intern(&library->names, name);
    if (number < model->material_count)
        return number;
    if (number >= library->capacity) {
        int capacity = library->capacity == 0 ? 8 : library->capacity * 2;
        struct mtl_material *more = realloc(library->material, (size_t)capacity * sizeof *more);
        if (more == NULL)
            return -1;
        library->material = more;
        struct model_material *materials =
            realloc(model->material, (size_t)capacity * sizeof *materials);
        if (materials == NULL)
            return -1;
        model->material = materials;
        library->capacity = capacity;
    }
    size_t size = strlen(name) + 1;
    char *copy = malloc(size);
    if (copy == NULL)
        return -1;
    memcpy(copy, name, size);
    library->material[number] = (struct mtl_material){ .scale = { 1, 1 } };
    model->material[number] = (struct model_material){
        .name = copy, .base = { 1, 1, 1, 1 }, .image = -1, .alpha_cutoff = 0.5f
    };
    library->count = ++model->material_count;
    return number;
}

void mtl_library_free(struct mtl_library *library)
{
    for (int i = 0; i < library->count; i++)
        free(library->material[i].map);
    free(library->material);
    text_table_free(&library->names);
    *library = (struct mtl_library){ 0 };
}

void mtl_settle(struct mtl_library *library, struct model *model)
{
    const char *first = "";
    int count = 0;
    for (int i = 0; i < library->count; i++) {
        struct model_material *m = &model->material[i];
        if (!library->material[i].is_drawn)
            continue;
        if (library->material[i].map != NULL && m->base[0] == 0 && m->base[1] == 0 && m->base[2] == 0)
            m->base[0] = m->base[1] = m->base[2] = 1;
        if (m->base[3] > 0)
            continue;
        m->base[3] = 1;
        m->alpha = MODEL_ALPHA_OPAQUE;
        first = count++ == 0 ? m->name : first;
    }
    if (count == 1)
        model_warn(model, "material %.60s, which would be invisible (d 0 or Tr 1), is drawn opaque", first);
    else if (count > 1)
        model_warn(model, "%d materials, %.60s the first, which would be invisible (d 0 or Tr 1), are drawn opaque", count, first);
}

static bool bad_number(const struct obj_text *text, const char *word, struct failure *f)
{
    return fail(f, "bad number after %.20s (line %d)", word, text->line);
}

static float clamp_unit(float x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* Kd r [g b]; spectral curves and CIE XYZ are left alone. */
static bool read_diffuse(const struct obj_text *text, char *rest, struct model_material *out,
                         struct failure *f)
{
    if (strncmp(rest, "spectral", 8) == 0 || strncmp(rest, "xyz", 3) == 0)
        return true;
    char *word = obj_word(&rest);
    float rgb[3];
    if (!obj_number(word, &rgb[0]))
        return bad_number(text, "Kd", f);
    rgb[1] = rgb[2] = rgb[0];
    for (int i = 1; i < 3 && (word = obj_word(&rest)) != NULL; i++) {
        if (!obj_number(word, &rgb[i]))
            return bad_number(text, "Kd", f);
    }
    for (int i = 0; i < 3; i++)
        out->base[i] = clamp_unit(rgb[i]);
    return true;
}

/* d 1 and Tr 0 are opaque. Where a material has both, d counts: some programs write Tr 1 for opaque, too. */
static bool read_dissolve(const struct obj_text *text, const char *keyword, char *rest,
                          struct mtl_material *m, struct model_material *out, struct failure *f)
{
    char *word = obj_word(&rest);
    float value;
    if (word != NULL && strcmp(word, "-halo") == 0)
        word = obj_word(&rest);
    if (!obj_number(word, &value))
        return bad_number(text, keyword, f);
    if (keyword[0] == 'T' && m->has_dissolve)
        return true;
    m->has_dissolve = m->has_dissolve || keyword[0] == 'd';
    float alpha = clamp_unit(keyword[0] == 'd' ? value : 1 - value);
    out->base[3] = alpha;
    out->alpha = alpha < 1 ? MODEL_ALPHA_BLEND : MODEL_ALPHA_OPAQUE;
    return true;
}

/* The numbers of -s or -o: u, and v if it is there; a third is for volumes. */
static void read_pair(char **rest, float pair[2])
{
    float unused;
    for (int i = 0; i < 3; i++) {
        char *before = *rest, ahead[64];
        size_t length = strcspn(before, " \t");
        if (length == 0 || length >= sizeof ahead)
            return;
        memcpy(ahead, before, length);
        ahead[length] = '\0';
        if (!obj_number(ahead, i < 2 ? &pair[i] : &unused))
            return;
        obj_word(rest);
    }
}

/* map_Kd [options] file name, which may have blanks in it. */
static bool read_map(char *rest, struct mtl_material *m, struct model_material *out,
                     struct failure *f)
{
    while (rest[0] == '-') {
        char *option = obj_word(&rest);
        if (strcmp(option, "-s") == 0) {
            read_pair(&rest, m->scale);
        } else if (strcmp(option, "-o") == 0) {
            read_pair(&rest, m->offset);
        } else if (strcmp(option, "-t") == 0) {
            float turbulence[2];
            read_pair(&rest, turbulence);
        } else if (strcmp(option, "-mm") == 0) {
            obj_word(&rest);
            obj_word(&rest);
        } else if (strcmp(option, "-clamp") == 0) {
            char *word = obj_word(&rest);
            if (word != NULL && strcmp(word, "on") == 0)
                out->wrap_u = out->wrap_v = MODEL_WRAP_CLAMP;
        } else {
            obj_word(&rest);
        }
    }
    size_t length = strlen(rest);
    char *name = malloc(length + 1);
    if (name == NULL)
        return fail(f, "out of memory (a file name)");
    for (size_t i = 0; i <= length; i++)
        name[i] = rest[i] == '\\' ? '/' : rest[i];
    free(m->map);
    m->map = name;
    return true;
}

bool mtl_parse(const uint8_t *bytes, size_t size, struct mtl_library *library, struct model *model,
               struct failure *f)
{
    struct obj_text text;
    char *word, *rest;
    int now = -1;
    bool ok = obj_text_open(bytes, size, &text, f);
    while (ok && obj_text_next(&text, &word, &rest)) {
        if (strcmp(word, "newmtl") == 0) {
            now = mtl_find(library, model, rest);
            ok = now >= 0 || fail(f, "out of memory (a material)");
        }
        if (now < 0)
            continue;
        struct model_material *out = &model->material[now];
        if (strcmp(word, "Kd") == 0)
            ok = read_diffuse(&text, rest, out, f);
        else if (strcmp(word, "d") == 0 || strcmp(word, "Tr") == 0)
            ok = read_dissolve(&text, word, rest, &library->material[now], out, f);
        else if (strcmp(word, "map_Kd") == 0)
            ok = read_map(rest, &library->material[now], out, f);
        else if (strcmp(word, "illum") == 0)
            out->unlit = strcmp(rest, "0") == 0;    /* constant colour */
    }
    obj_text_close(&text);
    return ok;
}

/* ------------------------------------------------------------------ text */

bool obj_text_open(const uint8_t *bytes, size_t size, struct obj_text *out, struct failure *f)
{
    static const uint8_t byte_order_mark[3] = { 0xef, 0xbb, 0xbf };
    *out = (struct obj_text){ 0 };
    if (size >= 3 && memcmp(bytes, byte_order_mark, 3) == 0)
        bytes += 3, size -= 3;
    if (memchr(bytes, '\0', size) != NULL)
        return fail(f, "neither glTF nor text");
    out->copy = malloc(size + 1);
    if (out->copy == NULL)
        return fail(f, "out of memory (%zu bytes of text)", size);
    memcpy(out->copy, bytes, size);
    out->copy[size] = '\0';
    out->size = size;
    return true;
}

void obj_text_close(struct obj_text *text)
{
    free(text->copy);
    *text = (struct obj_text){ 0 };
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* The line at `at`, joined with those that a backslash continues; NUL takes the place of its end.
 */
static char *next_line(struct obj_text *t)
{
    char *line = t->copy + t->at;
    t->line = t->lines_read + 1;
    for (;;) {
        char *end = memchr(t->copy + t->at, '\n', t->size - t->at);
        t->lines_read++;
        if (end == NULL) {
            t->at = t->size;
            return line;
        }
        t->at = (size_t)(end - t->copy) + 1;
        char *last = end > line && end[-1] == '\r' ? end - 1 : end;
        if (last == line || last[-1] != '\\') {
            *end = '\0';
            return line;
        }
        for (char *p = last - 1; p <= end; p++)
            *p = ' ';
    }
}

/* A '#' inside a word belongs to the word: names may have one. */
static void cut_comment(char *line)
{
    for (char *p = strchr(line, '#'); p != NULL; p = strchr(p + 1, '#')) {
        if (p == line || is_blank(p[-1])) {
            *p = '\0';
            return;
        }
    }
}

bool obj_text_next(struct obj_text *t, char **word, char **rest)
{
    while (t->at < t->size) {
        char *line = next_line(t);
        cut_comment(line);
        size_t length = strlen(line);
        while (length > 0 && is_blank(line[length - 1]))
            line[--length] = '\0';
        *rest = line;
        *word = obj_word(rest);
        if (*word != NULL)
            return true;
    }
    return false;
}

char *obj_word(char **rest)
{
    char *start = *rest;
    while (is_blank(*start))
        start++;
    char *end = start;
    while (*end != '\0' && !is_blank(*end))
        end++;
    *rest = end;
    if (*end != '\0') {
        *end++ = '\0';
        while (is_blank(*end))
            end++;
        *rest = end;
    }
    return *start == '\0' ? NULL : start;
}

bool obj_number(const char *word, float *out)
{
    if (word == NULL || word[strspn(word, "0123456789+-.eE")] != '\0')
        return false;
    char *end;
    double value = strtod(word, &end);
    if (end == word || *end != '\0' || !(fabs(value) <= (double)FLT_MAX))
        return false;
    *out = (float)value;
    return true;
}

/* Whether the word is this one, in letters of either size; `end` may follow it. */
static bool is_word(const char *word, const char *small, char end)
{
    for (; *small != '\0'; word++, small++) {
        if ((*word | 32) != *small)
            return false;
    }
    return *word == '\0' || *word == end;
}

bool obj_is_not_finite(const char *word)
{
    word += *word == '-' || *word == '+';
    return is_word(word, "nan", '(') || is_word(word, "inf", '\0') || is_word(word, "infinity", '\0') ||
           strncmp(word, "1.#", 3) == 0;
}
