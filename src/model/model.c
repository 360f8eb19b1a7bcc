/* SPDX-License-Identifier: MIT */
/* model.c - blobs: what they are checked for, and how they become a smear_model without being copied. */
#include "smear_model.h"

#include "base/compiled.h"
#include "model/blob.h"
#include "base/base.h"

#if SMEAR_WITH_MODEL

/* A blob whose head is good. */
struct blob {
    const uint8_t *bytes;
    const struct smear_blob_head *head;
    uint32_t looks;             /* elements of arrays that may still be looked at */
};

static const void *blob_at(const struct blob *b, uint32_t at)
{
    return at != 0 ? b->bytes + at : NULL;
}

static const void *blob_table(const struct blob *b, int table)
{
    return b->bytes + b->head->table[table].at;
}

static uint32_t blob_count(const struct blob *b, int table)
{
    return b->head->table[table].count;
}

/* Whether `count` elements of `size` bytes from `at` on lie within the blob, behind its head. */
static bool blob_has(const struct blob *b, uint32_t at, uint32_t count, uint32_t size)
{
    uint32_t end = b->head->size;
    return at >= sizeof *b->head && (at & 3u) == 0 && at <= end && count <= (end - at) / size;
}

static bool blob_may_have(const struct blob *b, uint32_t at, uint32_t count, uint32_t size)
{
    return at == 0 || blob_has(b, at, count, size);
}

/* Takes `count` elements that a record refers to from the looks that are left. Records may share arrays, so that a small
 * blob could ask for any number of them. */
static bool blob_looks(struct blob *b, uint32_t count)
{
    const bool may = b->looks != 0 && count < b->looks;
    b->looks = may ? b->looks - count : 0;
    return may;
}

/* Whether first + count <= limit, also where the sum would wrap. */
static bool is_range(uint32_t first, uint32_t count, uint32_t limit)
{
    return first <= limit && count <= limit - first;
}

/* Whether the animation takes all of these as factors or places: Q8.24 within +-8, Q16.16 within +-2048. */
static bool is_modest(const int32_t *value, int count)
{
    for (int i = 0; i < count; i++)
        if (value[i] >= 1 << 27 || value[i] <= -(1 << 27))
            return false;
    return true;
}

/* ------------------------------------------------------------------ what smear_submit takes */

/* Of all levels: at most 2^25. */
static uint32_t texels_of(const struct smear_blob_texture *t)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i <= t->levels; i++)
        count += (uint32_t)max_i32(t->width >> i, 1) * (uint32_t)max_i32(t->height >> i, 1);
    return count;
}

static bool are_textures(struct blob *b)
{
    const struct smear_blob_texture *t = blob_table(b, BLOB_TEXTURE);
    for (uint32_t i = 0; i < blob_count(b, BLOB_TEXTURE); i++, t++) {
        if (t->width < 1 || t->width > 4096 || t->height < 1 || t->height > 4096
            || t->format > SMEAR_TEXEL_PALETTE8 || t->wrap_u > SMEAR_MIRROR || t->wrap_v > SMEAR_MIRROR
            || !texture_has_levels(t->width, t->height, t->levels))
            return false;
        uint32_t count = texels_of(t);
        uint32_t size = t->format == SMEAR_TEXEL_8888 ? 4 : t->format == SMEAR_TEXEL_565 ? 2 : 1;
        if (!blob_has(b, t->texels, count, size))
            return false;
        if (t->format != SMEAR_TEXEL_PALETTE8)
            continue;
        if (!blob_has(b, t->palette, t->palette_count, 4))
            return false;
        if (!blob_looks(b, count))
            return false;
        const uint8_t *texel = blob_at(b, t->texels);
        for (uint32_t k = 0; k < count; k++)
            if (texel[k] >= t->palette_count)
                return false;
    }
    return true;
}

static bool are_materials(const struct blob *b)
{
    const struct smear_blob_material *m = blob_table(b, BLOB_MATERIAL);
    for (uint32_t i = 0; i < blob_count(b, BLOB_MATERIAL); i++, m++)
        if (m->alpha > SMEAR_BLEND
            || (m->texture != SMEAR_MODEL_NONE && m->texture >= blob_count(b, BLOB_TEXTURE)))
            return false;
    return true;
}

static bool are_meshes(struct blob *b)
{
    const struct smear_blob_mesh *m = blob_table(b, BLOB_MESH);
    for (uint32_t i = 0; i < blob_count(b, BLOB_MESH); i++, m++) {
        if (!blob_has(b, m->position, m->vertex_count, 6) || !blob_has(b, m->index, m->triangle_count, 6)
            || !blob_may_have(b, m->normal, m->vertex_count, 3)
            || !blob_may_have(b, m->uv, m->vertex_count, 4) || !blob_may_have(b, m->color, m->vertex_count, 4)
            || !blob_may_have(b, m->face_color, m->triangle_count, 4))
            return false;
        if (m->shift < -32 || m->shift > 62 || m->uv_shift > 15 || m->scale < 0)
            return false;
        for (int k = 0; k < 3; k++)
            if (m->offset[k] > 1 << 20 || m->offset[k] < -(1 << 20))
                return false;
        if (m->triangle_count > b->head->size || !blob_looks(b, 3 * m->triangle_count + m->vertex_count))
            return false;
        const uint16_t *index = blob_at(b, m->index);
        for (uint32_t k = 0; k < 3 * m->triangle_count; k++)
            if (index[k] >= m->vertex_count)
                return false;
    }
    return true;
}

/* ------------------------------------------------------------------ what the animation takes */

static bool are_nodes(const struct blob *b)
{
    const smear_model_node *n = blob_table(b, BLOB_NODE);
    for (uint32_t i = 0; i < blob_count(b, BLOB_NODE); i++, n++) {
        if ((n->parent != SMEAR_MODEL_NONE && n->parent >= i) || n->moves > 1)
            return false;
        if (!is_modest(n->rest, n->moves ? 6 : 12))
            return false;
        for (int k = 6; n->moves && k < 10; k++)
            if (n->rest[k] > 1 << 30 || n->rest[k] < -(1 << 30))
                return false;
    }
    return true;
}

static bool are_skins(const struct blob *b)
{
    const smear_model_joint *j = blob_table(b, BLOB_JOINT);
    const smear_model_skin *s = blob_table(b, BLOB_SKIN);
    for (uint32_t i = 0; i < blob_count(b, BLOB_JOINT); i++, j++)
        if (j->node >= blob_count(b, BLOB_NODE) || !is_modest(j->origin, 3))
            return false;
    for (uint32_t i = 0; i < blob_count(b, BLOB_SKIN); i++, s++)
        if (!is_range(s->joint_first, s->joint_count, blob_count(b, BLOB_JOINT))
            || s->joint_count > b->head->joint_count || !is_modest(s->offset, 3)
            || s->shift < -31 || s->shift > 31)
            return false;
    return true;
}

static bool are_influences(struct blob *b, const smear_model_draw *d, uint32_t vertices)
{
    const smear_model_skin *s = (const smear_model_skin *)blob_table(b, BLOB_SKIN) + d->skin;
    uint32_t n = d->influences, bytes = 2 * n - 1;
    if (n < 1 || n > 4 || !is_range(d->influence_first, vertices * bytes, blob_count(b, BLOB_INFLUENCE)))
        return false;
    if (!blob_looks(b, vertices * bytes))
        return false;
    const uint8_t *at = (const uint8_t *)blob_table(b, BLOB_INFLUENCE) + d->influence_first;
    for (uint32_t v = 0; v < vertices; v++, at += bytes) {
        uint32_t sum = 0;
        for (uint32_t k = 0; k < n; k++) {
            if (at[k] >= s->joint_count)
                return false;
            sum += k > 0 ? at[n + k - 1] : 0u;
        }
        if (sum > 255)
            return false;
    }
    return true;
}

static bool is_draw(struct blob *b, const smear_model_draw *d)
{
    if (d->mesh >= blob_count(b, BLOB_MESH)
        || (d->material != SMEAR_MODEL_NONE && d->material >= blob_count(b, BLOB_MATERIAL))
        || (d->node != SMEAR_MODEL_NONE && d->node >= blob_count(b, BLOB_NODE))
        || (d->skin != SMEAR_MODEL_NONE && d->skin >= blob_count(b, BLOB_SKIN))
        || d->transform >= b->head->transform_count)
        return false;
    if (d->skin == SMEAR_MODEL_NONE && d->target_count == 0)
        return d->deformed == SMEAR_MODEL_NONE;
    const struct smear_blob_mesh *m = (const struct smear_blob_mesh *)blob_table(b, BLOB_MESH) + d->mesh;
    return d->deformed < b->head->deformed_count
        && is_range(d->vertex_first, m->vertex_count, b->head->deformed_vertices)
        && (m->normal == 0 || b->head->normals == 1)
        && (d->skin == SMEAR_MODEL_NONE || are_influences(b, d, m->vertex_count));
}

static bool are_draws(struct blob *b)
{
    const smear_model_draw *d = blob_table(b, BLOB_DRAW);
    for (uint32_t i = 0; i < blob_count(b, BLOB_DRAW); i++, d++)
        if (!is_draw(b, d))
            return false;
    return true;
}

static bool is_target(struct blob *b, const smear_model_target *t, uint32_t vertices)
{
    if (!is_range(t->delta_first, t->delta_count, blob_count(b, BLOB_DELTA)) || t->shift > 2)
        return false;
    if (t->normal_first != SMEAR_MODEL_NO_NORMALS
        && (t->delta_count > blob_count(b, BLOB_DELTA_NORMAL) / 3
            || !is_range(t->normal_first, 3 * t->delta_count, blob_count(b, BLOB_DELTA_NORMAL))))
        return false;
    if (!blob_looks(b, t->delta_count))
        return false;
    const smear_model_delta *d = (const smear_model_delta *)blob_table(b, BLOB_DELTA) + t->delta_first;
    for (uint32_t i = 0; i < t->delta_count; i++)
        if (d[i].vertex >= vertices)
            return false;
    return true;
}

static bool are_morphs(struct blob *b)
{
    const smear_model_draw *d = blob_table(b, BLOB_DRAW);
    const smear_model_target *t = blob_table(b, BLOB_TARGET);
    const struct smear_blob_mesh *m = blob_table(b, BLOB_MESH);
    for (uint32_t i = 0; i < blob_count(b, BLOB_DRAW); i++, d++) {
        if (d->target_count == 0)
            continue;
        if (!is_range(d->target_first, d->target_count, blob_count(b, BLOB_TARGET))
            || !is_range(d->weight_first, d->target_count, blob_count(b, BLOB_WEIGHT))
            || !blob_looks(b, d->target_count))
            return false;
        for (uint32_t k = 0; k < d->target_count; k++)
            if (!is_target(b, t + d->target_first + k, m[d->mesh].vertex_count))
                return false;
    }
    return true;
}

static bool is_channel(struct blob *b, const smear_model_channel *c)
{
    const smear_model_node *node = blob_table(b, BLOB_NODE);
    if (c->path > SMEAR_PATH_WEIGHTS || c->step > 1 || c->key_count < 1 || c->width < 1
        || c->shift < -31 || c->shift > 31 || !is_modest(c->offset, 3)
        || !is_range(c->time_first, c->key_count, blob_count(b, BLOB_KEY_TIME))
        || !is_range(c->value_first, (uint32_t)c->key_count * c->width, blob_count(b, BLOB_KEY_VALUE)))
        return false;
    if (c->path == SMEAR_PATH_WEIGHTS) {
        if (!is_range(c->target, c->width, blob_count(b, BLOB_WEIGHT)))
            return false;
    } else if (c->width != (c->path == SMEAR_PATH_ROTATION ? 4 : 3) || c->target >= blob_count(b, BLOB_NODE)
               || node[c->target].moves == 0) {
        return false;
    }
    if (!blob_looks(b, c->key_count))
        return false;
    const uint16_t *time = (const uint16_t *)blob_table(b, BLOB_KEY_TIME) + c->time_first;
    for (uint32_t k = 1; k < c->key_count; k++)
        if (time[k] < time[k - 1])
            return false;
    return true;
}

static bool are_clips(struct blob *b)
{
    const smear_model_channel *channel = blob_table(b, BLOB_CHANNEL);
    const smear_model_clip *c = blob_table(b, BLOB_CLIP);
    const char *text = blob_table(b, BLOB_TEXT);
    uint32_t letters = blob_count(b, BLOB_TEXT);
    if (letters > 0 && text[letters - 1] != '\0')
        return false;
    for (uint32_t i = 0; i < blob_count(b, BLOB_CHANNEL); i++)
        if (!is_channel(b, channel + i))
            return false;
    for (uint32_t i = 0; i < blob_count(b, BLOB_CLIP); i++, c++)
        if (!is_range(c->channel_first, c->channel_count, blob_count(b, BLOB_CHANNEL)) || c->name >= letters
            || c->duration >= 1u << 31 || c->tick_shift > 15)
            return false;
    return true;
}

/* ------------------------------------------------------------------ the whole */

static bool is_little_endian(void)
{
    const uint16_t one = 1;
    return *(const uint8_t *)&one == 1;
}

static int check_head(struct blob *b, const void *bytes, size_t size)
{
    if (!is_little_endian())
        return SMEAR_MODEL_ERR_ENDIAN;
    if (bytes == NULL || ((uintptr_t)bytes & 3u) != 0)
        return SMEAR_MODEL_ERR_ALIGN;
    b->bytes = (const uint8_t *)bytes;
    b->head = (const struct smear_blob_head *)bytes;
    if (size < 8)
        return SMEAR_MODEL_ERR_SIZE;
    if (b->head->magic != SMEAR_BLOB_MAGIC)
        return SMEAR_MODEL_ERR_MAGIC;
    if (b->head->format != SMEAR_MODEL_FORMAT)
        return SMEAR_MODEL_ERR_FORMAT;
    if (size < sizeof *b->head || b->head->size < sizeof *b->head || b->head->size > size
        || b->head->size > 1u << 30)
        return SMEAR_MODEL_ERR_SIZE;
    if (smear_crc32(0, b->bytes + SMEAR_BLOB_CRC_FROM, b->head->size - SMEAR_BLOB_CRC_FROM) != b->head->crc32)
        return SMEAR_MODEL_ERR_CRC;
    return SMEAR_OK;
}

static bool are_tables(const struct blob *b)
{
    const struct smear_blob_head *h = b->head;
    for (int i = 0; i < BLOB_TABLES; i++) {
        bool large = i == BLOB_INFLUENCE || i == BLOB_DELTA || i == BLOB_DELTA_NORMAL || i == BLOB_KEY_TIME
                  || i == BLOB_KEY_VALUE || i == BLOB_TEXT;
        if (!blob_has(b, h->table[i].at, h->table[i].count, smear_blob_element[i])
            || (!large && h->table[i].count >= SMEAR_MODEL_NONE))
            return false;
    }
    return h->normals <= 1 && h->joint_count <= 256 && h->transform_count >= 1
        && h->deformed_vertices <= 1u << 20 && h->unit_shift >= -31 && h->unit_shift <= 31;
}

/* Records of real models share little: this many looks at each byte are many. */
enum { LOOKS_PER_BYTE = 8 };

static int check_blob(struct blob *b, const void *bytes, size_t size)
{
    int error = check_head(b, bytes, size);
    if (error != SMEAR_OK)
        return error;
    b->looks = LOOKS_PER_BYTE * min_u32(b->head->size, UINT32_MAX / LOOKS_PER_BYTE);
    error = !are_tables(b)    ? SMEAR_MODEL_ERR_TABLE
          : !are_textures(b)  ? SMEAR_MODEL_ERR_TEXTURE
          : !are_materials(b) ? SMEAR_MODEL_ERR_MATERIAL
          : !are_meshes(b)    ? SMEAR_MODEL_ERR_MESH
          : !are_nodes(b)     ? SMEAR_MODEL_ERR_NODE
          : !are_skins(b)     ? SMEAR_MODEL_ERR_SKIN
          : !are_draws(b)     ? SMEAR_MODEL_ERR_DRAW
          : !are_morphs(b)    ? SMEAR_MODEL_ERR_MORPH
          : !are_clips(b)     ? SMEAR_MODEL_ERR_CLIP : (int)SMEAR_OK;
    return error != SMEAR_OK && b->looks == 0 ? (int)SMEAR_MODEL_ERR_SHARED : error;
}

int smear_mesh_check(const void *blob, size_t bytes)
{
    struct blob b;
    return check_blob(&b, blob, bytes);
}

const char *smear_mesh_reason(int error)
{
    /* One after the other, each with its end: SMEAR_OK, SMEAR_ERR_MEMORY, and from SMEAR_MODEL_ERR_ENDIAN down. */
    static const char texts[] = "\0too little memory for its tables\0"
                                "blobs are little-endian and this core is not: take the header\0"
                                "does not lie on a multiple of 4\0not a model of smear convert\0"
                                "made for another version of smear\0cut short\0damaged: its checksum is wrong\0"
                                "a table does not lie within it\0a mesh points outside of it\0"
                                "a texture points outside of it\0a material has no such texture or alpha mode\0"
                                "a draw names something that is not there\0a node comes before its parent or is out of range\0"
                                "a skin names a joint that is not there\0a morph target names a vertex that is not there\0"
                                "a clip has keys out of order or a target that is not there\0"
                                "its records share arrays so often that checking them would take too long\0unknown error";
    int number = error == SMEAR_OK ? 0 : error == SMEAR_ERR_MEMORY ? 1 : 18;
    if (error <= SMEAR_MODEL_ERR_ENDIAN && error >= SMEAR_MODEL_ERR_SHARED)
        number = 2 + SMEAR_MODEL_ERR_ENDIAN - error;
    const char *text = texts;
    for (; number > 0; text++)
        number -= *text == '\0';
    return text;
}

/* ------------------------------------------------------------------ a model from a blob */

struct model_tables {
    smear_texture *texture;
    smear_material *material;
    smear_mesh *mesh;
};

static size_t lay_out_tables(struct model_tables *t, const struct blob *b, void *memory)
{
    struct smear_arena a = { (uint8_t *)memory, 0 };
    t->texture = arena_take(&a, blob_count(b, BLOB_TEXTURE), sizeof *t->texture);
    t->material = arena_take(&a, blob_count(b, BLOB_MATERIAL), sizeof *t->material);
    t->mesh = arena_take(&a, blob_count(b, BLOB_MESH), sizeof *t->mesh);
    return a.used;
}

size_t smear_model_memory(const void *blob, size_t bytes)
{
    struct blob b;
    struct model_tables t;
    return check_blob(&b, blob, bytes) == SMEAR_OK ? lay_out_tables(&t, &b, NULL) : 0;
}

static void fill_tables(const struct model_tables *t, const struct blob *b)
{
    const struct smear_blob_texture *texture = blob_table(b, BLOB_TEXTURE);
    const struct smear_blob_material *material = blob_table(b, BLOB_MATERIAL);
    const struct smear_blob_mesh *mesh = blob_table(b, BLOB_MESH);
    for (uint32_t i = 0; i < blob_count(b, BLOB_TEXTURE); i++, texture++)
        t->texture[i] = (smear_texture){
            .texels = blob_at(b, texture->texels), .palette = blob_at(b, texture->palette),
            .width = texture->width, .height = texture->height, .format = texture->format,
            .wrap_u = texture->wrap_u, .wrap_v = texture->wrap_v, .levels = texture->levels
        };
    for (uint32_t i = 0; i < blob_count(b, BLOB_MATERIAL); i++, material++) {
        smear_material *m = &t->material[i];
        *m = (smear_material){ .alpha = material->alpha, .cutoff = material->cutoff, .unlit = material->unlit,
                               .double_sided = material->double_sided, .bilinear = (uint8_t)(material->bilinear & 15u),
                               .gloss = material->gloss, .shine = (uint8_t)(material->bilinear >> 4) };
        m->texture = material->texture != SMEAR_MODEL_NONE ? t->texture + material->texture : NULL;
        for (int k = 0; k < 4; k++)
            m->color[k] = material->color[k];
    }
    for (uint32_t i = 0; i < blob_count(b, BLOB_MESH); i++, mesh++) {
        t->mesh[i] = (smear_mesh){
            .position = blob_at(b, mesh->position), .normal = blob_at(b, mesh->normal),
            .uv = blob_at(b, mesh->uv), .color = blob_at(b, mesh->color),
            .face_color = blob_at(b, mesh->face_color), .index = blob_at(b, mesh->index),
            .triangle_count = mesh->triangle_count,
            .vertex_count = mesh->vertex_count, .shift = mesh->shift, .uv_shift = mesh->uv_shift,
            .scale = mesh->scale, .offset = { mesh->offset[0], mesh->offset[1], mesh->offset[2] }
        };
        smear_mesh_find_bounds(&t->mesh[i]);
    }
}

int smear_model_open(smear_model *model, const void *blob, size_t bytes, void *memory, size_t memory_bytes)
{
    struct blob b;
    struct model_tables t;
    if (model == NULL)
        return SMEAR_ERR_ARG;
    int error = check_blob(&b, blob, bytes);
    if (error != SMEAR_OK)
        return error;
    if (((uintptr_t)memory & 7u) != 0 || (memory == NULL ? 0 : memory_bytes) < lay_out_tables(&t, &b, NULL))
        return SMEAR_ERR_MEMORY;
    lay_out_tables(&t, &b, memory);
    fill_tables(&t, &b);
    *model = (smear_model){
        .mesh = t.mesh, .material = t.material,
        .draw = blob_table(&b, BLOB_DRAW), .node = blob_table(&b, BLOB_NODE),
        .joint = blob_table(&b, BLOB_JOINT), .skin = blob_table(&b, BLOB_SKIN),
        .influence = blob_table(&b, BLOB_INFLUENCE),
        .target = blob_table(&b, BLOB_TARGET), .delta = blob_table(&b, BLOB_DELTA),
        .delta_normal = blob_table(&b, BLOB_DELTA_NORMAL), .weight = blob_table(&b, BLOB_WEIGHT),
        .clip = blob_table(&b, BLOB_CLIP), .channel = blob_table(&b, BLOB_CHANNEL),
        .key_time = blob_table(&b, BLOB_KEY_TIME), .key_value = blob_table(&b, BLOB_KEY_VALUE),
        .text = blob_table(&b, BLOB_TEXT),
        .mesh_count = (uint16_t)blob_count(&b, BLOB_MESH),
        .material_count = (uint16_t)blob_count(&b, BLOB_MATERIAL),
        .draw_count = (uint16_t)blob_count(&b, BLOB_DRAW), .node_count = (uint16_t)blob_count(&b, BLOB_NODE),
        .clip_count = (uint16_t)blob_count(&b, BLOB_CLIP),
        .weight_count = (uint16_t)blob_count(&b, BLOB_WEIGHT),
        .transform_count = b.head->transform_count, .deformed_count = b.head->deformed_count,
        .joint_count = b.head->joint_count, .normals = b.head->normals,
        .deformed_vertices = b.head->deformed_vertices, .unit_shift = b.head->unit_shift,
        .center = { b.head->center[0], b.head->center[1], b.head->center[2] }, .radius = b.head->radius
    };
    return SMEAR_OK;
}

int smear_model_find_clip(const smear_model *model, const char *name)
{
    for (int i = 0; i < model->clip_count; i++) {
        const char *own = model->text + model->clip[i].name;
        int k = 0;
        while (own[k] == name[k] && name[k] != '\0')
            k++;
        if (own[k] == name[k])
            return i;
    }
    return -1;
}

#endif
