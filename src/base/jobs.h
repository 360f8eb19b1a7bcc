/* SPDX-License-Identifier: MIT */
/* jobs.h - independent jobs on one or several cores.
 *
 * Core 0 announces a stage (a function and a number of jobs); worker w of n does jobs w, w + n, w + 2n ... and reports.
 * Only loads and stores of single words are needed, so cores without atomic read-modify-write (Cortex-M0+) can take
 * part. */
#ifndef SMEAR_JOBS_H
#define SMEAR_JOBS_H

#include "base/base.h"

/* Words that cores and interrupts share, each written by one of them. */
static inline unsigned word_read(const unsigned *word) { return __atomic_load_n(word, __ATOMIC_ACQUIRE); }
static inline unsigned word_own(const unsigned *word) { return __atomic_load_n(word, __ATOMIC_RELAXED); }

static inline void word_write(unsigned *word, unsigned value)
{
    __atomic_store_n(word, value, __ATOMIC_RELEASE);
}

#define SMEAR_WORKERS_MAX (SMEAR_WITH_WORKERS ? 8 : 1)

typedef void smear_job_fn(void *argument, int job, int worker);

struct smear_jobs {
    int workers;
    smear_job_fn *job;          /* null: the frame is over */
    void *argument;
    int count;
    void (*idle)(void *user);   /* called while waiting; may be null */
    void *user;
    unsigned stage;                          /* written by core 0 */
    unsigned done[SMEAR_WORKERS_MAX];        /* last stage that worker w finished; written by it */
};

/* Runs jobs 0 .. count - 1 and waits for all of them. */
void smear_jobs_run(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count);

/* Lets the other workers go. */
void smear_jobs_end_frame(struct smear_jobs *jobs);

/* Works as a worker other than 0 until the frame is over. */
void smear_jobs_work(struct smear_jobs *jobs, int worker);

#endif
