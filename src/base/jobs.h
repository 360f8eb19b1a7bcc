/* SPDX-License-Identifier: MIT */
/* jobs.h - independent jobs on one or several cores.
 *
 * Core 0 announces a stage (a function and a number of jobs); workers claim one job after the other and report. Where cores
 * have loads and stores of single words alone (Cortex-M), worker w of n does jobs w, w + n, w + 2n ... instead, or they take
 * turns by tickets (Lamport's bakery) where the program says SMEAR_TICKETS=1. */
#ifndef SMEAR_JOBS_H
#define SMEAR_JOBS_H

#include "base/base.h"

/* Words that cores and interrupts share, each written by one of them. Compilers that have no word for the order of loads and
 * stores keep that of volatile ones; a core that does not (ARMv7-A, ARMv8) gets its barrier by -DSMEAR_BARRIER='...' if it
 * shall work beside another. */
#if SMEAR_GNU && !defined(SMEAR_BARRIER)
static inline unsigned word_read(const unsigned *word) { return __atomic_load_n(word, __ATOMIC_ACQUIRE); }
static inline unsigned word_own(const unsigned *word) { return __atomic_load_n(word, __ATOMIC_RELAXED); }
static inline unsigned word_look(const unsigned *word) { return __atomic_load_n(word, __ATOMIC_SEQ_CST); }
static inline void word_show(unsigned *word, unsigned value) { __atomic_store_n(word, value, __ATOMIC_SEQ_CST); }

static inline void word_write(unsigned *word, unsigned value)
{
    __atomic_store_n(word, value, __ATOMIC_RELEASE);
}
#else
#ifndef SMEAR_BARRIER
#define SMEAR_BARRIER ((void)0)
#endif
static inline unsigned word_own(const unsigned *word) { return *word; }

static inline unsigned word_read(const unsigned *word)
{
    const unsigned value = *(const volatile unsigned *)word;
    SMEAR_BARRIER;
    return value;
}

static inline void word_write(unsigned *word, unsigned value)
{
    SMEAR_BARRIER;
    *(volatile unsigned *)word = value;
}

static inline unsigned word_look(const unsigned *word) { return word_read(word); }

static inline void word_show(unsigned *word, unsigned value)
{
    word_write(word, value);
    SMEAR_BARRIER;
}
#endif

/* Cores take turns elsewhere: word_show() is seen before word_look() looks at another word. All files must agree. */
#ifndef SMEAR_TICKETS
#define SMEAR_TICKETS 0
#endif

#define SMEAR_WORKERS_MAX (SMEAR_WITH_WORKERS ? 8 : 1)

typedef void smear_job_fn(void *argument, int job, int worker);

struct smear_jobs {
    int workers;
    smear_job_fn *job;          /* null: the frame is over */
    void *argument;
    int count;
#if SMEAR_CLAIMS || SMEAR_TICKETS
    int claimed;                /* jobs that some worker does or has done */
#endif
#if SMEAR_TICKETS && !SMEAR_CLAIMS
    unsigned ticket[SMEAR_WORKERS_MAX];      /* 0: does not want a job; TICKET_TAKING; else the least is next */
#endif
    void (*idle)(void *user);   /* called while waiting; may be null */
    void *user;
    unsigned stage;                          /* written by core 0 */
    unsigned done[SMEAR_WORKERS_MAX];        /* last stage that worker w finished; written by it */
};

/* Does so on several cores, in workers/; a null job lets them go. */
void smear_jobs_announce(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count);

/* Runs jobs 0 .. count - 1 and waits for all of them. */
void smear_jobs_run(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count);

/* Lets the other workers go. */
void smear_jobs_end_frame(struct smear_jobs *jobs);

/* Works as a worker other than 0 until the frame is over. */
void smear_jobs_work(struct smear_jobs *jobs, int worker);

#endif
