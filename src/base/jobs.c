/* SPDX-License-Identifier: MIT */
/* jobs.c - see jobs.h. */
#include "base/jobs.h"

static void do_share(struct smear_jobs *jobs, int worker)
{
#if SMEAR_CLAIMS
    for (int i; (i = __atomic_fetch_add(&jobs->claimed, 1, __ATOMIC_RELAXED)) < jobs->count;)
        jobs->job(jobs->argument, i, worker);
#else
    for (int i = worker; i < jobs->count; i += jobs->workers)
        jobs->job(jobs->argument, i, worker);
#endif
}

static void wait_a_little(struct smear_jobs *jobs)
{
    if (jobs->idle != NULL)
        jobs->idle(jobs->user);
}

static void announce(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count)
{
    jobs->job = job;
    jobs->argument = argument;
    jobs->count = count;
#if SMEAR_CLAIMS
    jobs->claimed = 0;
#endif
    unsigned stage = word_own(&jobs->stage) + 1u;
    word_write(&jobs->stage, stage);
    if (job != NULL)
        do_share(jobs, 0);
    for (int worker = 1; worker < jobs->workers; worker++)
        while (word_read(&jobs->done[worker]) != stage)
            wait_a_little(jobs);
}

void smear_jobs_run(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count)
{
    if (SMEAR_WITH_WORKERS && jobs->workers > 1) {
        announce(jobs, job, argument, count);
        return;
    }
    for (int i = 0; i < count; i++)
        job(argument, i, 0);
}

void smear_jobs_end_frame(struct smear_jobs *jobs)
{
    if (SMEAR_WITH_WORKERS && jobs->workers > 1)
        announce(jobs, NULL, NULL, 0);
}

void smear_jobs_work(struct smear_jobs *jobs, int worker)
{
    for (;;) {
        unsigned last = word_own(&jobs->done[worker]), stage;
        while ((stage = word_read(&jobs->stage)) == last)
            wait_a_little(jobs);
        bool over = jobs->job == NULL;
        if (!over)
            do_share(jobs, worker);
        word_write(&jobs->done[worker], stage);
        if (over)
            return;
    }
}
