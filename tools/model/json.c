/* SPDX-License-Identifier: MIT */
/* json.c - see json.h. One pass over a private copy of the text; strings are unescaped where
 * they stand, which works because no escape is shorter than what it stands for. */
#include "tools/model/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct parser {
    const uint8_t *source;  /* what was given */
    char *text;             /* the copy, NUL-terminated; differs where strings were unescaped */
    size_t size, at;
    struct json_value *value;
    int count, capacity;
    struct failure *f;
};

static const char *const type_name[] = {
    "null", "false", "true", "a number", "a string", "an array", "an object"
};

/* Lines and columns count from 1, columns in bytes. */
static bool fail_at(struct parser *p, size_t at, const char *what)
{
    size_t line = 1, column = 1;
    for (size_t i = 0; i < at && i < p->size; i++) {
        column++;
        if (p->source[i] == '\n') {
            line++;
            column = 1;
        }
    }
    return fail(p->f, "%s (line %zu, column %zu)", what, line, column);
}

static void skip_space(struct parser *p)
{
    while (p->at < p->size && (p->text[p->at] == ' ' || p->text[p->at] == '\t' ||
                               p->text[p->at] == '\n' || p->text[p->at] == '\r'))
        p->at++;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    if (c >= 'A' && c <= 'F')
        return c - 'A' + 10;
    return -1;
}

/* Four hex digits at `at`; false when they are not there. */
static bool hex4(const struct parser *p, size_t at, uint32_t *out)
{
    uint32_t code = 0;
    for (size_t i = 0; i < 4; i++) {
        int digit = at + i < p->size ? hex_digit(p->text[at + i]) : -1;
        if (digit < 0)
            return false;
        code = code << 4 | (uint32_t)digit;
    }
    *out = code;
    return true;
}

static size_t put_utf8(char *out, uint32_t code)
{
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    if (code < 0x800) {
        out[0] = (char)(0xc0 | code >> 6);
        out[1] = (char)(0x80 | (code & 63));
        return 2;
    }
    if (code < 0x10000) {
        out[0] = (char)(0xe0 | code >> 12);
        out[1] = (char)(0x80 | (code >> 6 & 63));
        out[2] = (char)(0x80 | (code & 63));
        return 3;
    }
    out[0] = (char)(0xf0 | code >> 18);
    out[1] = (char)(0x80 | (code >> 12 & 63));
    out[2] = (char)(0x80 | (code >> 6 & 63));
    out[3] = (char)(0x80 | (code & 63));
    return 4;
}

/* Length of the well-formed UTF-8 sequence at `at` whose first byte is above 0x7f, or 0. */
static size_t utf8_length(const struct parser *p, size_t at)
{
    const uint8_t *s = (const uint8_t *)p->text + at;
    size_t length = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
    if (s[0] < 0xc2 || s[0] > 0xf4 || length > p->size - at)
        return 0;
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80)
            return 0;
    }
    /* overlong forms, surrogates, above U+10FFFF */
    if ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] > 0x9f) ||
        (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] > 0x8f))
        return 0;
    return length;
}

/* The escape at `at`, which stands on the backslash; appends to *write and moves `at` past it. */
static bool parse_escape(struct parser *p, size_t *write)
{
    static const char from[] = "\"\\/bfnrt", to[] = "\"\\/\b\f\n\r\t";
    size_t start = p->at;
    char kind = p->at + 1 < p->size ? p->text[p->at + 1] : '\0';
    const char *known = kind == '\0' ? NULL : strchr(from, kind);
    if (known != NULL) {
        p->text[(*write)++] = to[known - from];
        p->at += 2;
        return true;
    }
    uint32_t code, low;
    if (kind != 'u' || !hex4(p, p->at + 2, &code))
        return fail_at(p, start, "bad escape in a string");
    p->at += 6;
    if (code >= 0xd800 && code < 0xdc00) {
        if (p->at + 1 >= p->size || p->text[p->at] != '\\' || p->text[p->at + 1] != 'u' ||
            !hex4(p, p->at + 2, &low) || low < 0xdc00 || low > 0xdfff)
            return fail_at(p, start, "half a surrogate pair in a string");
        p->at += 6;
        code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
    } else if (code >= 0xdc00 && code < 0xe000) {
        return fail_at(p, start, "half a surrogate pair in a string");
    }
    if (code == 0)
        return fail_at(p, start, "NUL character in a string");
    *write += put_utf8(p->text + *write, code);
    return true;
}

/* The string whose opening quote is at `at`. */
static bool parse_string(struct parser *p, const char **out)
{
    size_t start = p->at, write = ++p->at;
    *out = p->text + write;
    while (p->at < p->size) {
        uint8_t c = (uint8_t)p->text[p->at];
        if (c == '"') {
            p->at++;
            p->text[write] = '\0';
            return true;
        }
        if (c < 0x20)
            return fail_at(p, p->at, "control character in a string");
        if (c == '\\') {
            if (!parse_escape(p, &write))
                return false;
            continue;
        }
        size_t length = c < 0x80 ? 1 : utf8_length(p, p->at);
        if (length == 0)
            return fail_at(p, p->at, "text is not UTF-8");
        memmove(p->text + write, p->text + p->at, length);
        write += length;
        p->at += length;
    }
    return fail_at(p, start, "string has no end");
}

static size_t digits_from(const struct parser *p, size_t at)
{
    size_t n = 0;
    while (at + n < p->size && p->text[at + n] >= '0' && p->text[at + n] <= '9')
        n++;
    return n;
}

/* Checks JSON's grammar here; the conversion is strtod's (programs of this project keep the C
 * locale, so the decimal point is a point). */
static bool parse_number(struct parser *p, double *out)
{
    size_t start = p->at, at = p->at;
    if (p->text[at] == '-')
        at++;
    size_t whole = digits_from(p, at);
    if (whole == 0 || (whole > 1 && p->text[at] == '0'))
        return fail_at(p, start, "bad number");
    at += whole;
    if (at < p->size && p->text[at] == '.') {
        size_t digits = digits_from(p, at + 1);
        if (digits == 0)
            return fail_at(p, start, "bad number");
        at += 1 + digits;
    }
    if (at < p->size && (p->text[at] == 'e' || p->text[at] == 'E')) {
        at++;
        if (at < p->size && (p->text[at] == '+' || p->text[at] == '-'))
            at++;
        size_t digits = digits_from(p, at);
        if (digits == 0)
            return fail_at(p, start, "bad number");
        at += digits;
    }
    /* Ends the number for strtod, which would read on in 0x10; the text is NUL-terminated at
     * size. */
    char after = p->text[at];
    p->text[at] = '\0';
    *out = strtod(p->text + start, NULL);
    p->text[at] = after;
    p->at = at;
    if (!isfinite(*out))
        return fail_at(p, start, "number is out of range");
    return true;
}

static bool parse_word(struct parser *p, enum json_type *type)
{
    static const struct { const char *word; enum json_type type; } words[] = {
        { "null", JSON_NULL }, { "false", JSON_FALSE }, { "true", JSON_TRUE }
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        size_t length = strlen(words[i].word);
        if (p->size - p->at >= length && memcmp(p->text + p->at, words[i].word, length) == 0) {
            p->at += length;
            *type = words[i].type;
            return true;
        }
    }
    return fail_at(p, p->at, p->at < p->size ? "expected a value" : "text ends too early");
}

static bool add_value(struct parser *p, int parent, const char *key, enum json_type type)
{
    if (p->count == p->capacity) {
        if (p->count == JSON_MAX_VALUES)
            return fail_at(p, p->at, "too many values");
        int capacity = p->capacity == 0 ? 256 : p->capacity * 2;
        struct json_value *grown = realloc(p->value, (size_t)capacity * sizeof *grown);
        if (grown == NULL)
            return fail(p->f, "out of memory (%d JSON values)", capacity);
        p->value = grown;
        p->capacity = capacity;
    }
    p->value[p->count] = (struct json_value){ .type = type, .parent = parent, .key = key };
    p->count++;
    if (parent >= 0)
        p->value[parent].count++;
    return true;
}

static int compare_keys(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Called when the object at `object` is complete; `at` is the place for the error. */
static bool check_unique_keys(struct parser *p, int object)
{
    int n = p->value[object].count;
    if (n < 2)
        return true;
    const char **keys = malloc((size_t)n * sizeof *keys);
    if (keys == NULL)
        return fail(p->f, "out of memory (%d JSON names)", n);
    int k = 0;
    for (int i = object + 1; i < p->count; i = p->value[i].next)
        keys[k++] = p->value[i].key;
    qsort(keys, (size_t)n, sizeof *keys, compare_keys);
    bool unique = true;
    for (int i = 1; i < n && unique; i++)
        unique = strcmp(keys[i - 1], keys[i]) != 0;
    free(keys);
    return unique || fail_at(p, p->at, "an object that ends here has a name twice");
}

/* One value: a scalar is complete afterwards, a container is open. */
static bool parse_value(struct parser *p, int parent, const char *key, bool *opened)
{
    *opened = false;
    char c = p->at < p->size ? p->text[p->at] : '\0';
    if (c == '{' || c == '[') {
        p->at++;
        *opened = true;
        return add_value(p, parent, key, c == '{' ? JSON_OBJECT : JSON_ARRAY);
    }
    enum json_type type = JSON_NUMBER;
    double number = 0;
    const char *string = NULL;
    if (c == '"') {
        type = JSON_STRING;
        if (!parse_string(p, &string))
            return false;
    } else if (c == '-' || (c >= '0' && c <= '9')) {
        if (!parse_number(p, &number))
            return false;
    } else if (!parse_word(p, &type)) {
        return false;
    }
    if (!add_value(p, parent, key, type))
        return false;
    struct json_value *v = &p->value[p->count - 1];
    if (type == JSON_STRING)
        v->string = string;
    else
        v->number = number;
    v->next = p->count;
    return true;
}

/* A member's name and colon. */
static bool parse_key(struct parser *p, const char **key)
{
    if (p->at >= p->size || p->text[p->at] != '"')
        return fail_at(p, p->at, p->at < p->size ? "expected a name" : "text ends too early");
    if (!parse_string(p, key))
        return false;
    skip_space(p);
    if (p->at >= p->size || p->text[p->at] != ':')
        return fail_at(p, p->at, "expected ':'");
    p->at++;
    skip_space(p);
    return true;
}

/* `open` is the innermost container that still lacks its end, -1 when the document is complete. */
static bool parse_document(struct parser *p)
{
    int open = -1, depth = 0;
    bool first = true;          /* nothing read yet in the open container */
    do {
        skip_space(p);
        if (open >= 0) {
            bool object = p->value[open].type == JSON_OBJECT;
            char c = p->at < p->size ? p->text[p->at] : '\0';
            if (c == (object ? '}' : ']')) {
                if (object && !check_unique_keys(p, open))
                    return false;
                p->at++;
                p->value[open].next = p->count;
                open = p->value[open].parent;
                depth--;
                first = false;
                continue;
            }
            if (!first) {
                if (c != ',')
                    return fail_at(p, p->at, p->at >= p->size ? "text ends too early" :
                                   object ? "expected ',' or '}'" : "expected ',' or ']'");
                p->at++;
                skip_space(p);
            }
        }
        const char *key = NULL;
        if (open >= 0 && p->value[open].type == JSON_OBJECT && !parse_key(p, &key))
            return false;
        bool opened;
        if (!parse_value(p, open, key, &opened))
            return false;
        first = opened;
        if (opened) {
            open = p->count - 1;
            if (++depth > JSON_MAX_DEPTH)
                return fail_at(p, p->at, "nested too deeply");
        }
    } while (open >= 0);
    skip_space(p);
    return p->at == p->size || fail_at(p, p->at, "text goes on after its end");
}

bool json_parse(const uint8_t *bytes, size_t size, struct json *out, struct failure *f)
{
    static const uint8_t byte_order_mark[3] = { 0xef, 0xbb, 0xbf };
    *out = (struct json){ 0 };
    struct parser p = { .f = f };
    if (size >= 3 && memcmp(bytes, byte_order_mark, 3) == 0)
        bytes += 3, size -= 3;
    if (size == SIZE_MAX || (p.text = malloc(size + 1)) == NULL)
        return fail(f, "out of memory (%zu bytes of JSON)", size);
    if (size != 0)
        memcpy(p.text, bytes, size);
    p.text[size] = '\0';
    p.source = bytes;
    p.size = size;
    if (!parse_document(&p)) {
        free(p.value);
        free(p.text);
        return false;
    }
    *out = (struct json){ .text = p.text, .value = p.value, .count = p.count };
    return true;
}

void json_free(struct json *json)
{
    free(json->text);
    free(json->value);
    *json = (struct json){ 0 };
}

int json_first(const struct json *json, int container)
{
    return container >= 0 && json->value[container].count > 0 ? container + 1 : -1;
}

int json_after(const struct json *json, int value)
{
    int next = json->value[value].next;
    return next < json->value[json->value[value].parent].next ? next : -1;
}

int json_member(const struct json *json, int object, const char *key)
{
    if (object < 0 || json->value[object].type != JSON_OBJECT)
        return -1;
    for (int i = json_first(json, object); i >= 0; i = json_after(json, i)) {
        if (strcmp(json->value[i].key, key) == 0)
            return i;
    }
    return -1;
}

/* Writes `part` so that it ends right before `end`, control characters as '?'; returns its start.
 * What does not fit is cut off in front. */
static char *prepend(char *start, char *end, const char *part)
{
    size_t length = strlen(part);
    while (length > 0 && end > start) {
        char c = part[--length];
        *--end = c >= 0 && c < 0x20 ? '?' : c;
    }
    return end;
}

bool json_fail(const struct json *json, int value, const char *key, struct failure *f,
               const char *format, ...)
{
    char text[sizeof f->text], path[120];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);

    char *end = path + sizeof path - 1;
    *end = '\0';
    if (key != NULL) {
        end = prepend(path, end, key);
        if (value > 0)
            end = prepend(path, end, ".");
    }
    for (int v = value; v > 0; v = json->value[v].parent) {
        const char *name = json->value[v].key;
        if (name != NULL) {
            end = prepend(path, end, name);
            if (json->value[v].parent > 0)
                end = prepend(path, end, ".");
        } else {
            int position = 0;
            for (int i = json->value[v].parent + 1; i != v; i = json->value[i].next)
                position++;
            char index[24];
            snprintf(index, sizeof index, "[%d]", position);
            end = prepend(path, end, index);
        }
    }
    if (*end == '\0')
        return fail(f, "%s", text);
    return fail(f, "%s (%s)", text, end);
}

static bool expect(const struct json *json, int value, enum json_type type, struct failure *f)
{
    if (json->value[value].type == type)
        return true;
    return json_fail(json, value, NULL, f, "expected %s, found %s", type_name[type],
                     type_name[json->value[value].type]);
}

bool json_to_number(const struct json *json, int value, double *out, struct failure *f)
{
    if (!expect(json, value, JSON_NUMBER, f))
        return false;
    *out = json->value[value].number;
    return true;
}

bool json_to_integer(const struct json *json, int value, int64_t min, int64_t max, int64_t *out,
                     struct failure *f)
{
    double number;
    if (!json_to_number(json, value, &number, f))
        return false;
    if (number != floor(number))
        return json_fail(json, value, NULL, f, "%g is not a whole number", number);
    if (number < (double)min || number > (double)max)
        return json_fail(json, value, NULL, f, "%.17g is not in %lld to %lld", number,
                         (long long)min, (long long)max);
    *out = (int64_t)number;
    return true;
}

bool json_get_number(const struct json *json, int object, const char *key, double *out,
                     struct failure *f)
{
    int value = json_member(json, object, key);
    return value < 0 || json_to_number(json, value, out, f);
}

bool json_get_bool(const struct json *json, int object, const char *key, bool *out,
                   struct failure *f)
{
    int value = json_member(json, object, key);
    if (value < 0)
        return true;
    if (json->value[value].type != JSON_TRUE && json->value[value].type != JSON_FALSE)
        return json_fail(json, value, NULL, f, "expected true or false, found %s",
                         type_name[json->value[value].type]);
    *out = json->value[value].type == JSON_TRUE;
    return true;
}

bool json_get_string(const struct json *json, int object, const char *key, const char **out,
                     struct failure *f)
{
    int value = json_member(json, object, key);
    if (value < 0)
        return true;
    if (!expect(json, value, JSON_STRING, f))
        return false;
    *out = json->value[value].string;
    return true;
}

bool json_get_integer(const struct json *json, int object, const char *key, int64_t min,
                      int64_t max, int64_t *out, struct failure *f)
{
    int value = json_member(json, object, key);
    return value < 0 || json_to_integer(json, value, min, max, out, f);
}

bool json_get_index(const struct json *json, int object, const char *key, int count,
                    const char *what, int *out, struct failure *f)
{
    int value = json_member(json, object, key);
    return value < 0 || json_to_index(json, value, count, what, out, f);
}

bool json_to_index(const struct json *json, int value, int count, const char *what, int *out, struct failure *f)
{
    int64_t index;
    if (!json_to_integer(json, value, 0, INT32_MAX, &index, f))
        return false;
    if (index >= count)
        return json_fail(json, value, NULL, f, "there is no %s %d", what, (int)index);
    *out = (int)index;
    return true;
}

bool json_get_numbers(const struct json *json, int object, const char *key, int n, double *out,
                      bool *present, struct failure *f)
{
    int array;
    if (!json_get_array(json, object, key, &array, f))
        return false;
    if (present != NULL)
        *present = array >= 0;
    if (array < 0)
        return true;
    if (json->value[array].count != n)
        return json_fail(json, array, NULL, f, "expected %d numbers, found %d", n,
                         json->value[array].count);
    for (int i = json_first(json, array); i >= 0; i = json_after(json, i)) {
        if (!json_to_number(json, i, out++, f))
            return false;
    }
    return true;
}

bool json_get_array(const struct json *json, int object, const char *key, int *out,
                    struct failure *f)
{
    *out = json_member(json, object, key);
    return *out < 0 || expect(json, *out, JSON_ARRAY, f);
}

bool json_get_object(const struct json *json, int object, const char *key, int *out,
                     struct failure *f)
{
    *out = json_member(json, object, key);
    return *out < 0 || expect(json, *out, JSON_OBJECT, f);
}
