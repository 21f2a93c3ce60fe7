/* SPDX-License-Identifier: Apache-2.0 */
/* The file and its function are spelled as in micro-ROS. */
#ifndef MICROROS_RMW_MICROROS_CONTINOUS_SERIALIZATION_H
#define MICROROS_RMW_MICROROS_CONTINOUS_SERIALIZATION_H

/**
 * @file Messages that are larger than the memory of the device: the application writes the rest of a message while
 * rcl_publish sends it.
 *
 * rcl_publish encodes the given message, calls the first callback for the size of the whole and the second one to write
 * the rest. It returns when the agent has acknowledged all of it, so it waits; it is not limited by `on_full`. Messages
 * that were published before arrive before. It returns RCL_RET_ERROR, with a text, and counts a dropped message
 * (rmw_uros_get_statistics)
 * - for a best-effort publisher: only the reliable stream has fragments,
 * - if the whole has more than 65,527 bytes, which is all that a submessage of XRCE holds,
 * - if the second callback writes more or less than the first one promised, or a call in it failed,
 * - if the session is lost meanwhile, or the agent acknowledges nothing for XRCE_CONTINUOUS_TIMEOUT_MS.
 * Subscribers then get nothing of it. Only if the time-out follows the last fragment can they still get the whole.
 */

#include <stdint.h>

#include "rmw/types.h"
#include "ucdr/microcdr.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Adds the bytes that the other callback writes to *topic_length, which is the encoded size of the message that was
 * passed to rcl_publish (without the encapsulation header). `ucdr_alignment` computes padding.
 */
typedef void (*rmw_uros_continous_serialization_size)(uint32_t * topic_length);

/**
 * Writes the rest of the message with the functions of ucdr/microcdr.h, which wait whenever a fragment is full. The
 * message before it ends at `iterator`. A last member that is an empty sequence has ended there with its number of
 * elements, 4 bytes; an empty string with 5 bytes. Subtract these from `iterator` and `offset` to write the member
 * itself. May publish other messages, but none with callbacks.
 */
typedef void (*rmw_uros_continous_serialization)(ucdrBuffer * ucdr);

/**
 * Sets both callbacks of an open publisher; NULL: without. They are called by each rcl_publish of this publisher, in
 * the task that calls it, until others are set, the publisher is closed or the device sleeps (sleep_cycles).
 * `publisher` is the result of rcl_publisher_get_rmw_handle; for one that is not open the call has no effect.
 */
void rmw_uros_set_continous_serialization_callbacks(
  rmw_publisher_t * publisher, rmw_uros_continous_serialization_size size_cb,
  rmw_uros_continous_serialization serialization_cb);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_CONTINOUS_SERIALIZATION_H */
