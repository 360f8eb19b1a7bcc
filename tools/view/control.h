/* SPDX-License-Identifier: MIT */
/* control.h - what keys and the pointer do. */
#ifndef SMEAR_TOOLS_VIEW_CONTROL_H
#define SMEAR_TOOLS_VIEW_CONTROL_H

#include "tools/view/view.h"

struct control {
    const char *keys;           /* for people */
    int key[2];                 /* forward and back; 0: none */
    void (*act)(struct view *view, int way);    /* way: 1 or -1 */
    const char *what;           /* at most 40 letters */
};

extern const struct control control_list[];     /* keys null ends it */

/* The edges that these options get: those asked for, or hard where there are no others. */
smear_edges control_edges(const struct view *view, const struct render_options *options);

/* Keys, drags and wheels; anything else is left alone. */
void control_event(struct view *view, const struct event *event);

/* The name of the main lane's method, of a way of time, and so on, as the command line has them. */
const char *control_method_name(smear_method method);
extern const char *const pace_names[];

#endif
