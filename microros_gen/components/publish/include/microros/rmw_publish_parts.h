/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Whether a publisher's messages are written in parts while the application provides them: never, unless a component
 * replaces this header. Internal. */
#ifndef MICROROS_RMW_PUBLISH_PARTS_H
#define MICROROS_RMW_PUBLISH_PARTS_H

#include <stdbool.h>

#include "microros/xrce_objects.h"
#include "rmw/types.h"

/* Returns whether it has published the message itself, with *result as that of rmw_publish. */
static inline bool rmw_publish_parts(
  const xrce_endpoint_t * writer, const void * ros_message, rmw_ret_t * result)
{
  (void)writer;
  (void)ros_message;
  (void)result;
  return false;
}

/* Called when a publisher has a new owner. */
static inline void rmw_publish_parts_clear(const xrce_endpoint_t * writer)
{
  (void)writer;
}

#endif /* MICROROS_RMW_PUBLISH_PARTS_H */
