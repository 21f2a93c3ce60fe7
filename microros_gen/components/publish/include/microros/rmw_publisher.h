/* SPDX-License-Identifier: Apache-2.0 */
/* Publishers of the middleware layer: opens and closes places. Internal. */
#ifndef MICROROS_RMW_PUBLISHER_H
#define MICROROS_RMW_PUBLISHER_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_names.h"
#include "microros/xrce_objects.h"
#include "rmw/types.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Takes a place for a publisher and waits for its objects. RMW_RET_OK: *publisher is set and belongs to
 * the library; otherwise RMW_RET_UNSUPPORTED, RMW_RET_TIMEOUT or RMW_RET_ERROR with a text. `topic` is
 * valid and not expanded.
 */
rmw_ret_t rmw_publisher_open(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, const char * topic,
  const rmw_qos_profile_t * qos, rmw_publisher_t ** publisher);

/* Releases the place. */
void rmw_publisher_close(rmw_publisher_t * publisher);

bool rmw_publisher_is_open(const rmw_publisher_t * publisher);

/* rmw_publish for an open publisher and a message that is not NULL. */
rmw_ret_t rmw_publisher_write(const rmw_publisher_t * publisher, const void * ros_message);

/* Finds a free place for the writer and fills in its topic and index, and its type if its declaration has
 * separate limits. Returns false, with a text, if no place is free. The place is in use once the client's
 * table of writers contains it. `given` is the topic as passed by the caller. */
bool rmw_publisher_take(xrce_endpoint_t * writer, const rmw_name_t * topic, const char * given);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PUBLISHER_H */
