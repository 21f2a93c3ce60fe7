/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A program whose test tells it what to do: one command for each line of standard input, answered with what it prints
 * and "ret CODE TEXT", until the line "end". Meanwhile its executor spins.
 */
#ifndef COMMANDED_H
#define COMMANDED_H

#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rclc/executor.h>

/* Four words at most; NULL where a line has fewer. */
typedef rcl_ret_t (*command_t)(char ** words);

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static bool answer(command_t run)
{
  static char line[256];
  char * words[4] = {NULL};
  size_t count = 0;
  rcl_ret_t result;

  if (fgets(line, sizeof(line), stdin) == NULL || strcmp(line, "end\n") == 0) {
    return false;
  }
  for (char * word = strtok(line, " \n"); word != NULL && count < 4u; word = strtok(NULL, " \n")) {
    words[count++] = word;
  }
  result = run(words);
  (void)printf("ret %d %s\n", (int)result, result == RCL_RET_OK ? "" : rcl_get_error_string().str);
  (void)fflush(stdout);
  rcl_reset_error();
  return true;
}

/* How often a call of the executor failed, as with a request above the limits, and why the last time. */
static unsigned int faults;
static char last_error[512];

/* Returns after "end". */
static void obey(rclc_executor_t * executor, int64_t spin_ms, command_t run)
{
  struct pollfd input = {0, POLLIN, 0};
  bool goes_on = true;

  (void)setvbuf(stdin, NULL, _IONBF, 0);
  while (goes_on) {
    if (rclc_executor_spin_some(executor, RCL_MS_TO_NS(spin_ms)) != RCL_RET_OK) {
      ++faults;
      (void)snprintf(last_error, sizeof(last_error), "%s", rcl_get_error_string().str);
      rcl_reset_error();
    }
    if (poll(&input, 1, 0) > 0) {
      goes_on = answer(run);
    }
  }
}

#endif
