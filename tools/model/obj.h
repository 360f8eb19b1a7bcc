/* SPDX-License-Identifier: MIT */
/* obj.h - what the parts of the OBJ reader share; only obj*.c and model.c include it. */
#ifndef SMEAR_TOOLS_OBJ_H
#define SMEAR_TOOLS_OBJ_H

#include "tools/model/external.h"
#include "tools/model/intern.h"
#include "tools/model/model.h"

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

#endif
