/* SPDX-License-Identifier: Apache-2.0 */
/* Subscriptions of the same image get copies of a message. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_LOCAL_PUBLISH_H
#define MICROROS_RMW_LOCAL_PUBLISH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Copies the message, which stays the caller's, into the queue of each open subscription on the topic. Returns whether
 * nothing is to be sent to the agent; then *result is that of the call: RMW_RET_ERROR, with a text, for a message above
 * its limits, which is delivered nowhere.
 */
bool rmw_local_publish(const xrce_endpoint_t * writer, const void * message, rmw_ret_t * result);

/* Returns whether subscriptions of the image get messages of this publisher. Needs no lock: a table of the plan. */
bool rmw_local_has_route(const xrce_endpoint_t * writer);

/* Same as rmw_local_publish for a CDR body of `size` bytes, little endian. */
bool rmw_local_publish_body(
  const xrce_endpoint_t * writer, const uint8_t * body, size_t size, rmw_ret_t * result);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOCAL_PUBLISH_H */
