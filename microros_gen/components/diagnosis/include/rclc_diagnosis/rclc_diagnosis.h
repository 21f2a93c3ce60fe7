/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a device reports of itself on /diagnostics. The library publishes by itself, in the functions that run the
 * session (publish, take, spin, wait); the application sets the values of the checks that the application file declares
 * below `diagnosis:`. rclc_diagnosis/declared_checks.h has their positions.
 *
 * Both functions can be called by any task (component multithread: under the lock), before rcl_init and while the agent
 * is away, and neither waits nor allocates. They are not for interrupts.
 */
#ifndef RCLC_DIAGNOSIS_RCLC_DIAGNOSIS_H
#define RCLC_DIAGNOSIS_RCLC_DIAGNOSIS_H

#include <stdint.h>

#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Levels, as diagnostic_msgs/msg/DiagnosticStatus has them. */
typedef enum rclc_diagnosis_level_t {
  RCLC_DIAGNOSIS_OK,
  RCLC_DIAGNOSIS_WARN,
  RCLC_DIAGNOSIS_ERROR,
  RCLC_DIAGNOSIS_STALE /* not set yet, or longer ago than its `timeout` */
} rclc_diagnosis_level_t;

/*
 * Sets the value of a check, in its unit. A new level is published as soon as the stream has room, the value itself with
 * the next report. RCL_RET_INVALID_ARGUMENT: no such check.
 */
rcl_ret_t rclc_diagnosis_set(uint8_t check, int32_t value);

/* Returns the level of a check, an rclc_diagnosis_level_t; RCLC_DIAGNOSIS_STALE also if the check does not exist. */
uint8_t rclc_diagnosis_level(uint8_t check);

#ifdef __cplusplus
}
#endif

#endif /* RCLC_DIAGNOSIS_RCLC_DIAGNOSIS_H */
