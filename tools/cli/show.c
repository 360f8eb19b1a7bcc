/* SPDX-License-Identifier: MIT */
/* show.c - `smear show`: a model at its best. It is `render` or `view` with the options that show_choose.c finds. */
#include "tools/cli/show.h"

#include "tools/cli/commands.h"
#include "tools/image/file.h"
#include "tools/options/arguments.h"
#include "tools/options/say.h"
#include "tools/options/sink.h"

#include <stdarg.h>
#include <string.h>
#include <unistd.h>

/* A studio: dark above, light below. */
static const char background[] = "55636f,c4ced6";

/* ------------------------------------------------------------------ options */

void show_add(struct show_texts *t, const char *option, const char *value)
{
    t->text[t->count++] = (char *)option;
    if (value != NULL)
        t->text[t->count++] = (char *)value;
}

void show_print(struct show_texts *t, const char *option, const char *format, ...)
{
    char *out = t->number[t->numbers++];
    va_list args;
    va_start(args, format);
    vsnprintf(out, sizeof t->number[0], format, args);
    va_end(args);
    show_add(t, option, out);
}

void show_add_scene(struct show_texts *t, const struct show *s)
{
    show_print(t, "--clip", "%s", s->clip_text);
    show_add(t, "--loop", NULL);
    show_print(t, "--fps", "%.9g", s->fps);
    show_print(t, "--size", "%dx%d", s->width, s->height);
    if (!s->has_eye)
        return;
    show_print(t, "--eye", "%.7g,%.7g,%.7g", s->eye[0], s->eye[1], s->eye[2]);
    show_print(t, "--look", "%.7g,%.7g,%.7g", s->look[0], s->look[1], s->look[2]);
    show_print(t, "--fov", "%.4g", s->fov_degrees);
}

void show_add_background(struct show_texts *t)
{
    show_add(t, "--clear", background);
}

void show_add_smoothness(struct show_texts *t)
{
    show_add(t, "--edges", "smooth");
    show_add(t, "--filter", "bilinear");
}

int show_choose_file(const char *name, const struct source_view *view, double aspect, struct show *out, bool *is_empty,
                     struct failure *why)
{
    static struct model model;          /* large */
    *is_empty = false;
    if (!model_load_from(name, view->files, &model, why))
        return say_bad_input(name, why);
    *is_empty = !show_choose(&model, aspect, out, why);
    model_free(&model);
    return STATUS_OK;
}

/* ------------------------------------------------------------------ the command line */

struct show_options {
    const char *model, *output, *shadow;
    struct source_view view;
};

#define AT(member) OPTION_AT(struct show_options, member)

static const struct option table[] = {
    { "-o", OPTION_TEXT, AT(output) },
    { "--outside", OPTION_FLAG, AT(view.files) },
    { "--double-sided", OPTION_FLAG, AT(view.double_sided) },
    { "--shadow", OPTION_TEXT, AT(shadow) },
    { .name = NULL },
};

static int read_options(struct show_options *o, int count, char **text, bool *wants_help)
{
    struct sink sink;
    *o = (struct show_options){ .model = NULL };
    int status = arguments_read(count, text, table, o, &o->model, 1, wants_help);
    if (status != STATUS_OK || *wants_help)
        return status;
    if (o->model == NULL)
        return say_bad_usage("show", "needs a model (smear help show)");
    if (source_builtin_name(o->model) != NULL)
        return say_bad_usage("show", "shows model files; built-in scenes know how they look best (smear view %s)", o->model);
    return o->output != NULL ? sink_open(&sink, "-o", o->output, 1, false) : STATUS_OK;
}

/* ------------------------------------------------------------------ the command */

static void add_model(struct show_texts *t, const struct show_options *o)
{
    if (o->view.files == MODEL_FILES_ANYWHERE)
        show_add(t, "--outside", NULL);
    if (o->view.double_sided)
        show_add(t, "--double-sided", NULL);
    if (o->shadow != NULL)
        show_add(t, "--shadow", o->shadow);
}

/* What a person can go on from. */
static void print_command(const struct show_options *o, const struct show *s, const struct show_texts *t)
{
    printf("%s: ", o->output);
    if (s->clip == MODEL_CLIP_NONE)
        printf("a turn");
    else
        printf("clip %d", s->clip);
    for (const char *c = s->clip_name; *c != '\0'; c++)
        printf("%s%c%s", c == s->clip_name ? " \"" : "", (unsigned char)*c < 32 || *c == 127 ? '?' : *c, c[1] == '\0' ? "\"" : "");
    printf(", %s%ld frames. As by: smear render MODEL", s->is_cut ? "the first " : "", s->frames);
    for (int i = 0; i < t->count; i++)
        printf(" %s", t->text[i]);
    printf("\n");
}

static int show_file(struct show_options *o, const struct show *s)
{
    struct show_texts texts = { .count = 0 }, render;
    struct sink sink;
    int status = sink_open(&sink, "-o", o->output, 1, false);
    const bool moves = sink.kind == SINK_GIF || sink.kind == SINK_APNG || sink.has_pattern;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (status != STATUS_OK)
        return status;
    add_model(&texts, o);
    show_add_scene(&texts, s);
    show_add_background(&texts);
    show_add_smoothness(&texts);
    if (s->spin != 0.0)
        show_add(&texts, "--orbit", moves ? "1" : "0.02");
    if (moves)
        show_print(&texts, "--frames", "0-%ld", s->frames - 1);
    else if (s->spin == 0.0)
        show_print(&texts, "--frames", "%ld-%ld", s->frames / 2, s->frames / 2);
    show_add(&texts, "-o", o->output);
    render = texts;
    show_print(&render, "--threads", "%d", cores > 4 ? 4 : cores > 1 ? (int)cores : 1);
    show_add(&render, "--", o->model);
    status = command_render(render.count, render.text);
    if (status == STATUS_OK)
        print_command(o, s, &texts);
    return status;
}

int command_show(int count, char **text)
{
    struct show_options options;
    struct show show;
    struct failure why = { "" };
    bool wants_help, is_empty;
    int status = read_options(&options, count, text, &wants_help);
    if (status != STATUS_OK || wants_help)
        return status == STATUS_OK ? help_print("show") : status;
    if (options.output == NULL) {
        struct show_texts texts = { .count = 0 };
        add_model(&texts, &options);
        show_add(&texts, "--", options.model);
        return command_view(texts.count, texts.text);
    }
    status = show_choose_file(options.model, &options.view, 0.0, &show, &is_empty, &why);
    if (status == STATUS_OK && is_empty)
        status = say_bad_input(options.model, &why);
    return status == STATUS_OK ? show_file(&options, &show) : status;
}
