/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of the same image that wait for a subscription: none, unless a component replaces this header. Called with
 * the lock held. Internal. */
#ifndef MICROROS_RMW_LOCAL_TAKE_H
#define MICROROS_RMW_LOCAL_TAKE_H

#include <stdbool.h>

#include "microros/xrce_objects.h"
#include "rmw/types.h"

/* Returns whether a message of the image waits. */
static inline bool rmw_local_is_ready(const xrce_endpoint_t * reader)
{
  (void)reader;
  return false;
}

/* Returns whether a message waits and the session was pumped in this millisecond: taking it need not pump again. */
static inline bool rmw_local_may_wait(const xrce_endpoint_t * reader)
{
  (void)reader;
  return false;
}

/* The others do nothing, and return false, if the oldest message is one of the agent. */

/* Describes the oldest message. */
static inline bool rmw_local_describe(const xrce_endpoint_t * reader, rmw_message_info_t * info)
{
  (void)reader;
  (void)info;
  return false;
}

/* Takes it; *result is that of the call. */
static inline bool rmw_local_take(const xrce_endpoint_t * reader, void * message, rmw_ret_t * result)
{
  (void)reader;
  (void)message;
  (void)result;
  return false;
}

/* Same, but returns the bytes. */
static inline bool rmw_local_take_serialized(
  const xrce_endpoint_t * reader, rmw_serialized_message_t * serialized_message, rmw_ret_t * result)
{
  (void)reader;
  (void)serialized_message;
  (void)result;
  return false;
}

#endif /* MICROROS_RMW_LOCAL_TAKE_H */
