/* SPDX-License-Identifier: MIT */
/* screen_term.c - a terminal as a screen: two pixels in each cell, the upper half block in the
 * colour of the upper one on the colour of the lower one. Only cells that have changed are
 * written. */
#define _DEFAULT_SOURCE                 /* SIGWINCH */
#include "tools/view/screen.h"

#include "tools/view/guard.h"
#include "tools/view/tty.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { MAX_COLUMNS = 1000, MAX_ROWS = 500 };
/* Of a cell: move there, two colours, a block; and what frames a picture. */
enum { MAX_CELL_BYTES = 16 + 2 * 20 + 3, FRAME_BYTES = 64 };

#define TEXT_BACKGROUND 0x101418u

/* Alternate screen, no cursor, drags and wheel as SGR reports. */
static const char enter[] = "\033[?1049h\033[?25l\033[?1002h\033[?1006h\033[2J";
static const char leave[] = "\033[?1006l\033[?1002l\033[0m\033[2J\033[?25h\033[?1049l";

struct cell {
    uint32_t upper, lower;      /* colours, 0x00RRGGBB; of text: letter and background */
    char letter;                /* 0: a picture */
};

struct term {
    struct screen screen;
    int columns, rows;
    uint32_t *pixel;
    struct cell *shown;         /* on the terminal now */
    bool is_blank;              /* nothing is known of what is on the terminal */
    bool is_palette, is_utf8;   /* 256 colours; half blocks can be printed */
    char *bytes;
    size_t size;
};

static volatile sig_atomic_t resized, entered;

static void on_resize(int signal_number)
{
    (void)signal_number;
    resized = 1;
}

/* All that a signal handler may do. */
static void undo(void)
{
    if (entered)
        tty_write_at_once(STDOUT_FILENO, leave, sizeof leave - 1);
    entered = 0;
    tty_restore();
}

static void redo(void)
{
    tty_again();
    entered = 1;
    tty_write(STDOUT_FILENO, enter, sizeof enter - 1);
    resized = 1;
}

static void suspend(void)
{
    guard_suspend(redo);
}

/* ------------------------------------------------------------------ size */

static bool fit(struct term *t, struct failure *f)
{
    struct winsize size = { 0 };
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
        size.ws_col = 80;
        size.ws_row = 24;
    }
    t->columns = size.ws_col < MAX_COLUMNS ? size.ws_col : MAX_COLUMNS;
    t->rows = size.ws_row < MAX_ROWS ? size.ws_row : MAX_ROWS;
    t->screen.width = t->columns;
    t->screen.height = t->rows * 2;
    size_t cells = (size_t)t->columns * (size_t)t->rows;
    free(t->pixel);
    free(t->shown);
    free(t->bytes);
    t->pixel = calloc(cells * 2, sizeof *t->pixel);
    t->shown = calloc(cells, sizeof *t->shown);
    t->bytes = malloc(cells * MAX_CELL_BYTES + FRAME_BYTES);
    t->is_blank = true;
    return (t->pixel != NULL && t->shown != NULL && t->bytes != NULL) || fail(f, "out of memory");
}

/* ------------------------------------------------------------------ bytes */

static void put(struct term *t, const char *text)
{
    size_t length = strlen(text);
    memcpy(t->bytes + t->size, text, length);
    t->size += length;
}

static void put_number(struct term *t, unsigned value)
{
    char digits[12];
    int count = 0;
    do
        digits[count++] = (char)('0' + value % 10);
    while ((value /= 10) != 0);
    while (count > 0)
        t->bytes[t->size++] = digits[--count];
}

/* The nearest of the colour cube and the greys of the 256-colour palette. */
static unsigned palette_index(uint32_t rgb)
{
    static const int level[6] = { 0, 95, 135, 175, 215, 255 };
    int code[3] = { (int)(rgb >> 16 & 255), (int)(rgb >> 8 & 255), (int)(rgb & 255) };
    int cube[3], cube_error = 0, grey_error = 0;
    int grey = (code[0] + code[1] + code[2]) / 3;
    grey = grey < 8 ? 0 : grey > 238 ? 23 : (grey - 8 + 5) / 10;
    for (int i = 0; i < 3; i++) {
        cube[i] = code[i] < 48 ? 0 : code[i] < 115 ? 1 : (code[i] - 35) / 40;
        int c = code[i] - level[cube[i]], g = code[i] - (8 + 10 * grey);
        cube_error += c * c;
        grey_error += g * g;
    }
    return grey_error < cube_error ? 232u + (unsigned)grey
                                   : 16u + (unsigned)(36 * cube[0] + 6 * cube[1] + cube[2]);
}

static void put_color(struct term *t, bool is_background, uint32_t rgb)
{
    if (t->is_palette) {
        put(t, is_background ? "\033[48;5;" : "\033[38;5;");
        put_number(t, palette_index(rgb));
    } else {
        put(t, is_background ? "\033[48;2;" : "\033[38;2;");
        put_number(t, rgb >> 16 & 255);
        put(t, ";");
        put_number(t, rgb >> 8 & 255);
        put(t, ";");
        put_number(t, rgb & 255);
    }
    put(t, "m");
}

static uint32_t mean(uint32_t a, uint32_t b)
{
    return (a & 0xfefefeu) / 2 + (b & 0xfefefeu) / 2;
}

/* What a cell is to show, as far as the terminal can. */
static struct cell cell_at(const struct term *t, const struct text *text, int column, int row)
{
    const char *line = text != NULL && row < text->rows ? text->line[row] : "";
    const uint32_t *p = t->pixel + (size_t)row * 2 * (size_t)t->columns + (size_t)column;
    if (column < (int)strnlen(line, TEXT_COLUMNS))
        return (struct cell){ 0xffffff, TEXT_BACKGROUND, line[column] };
    struct cell cell = { p[0], p[t->columns], 0 };
    if (!t->is_utf8) {
        cell.upper = cell.lower = mean(cell.upper, cell.lower);
        cell.letter = ' ';
    }
    return cell;
}

static bool is_same(struct cell a, struct cell b)
{
    return a.upper == b.upper && a.lower == b.lower && a.letter == b.letter;
}

static void put_picture(struct term *t, const struct text *text)
{
    uint32_t front = UINT32_MAX, back = UINT32_MAX;     /* no colours are set */
    put(t, "\033[?2026h");              /* shown at once, where terminals know that */
    if (t->is_blank)
        put(t, "\033[0m\033[2J");
    for (int row = 0; row < t->rows; row++) {
        bool is_here = false;           /* the cursor is at this cell */
        for (int column = 0; column < t->columns; column++) {
            struct cell cell = cell_at(t, text, column, row);
            struct cell *shown = &t->shown[(size_t)row * (size_t)t->columns + (size_t)column];
            if (!t->is_blank && is_same(cell, *shown)) {
                is_here = false;
                continue;
            }
            if (!is_here) {
                put(t, "\033[");
                put_number(t, (unsigned)row + 1);
                put(t, ";");
                put_number(t, (unsigned)column + 1);
                put(t, "H");
            }
            if (cell.upper != front && cell.letter != ' ')
                put_color(t, false, front = cell.upper);
            if (cell.lower != back)
                put_color(t, true, back = cell.lower);
            if (cell.letter != 0)
                put(t, (const char[2]){ cell.letter, '\0' });
            else
                put(t, "\342\226\200");
            *shown = cell;
            is_here = true;
        }
    }
    put(t, "\033[0m\033[?2026l");
    t->is_blank = false;
}

/* ------------------------------------------------------------------ the screen */

static bool term_show(struct screen *screen, const struct text *text, struct failure *f)
{
    struct term *t = (struct term *)screen;
    t->size = 0;
    put_picture(t, text);
    return tty_write(STDOUT_FILENO, t->bytes, t->size) || fail(f, "the terminal is gone");
}

static bool term_surface(struct screen *screen, struct surface *out, struct failure *f)
{
    struct term *t = (struct term *)screen;
    (void)f;
    *out = (struct surface){ screen->width, screen->height, (size_t)screen->width, t->pixel };
    return true;
}

static bool term_event(struct screen *screen, int wait_ms, struct event *out)
{
    struct term *t = (struct term *)screen;
    if (!resized && !tty_event(wait_ms, suspend, out) && !resized)
        return false;
    if (resized) {
        struct failure f = { "" };
        resized = 0;
        *out = (struct event){ .kind = EVENT_RESIZE };
        if (!fit(t, &f)) {
            screen->lost = f;
            out->kind = EVENT_LOST;
        }
    } else if (out->kind == EVENT_LOST) {
        fail(&screen->lost, "the terminal is gone");
    }
    return true;
}

static void term_close(struct screen *screen)
{
    struct term *t = (struct term *)screen;
    undo();
    guard_set(NULL);
    tty_close();
    free(t->pixel);
    free(t->shown);
    free(t->bytes);
    free(t);
}

/* ------------------------------------------------------------------ opening */

static const char *environment(const char *name)
{
    const char *value = getenv(name);
    return value != NULL ? value : "";
}

static bool has_24_bits(void)
{
    const char *colors = environment("COLORTERM");
    return strstr(colors, "truecolor") != NULL || strstr(colors, "24bit") != NULL ||
           strstr(environment("TERM"), "direct") != NULL;
}

static bool is_utf8(void)
{
    static const char *const names[] = { "LC_ALL", "LC_CTYPE", "LANG" };
    for (int i = 0; i < 3; i++) {
        const char *value = environment(names[i]);
        if (value[0] == '\0')
            continue;
        const char *dot = strrchr(value, '.');
        return dot != NULL && (strcasecmp(dot, ".utf-8") == 0 || strcasecmp(dot, ".utf8") == 0);
    }
    return false;
}

static struct screen *term_open(const struct screen_wish *wish, struct failure *f)
{
    const char *name = environment("TERM");
    if (!isatty(STDOUT_FILENO)) {
        fail(f, "standard output is no terminal");
        return NULL;
    }
    if (name[0] == '\0' || strcmp(name, "dumb") == 0) {
        fail(f, "TERM=%s cannot show pictures", name);
        return NULL;
    }
    struct term *t = calloc(1, sizeof *t);
    if (t == NULL || !fit(t, f) || !tty_open(f)) {
        if (t != NULL) {
            free(t->pixel);
            free(t->shown);
            free(t->bytes);
        }
        free(t);
        fail(f, "out of memory");
        return NULL;
    }
    t->is_palette = wish->colors != 0 ? wish->colors == 8 : !has_24_bits();
    t->is_utf8 = is_utf8();
    t->screen.kind = &screen_term;
    t->screen.has_text = true;
    snprintf(t->screen.what, sizeof t->screen.what, "terminal, %s, %s",
             t->is_palette ? "256 colours" : "24 bits", t->is_utf8 ? "half blocks" : "whole cells");
    struct sigaction action = { .sa_handler = on_resize };
    sigemptyset(&action.sa_mask);
    sigaction(SIGWINCH, &action, NULL);
    entered = 1;
    guard_set(undo);
    if (!tty_write(STDOUT_FILENO, enter, sizeof enter - 1)) {
        fail(f, "the terminal is gone");
        term_close(&t->screen);
        return NULL;
    }
    return &t->screen;
}

const struct screen_kind screen_term = { "term", term_open, term_surface, term_show, term_event,
                                         term_close };
