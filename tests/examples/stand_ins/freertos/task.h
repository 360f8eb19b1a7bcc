/* SPDX-License-Identifier: MIT */
/* A stand-in for ESP-IDF: while the first task yields, the bus goes on; another one is a thread. */
#ifndef STAND_INS_TASK_H
#define STAND_INS_TASK_H
#include "../esp_lcd_panel_ops.h"

#include <pthread.h>
#include <sched.h>

static struct { pthread_t thread; void (*run)(void *); bool runs; } stand_in_task;

static inline void stand_in_yield(void)
{
    if (stand_in_task.runs && pthread_equal(pthread_self(), stand_in_task.thread))
        sched_yield();
    else
        stand_in_interrupt();
}

static inline void *stand_in_run(void *user)
{
    stand_in_task.thread = pthread_self();
    stand_in_task.run(user);
    return NULL;
}

static inline int xTaskCreatePinnedToCore(void (*run)(void *), const char *name, unsigned stack, void *user, unsigned priority,
                                          void *handle, int core)
{
    (void)name, (void)stack, (void)priority, (void)handle, (void)core;
    stand_in_task.run = run;
    stand_in_task.runs = pthread_create(&stand_in_task.thread, NULL, stand_in_run, user) == 0;
    return stand_in_task.runs;
}

/* Goes on by a thirtieth of a second each time it is read. */
static inline uint32_t xTaskGetTickCount(void)
{
    static uint32_t frames;
    return frames++ * 1000 / 30;
}

#define portTICK_PERIOD_MS 1
#define taskYIELD() stand_in_yield()
#define vTaskDelay(ticks) stand_in_yield()
#endif
