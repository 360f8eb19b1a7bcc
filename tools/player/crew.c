/* SPDX-License-Identifier: MIT */
/* crew.c - see crew.h. Threads sleep between frames; within one they spin in smear_work. */
#include "tools/player/crew.h"

#include <pthread.h>
#include <sched.h>
#include <stdlib.h>

enum { CREW_MAX = 7 };

struct member {
    struct crew *crew;
    int worker;
    pthread_t thread;
};

struct crew {
    pthread_mutex_t mutex;
    pthread_cond_t called;
    smear_context *ctx;         /* of the frame at hand */
    unsigned frame;             /* counts frames */
    bool quits;
    int count;
    struct member member[CREW_MAX];
};

static void *member_main(void *argument)
{
    const struct member *self = argument;
    struct crew *crew = self->crew;
    unsigned seen = 0;
    for (;;) {
        pthread_mutex_lock(&crew->mutex);
        while (crew->frame == seen && !crew->quits)
            pthread_cond_wait(&crew->called, &crew->mutex);
        bool quits = crew->quits;
        smear_context *ctx = crew->ctx;
        seen = crew->frame;
        pthread_mutex_unlock(&crew->mutex);
        if (quits)
            return NULL;
        smear_work(ctx, self->worker);
    }
}

struct crew *crew_start(int workers, struct failure *f)
{
    struct crew *crew = calloc(1, sizeof *crew);
    if (crew == NULL) {
        fail(f, "out of memory");
        return NULL;
    }
    pthread_mutex_init(&crew->mutex, NULL);
    pthread_cond_init(&crew->called, NULL);
    for (int i = 0; i < workers - 1 && i < CREW_MAX; i++) {
        struct member *member = &crew->member[i];
        *member = (struct member){ .crew = crew, .worker = i + 1 };
        if (pthread_create(&member->thread, NULL, member_main, member) != 0) {
            fail(f, "cannot start thread %d", i + 1);
            crew_stop(crew);
            return NULL;
        }
        crew->count++;
    }
    return crew;
}

int crew_render(struct crew *crew, smear_context *ctx)
{
    if (crew != NULL) {
        pthread_mutex_lock(&crew->mutex);
        crew->ctx = ctx;
        crew->frame++;
        pthread_cond_broadcast(&crew->called);
        pthread_mutex_unlock(&crew->mutex);
    }
    return smear_render(ctx);
}

void crew_stop(struct crew *crew)
{
    if (crew == NULL)
        return;
    pthread_mutex_lock(&crew->mutex);
    crew->quits = true;
    pthread_cond_broadcast(&crew->called);
    pthread_mutex_unlock(&crew->mutex);
    for (int i = 0; i < crew->count; i++)
        pthread_join(crew->member[i].thread, NULL);
    pthread_cond_destroy(&crew->called);
    pthread_mutex_destroy(&crew->mutex);
    free(crew);
}

void crew_idle(void *user)
{
    (void)user;
    sched_yield();
}
