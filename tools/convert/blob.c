/* SPDX-License-Identifier: MIT */
/* blob.c - a conversion as a .smr file: src/model/blob.h has the layout. Written byte by byte, low byte first, so
 * that the host's byte order does not matter. */
#include "tools/convert/build.h"

#include "model/blob.h"
#include "tools/image/buffer.h"
#include "tools/image/image.h"

#include <string.h>

static void put_i32s(struct buffer *b, const int32_t *value, int count)
{
    for (int i = 0; i < count; i++)
        buffer_le32(b, (uint32_t)value[i]);
}

static void align(struct buffer *b)
{
    while (b->size % 4 != 0)
        buffer_byte(b, 0);
}

static void put_array(struct buffer *b, const void *data, size_t count, int size)
{
    const uint8_t *bytes = data;
    const uint16_t *halves = data;
    const uint32_t *words = data;
    for (size_t i = 0; i < count; i++) {
        if (size == 1)
            buffer_byte(b, bytes[i]);
        else if (size == 2)
            buffer_le16(b, halves[i]);
        else
            buffer_le32(b, words[i]);
    }
    align(b);
}

struct blob_writer {
    struct buffer b;
    const struct conversion *c;
    struct smear_blob_table table[BLOB_TABLES];
    struct smear_blob_mesh *mesh;       /* offsets of each mesh's arrays */
    uint32_t *texels, *palette;         /* of each texture */
};

static uint32_t put_optional(struct buffer *b, const void *data, size_t count, int size)
{
    uint32_t at = (uint32_t)b->size;
    if (data == NULL)
        return 0;
    put_array(b, data, count, size);
    return at;
}

static void put_arrays(struct blob_writer *w)
{
    const smear_model *m = &w->c->model;
    for (int i = 0; i < w->c->texture_count; i++) {
        const smear_texture *t = &w->c->texture[i];
        int same = w->c->same_texels[i];
        size_t count = convert_texel_count(t);
        int size = t->format == SMEAR_TEXEL_8888 ? 4 : t->format == SMEAR_TEXEL_565 ? 2 : 1;
        w->texels[i] = same < i ? w->texels[same] : put_optional(&w->b, t->texels, count, size);
        w->palette[i] = same < i ? w->palette[same]
                                 : put_optional(&w->b, t->palette, (size_t)w->c->palette_count[i], 4);
    }
    for (int i = 0; i < m->mesh_count; i++) {
        const smear_mesh *mesh = &m->mesh[i];
        struct smear_blob_mesh *out = &w->mesh[i];
        size_t vertices = mesh->vertex_count, triangles = mesh->triangle_count;
        int same = 0;
        while (m->mesh[same].position != mesh->position)
            same++;
        if (same < i) {
            *out = w->mesh[same];
            continue;
        }
        out->position = put_optional(&w->b, mesh->position, 3 * vertices, 2);
        out->normal = put_optional(&w->b, mesh->normal, 3 * vertices, 1);
        out->uv = put_optional(&w->b, mesh->uv, 2 * vertices, 2);
        out->color = put_optional(&w->b, mesh->color, 4 * vertices, 1);
        out->face_color = put_optional(&w->b, mesh->face_color, 4 * triangles, 1);
        out->index = put_optional(&w->b, mesh->index, 3 * triangles, 2);
    }
}

static void begin_table(struct blob_writer *w, int table, int count)
{
    w->table[table] = (struct smear_blob_table){ (uint32_t)w->b.size, (uint32_t)count };
}

static void put_surfaces(struct blob_writer *w)
{
    const struct conversion *c = w->c;
    struct buffer *b = &w->b;
    begin_table(w, BLOB_TEXTURE, c->texture_count);
    for (int i = 0; i < c->texture_count; i++) {
        const smear_texture *t = &c->texture[i];
        buffer_le32(b, w->texels[i]);
        buffer_le32(b, w->palette[i]);
        buffer_le16(b, (unsigned)c->palette_count[i]);
        buffer_le16(b, t->width);
        buffer_le16(b, t->height);
        buffer_byte(b, t->format);
        buffer_byte(b, t->wrap_u);
        buffer_byte(b, t->wrap_v);
        buffer_byte(b, t->levels);
        put_array(b, "\0\0", 2, 1);
    }
    begin_table(w, BLOB_MATERIAL, c->model.material_count);
    for (int i = 0; i < c->model.material_count; i++) {
        const smear_material *m = &c->model.material[i];
        buffer_le16(b, m->texture != NULL ? (unsigned)(m->texture - c->texture) : SMEAR_MODEL_NONE);
        for (int k = 0; k < 4; k++)
            buffer_byte(b, m->color[k]);
        buffer_byte(b, m->alpha);
        buffer_byte(b, m->cutoff);
        buffer_byte(b, m->unlit);
        buffer_byte(b, m->double_sided);
        buffer_byte(b, (uint8_t)(m->bilinear | m->shine << 4));
        buffer_byte(b, m->gloss);
    }
    begin_table(w, BLOB_MESH, c->model.mesh_count);
    for (int i = 0; i < c->model.mesh_count; i++) {
        const smear_mesh *mesh = &c->model.mesh[i];
        const struct smear_blob_mesh *at = &w->mesh[i];
        buffer_le32(b, at->position);
        buffer_le32(b, at->normal);
        buffer_le32(b, at->uv);
        buffer_le32(b, at->color);
        buffer_le32(b, at->face_color);
        buffer_le32(b, at->index);
        buffer_le32(b, mesh->triangle_count);
        buffer_le16(b, mesh->vertex_count);
        buffer_byte(b, (uint8_t)mesh->shift);
        buffer_byte(b, mesh->uv_shift);
        buffer_le32(b, (uint32_t)mesh->scale);
        put_i32s(b, mesh->offset, 3);
    }
}

/* Low bytes first, whatever the host's order is. */
static void put_records(struct blob_writer *w, const struct record_table *t)
{
    const uint8_t *data = t->data;
    begin_table(w, t->blob, t->count);
    for (int i = 0; i < t->count; i++)
        for (const char *field = t->fields; *field != '\0'; field++) {
            if (strchr("{}", *field) != NULL)
                continue;
            const uint64_t number = (uint64_t)record_number(*field, &data);
            for (int byte = 0; byte < record_size(*field); byte++)
                buffer_byte(&w->b, number >> 8 * byte & 255);
        }
    align(&w->b);
}

static void set_u32(struct buffer *b, size_t at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        b->data[at + (size_t)i] = (uint8_t)(value >> 8 * i);
}

static void put_head(struct buffer *b, const smear_model *m)
{
    const uint32_t words[4] = { SMEAR_BLOB_MAGIC, SMEAR_MODEL_FORMAT, 0, 0 };
    put_array(b, words, 4, 4);
    buffer_le16(b, m->transform_count);
    buffer_le16(b, m->deformed_count);
    buffer_le16(b, m->joint_count);
    buffer_le16(b, m->normals);
    buffer_le32(b, m->deformed_vertices);
    buffer_le32(b, (uint32_t)m->unit_shift);
    put_i32s(b, m->center, 3);
    buffer_le32(b, (uint32_t)m->radius);
    for (int i = 0; i < 2 * BLOB_TABLES; i++)
        buffer_le32(b, 0);
}

bool convert_to_blob(const struct conversion *c, uint8_t **bytes, size_t *size, struct failure *f)
{
    struct blob_writer w = { .c = c };
    struct record_table tables[RECORD_TABLES];
    w.mesh = calloc((size_t)c->model.mesh_count + 1, sizeof *w.mesh);
    w.texels = calloc((size_t)c->texture_count + 1, sizeof *w.texels);
    w.palette = calloc((size_t)c->texture_count + 1, sizeof *w.palette);
    bool ok = w.mesh != NULL && w.texels != NULL && w.palette != NULL;
    if (ok) {
        put_head(&w.b, &c->model);
        put_arrays(&w);
        put_surfaces(&w);
        record_tables(c, tables);
        for (int i = 0; i < RECORD_TABLES; i++)
            put_records(&w, &tables[i]);
        ok = !w.b.failed;
    }
    free(w.mesh);
    free(w.texels);
    free(w.palette);
    if (!ok || w.b.size > 1u << 30) {
        buffer_free(&w.b);
        return fail(f, ok ? "is larger than a gigabyte" : "out of memory");
    }
    for (size_t i = 0; i < BLOB_TABLES; i++) {
        set_u32(&w.b, offsetof(struct smear_blob_head, table) + 8 * i, w.table[i].at);
        set_u32(&w.b, offsetof(struct smear_blob_head, table) + 8 * i + 4, w.table[i].count);
    }
    set_u32(&w.b, 8, (uint32_t)w.b.size);
    set_u32(&w.b, 12, crc32_update(0, w.b.data + SMEAR_BLOB_CRC_FROM, w.b.size - SMEAR_BLOB_CRC_FROM));
    return buffer_give(&w.b, bytes, size);
}

/* ------------------------------------------------------------------ records */

/* No struct has padding (src/model/blob.h), so that members lie one behind the other. */

void record_tables(const struct conversion *c, struct record_table out[RECORD_TABLES])
{
    const smear_model *m = &c->model;
    const struct record_table all[RECORD_TABLES] = {
        { BLOB_DRAW, "smear_model_draw", "draw", "HHHHHHHHHHII", 1, m->draw, m->draw_count },
        { BLOB_NODE, "smear_model_node", "node", "HH{iiiiiiiiiiii}", 1, m->node, m->node_count },
        { BLOB_JOINT, "smear_model_joint", "joint", "HH{iiiiiiiii}{iii}", 1, m->joint, c->joint_count },
        { BLOB_SKIN, "smear_model_skin", "skin", "HHi{iii}i", 1, m->skin, c->skin_count },
        { BLOB_INFLUENCE, "uint8_t", "influence", "B", 1, m->influence, c->influence_count },
        { BLOB_TARGET, "smear_model_target", "target", "IIxI", 1, m->target, c->target_count },
        { BLOB_DELTA, "smear_model_delta", "delta", "H{hhh}", 3, m->delta, c->delta_count },
        { BLOB_DELTA_NORMAL, "int8_t", "delta_normal", "b", 1, m->delta_normal, c->delta_normals },
        { BLOB_WEIGHT, "int16_t", "weight", "h", 1, m->weight, m->weight_count },
        { BLOB_CLIP, "smear_model_clip", "clip", "IIHHI", 1, m->clip, m->clip_count },
        { BLOB_CHANNEL, "smear_model_channel", "channel", "HpBHHII{iii}ii", 1, m->channel, c->channel_count },
        { BLOB_KEY_TIME, "uint16_t", "key_time", "H", 1, m->key_time, c->key_times },
        { BLOB_KEY_VALUE, "int16_t", "key_value", "h", 1, m->key_value, c->key_values },
        { BLOB_TEXT, "char", "text", "c", 1, m->text, c->text_size },
    };
    memcpy(out, all, sizeof all);
}

int record_size(char letter)
{
    return strchr("bBpc", letter) != NULL ? 1 : letter == 'h' || letter == 'H' ? 2 : 4;
}

int64_t record_number(char letter, const uint8_t **data)
{
    int8_t signed_byte;
    int16_t signed_half;
    int32_t signed_word;
    uint16_t half;
    uint32_t word;
    const uint8_t *at = *data;
    *data += record_size(letter);
    switch (letter) {
    case 'b': memcpy(&signed_byte, at, sizeof signed_byte); return signed_byte;
    case 'h': memcpy(&signed_half, at, sizeof signed_half); return signed_half;
    case 'H': memcpy(&half, at, sizeof half); return half;
    case 'i': memcpy(&signed_word, at, sizeof signed_word); return signed_word;
    case 'I':
    case 'x': memcpy(&word, at, sizeof word); return word;
    default: return *at;
    }
}
