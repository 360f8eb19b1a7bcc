/* SPDX-License-Identifier: MIT */
/* test_jobs.c - independent jobs on one core and on several: each exactly once, all done when the
 * call returns. Host only: threads. */
#include "base/jobs.h"

#include "tests/host.h"

#include <pthread.h>
#include <sched.h>

enum { JOBS = 200, FRAMES = 20 };

static int done[JOBS], by[JOBS];

static void count_job(void *argument, int job, int worker)
{
    (void)argument;
    done[job]++;
    by[job] = worker;
}

static void nap(void *user)
{
    (void)user;
    sched_yield();
}

static void test_one_core_does_the_jobs_in_order(void)
{
    struct smear_jobs jobs = { .workers = 1 };
    for (int count = 0; count <= 3; count++) {
        memset(done, 0, sizeof done);
        smear_jobs_run(&jobs, count_job, NULL, count);
        for (int i = 0; i < JOBS; i++) {
            CHECK_EQ(done[i], i < count);
            CHECK(i >= count || by[i] == 0);
        }
    }
    smear_jobs_end_frame(&jobs);        /* nobody to wait for */
}

static struct smear_jobs shared;

struct core {
    int worker;
};

static void *work(void *argument)
{
    const struct core *core = argument;
    for (int frame = 0; frame < FRAMES; frame++)
        smear_jobs_work(&shared, core->worker);
    return NULL;
}

static void test_every_job_is_done_once_whatever_the_number_of_cores(void)
{
    for (int workers = 2; workers <= SMEAR_WORKERS_MAX; workers++) {
        memset(&shared, 0, sizeof shared);
        shared.workers = workers;
        shared.idle = nap;
        pthread_t thread[SMEAR_WORKERS_MAX];
        struct core core[SMEAR_WORKERS_MAX];
        for (int i = 1; i < workers; i++) {
            core[i].worker = i;
            CHECK_EQ(pthread_create(&thread[i], NULL, work, &core[i]), 0);
        }
        for (int frame = 0; frame < FRAMES; frame++) {
            for (int stage = 0; stage < 5; stage++) {
                int count = stage * 37 % JOBS;
                memset(done, 0, sizeof done);
                smear_jobs_run(&shared, count_job, NULL, count);
                for (int i = 0; i < JOBS; i++) {
                    CHECK_EQ(done[i], i < count);
                    CHECK(i >= count || (SMEAR_CLAIMS || SMEAR_TICKETS ? by[i] >= 0 && by[i] < workers : by[i] == i % workers));
                }
            }
            smear_jobs_end_frame(&shared);
        }
        for (int i = 1; i < workers; i++)
            pthread_join(thread[i], NULL);
    }
}

/* What a job wrote is seen by the next stage's jobs on other cores. */
static int chain[JOBS];

static void pass_on(void *argument, int job, int worker)
{
    const int *stage = argument;
    (void)worker;
    /* The neighbour's value belongs to another worker of the stage before. */
    if (*stage & 1)
        chain[job] = done[(job + 1) % JOBS] + 1;
    else
        done[job] = chain[(job + 1) % JOBS] + 1;
}

static void test_a_stage_sees_all_that_the_stage_before_wrote(void)
{
    memset(&shared, 0, sizeof shared);
    shared.workers = 3;
    shared.idle = nap;
    pthread_t thread[3];
    struct core core[3];
    for (int i = 1; i < 3; i++) {
        core[i].worker = i;
        CHECK_EQ(pthread_create(&thread[i], NULL, work, &core[i]), 0);
    }
    for (int frame = 0; frame < FRAMES; frame++) {
        memset(done, 0, sizeof done);
        memset(chain, 0, sizeof chain);
        int last = 0;
        for (int stage = 0; stage < 30; stage++) {
            smear_jobs_run(&shared, pass_on, &stage, JOBS);
            last = stage;
        }
        const int *result = last & 1 ? chain : done;
        for (int i = 0; i < JOBS; i++)
            CHECK_EQ(result[i], 30);
        smear_jobs_end_frame(&shared);
    }
    for (int i = 1; i < 3; i++)
        pthread_join(thread[i], NULL);
}

#include "build/suites/jobs.h"
