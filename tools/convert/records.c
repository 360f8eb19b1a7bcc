/* SPDX-License-Identifier: MIT */
/* records.c - see records.h. No struct has padding (src/model/blob.h), so that members lie one behind the other. */
#include "tools/convert/records.h"

#include "model/blob.h"

#include <string.h>

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
