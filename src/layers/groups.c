/* SPDX-License-Identifier: MIT */
/* groups.c - sorts draws into groups by their velocity, and groups by their depth. */
#include "layers/layer.h"

/* Returns a draw's layer: the first that shares a bit with it. */
static uint8_t find_layer(const struct smear_layers *l, const smear_draw *draw)
{
    uint32_t bits = draw->layers != 0 ? draw->layers : 1u;
    for (int i = 0; i < l->setting_count; i++)
        if ((l->setting[i].layer.mask & bits) != 0)
            return (uint8_t)i;
    return SMEAR_NO_LAYER;
}

void smear_groups_begin(struct smear_layers *l)
{
    l->group_count = 0;
}

void smear_groups_find_layer(struct smear_layers *l, uint32_t index, const smear_draw *draw)
{
    l->group_of[index] = SMEAR_NO_GROUP;
    l->layer_of[index] = find_layer(l, draw);
}

/* How many vertices stand for a draw. */
enum { SAMPLES = 24 };

/* What vertices of a draw say of its motion. */
struct motion {
    int32_t x, y, depth, longest, count;
    int32_t x0, x1, y0, y1;     /* least and largest displacements */
    bool cut;                   /* some lie before the near plane */
};

/* Measures the motion of a draw. Vertices that are nearer than the mean count: the others are more likely hidden. */
static void measure(struct motion *m, const struct smear_viewport *viewport, const smear_mesh *mesh,
                    const struct smear_placement key[2], const struct smear_placement *middle)
{
    const int32_t far_out = 1 << 20;
    int32_t x[SAMPLES], y[SAMPLES], depth[SAMPLES], n = 0, mean = 0;
    uint32_t step = max_u32(mesh->vertex_count / SAMPLES, 1);
    *m = (struct motion){ .x0 = INT32_MAX, .x1 = INT32_MIN, .y0 = INT32_MAX, .y1 = INT32_MIN };
    for (uint32_t i = step >> 1; i < mesh->vertex_count && n < SAMPLES; i += step) {
        struct smear_screen open, close, now;
        if (((placement_project(&open, &key[0], i, viewport)
              | placement_project(&close, &key[1], i, viewport)
              | placement_project(&now, middle, i, viewport))
             & OUT_NEAR)
            != 0) {
            m->cut = true;
            continue;
        }
        x[n] = clamp_i32(close.x - open.x, -far_out, far_out);
        y[n] = clamp_i32(close.y - open.y, -far_out, far_out);
        depth[n] = now.depth / SAMPLES;
        mean += depth[n++];
    }
    m->depth = mean;
    for (int32_t i = 0; i < n; i++) {
        m->x0 = min_i32(m->x0, x[i]);
        m->x1 = max_i32(m->x1, x[i]);
        m->y0 = min_i32(m->y0, y[i]);
        m->y1 = max_i32(m->y1, y[i]);
        m->longest = max_i32(m->longest, max_i32(abs_i32(x[i]), abs_i32(y[i])));
        if (depth[i] < mean / n)
            continue;
        m->x += x[i];
        m->y += y[i];
        m->count++;
    }
    if (n != 0)
        m->depth /= n;
}

/* Whether one velocity tells how all of the draw moves: within a third of it and a pixel. */
static bool is_constant(const struct motion *m)
{
    if (m->cut || m->count == 0)
        return false;
    int32_t spread = max_i32(m->x1 - m->x0, m->y1 - m->y0) >> 1;
    return spread <= max_i32(abs_i32(m->x), abs_i32(m->y)) / m->count / 3 + 256;
}

static bool belongs(const struct smear_group *g, const struct smear_group *to, bool plain)
{
    if (g->layer != to->layer || g->method != to->method)
        return false;
    return plain || g->method != SMEAR_OBJECT
        || (abs_i32(g->vx - to->vx) <= 64 && abs_i32(g->vy - to->vy) <= 64);
}

void smear_groups_add(struct smear_layers *l, uint32_t index, const smear_draw *draw, const struct smear_placement key[2],
                      const struct smear_placement *middle, const struct smear_viewport *viewport, bool moves)
{
    enum { LOOKED_AT = 16 };    /* groups, from the newest: enough for parts of one thing, and no more than linear time */
    const struct smear_layer_setting *setting = &l->setting[l->layer_of[index]];
    const bool over = setting->has_camera || setting->layer.over;
    struct motion m;
    measure(&m, viewport, draw->mesh, key, middle);
    moves = moves && (m.longest >= 8 || m.cut);             /* 1/32 px */
    if (!moves && !over)
        return;
    struct smear_group g = {
        .layer = l->layer_of[index],
        .rank = (uint8_t)(over || setting->layer.two_camera ? l->layer_of[index] + 1 : 0),
        .method = (uint8_t)(moves ? setting->layer.method : (int)SMEAR_NONE)
    };
    if (g.method == SMEAR_OBJECT && !setting->layer.two_camera && !is_constant(&m))
        g.method = SMEAR_LAYERED;
    if (m.count != 0) {
        g.vx = mul_shift(m.x / m.count, setting->shutter, 16);
        g.vy = mul_shift(m.y / m.count, setting->shutter, 16);
        g.depth = m.depth * SAMPLES;
    }
    if (!moves)
        g.vx = g.vy = 0;
    uint32_t at = l->group_count;
    for (uint32_t i = 0; i < min_u32(l->group_count, LOOKED_AT) && at == l->group_count; i++)
        if (belongs(&l->group[l->group_count - 1 - i], &g, setting->layer.two_camera))
            at = l->group_count - 1 - i;
    if (at == l->group_count)
        l->group[l->group_count++] = g;
    const smear_material *material = draw->material;
    l->group[at].textured = l->group[at].textured || (material != NULL && material->texture != NULL);
    l->group_of[index] = (uint16_t)at;
}

static bool is_before(const struct smear_group *a, const struct smear_group *b)
{
    return a->rank != b->rank ? a->rank < b->rank : a->depth < b->depth;
}

void smear_groups_end(struct smear_layers *l, uint32_t draw_count)
{
    for (uint32_t i = 0; i < l->group_count; i++) {
        uint32_t at = i;
        for (; at > 0 && is_before(&l->group[i], &l->group[l->order[at - 1]]); at--)
            l->order[at] = l->order[at - 1];
        l->order[at] = (uint16_t)i;
        l->group[i].end = 0;
    }
    /* Draws by groups, those of none first: `end` counts, then tells where the next draw of a group goes. */
    uint32_t ungrouped = 0;
    for (uint32_t i = 0; i < draw_count; i++) {
        if (l->group_of[i] == SMEAR_NO_GROUP)
            l->sequence[ungrouped++] = (uint16_t)i;
        else
            l->group[l->group_of[i]].end++;
    }
    for (uint32_t i = 0; i < l->group_count; i++) {
        uint32_t count = l->group[i].end;
        l->group[i].end = ungrouped;
        ungrouped += count;
    }
    for (uint32_t i = 0; i < draw_count; i++)
        if (l->group_of[i] != SMEAR_NO_GROUP)
            l->sequence[l->group[l->group_of[i]].end++] = (uint16_t)i;
}

/* Triangles of layers lie in the store at the places that layer.h tells. */
bool smear_groups_assemble(struct smear_layers *l, struct smear_assembler *assembler, const struct smear_assembly *a)
{
    struct smear_bins *g = assembler->bins;
    const struct smear_viewport viewport = assembler->viewport;
    uint32_t *opaque = g->opaque_last;
    const int end = g->row_end;
    assembler->viewport = (struct smear_viewport){ l->rows.width, l->rows.height };
    g->opaque_last = g->moving_last;
    g->row_end = end + g->moving_rows;
    const bool added = smear_assemble(assembler, a);
    g->row_end = end;
    g->opaque_last = opaque;
    assembler->viewport = viewport;
    l->group[l->group_of[a->draw]].end = g->triangle_count;
    return added;
}

/* ------------------------------------------------------------------ lists */

static void extend(struct smear_group *group, const struct smear_bins *g, const struct smear_triangle *t)
{
    if (t->segment == SMEAR_POINT) {
        group->x0 = min_i32(group->x0, t->vertex[POINT_X]);
        group->x1 = max_i32(group->x1, t->vertex[POINT_X] + 1);
        group->nearest = (uint16_t)max_u32(group->nearest, t->vertex[POINT_DEPTH]);
        group->farthest = (uint16_t)min_u32(group->farthest, t->vertex[POINT_DEPTH]);
        return;
    }
    const struct smear_segment *s = &g->segment[t->segment];
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, low = INT32_MAX, high = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = bins_vertex(g, s, t->vertex[i]);
        x0 = min_i32(x0, v[VERTEX_X]);
        x1 = max_i32(x1, v[VERTEX_X]);
        low = min_i32(low, v[VERTEX_DEPTH]);
        high = max_i32(high, v[VERTEX_DEPTH]);
    }
    group->x0 = min_i32(group->x0, (x0 + 127) >> 8);
    group->x1 = max_i32(group->x1, (x1 + 127) >> 8);
    group->nearest = (uint16_t)max_u32(group->nearest, min_u32(depth_code_of((uint32_t)high >> 11) + 1u, UINT16_MAX));
    group->farthest = (uint16_t)min_u32(group->farthest, depth_code_of((uint32_t)low >> 11));
}

void smear_groups_list_begin(struct smear_layers *l)
{
    for (uint32_t i = 0; i < l->group_count; i++) {
        struct smear_group *group = &l->group[i];
        group->head = group->tail = SMEAR_NO_TRIANGLE;
        group->x0 = INT32_MAX;
        group->x1 = INT32_MIN;
        group->nearest = 0;
        group->farthest = UINT16_MAX;
    }
}

uint32_t smear_groups_list_add(struct smear_group *group, const struct smear_bins *g, uint32_t i)
{
    for (; i < group->end; i = bins_triangle(g, i)->next) {         /* none is the largest number */
        if (group->head == SMEAR_NO_TRIANGLE)
            group->head = i;
        group->tail = i;
        extend(group, g, bins_triangle(g, i));
    }
    return i;
}

void smear_groups_list_end(struct smear_layers *l)
{
    for (uint32_t i = 0; i < l->group_count; i++) {
        struct smear_group *group = &l->group[i];
        group->x0 = max_i32(group->x0, 0) & ~15;        /* cuts of columns lie on multiples of 16 */
        group->x1 = min_i32((group->x1 + 15) & ~15, l->rows.width);
    }
}

void smear_groups_list(struct smear_layers *l, const struct smear_bins *g, uint32_t head)
{
    smear_groups_list_begin(l);
    /* Numbers grow along the list, group by group; a group may have none. */
    for (uint32_t i = 0; i < l->group_count; i++)
        head = smear_groups_list_add(&l->group[i], g, head);
    smear_groups_list_end(l);
}

static int32_t reach_of(int32_t reach, const struct smear_group *group)
{
    return group->method == SMEAR_LAYERED ? reach : (abs_i32(group->vx) >> 9) + 2;
}

bool smear_groups_find_mixed(struct smear_layers *l, int32_t reach)
{
    bool any = false;
    for (uint32_t i = 0; i < l->group_count; i++) {
        struct smear_group *g = &l->group[l->order[i]];
        g->mixed0 = INT32_MAX;
        g->mixed1 = INT32_MIN;
        g->marks = false;
        g->marked_from = UINT32_MAX;
        for (uint32_t k = 0; k < i && g->head != SMEAR_NO_TRIANGLE; k++) {
            struct smear_group *before = &l->group[l->order[k]];
            int32_t x0 = max_i32(g->x0 - reach_of(reach, g), before->x0 - reach_of(reach, before));
            int32_t x1 = min_i32(g->x1 + reach_of(reach, g), before->x1 + reach_of(reach, before));
            if (before->head == SMEAR_NO_TRIANGLE || g->rank != before->rank || g->farthest >= before->nearest
                || x0 >= x1)
                continue;
            g->mixed0 = min_i32(g->mixed0, x0);
            g->mixed1 = max_i32(g->mixed1, x1);
            before->mixed0 = min_i32(before->mixed0, x0);
            before->mixed1 = max_i32(before->mixed1, x1);
            before->marks = any = true;
            before->marked_from = min_u32(before->marked_from, g->farthest);
        }
    }
    return any;
}
