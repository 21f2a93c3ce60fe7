/* SPDX-License-Identifier: Apache-2.0 */
/* Times of an executor in one task. Each wraps to 0 after 71 minutes; reports are at most one hour apart. */
#include "microros/port_diagnosis.h"
#include "microros/rcl_diagnosis.h"
#include "microros/rcl_diagnosis_hooks.h"

enum { SHORTEST_US = 1000, PERCENT = 100 };

typedef struct times_t {
  uint32_t since_us; /* start of what is measured */
  uint32_t idle_us;  /* of it */
  uint32_t rest_us;  /* start of the present wait */
  uint32_t round_us; /* start of the present round */
  uint32_t rounds;
  uint32_t longest_us;
  uint32_t missed;
} times_t;

static times_t times;

void rcl_diagnosis_times_begin(void)
{
  times.since_us = port_time_us();
  times.idle_us = 0;
}

int32_t rcl_diagnosis_busy(void)
{
  const uint32_t total_us = port_time_us() - times.since_us;
  const uint32_t busy_us = times.idle_us < total_us ? total_us - times.idle_us : 0u;
  uint32_t share;

  rcl_diagnosis_times_begin();
  if (total_us < (uint32_t)SHORTEST_US) {
    return -1;
  }
  share = busy_us / (total_us / (uint32_t)PERCENT);
  return share < (uint32_t)PERCENT ? (int32_t)share : (int32_t)PERCENT;
}

void rcl_diagnosis_rests(void)
{
  times.rest_us = port_time_us();
}

void rcl_diagnosis_rested(void)
{
  times.idle_us += port_time_us() - times.rest_us;
}

void rcl_diagnosis_round_begins(void)
{
  times.round_us = port_time_us();
}

void rcl_diagnosis_round_ends(void)
{
  const uint32_t took_us = port_time_us() - times.round_us;

  ++times.rounds;
  if (took_us > times.longest_us) {
    times.longest_us = took_us;
  }
  if (MICROROS_DIAGNOSIS_DEADLINE_US != 0u && took_us > MICROROS_DIAGNOSIS_DEADLINE_US) {
    ++times.missed;
  }
}

uint32_t rcl_diagnosis_rounds(void)
{
  return times.rounds;
}

uint32_t rcl_diagnosis_longest_us(void)
{
  return times.longest_us;
}

uint32_t rcl_diagnosis_missed(void)
{
  return times.missed;
}
