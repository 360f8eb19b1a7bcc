/* SPDX-License-Identifier: MIT */
/* obj.h - what the parts of the OBJ reader share; only obj*.c and model.c include it. */
#ifndef SMEAR_TOOLS_OBJ_H
#define SMEAR_TOOLS_OBJ_H

#include "tools/failure.h"
#include "tools/model/external.h"
#include "tools/model/intern.h"
#include "tools/model/model.h"

#include <stddef.h>
#include <stdint.h>

bool obj_parse(const uint8_t *bytes, size_t size, struct external *files, struct model *model, struct failure *f);

/* What a material needs besides struct model_material while pictures are not loaded yet. */
struct mtl_material {
    char *map;                  /* map_Kd's file name, or null */
    float scale[2], offset[2];  /* of texture coordinates, v up */
    bool has_dissolve;          /* d is given: Tr, of which there are two meanings, does not count */
    bool is_drawn;
};

/* Materials by name: number i in `names` is material[i] here and in the model. */
struct mtl_library {
    struct text_table names;
    struct mtl_material *material;
    int count, capacity;
};

/* Adds the materials of an .mtl file to the library and the model. */
bool mtl_parse(const uint8_t *bytes, size_t size, struct mtl_library *library, struct model *model,
               struct failure *f);
/* The material of that name, added with default values when it is new; -1 when out of memory. */
int mtl_find(struct mtl_library *library, struct model *model, const char *name);
/* What programs write and do not mean: a drawn material that would be invisible is opaque, with a warning, and one that is
 * black under a picture white. */
void mtl_settle(struct mtl_library *library, struct model *model);
void mtl_library_free(struct mtl_library *library);

/* ------------------------------------------------------------------ text */

/* The line format that OBJ and MTL share: statements of words, one per line, '#' comments, a backslash at a line's end joins it to the
 * next. */

struct obj_text {
    char *copy;                 /* NUL-terminated; lines are cut up in place */
    size_t size, at;
    int line;                   /* of the statement last returned, from 1 */
    int lines_read;
};

/* Copies the text; refuses one with NUL bytes, which is no text. */
bool obj_text_open(const uint8_t *bytes, size_t size, struct obj_text *out, struct failure *f);
void obj_text_close(struct obj_text *text);

/* The next statement that is not empty: *word is its keyword, *rest what follows, without blanks at
 * either end. False at the end. */
bool obj_text_next(struct obj_text *text, char **word, char **rest);

/* Cuts the first word off *rest; null when there is none. */
char *obj_word(char **rest);

/* A decimal number that fits a float; hexadecimal, infinities and NaN are none. */
bool obj_number(const char *word, float *out);

/* What programs write for a result that is no finite number: nan, -inf, 1.#IND and their like. */
bool obj_is_not_finite(const char *word);

#endif
