/* SPDX-License-Identifier: MIT */
/* crew.c - jobs on several cores: see base/jobs.h. */
#include "base/jobs.h"

#if SMEAR_WITH_WORKERS

#if SMEAR_TICKETS && !SMEAR_CLAIMS
enum { TICKET_TAKING = 1, TICKET_STEP = 2 };

/* Whether worker `other` is before the one with this ticket, or may be. */
static bool is_before(const struct smear_jobs *jobs, int other, unsigned ticket, int worker)
{
    const unsigned t = word_look(&jobs->ticket[other]);
    return t != 0 && (t < ticket || (t == ticket && other < worker));
}

/* Claims a job; beyond the last one there are none left. */
static int claim(struct smear_jobs *jobs, int worker)
{
    unsigned last = 0;
    word_show(&jobs->ticket[worker], TICKET_TAKING);
    for (int i = 0; i < jobs->workers; i++)
        last = max_u32(last, word_look(&jobs->ticket[i]) & ~(unsigned)TICKET_TAKING);
    const unsigned ticket = last + TICKET_STEP;
    word_show(&jobs->ticket[worker], ticket);
    for (int i = 0; i < jobs->workers; i++)
        while (i != worker && is_before(jobs, i, ticket, worker))
            ;
    const int job = jobs->claimed++;
    word_write(&jobs->ticket[worker], 0);
    return job;
}
#endif

static void do_share(struct smear_jobs *jobs, int worker)
{
#if SMEAR_CLAIMS
    for (int i; (i = __atomic_fetch_add(&jobs->claimed, 1, __ATOMIC_RELAXED)) < jobs->count;)
        jobs->job(jobs->argument, i, worker);
#elif SMEAR_TICKETS
    for (int i; (i = claim(jobs, worker)) < jobs->count;)
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

void smear_jobs_announce(struct smear_jobs *jobs, smear_job_fn *job, void *argument, int count)
{
    jobs->job = job;
    jobs->argument = argument;
    jobs->count = count;
#if SMEAR_CLAIMS || SMEAR_TICKETS
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

#endif
