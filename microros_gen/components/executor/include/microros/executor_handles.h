/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How a component brings a kind of handle to the executor: three functions, and an rclc_executor_add_… that puts them into
 * a handle. The executor knows kinds by these pointers alone, so what is never added is not linked. Internal.
 */
#ifndef MICROROS_EXECUTOR_HANDLES_H
#define MICROROS_EXECUTOR_HANDLES_H

#include <stdbool.h>
#include <stdint.h>

#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rclc_handle_kind_s {
  /*
   * Gives whether there is something for the callback, without receiving; *look_again_ns, INT64_MAX at first, may be made
   * smaller: nothing else wakes the executor for it. An error (…_INVALID: the entity was ended) ends the round.
   */
  rcl_ret_t (*look)(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns);

  /*
   * Takes what look found. It may set data_available to false: there was nothing after all. An error is told when the round
   * is over, the others go on, and this callback is called as if there was nothing.
   */
  rcl_ret_t (*take)(rclc_executor_handle_t * handle);

  /* Calls the callback, with what was taken if data_available; an error as of take. */
  rcl_ret_t (*call)(rclc_executor_handle_t * handle);
} rclc_handle_kind_t;

/* Returns the executor's next handle, empty but for type and kind, invocation ON_NEW_DATA; NULL, with a text: it has no
 * more, or is not initialized. `executor` is not NULL. */
rclc_executor_handle_t * rclc_executor_add_handle(
  rclc_executor_t * executor, rclc_executor_handle_type_t type, const rclc_handle_kind_t * kind);

/* Takes the entity out; the others keep their order. RCL_RET_ERROR: it is not there. */
rcl_ret_t rclc_executor_remove_handle(rclc_executor_t * executor, const void * entity);

/* For kinds that have nothing to take. */
rcl_ret_t rclc_handle_take_nothing(rclc_executor_handle_t * handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EXECUTOR_HANDLES_H */
