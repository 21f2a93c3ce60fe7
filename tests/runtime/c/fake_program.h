/* SPDX-License-Identifier: Apache-2.0 */
/* The loop of a program in the hands of a test: one call for each line of standard input, until `quit`. */
#ifndef FAKE_PROGRAM_H
#define FAKE_PROGRAM_H

#include "port_fake.h"

#include <rcl/error_handling.h>
#include <rcl/types.h>

#include <stdio.h>
#include <string.h>

/* Reads lines and gives those that are not meant for the port to `work`, which may change its copy. Returns 0. */
static inline int run_calls(void (*work)(char * line))
{
  static char copy[4096]; /* the line's memory is used again when time passes */

  for (;;) {
    char * line = fake_read_line();

    if (strcmp(line, "quit") == 0) {
      return 0;
    }
    if (!fake_take_line(line)) {
      (void)snprintf(copy, sizeof(copy), "%s", line);
      work(copy);
    }
  }
}

/* Answers a line with the result of its call and the error's text, and clears the error. */
static inline void report_result(rcl_ret_t result)
{
  printf("ret %d %s\n", (int)result, rcl_get_error_string().str);
  rcl_reset_error();
  (void)fflush(stdout);
}

#endif /* FAKE_PROGRAM_H */
