/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Interface by which a component adds a kind of handle to the executor: three functions, and an
 * rclc_executor_add_… that stores them in a handle. The executor knows kinds only by these pointers, so
 * kinds that are never added are not linked. Internal.
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
   * Returns in *is_ready whether the callback is due, without receiving. May lower *look_again_ns
   * (initially INT64_MAX) if only time makes it due. An error (…_INVALID: the entity was finalized) ends
   * the round.
   */
  rcl_ret_t (*look)(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns);

  /*
   * Takes what look found. May clear data_available if nothing was there after all. An error is reported
   * when the round is over: the other handles proceed, and this callback is called as if nothing had
   * arrived.
   */
  rcl_ret_t (*take)(rclc_executor_handle_t * handle);

  /* Calls the callback, with the taken data if data_available; errors as for take. */
  rcl_ret_t (*call)(rclc_executor_handle_t * handle);
} rclc_handle_kind_t;

/* Returns the executor's next handle, empty but for type, kind and invocation ON_NEW_DATA. NULL, with a
 * text, if all are in use or the executor is not initialized. `executor` is not NULL. */
rclc_executor_handle_t * rclc_executor_add_handle(
  rclc_executor_t * executor, rclc_executor_handle_type_t type, const rclc_handle_kind_t * kind);

/* Removes the entity; the others keep their order. RCL_RET_ERROR if it was not added. */
rcl_ret_t rclc_executor_remove_handle(rclc_executor_t * executor, const void * entity);

/* For kinds without data to take. */
rcl_ret_t rclc_handle_take_nothing(rclc_executor_handle_t * handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EXECUTOR_HANDLES_H */
