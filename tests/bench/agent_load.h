/* SPDX-License-Identifier: Apache-2.0 */
/* What the bench's XRCE client and its ROS 2 peer share: numbered samples, credit, pace. */
#ifndef MICROROS_BENCH_AGENT_LOAD_H
#define MICROROS_BENCH_AGENT_LOAD_H

#include <netinet/in.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum {
  AGENT_LOAD_DIGITS = 8,
  AGENT_LOAD_SAMPLE_MINIMUM = 4 + AGENT_LOAD_DIGITS + 1,
  AGENT_LOAD_PROGRESS_STEP = 64, /* samples for a byte of credit */
  AGENT_LOAD_CREDITS = 6         /* bytes of credit in the beginning: samples under way are bounded by it */
};

/* Write the CDR body of a std_msgs/msg/String of `size` bytes, whose text begins with `number`. */
static inline void agent_load_fill(uint8_t * body, size_t size, uint32_t number)
{
  uint32_t text = (uint32_t)size - 4U;

  memset(&body[4], '.', size - 5U);
  body[size - 1U] = 0;
  for (unsigned i = 0; i < 4U; ++i) {
    body[i] = (uint8_t)(text >> 8U * i & 0xFFU);
  }
  for (unsigned i = AGENT_LOAD_DIGITS; i > 0U; --i) {
    body[3U + i] = (uint8_t)('0' + number % 10U);
    number /= 10U;
  }
}

/* Return the number of a sample. */
static inline uint32_t agent_load_number(const uint8_t * body)
{
  uint32_t number = 0;

  for (unsigned i = 0; i < AGENT_LOAD_DIGITS; ++i) {
    number = number * 10U + (uint32_t)(body[4U + i] - '0');
  }
  return number;
}

/* Let the other side send PROGRESS_STEP samples more, `times` times. */
static inline void agent_load_credit(int descriptor, size_t times)
{
  static const uint8_t credit[AGENT_LOAD_CREDITS] = {0};

  if (write(descriptor, credit, times) != (ssize_t)times) {
    perror("credit");
    exit(1);
  }
}

/* Sleep until a moment of CLOCK_MONOTONIC, in nanoseconds. */
static inline void agent_load_wait_until(int64_t moment)
{
  struct timespec then = {.tv_sec = moment / 1000000000, .tv_nsec = moment % 1000000000};

  (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &then, NULL);
}

#endif
