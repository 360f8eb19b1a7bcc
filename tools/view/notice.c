/* SPDX-License-Identifier: MIT */
/* notice.c - what the user is told of the first picture: that nothing is to be seen on it, or most of it from behind. */
#include "tools/view/view.h"

#include "tools/view/film.h"

#include "tools/options/say.h"
#include "tools/player/unseen.h"

void view_notice(struct view *v)
{
    struct unseen unseen = { .frames = 0 };
    struct failure ignored = { "" };
    struct image picture;
    struct instant instant = view_instant(v, v->at);
    struct present_options options = setup_frame(&v->main.setup, &v->main.options, instant.frame);
    char text[600];
    if (!film_picture(v, &picture, &ignored))
        return;
    const struct unseen_frame frame = {
        .scene = &v->orbit.scene, .presenter = v->presenter, .options = &options, .time = instant.time, .number = instant.frame,
        .width = v->main.setup.width, .height = v->main.setup.height, .picture = &picture,
        .has_sides = !v->source->is_file || v->source->model.has_sides, .is_covered = v->main.stats.triangles_drawn > 0,
    };
    if (unseen_look(&unseen, &frame, &ignored) && unseen_tell(&unseen, text, sizeof text)) {
        view_say(v, "%s", text);
        say_warning_when_done(v->source->name, text);
    }
    image_free(&picture);
}
