/* SPDX-License-Identifier: MIT */
/* jobs.h - independent jobs on one or several cores.
 *
 * Core 0 announces a stage (a function and a number of jobs); every worker w does jobs w, w + n, w + 2n ... and reports.
 * Only loads and stores of single words are needed, so cores without atomic read-modify-write (Cortex-M0+) can play. */
#ifndef SMEAR_JOBS_H
#define SMEAR_JOBS_H

#include "base.h"

#include <stdatomic.h>

#define SMEAR_WORKERS_MAX 8

typedef void smear_job_fn(void *argument, int job, int worker);

struct smear_jobs {
    int workers;
    smear_job_fn *job;          /* null: the frame is over */
    void *argument;
    int count;
    void (*idle)(void *user);   /* called while waiting; may be null */
    void *user;
    atomic_uint stage;                          /* written by core 0 */
    atomic_uint done[SMEAR_WORKERS_MAX];        /* last stage that worker w finished; written by it */
};

/* Runs jobs 0 .. count - 1 and waits for all of them. */
void smear_jobs_run(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count);

/* Lets the other workers go. */
void smear_jobs_end_frame(struct smear_jobs *jobs);

/* What a worker other than 0 does until the frame is over. */
void smear_jobs_work(struct smear_jobs *jobs, int worker);

#endif
