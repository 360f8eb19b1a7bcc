/* SPDX-License-Identifier: MIT */
/* lines.h - the still scene of a frame whose camera moves: one to four sharp pictures of it, at even instants of the exposure, whose
 * mean is blurred along the line on which the camera's motion takes each block of pixels until the next picture.
 *
 * The plain form of [GPUGems3] chapter 27: what a block's depth and two cameras say holds for the whole block, and its taps
 * weigh alike. Nothing is done per vertex. The window keeps the rows that lines reach.
 *
 * A line errs by a share of what pixels beside each other differ by, more where blocks beside each other go unlike ways: the more
 * pictures, the less. A frame begins with as many as the last would have been good with; where what is seen so far says that they
 * are too few, what is left of it takes more: as if it had three quarters of that contrast. */
#ifndef SMEAR_LINES_H
#define SMEAR_LINES_H

#include "base/pixel.h"
#include "geometry/reproject.h"
#include "geometry/shot.h"
#include "raster/window.h"

enum {
    LINE_PICTURES = 4,              /* at most */
    LINE_MOVERS = 2,                /* of what moves by itself (line_movers.h), at most */
    LINE_BEHIND = LINE_PICTURES,    /* number of the picture of what stands still behind all of them */
    LINE_ROWS_SEEN = 4,             /* tile rows of blocks that are kept: the one that is blurred, those around it, and one more */
    LINE_LISTS = LINE_BEHIND + LINE_MOVERS              /* in bins.more_last: of pictures from the second on, then of movers */
};

/* Targets so coarse that lines do; and those for which little is measured of what lines do not blur: from 7 codes on. */
static inline bool target_has_lines(int32_t target) { return SMEAR_WITH_LINES && target >= SMEAR_DRAFT; }
static inline bool target_is_sketch(int32_t target) { return SMEAR_WITH_LINES && target >= SMEAR_SKETCH - 64; }

static inline int line_list(int picture) { return picture - 1; }
static inline int line_movers_list(int picture) { return LINE_BEHIND + picture; }

/* What a block of pixels shows. */
struct smear_line_seen {
    uint16_t depth;                 /* the nearest of some pixels */
    uint16_t contrast;              /* between some and those beside and below them: sum of squares of codes / 16. Of one that is bare, once
                                     * it is blurred, the depth of what passes it */
    int16_t x, y;                   /* displacement from picture to picture, px */
};

struct smear_lines {
    bool on;                        /* in this frame */
    smear_transfer transfer;
    uint8_t pictures;               /* of what stands still */
    uint8_t picture;                /* that is assembled and drawn */
    struct smear_instant instant[LINE_PICTURES], mover_instant[LINE_MOVERS];
    struct smear_flow flow;         /* how what stands still moves on the screen */
    uint32_t list[LINE_LISTS];      /* of the row */
    int32_t drawn;                  /* pixel rows so far, and tile rows that are finished */
    int finished;
    uint32_t contrast;              /* of the blocks drawn, together, where they move: as each block's */
    uint32_t blocks;
    uint64_t error;                 /* squared, by lines, q16 of the contrast */
    struct smear_line_seen *seen;   /* of the row that is drawn and LINE_ROWS_SEEN - 1 above it */
    uint32_t *row;                  /* pixels of a tile row: of a further picture, then blurred ones */
    uint16_t *depth;                /* of a further picture, then of the blurred one: planes of a target are alike */
    uint16_t movers, behind;        /* draws that are */
    uint8_t most;                   /* pictures in this frame */
    uint8_t wait;                   /* frames by instants after one that lines did not do for */
    bool takes_movers;              /* else they are drawn at instants */
    bool measures;                  /* how many these are is measured: there was no room for a mover */
    uint32_t room;                  /* for movers that lines may still take: pixels times how far they go, px */
    bool twice;                     /* one picture of one of them does not do, so that there are two of all */
    uint8_t *kind;                  /* of each draw: enum smear_line_kind */
    struct smear_flow *own;         /* of each draw that has one */
    struct smear_line_block *block; /* of the tile row */
    uint32_t *over;                 /* its pixels, blurred ones with movers over them */
};

static inline int line_mover_pictures(const struct smear_lines *lines)
{
    return lines->twice ? min_i32(lines->pictures, LINE_MOVERS) : 1;
}

/* How a draw goes: with what stands still or drawn at instants, or it is a mover, which stays where it is on the screen or not. What
 * stays there far away is drawn into the pictures, too, where they show nothing nearer: lines take pixels from there. */
enum smear_line_kind { LINE_GOES_ALONG, LINE_IS_BEHIND, LINE_IS_STILL, LINE_MOVES };

static inline bool line_is_mover(const struct smear_lines *lines, uint32_t draw) { return lines->kind[draw] != LINE_GOES_ALONG; }
static inline bool line_is_behind(const struct smear_lines *lines, uint32_t draw) { return lines->kind[draw] == LINE_IS_BEHIND; }

/* Pixels that share a displacement are so many wide and high. */
enum { LINE_BLOCK_LOG2 = 3, LINE_BLOCK = 1 << LINE_BLOCK_LOG2 };

/* How movers pass a block. */
struct smear_line_block {
    int16_t x, y;                   /* displacement, px */
    uint16_t depth;                 /* the nearest of what they show there; 1: nothing, 0: it is not known */
    uint16_t mover;                 /* the number of the draw that goes so, from 1 on */
};

static inline int32_t line_blocks(int32_t pixels) { return (pixels + LINE_BLOCK - 1) >> LINE_BLOCK_LOG2; }

/* Whether what has these transforms at the shot's first pose and in its middle turns over the exposure by an angle of which a third of the
 * square is more than of / parts, about. What grows or shrinks counts, too. */
bool smear_lines_turn(const struct smear_shot *shot, const smear_transform *open, const smear_transform *middle, int32_t parts, int32_t of);

/* Begins a frame whose camera moves, of which an error of `target` is asked, 1/64 codes. Smoothed edges have one picture. Returns false
 * where it turns too far for lines. */
bool smear_lines_begin(struct smear_lines *lines, const struct smear_shot *shot, const struct smear_window *w, int32_t target,
                       smear_transfer transfer, bool smooth);

/* Forgets what the rows before showed. */
static inline void lines_forget(struct smear_lines *lines)
{
    lines->contrast = 0;
    lines->blocks = lines->wait = 0;
}

/* From here on there are so many pictures. */
void smear_lines_take(struct smear_lines *lines, const struct smear_shot *shot, int pictures);

/* Returns how many it takes for an error of `target`, 1/64 codes, from the tile row of pixel rows [y0, y1) on, which has been drawn and
 * displaced: more than lines->most where no number will do. Where it takes no more than now, that row is noted. */
int smear_lines_needed(struct smear_lines *lines, const struct smear_window *w, int32_t y0, int32_t y1, int32_t target);

/* Makes the flow of what stands still before three cameras, those of the shot's poses. */
void smear_lines_make_flow(struct smear_flow *flow, const struct smear_shot *shot, const struct smear_window *w,
                           const smear_camera *camera);

/* Finds the displacement from one of so many pictures to the next of what is seen at a pixel, in whole pixels (q8), so that blocks
 * beside each other often have the same, and no longer along y than lines reach. Returns how long it is before that, q8 px. */
int32_t smear_lines_displacement(int32_t out[2], int pictures, const struct smear_flow *flow, const struct smear_window *w, int32_t x,
                                 int32_t y, uint32_t depth);

/* Blurs the blocks of columns [x0, x1) of a row of them along a displacement. Where taps of a block would lie beside the frame, or
 * beyond its rows [first, end), it takes what is inside. */
void smear_lines_blur_blocks(const struct smear_lines *lines, const struct smear_window *w, const int32_t d[2], int32_t x0, int32_t x1,
                             int32_t y0, int32_t y1, int32_t first, int32_t end);

/* Notes what columns [x0, x1) of pixel rows [y0, y1), a tile row, show in the picture that has been drawn. */
void smear_lines_look(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1);

/* Points at the depth of a pixel: in the picture that is drawn, and in the one before which movers are seen. */
static inline uint16_t *line_depth(const struct smear_lines *lines, const struct smear_window *w, int32_t x, int32_t y)
{
    return lines->depth + (y & (w->tile - 1)) * w->width + x;
}

static inline uint16_t *window_depth(const struct smear_window *w, int32_t x, int32_t y)
{
    return w->depth + window_ring_row(w, y) * w->width + x;
}

/* Copies the depth of columns [x0, x1) of rows [y0, y1) of the window to lines->depth, or back. */
void smear_lines_copy_depth(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1,
                            bool back);

/* Finds the displacements of the blocks of columns [x0, x1) of a tile row whose pictures have been looked at. */
void smear_lines_displace(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1);

/* Blurs columns [x0, x1) of pixel rows [y0, y1) of a tile row into lines->row; x0 and y0 are multiples of 8. */
void smear_lines_blur(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1);

#endif
