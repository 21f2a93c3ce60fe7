/* SPDX-License-Identifier: Apache-2.0 */
/* Whether the calling task runs the session and waits for the line; a component with other tasks replaces this header.
 * Internal. */
#ifndef MICROROS_RMW_TURN_H
#define MICROROS_RMW_TURN_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Every task does. */
static inline bool rmw_turn_pumps(void)
{
  return true;
}

/* No task waits for anything else. */
static inline bool rmw_turn_waits(uint32_t timeout_ms, const uint32_t * news)
{
  (void)timeout_ms;
  (void)news;
  return false;
}

/* No task ends. */
static inline bool rmw_turn_is_over(void)
{
  return false;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TURN_H */
