/* SPDX-License-Identifier: Apache-2.0 */
/* What the examples share: how they end, and how they tell what went wrong. On a board without signals and a console
 * these few lines become its own; the examples stay as they are. */
#ifndef EXAMPLES_EXAMPLE_H
#define EXAMPLES_EXAMPLE_H

#include <rcl/error_handling.h>
#include <rcl/types.h>

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

static volatile sig_atomic_t example_signal;

static inline void example_note_signal(int number)
{
  example_signal = number;
}

/* From now on Ctrl-C (or kill) lets the program delete its entities and end; each line is printed at once. */
static inline void example_begin(void)
{
  (void)signal(SIGINT, example_note_signal);
  (void)signal(SIGTERM, example_note_signal);
  (void)setvbuf(stdout, NULL, _IOLBF, 0);
}

/* Returns whether nobody has asked it to end. */
static inline bool example_runs(void)
{
  return example_signal == 0;
}

/* Tells what the library says of a call that failed. Returns whether it succeeded. */
static inline bool example_tell(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: error %d: %s\n", what, (int)result, rcl_get_error_string().str);
    rcl_reset_error();
  }
  return result == RCL_RET_OK;
}

/* The same, and ends the program. */
static inline void example_check(rcl_ret_t result, const char * what)
{
  if (!example_tell(result, what)) {
    exit(EXIT_FAILURE);
  }
}

#endif /* EXAMPLES_EXAMPLE_H */
