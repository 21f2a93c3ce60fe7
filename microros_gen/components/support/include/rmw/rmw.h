/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The part of the middleware interface that applications call. Publishing and rmw_serialize need the
 * component `publish`, taking needs `subscribe`, rmw_deserialize needs `cdr_decode`.
 */
#ifndef MICROROS_RMW_RMW_H
#define MICROROS_RMW_RMW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rmw/init.h"
#include "rmw/qos_profiles.h"
#include "rmw/serialized_message.h"
#include "rmw/types.h"
#include "rmw/visibility_control.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/sequence_bound.h"

#ifdef __cplusplus
extern "C" {
#endif

const char * rmw_get_implementation_identifier(void);

/* Returns "cdr". */
const char * rmw_get_serialization_format(void);

/*
 * Encodes into the stream and passes it to the transport; pumps the session once and does not wait, unless
 * `on_full` is block. RMW_RET_OK: the stream has accepted the message. RMW_RET_ERROR: a field above its
 * limit, no room, or no session.
 */
rmw_ret_t rmw_publish(
  const rmw_publisher_t * publisher, const void * ros_message, rmw_publisher_allocation_t * allocation);

/*
 * As rmw_publish, for a message that is already little endian CDR including its four bytes of
 * encapsulation. */
rmw_ret_t rmw_publish_serialized_message(
  const rmw_publisher_t * publisher, const rmw_serialized_message_t * serialized_message,
  rmw_publisher_allocation_t * allocation);

/*
 * Receives without waiting, and decodes the oldest sample; *taken is false if none was received.
 * RMW_RET_ERROR, with a text: a sample was discarded, as described for rcl_take.
 */
rmw_ret_t rmw_take(
  const rmw_subscription_t * subscription, void * ros_message, bool * taken,
  rmw_subscription_allocation_t * allocation);

rmw_ret_t rmw_take_with_info(
  const rmw_subscription_t * subscription, void * ros_message, bool * taken,
  rmw_message_info_t * message_info, rmw_subscription_allocation_t * allocation);

rmw_ret_t rmw_take_serialized_message(
  const rmw_subscription_t * subscription, rmw_serialized_message_t * serialized_message, bool * taken,
  rmw_subscription_allocation_t * allocation);

/* Returns the largest size within the limits, including the encapsulation. `message_bounds` is not used. */
rmw_ret_t rmw_get_serialized_message_size(
  const rosidl_message_type_support_t * type_support,
  const rosidl_runtime_c__Sequence__bound * message_bounds, size_t * size);

/* Writes encapsulation and body. A buffer that is too small is resized by its allocator; otherwise
 * RMW_RET_BAD_ALLOC. */
rmw_ret_t rmw_serialize(
  const void * ros_message, const rosidl_message_type_support_t * type_support,
  rmw_serialized_message_t * serialized_message);

/*
 * Returns the exact size of rmw_serialize's output for this message; RMW_RET_ERROR if the message would be
 * refused. */
rmw_ret_t rmw_uros_get_serialized_message_size(
  const void * ros_message, const rosidl_message_type_support_t * type_support, size_t * size);

/*
 * Reads plain CDR of either byte order into the storage of the message: strings and sequences need `data`
 * and `capacity`, set by the application or __bind. RMW_RET_ERROR, with the member's name, actual and
 * maximum size in the error text: truncated bytes, contents above a capacity, another encapsulation; the
 * contents of the message are then unspecified, its sizes within its capacities. RMW_RET_UNSUPPORTED: a
 * type that this application only sends. Bytes after the message are ignored, as in ROS 2. Keeps no
 * pointer to the buffer.
 */
rmw_ret_t rmw_deserialize(
  const rmw_serialized_message_t * serialized_message, const rosidl_message_type_support_t * type_support,
  void * ros_message);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_RMW_H */
