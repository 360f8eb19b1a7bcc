/* SPDX-License-Identifier: MIT */
/* labels.h - finds room for labels beside what they belong to. */
#ifndef SMEAR_BENCH_LABELS_H
#define SMEAR_BENCH_LABELS_H

struct box {
    double x, y, width, height;
};

enum { LABEL_ANCHORS = 32 };

struct label {
    double width, height;
    int anchors;                /* points it may stand beside; the first is the best */
    double anchor_x[LABEL_ANCHORS], anchor_y[LABEL_ANCHORS];
    double gap;                 /* to keep from the anchor */
    double x, y;                /* top left corner; set here */
    int anchor;                 /* the one it stands beside; set here */
    double distance;            /* of its nearest edge from that; set here */
};

/* Something that should not be covered. */
struct obstacle {
    struct box box;
    double weight;              /* per square pixel covered; other labels count 4 */
};

/* Places all labels within `bounds`: where they cover least and stand nearest. */
void labels_place(struct label *label, int count, const struct obstacle *obstacle, int obstacles,
                  struct box bounds);

#endif
