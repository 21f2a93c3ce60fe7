/* SPDX-License-Identifier: Apache-2.0 */
/* Two tasks log while a third one sets levels and reads counters, as the logger services and an application do. */
#define _POSIX_C_SOURCE 200809L
#include <rcutils/logging_macros.h>

#include <pthread.h>
#include <stdio.h>

enum { TURNS = 2000, LONG = 300 };

static int tasks[] = {1, 2};

static void * log_lines(void * argument)
{
  const int task = *(const int *)argument;

  for (int i = 0; i < TURNS; ++i) {
    RCUTILS_LOG_WARN_NAMED("arm.left", "task %d line %d end", task, i);
    RCUTILS_LOG_DEBUG_NAMED("arm.left", "%*d", (int)LONG, i);
  }
  return NULL;
}

static void * set_levels(void * argument)
{
  (void)argument;
  for (int i = 0; i < TURNS; ++i) {
    const bool all = i % 2 == 0;

    if (
      rcutils_logging_set_logger_level(
        i % 4 < 2 ? "arm" : "arm.right", all ? RCUTILS_LOG_SEVERITY_DEBUG : RCUTILS_LOG_SEVERITY_UNSET) !=
      RCUTILS_RET_OK) {
      return &tasks[0];
    }
    rcutils_logging_set_default_logger_level(all ? RCUTILS_LOG_SEVERITY_INFO : RCUTILS_LOG_SEVERITY_WARN);
    (void)rcutils_logging_get_default_logger_level();
    (void)rcutils_logging_get_logger_level("arm");
    (void)rcutils_logging_get_counts();
  }
  return NULL;
}

int main(void)
{
  pthread_t threads[3];
  void * failed = NULL;

  if (
    pthread_create(&threads[0], NULL, log_lines, &tasks[0]) != 0 ||
    pthread_create(&threads[1], NULL, log_lines, &tasks[1]) != 0 ||
    pthread_create(&threads[2], NULL, set_levels, NULL) != 0) {
    return 1;
  }
  for (int i = 0; i < 3; ++i) {
    void * result = NULL;

    if (pthread_join(threads[i], &result) != 0) {
      return 1;
    }
    failed = result != NULL ? result : failed;
  }
  (void)printf("dropped %u\n", (unsigned)rcutils_logging_get_counts().dropped);
  return failed == NULL ? 0 : 1;
}
