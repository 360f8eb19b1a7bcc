/* SPDX-License-Identifier: MIT */
/* A stand-in for the header of Playdate's SDK: what the example calls of it. Rows that are not marked are not shown. */
#ifndef STAND_INS_PD_API_H
#define STAND_INS_PD_API_H
#include "panel.h"

#define LCD_COLUMNS 400
#define LCD_ROWS 240
#define LCD_ROWSIZE 52

typedef enum { kEventInit, kEventTerminate } PDSystemEvent;
struct playdate_graphics {
    uint8_t *(*getFrame)(void);
    void (*markUpdatedRows)(int start, int end);
};
struct playdate_sys {
    void (*logToConsole)(const char *format, ...);
    void (*setUpdateCallback)(int (*update)(void *user), void *user);
};
typedef struct PlaydateAPI {
    const struct playdate_sys *system;
    const struct playdate_graphics *graphics;
} PlaydateAPI;

static uint8_t stand_in_frame[LCD_ROWS * LCD_ROWSIZE];
static int (*stand_in_update)(void *user);
static void *stand_in_user;

static inline uint8_t *stand_in_get_frame(void) { return stand_in_frame; }

static inline void stand_in_mark(int start, int end)
{
    memcpy(panel_memory + start * LCD_ROWSIZE, stand_in_frame + start * LCD_ROWSIZE, (size_t)(end - start + 1) * LCD_ROWSIZE);
}

static inline void stand_in_log(const char *format, ...) { (void)format; }

static inline void stand_in_set_update(int (*update)(void *user), void *user)
{
    stand_in_update = update;
    stand_in_user = user;
}

static const struct playdate_graphics stand_in_graphics = { stand_in_get_frame, stand_in_mark };
static const struct playdate_sys stand_in_system = { stand_in_log, stand_in_set_update };
static PlaydateAPI stand_in_playdate = { &stand_in_system, &stand_in_graphics };

#endif
