/* SPDX-License-Identifier: MIT */
/* labels.c - tries places around each anchor, nearest first, one label after the other; then once
 * more, as those placed later may have left better ones. */
#include "tools/bench/labels.h"

#include <math.h>
#include <stdbool.h>

enum { DIRECTIONS = 16, RINGS = 10, ROUNDS = 6 };

/* Per square pixel; and for labels that touch at all. */
static const double label_weight = 4.0, outside_weight = 20.0, touch = 400.0;

static double overlap(struct box a, struct box b)
{
    double w = fmin(a.x + a.width, b.x + b.width) - fmax(a.x, b.x);
    double h = fmin(a.y + a.height, b.y + b.height) - fmax(a.y, b.y);
    return w > 0.0 && h > 0.0 ? w * h : 0.0;
}

static struct box box_of(const struct label *label)
{
    return (struct box){ label->x, label->y, label->width, label->height };
}

struct field {
    struct label *label;
    int count, placed;          /* labels below `placed` have a place */
    const struct obstacle *obstacle;
    int obstacles;
    struct box bounds;
};

static double penalty(const struct field *field, int index, struct box box)
{
    double area = box.width * box.height;
    double sum = outside_weight * (area - overlap(box, field->bounds));
    for (int i = 0; i < field->obstacles; i++)
        sum += field->obstacle[i].weight * overlap(box, field->obstacle[i].box);
    for (int i = 0; i < field->placed; i++) {
        double area_shared = i != index ? overlap(box, box_of(&field->label[i])) : 0.0;
        sum += label_weight * area_shared + (area_shared > 0.0 ? touch : 0.0);
    }
    return sum;
}

/* The box whose edge is nearest to the anchor lies in this direction, `away` from it. */
static struct box beside(const struct label *label, int anchor, int direction, double away)
{
    double angle = 6.283185307179586 * direction / DIRECTIONS;
    double c = cos(angle), s = sin(angle);
    double x = label->anchor_x[anchor] + away * c, y = label->anchor_y[anchor] + away * s;
    /* Straight to the side or up and down it is centred; in between it slides. */
    return (struct box){ x + label->width * (c - 1.0) / 2.0, y + label->height * (s - 1.0) / 2.0,
                         label->width, label->height };
}

static void place(const struct field *field, int index)
{
    struct label *label = &field->label[index];
    double best = INFINITY;
    for (int anchor = 0; anchor < label->anchors; anchor++)
        for (int ring = 0; ring < RINGS; ring++)
            for (int direction = 0; direction < DIRECTIONS; direction++) {
                double away = label->gap + 5.0 * ring;
                struct box box = beside(label, anchor, direction, away);
                double cost = penalty(field, index, box) + 3.0 * ring * ring + 0.5 * anchor
                            + (direction % 4 == 0 ? 0.0 : 2.0);
                if (cost < best) {
                    best = cost;
                    label->x = box.x;
                    label->y = box.y;
                    label->anchor = anchor;
                    label->distance = away;
                }
            }
}

void labels_place(struct label *label, int count, const struct obstacle *obstacle, int obstacles,
                  struct box bounds)
{
    struct field field = { label, count, 0, obstacle, obstacles, bounds };
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < count; i++) {
            place(&field, i);
            if (round == 0)
                field.placed = i + 1;
        }
}
