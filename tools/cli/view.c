/* SPDX-License-Identifier: MIT */
/* view.c - `smear view`: the options of `render` that say what is drawn, and those of a viewer. */
#include "tools/cli/commands.h"

#include "tools/cli/show.h"

#include "tools/image/file.h"
#include "tools/options/arguments.h"
#include "tools/options/options.h"
#include "tools/options/say.h"
#include "tools/scenes/methods.h"

#include "tools/view/board.h"
#include "tools/view/control.h"
#include "tools/view/view.h"

#include <stdlib.h>
#include <string.h>

static const char default_scene[] = "builtin:demo/race";

/* ------------------------------------------------------------------ values with a form of their own */

static const char *read_out(void *to, const char *value)
{
    ((struct view_options *)to)->out = value;
    return read_name(value, screen_names) >= 0 ? NULL : "needs x11, term, fb, drm or null";
}

const char *view_read_board(const char *value, const struct board **board)
{
    static char wrong[200];
    int used = snprintf(wrong, sizeof wrong, "is no board; there is");
    *board = board_find(value);
    if (*board != NULL)
        return NULL;
    for (const struct board *b = board_list; b->name != NULL && used < (int)sizeof wrong; b++) {
        used += snprintf(wrong + used, sizeof wrong - (size_t)used, " %s%s", b->name, b[1].name != NULL ? "," : "");
        read_near(value, b->name);
    }
    return wrong;
}

static const char *read_board(void *to, const char *value)
{
    const struct board *board;
    (void)to;                   /* its options have been put before all others */
    return view_read_board(value, &board);
}

static const char *read_tint(void *to, const char *value)
{
    struct panel_look *look = &((struct view_options *)to)->look;
    char dark[8];
    unsigned d, l;
    if (strlen(value) != 13 || value[6] != ',')
        return "needs RRGGBB,RRGGBB: dark and lit";
    memcpy(dark, value, 6);
    dark[6] = '\0';
    if (!read_color(dark, &d) || !read_color(value + 7, &l))
        return "needs RRGGBB,RRGGBB: dark and lit";
    look->has_tint = true;
    look->dark = d;
    look->lit = l;
    return NULL;
}

/* CORE:HZ */
static const char *read_cpu(void *to, const char *value)
{
    struct view_options *o = to;
    char name[32];
    const char *colon = strrchr(value, ':');
    if (colon == NULL || (size_t)(colon - value) >= sizeof name)
        return "needs CORE:HZ";
    memcpy(name, value, (size_t)(colon - value));
    name[colon - value] = '\0';
    o->core = cost_find(name);
    if (o->core == NULL)
        return "is of no known core (smear help view lists them)";
    return read_number(colon + 1, 1e3, 1e11, &o->cpu_hz) ? NULL
                                                         : "needs a clock from 1e3 to 1e11 Hz";
}

/* N pictures, or frames A to B. */
static const char *read_frames(void *to, const char *value)
{
    struct view_options *o = to;
    long last;
    if (read_range(value, &o->first, &last)) {
        o->frames = last - o->first + 1;
        return NULL;
    }
    return read_integer(value, 1, 999999999, &o->frames) ? NULL
                                                         : "needs a number from 1 to 999999999, or FIRST-LAST";
}

static const char *read_split(void *to, const char *value)
{
    struct view_options *o = to;
    const char *wrong = read_method_name(value, &o->split);
    o->has_split = wrong == NULL;
    return wrong;
}

#define AT(member) OPTION_AT(struct view_options, member)

static const struct option table[] = {
    { "--out", OPTION_READ, .read = read_out },
    { "--board", OPTION_READ, .read = read_board },
    { "--zoom", OPTION_INTEGER, AT(look.zoom), .low = 1, .high = 8 },
    { "--rotate", OPTION_NAME, AT(look.turns), OPTION_NAMES("0", "90", "180", "270") },
    { "--round", OPTION_FLAG, AT(look.round) },
    { "--tint", OPTION_READ, .read = read_tint },
    { "--bus", OPTION_NUMBER, AT(bus.hz), .low = 1, .high = 1e12, .needs = "bits per second" },
    { "--panel-hz", OPTION_NUMBER, AT(bus.panel_hz), .low = 0.1, .high = 1000, .needs = "Hz" },
    { "--sync", OPTION_FLAG, AT(bus.synced) },
    { "--cpu", OPTION_READ, .read = read_cpu },
    { "--pace", OPTION_NAME, AT(pace), .names = pace_names },
    { "--frames", OPTION_READ, .read = read_frames },
    { "--paused", OPTION_FLAG, AT(paused) },
    { "--crc", OPTION_FLAG, AT(crc) },
    { "--check", OPTION_TEXT, AT(check) },
    { "--update", OPTION_FLAG, AT(update) },
    { "--record", OPTION_TEXT, AT(record) },
    { "--play", OPTION_TEXT, AT(play) },
    { "--split", OPTION_READ, .read = read_split },
    { "--see", OPTION_NAME, AT(debug), .names = debug_names },
    { "--figures", OPTION_FLAG, AT(figures) },
    { "--no-shared-memory", OPTION_FLAG, AT(no_shared_memory) },
    { "--colors", OPTION_NAME, AT(colors), OPTION_NAMES("256", "24bit"), OPTION_VALUES(8, 24) },
    { "--times", OPTION_FLAG, AT(times) },
    { .name = NULL },
};

/* ------------------------------------------------------------------ options of a board */

static const char *find_board(int count, char **text)
{
    const char *name = NULL;
    for (int i = 0; i < count && strcmp(text[i], "--") != 0; i++) {
        if (strncmp(text[i], "--board=", 8) == 0)
            name = text[i] + 8;
        else if (strcmp(text[i], "--board") == 0 && i + 1 < count)
            name = text[i + 1];
    }
    return name;
}

/* Whether the user says the option, with this value unless that is null. */
static bool says(int count, char **text, const char *option, const char *value)
{
    const size_t length = strlen(option);
    for (int i = 0; i < count && strcmp(text[i], "--") != 0; i++) {
        const char *said = NULL;
        if (strncmp(text[i], option, length) == 0 && text[i][length] == '=')
            said = text[i] + length + 1;
        else if (strcmp(text[i], option) == 0 && i + 1 < count)
            said = text[i + 1];
        if (said != NULL && (value == NULL || strcmp(said, value) == 0))
            return true;
    }
    return false;
}

/* What a board has goes with its other options: it is left out where what the user says contradicts it. */
static bool goes_with(const char *option, int count, char **text)
{
    static const struct {
        const char *board, *user, *value;
    } contradictions[] = {
        { "--keep-display", "--method", NULL }, { "--keep-display", "--dither", "diffuse" },
        { "--quality", "--target", NULL }, { "--reach", "--tile", NULL }, { "--tile", "--reach", NULL },
    };
    for (size_t i = 0; i < sizeof contradictions / sizeof *contradictions; i++)
        if (strcmp(option, contradictions[i].board) == 0
            && says(count, text, contradictions[i].user, contradictions[i].value))
            return false;
    return true;
}

/* The arguments, the board's before them, so that what the user says goes before it; malloc'ed. */
static char **with_board(int count, char **text, int *all_count)
{
    const char *name = find_board(count, text);
    const struct board *board = name != NULL ? board_find(name) : NULL;
    char **all = calloc((size_t)count + BOARD_MAX_OPTIONS, sizeof *all);
    bool goes = true;
    *all_count = 0;
    for (int i = 0; all != NULL && board != NULL && board->option[i] != NULL; i++) {
        if (strncmp(board->option[i], "--", 2) == 0)        /* else the value of the one before */
            goes = goes_with(board->option[i], count, text);
        if (goes)
            all[(*all_count)++] = (char *)board->option[i];
    }
    for (int i = 0; all != NULL && i < count; i++)
        all[(*all_count)++] = text[i];
    return all;
}

/* ------------------------------------------------------------------ help */

static const char *const help[] = {
    "smear view [SCENE] [options]\n"
    "\n"
    "Shows SCENE (without one, the demo) in a window, in the terminal or on the display, whichever\n"
    "there is, exactly as a device would show it: frames are drawn by what `smear render` uses, and\n"
    "equal options give equal bits. A model begins as `smear show` has it, unless options say which\n"
    "clip, camera or time, or nobody looks (below). All options of `render` that say what is drawn are options of\n"
    "view, too (smear help render); those that name files are not.\n"
    "\n"
    "Where\n"
    "  --out x11|term|fb|drm|null\n"
    "                        a window (by $DISPLAY); the terminal; a framebuffer ($FRAMEBUFFER or\n"
    "                        /dev/fb0); a display (/dev/dri/card*); nowhere [what is there; nowhere\n"
    "                        with --frames and --crc or --check]\n"
    "  --colors 256|24bit    of the terminal [24bit where $COLORTERM says so]\n"
    "  --no-shared-memory    pictures go to the window through its connection\n"
    "\n"
    "The device\n"
    "  --board NAME          options of a device, put before all others; listed below\n"
    "  --zoom 1..8           each pixel enlarged [the largest that fits]\n"
    "  --rotate 0|90|180|270 the panel turned clockwise [0]\n"
    "  --round               only the inscribed circle is seen\n"
    "  --tint RRGGBB,RRGGBB  colours of dark and lit pixels of grey formats\n"
    "  --bus HZ              bits per second to the panel: a frame takes its time on the wire\n"
    "  --panel-hz HZ         refresh of the panel: frames tear where both meet, unless --sync\n"
    "  --sync                frames wait for the panel\n"
    "  --cpu CORE:HZ         an ESTIMATE of the time on this core, from the work that was counted\n"
    "\n",
    "Time\n"
    "  --fps F               frames per second of the animation and, at most, of the screen [30]\n"
    "  --pace time|every|board\n"
    "                        time: frames that come late are left out; every: none is; board: as\n"
    "                        many frames go by as the board is estimated to need for one, and\n"
    "                        motion is that of the longer frame [time; every with --frames]\n"
    "  --paused              nothing moves until it is told to\n"
    "\n"
    "What is seen at first\n"
    "  --split METHOD        left half by this method, right half by --method\n"
    "  --see picture|velocity|depth|tiles|methods|samples|bands\n"
    "  --figures             written over the picture\n"
    "\n"
    "Without a user\n"
    "  --frames N|A-B        ends after N frames, or shows frames A to B\n"
    "  --crc                 prints the CRC-32 of each frame, as `render --stats` has it\n"
    "  --check FILE          exit status 1 unless the frames' CRCs are those in FILE; leaves\n"
    "                        FILE.0000.got.png and FILE.0000.difference.png where they are not\n"
    "  --update              writes FILE, and the accepted pictures beside it: FILE.0000.png ...\n"
    "  --record FILE         writes the user's input, picture by picture\n"
    "  --play FILE           gives it again\n"
    "  --times               prints what drawing and the window took, and with --cpu the estimate\n"
    "\n",
    NULL
};

int view_help_print(void)
{
    for (const char *const *text = help; *text != NULL; text++)
        fputs(*text, stdout);
    printf("Boards\n");
    for (const struct board *b = board_list; b->name != NULL; b++) {
        printf("  %-8s %s\n          ", b->name, b->what);
        for (int i = 0; b->option[i] != NULL; i++)
            printf(" %s", b->option[i]);
        printf("\n");
    }
    printf("\nCores\n ");
    for (const struct cost_core *c = cost_cores; c->name != NULL; c++)
        printf(" %s", c->name);
    printf("\n\nControls\n");
    for (const struct control *c = control_list; c->keys != NULL; c++)
        printf("  %-11s %s\n", c->keys, c->what);
    printf("  Ctrl-C ends it, too. The pointer: drag to orbit, wheel to come closer.\n");
    return STATUS_OK;
}

/* ------------------------------------------------------------------ the command */

static int check(const struct view_options *w, const struct render_options *o)
{
    const struct {
        const char *option;
        bool given;
    } only_render[] = {
        { "-o", o->output != NULL }, { "--depth", o->depth != NULL },
        { "--velocity", o->velocity != NULL }, { "--stats", o->stats != NULL },
        { "--orbit", o->orbit != 0.0 }, { "--repeat", o->repeat > 0 }, { "--exact", o->exact },
    };
    for (size_t i = 0; i < sizeof only_render / sizeof *only_render; i++)
        if (only_render[i].given)
            return say_bad_usage(only_render[i].option, "is an option of render");
    if (w->update && w->check == NULL)
        return say_bad_usage("--update", "goes with --check FILE");
    if (w->check != NULL && w->frames == 0)
        return say_bad_usage("--check", "needs --frames");
    if (w->out != NULL && strcmp(w->out, "null") == 0 && w->frames == 0)
        return say_bad_usage("--out", "null needs --frames");
    if (w->pace == PACE_BOARD && w->core == NULL)
        return say_bad_usage("--pace", "board needs --cpu or --board");
    return STATUS_OK;
}

/* The files that are written: the list of CRCs and its pictures, or those that differ from it, and the user's input. */
static int check_files(struct view_options *w)
{
    static char picture[2][4096];
    static const char *const kinds[2] = { ".got", ".difference" };
    struct failure f = { "" };
    struct apart_output *out = w->output;
    for (int i = 0; w->check != NULL && i < (w->update ? 1 : 2); i++) {
        if (strlen(w->check) + 32 > sizeof picture[i])
            return say_bad_usage("--check", "the name is too long");
        snprintf(picture[i], sizeof picture[i], "%s.%%04d%s.png", w->check, w->update ? "" : kinds[i]);
        *out++ = (struct apart_output){ .path = picture[i], .is_pattern = true, .last = w->frames > 0 ? w->frames - 1 : 0 };
    }
    if (w->update)
        *out++ = (struct apart_output){ .path = w->check };
    *out = (struct apart_output){ .path = w->record };
    if ((w->play != NULL && !file_keep(w->play, &f)) || (w->check != NULL && !w->update && !file_keep(w->check, &f)))
        return say_bad_input("view", &f);
    return apart_check(w->output, VIEW_OUTPUTS);
}

/* Whether a person looks at a model and leaves open how. */
static bool begins_at_its_best(const struct view_options *w, const struct render_options *o)
{
    const bool is_watched = w->frames == 0 && !w->crc && w->check == NULL && w->record == NULL && w->play == NULL;
    return is_watched && o->scene != NULL && source_builtin_name(o->scene) == NULL && o->view.clip == NULL && o->view.camera == NULL
        && !o->view.has_eye && !o->has_time;
}

/* Reads the options again, behind those that show the model at its best. A board's picture stays as the board would draw it. */
static int read_at_its_best(struct view_options *w, struct render_options *o, int count, char **all)
{
    struct show show;
    struct show_texts texts = { .count = 0 };
    struct failure why = { "" };
    bool is_empty, wants_help;
    int status = show_choose_file(o->scene, &o->view, o->has_size ? o->view.aspect : 0.0, &show, &is_empty, &why);
    if (status != STATUS_OK || is_empty)
        return status;                  /* the viewer says of what is empty why */
    const bool is_board = find_board(count, all) != NULL;
    show_add_scene(&texts, &show);
    if (!is_board && !o->has_clear && o->fog.end == 0.0)
        show_add_background(&texts);
    if (!is_board && method_smooths_edges(o->method) && !o->keep_display)
        show_add_smoothness(&texts);
    char **text = calloc((size_t)(texts.count + count), sizeof *text);
    if (text == NULL) {
        fail(&why, "out of memory");
        return say_bad_input("view", &why);
    }
    memcpy(text, texts.text, (size_t)texts.count * sizeof *text);
    memcpy(text + texts.count, all, (size_t)count * sizeof *text);
    status = options_read_seen(o, texts.count + count, text, &wants_help);
    w->spin = show.spin;
    free(text);
    return status;
}

int command_view(int count, char **text)
{
    static struct view view;            /* large, and one is enough */
    static struct render_options options;
    struct failure f = { "" };
    bool wants_help;
    char **all = with_board(count, text, &count);
    if (all == NULL) {
        fail(&f, "out of memory");
        return say_bad_input("view", &f);
    }
    arguments_also(table, &view.wish);
    int status = options_read_seen(&options, count, all, &wants_help);
    if (status == STATUS_OK && !wants_help)
        status = check(&view.wish, &options);
    if (status == STATUS_OK && !wants_help)
        status = check_files(&view.wish);
    if (status == STATUS_OK && !wants_help && begins_at_its_best(&view.wish, &options))
        status = read_at_its_best(&view.wish, &options, count, all);
    free(all);
    if (status == STATUS_OK && wants_help)
        return view_help_print();
    if (status != STATUS_OK)
        return status;
    if (options.scene == NULL)
        options.scene = default_scene;
    return view_run(&view, &options);
}
