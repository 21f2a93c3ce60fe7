/* SPDX-License-Identifier: Apache-2.0 */
/* Stamps of messages from a clock. */
#ifndef MICROROS_RCLC_STAMP_H
#define MICROROS_RCLC_STAMP_H

#include <stdint.h>

#include "rcl/error_handling.h"
#include "rcl/time.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Writes the time of a clock into the members of a builtin_interfaces/msg/Time, with one reading of the clock:
 * rclc_stamp(&clock, &message.header.stamp.sec, &message.header.stamp.nanosec). Any other code than RCL_RET_OK has written
 * nothing, and has a text:
 *   RCL_RET_INVALID_ARGUMENT   NULL
 *   RCL_RET_ERROR              the clock is not initialized, is steady, or has no time: no sample of /clock has arrived, or
 *                              the time of day is not known before rmw_uros_sync_session; or the time is
 *                              2038-01-19 03:14:08 UTC or later, which the type cannot express
 */
rcl_ret_t rclc_stamp(rcl_clock_t * clock, int32_t * sec, uint32_t * nanosec);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_STAMP_H */
