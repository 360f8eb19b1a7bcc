/* SPDX-License-Identifier: MIT */
/* jobs.c - see jobs.h. */
#include "base/jobs.h"

void smear_jobs_run(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count)
{
    if (SMEAR_WITH_WORKERS && jobs->workers > 1) {
        smear_jobs_announce(jobs, job, argument, count);
        return;
    }
    for (int i = 0; i < count; i++)
        job(argument, i, 0);
}

void smear_jobs_end_frame(struct smear_jobs *jobs)
{
    if (SMEAR_WITH_WORKERS && jobs->workers > 1)
        smear_jobs_announce(jobs, NULL, NULL, 0);
}
