/* SPDX-License-Identifier: Apache-2.0 */
/* For what a component sends by itself, which must neither wait nor displace a message of the application. Internal. */
#ifndef MICROROS_XRCE_WRITE_ROOM_H
#define MICROROS_XRCE_WRITE_ROOM_H

#include <stdbool.h>
#include <stddef.h>

#include "microros/lock.h"
#include "microros/xrce_write.h"

/* Returns whether there is a session, and room in the stream of this data writer, requester or replier. Takes the lock. */
static inline bool xrce_write_has_room(const xrce_endpoint_t * writer)
{
  bool result;

  microros_lock();
  result = xrce_write_reserve(writer) != NULL;
  microros_unlock();
  return result;
}

#endif /* MICROROS_XRCE_WRITE_ROOM_H */
