/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_service_call.h"

#include "microros/lock.h"
#include "microros_config.h"

#include <stddef.h>

/* An executor with rounds in progress; more than one if a callback spins its own executor. */
typedef struct call_rounds_t {
  const rclc_executor_t * executor; /* NULL: free */
  uint32_t depth;
} call_rounds_t;

/* Returns the entry of this executor, or NULL. */
static call_rounds_t * call_rounds_of(const rclc_executor_t * executor)
{
  static call_rounds_t call_rounds[MICROROS_EXECUTORS_MAX];

  for (size_t i = 0; i < MICROROS_EXECUTORS_MAX; ++i) {
    if (call_rounds[i].executor == executor) {
      return &call_rounds[i];
    }
  }
  return NULL;
}

void rclc_service_call_round_begins(const rclc_executor_t * executor)
{
  call_rounds_t * rounds;

  microros_lock();
  rounds = call_rounds_of(executor);
  if (rounds == NULL) {
    rounds = call_rounds_of(NULL);
  }
  if (rounds != NULL) {
    rounds->executor = executor;
    ++rounds->depth;
  }
  microros_unlock();
}

void rclc_service_call_round_ends(const rclc_executor_t * executor)
{
  call_rounds_t * rounds;

  microros_lock();
  rounds = call_rounds_of(executor);
  if (rounds != NULL) {
    --rounds->depth;
    rounds->executor = rounds->depth != 0u ? executor : NULL;
  }
  microros_unlock();
}

bool rclc_service_call_is_in_round(const rclc_executor_t * executor)
{
  bool result;

  microros_lock();
  result = call_rounds_of(executor) != NULL;
  microros_unlock();
  return result;
}
