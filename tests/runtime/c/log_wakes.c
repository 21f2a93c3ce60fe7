/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lines that threads log while nothing else happens: log_wakes MS ROUNDS. Prints how often threads of the process went to sleep
 * within MS without any line. Then in each of ROUNDS, WRITERS threads log a line at once, and the agent of test_task_wakes.py
 * sends a sample when it has them all: a wait that does not end for one of them ends the program.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit_spinner.h"

#include <rcutils/logging_macros.h>

#include <time.h>

enum { WRITERS = 4, MS_AT_MOST = 20000, PHASES = 7 };

static pthread_barrier_t begins;
static uint32_t rounds;

/* So that lines come at all moments of the session's task: before its wait, in it, and after it. */
static void rest(uint32_t round)
{
  const struct timespec time = {0, (long)(round % (uint32_t)PHASES) * 150000L};

  (void)nanosleep(&time, NULL);
}

static void * write_lines(void * argument)
{
  const unsigned number = *(const unsigned *)argument;

  for (uint32_t i = 0; i < rounds; ++i) {
    (void)pthread_barrier_wait(&begins);
    RCUTILS_LOG_WARN_NAMED("writer", "writer %u round %u", number, (unsigned)i);
  }
  return NULL;
}

static void await(uint32_t samples)
{
  for (uint32_t i = 0; i < 2u * (uint32_t)MS_AT_MOST && heard_now() < samples; ++i) {
    const struct timespec half = {0, 500000L};

    (void)nanosleep(&half, NULL);
  }
  CHECK(heard_now() == samples);
}

static void run_rounds(void)
{
  unsigned numbers[WRITERS];
  pthread_t threads[WRITERS];

  CHECK(pthread_barrier_init(&begins, NULL, (unsigned)WRITERS + 1u) == 0);
  for (unsigned i = 0; i < (unsigned)WRITERS; ++i) {
    numbers[i] = i;
    CHECK(pthread_create(&threads[i], NULL, write_lines, &numbers[i]) == 0);
  }
  for (uint32_t i = 0; i < rounds; ++i) {
    rest(i);
    (void)pthread_barrier_wait(&begins);
    await(i + 1u);
  }
  for (unsigned i = 0; i < (unsigned)WRITERS; ++i) {
    CHECK(pthread_join(threads[i], NULL) == 0);
  }
}

int main(int count, char * arguments[])
{
  CHECK(count == 3);
  rounds = (uint32_t)strtoul(arguments[2], NULL, 10);
  spinner_open();
  spinner_start();
  (void)printf("%lu\n", spinner_sleeps((uint32_t)strtoul(arguments[1], NULL, 10)));
  run_rounds();
  spinner_stop();
  return 0;
}
