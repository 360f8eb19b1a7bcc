/* SPDX-License-Identifier: MIT */
/* json.h - a strict JSON reader (RFC 8259) into one flat array; the ground glTF stands on.
 *
 * Values are stored in document order, each container right before what it holds, so a subtree is
 * a run of the array and nothing here or in a caller needs recursion. Strings are UTF-8 and
 * checked; a name that occurs twice in an object is refused, because two readers would disagree
 * about it. Syntax errors tell line and column; errors of meaning tell the value's path, such as
 * meshes[0].primitives[1].mode. */
#ifndef SMEAR_TOOLS_JSON_H
#define SMEAR_TOOLS_JSON_H

#include "tools/failure.h"

#include <stddef.h>
#include <stdint.h>

enum json_type {
    JSON_NULL, JSON_FALSE, JSON_TRUE, JSON_NUMBER, JSON_STRING, JSON_ARRAY, JSON_OBJECT
};

/* Containers nest no deeper; values are no more than this in one document. */
enum { JSON_MAX_DEPTH = 256, JSON_MAX_VALUES = 1 << 24 };

struct json_value {
    enum json_type type;
    int parent;             /* the container; -1 for the document's own value, which is value 0 */
    int next;               /* first value after this one and all it holds */
    int count;              /* members or items held */
    const char *key;        /* name in the object that holds it, else null */
    union {
        double number;      /* finite */
        const char *string; /* NUL-terminated, no NUL inside */
    };
};

struct json {
    char *text;             /* the strings live here */
    struct json_value *value;
    int count;
};

bool json_parse(const uint8_t *bytes, size_t size, struct json *out, struct failure *f);
void json_free(struct json *json);

/* Walks what a container holds: for (int i = json_first(j, c); i >= 0; i = json_after(j, i)).
 * json_first of a value that is no container, or of -1, is -1. */
int json_first(const struct json *json, int container);
int json_after(const struct json *json, int value);

/* The member of that name, or -1; also -1 when `object` is -1 or no object. */
int json_member(const struct json *json, int object, const char *key);

/* Fails with the text, then the value's path in brackets. With `key`, the path goes on to that
 * member (which need not exist). */
#if defined(__GNUC__)
__attribute__((format(printf, 5, 6)))
#endif
bool json_fail(const struct json *json, int value, const char *key, struct failure *f,
          const char *format, ...);

/* Typed reads of a member. An absent member leaves *out alone and is no failure; a wrong type or a
 * value outside the range is. */
bool json_get_number(const struct json *json, int object, const char *key, double *out,
                     struct failure *f);
bool json_get_bool(const struct json *json, int object, const char *key, bool *out,
                   struct failure *f);
bool json_get_string(const struct json *json, int object, const char *key, const char **out,
                     struct failure *f);
/* A whole number in [min, max]; both must be exact in a double. */
bool json_get_integer(const struct json *json, int object, const char *key, int64_t min,
                      int64_t max, int64_t *out, struct failure *f);
/* An index into a list of `count` things called `what`. */
bool json_get_index(const struct json *json, int object, const char *key, int count,
                    const char *what, int *out, struct failure *f);
/* Exactly n numbers; *present (may be null) tells whether the member is there. */
bool json_get_numbers(const struct json *json, int object, const char *key, int n, double *out,
                      bool *present, struct failure *f);
/* The member's value id if it is there, else -1. */
bool json_get_array(const struct json *json, int object, const char *key, int *out,
                    struct failure *f);
bool json_get_object(const struct json *json, int object, const char *key, int *out,
                     struct failure *f);

/* The value itself as a whole number in [min, max]. */
bool json_to_integer(const struct json *json, int value, int64_t min, int64_t max, int64_t *out,
                     struct failure *f);
bool json_to_number(const struct json *json, int value, double *out, struct failure *f);
/* The value itself as an index into a list of `count` things called `what`. */
bool json_to_index(const struct json *json, int value, int count, const char *what, int *out, struct failure *f);

#endif
