/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How long callbacks take. The application file names them below `diagnosis: {callbacks: [...]}`, the application says
 * which entity each one belongs to, and an executor measures it. rclc_diagnosis/declared_checks.h has their positions.
 *
 * Both functions can be called by any task (component multithread: under the lock), also before rcl_init and by callbacks,
 * and neither waits nor allocates. They are not for interrupts. Without declared callbacks they do not exist.
 */
#ifndef RCLC_DIAGNOSIS_CALLBACKS_H
#define RCLC_DIAGNOSIS_CALLBACKS_H

#include <stdint.h>

#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Since the program started; counters wrap to 0 after 2^32 - 1. Times are microseconds from the call by the executor to the
 * return, with what interrupts and other tasks do meanwhile. A call of more than 71 minutes is measured too short. */
typedef struct rclc_diagnosis_callback_t {
  uint32_t runs;
  uint32_t last_us;
  uint32_t longest_us;
  uint32_t overruns; /* runs that took longer than `limit`; 0 without one */
} rclc_diagnosis_callback_t;

/*
 * Measures the callback that executors call for an entity: the pointer that the executor was given, such as an
 * rcl_timer_t * or rcl_subscription_t *. Of a service this is the request's decoding, the callback and its reply; of an action
 * everything that is called for it in a round. The entity is not looked at, so it can be initialized later; it may be
 * finalized, too. NULL: nothing is measured any more. The numbers go on from where they are.
 *
 * RCL_RET_OK; RCL_RET_INVALID_ARGUMENT: no such callback, or the entity belongs to another one.
 */
rcl_ret_t rclc_diagnosis_watch(uint8_t callback, const void * entity);

/* Copies the present numbers of a callback. RCL_RET_OK; RCL_RET_INVALID_ARGUMENT: no such callback, or `times` is NULL. */
rcl_ret_t rclc_diagnosis_get_callback(uint8_t callback, rclc_diagnosis_callback_t * times);

#ifdef __cplusplus
}
#endif

#endif /* RCLC_DIAGNOSIS_CALLBACKS_H */
