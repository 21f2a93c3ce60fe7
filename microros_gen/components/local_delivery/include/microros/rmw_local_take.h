/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of the same image that wait for a subscription. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_LOCAL_TAKE_H
#define MICROROS_RMW_LOCAL_TAKE_H

#include <stdbool.h>

#include "microros/xrce_objects.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether a message of the image waits. */
bool rmw_local_is_ready(const xrce_endpoint_t * reader);

/* Returns whether a message waits and the session was pumped in this millisecond: taking it need not pump again. */
bool rmw_local_may_wait(const xrce_endpoint_t * reader);

/* The others do nothing, and return false, if the oldest message is one of the agent. */

/* Describes the oldest message: its two times are that of the publish call, to a millisecond. */
bool rmw_local_describe(const xrce_endpoint_t * reader, rmw_message_info_t * info);

/*
 * Copies it to the caller's message and removes it; *result is that of the call: RMW_RET_ERROR, with a text, if the
 * caller's message has too little memory. */
bool rmw_local_take(const xrce_endpoint_t * reader, void * message, rmw_ret_t * result);

/* Same, but returns the bytes. RMW_RET_BAD_ALLOC: the message stays in its queue. */
bool rmw_local_take_serialized(
  const xrce_endpoint_t * reader, rmw_serialized_message_t * serialized_message, rmw_ret_t * result);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOCAL_TAKE_H */
