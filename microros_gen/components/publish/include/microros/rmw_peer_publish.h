/* SPDX-License-Identifier: Apache-2.0 */
/* Other boards that get a message without the agent: none, unless a component replaces this header. Called with the
 * lock held. Internal. */
#ifndef MICROROS_RMW_PEER_PUBLISH_H
#define MICROROS_RMW_PEER_PUBLISH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

/* Returns whether other boards get messages of this publisher. Needs no lock. */
static inline bool rmw_peer_has_route(const xrce_endpoint_t * writer)
{
  (void)writer;
  return false;
}

/* Returns whether nothing is to be sent to the agent. *result is set if the message was not sent to another board. */
static inline bool rmw_peer_publish(const xrce_endpoint_t * writer, const void * message, rmw_ret_t * result)
{
  (void)writer;
  (void)message;
  (void)result;
  return false;
}

/* Same for a CDR body, little endian. */
static inline bool rmw_peer_publish_body(
  const xrce_endpoint_t * writer, const uint8_t * body, size_t size, rmw_ret_t * result)
{
  (void)writer;
  (void)body;
  (void)size;
  (void)result;
  return false;
}

#endif /* MICROROS_RMW_PEER_PUBLISH_H */
