/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The executor: one task that waits for entities and calls their callbacks in the order in which they were added. Its
 * handles are in a pool of the library, sized by the application file: MICROROS_EXECUTORS_MAX executors with
 * MICROROS_HANDLES_MAX handles each. Functions belong to the task that spins, but for rcl_trigger_guard_condition.
 *
 * A round waits until something is ready, asks the trigger function, and if that says so, takes and calls. Between rounds
 * what is ready stays ready: messages in their queues, guard conditions until their callback was called. While the trigger
 * says no, the next round waits until something else becomes ready, or for its time-out.
 *
 * A callback may add and remove any handle, its own too, and end any entity whose handle it removes: the round goes on with
 * the other handles, one that was added has its first turn in the next round.
 */
#ifndef MICROROS_RCLC_EXECUTOR_H
#define MICROROS_RCLC_EXECUTOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/error_handling.h"
#include "rcl/rcl.h"
#include "rcl/types.h"
#include "rcl/wait.h"
#include "rclc/executor_handle.h"
#include "rclc/sleep.h"
#include "rclc/types.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * RCLCPP_EXECUTOR: each message is taken directly before its callback, so what a callback changes is seen by the next.
 * LOGICAL_EXECUTION_TIME: all messages are taken first, and then all callbacks called; requests, which only their own
 * callback sees, are taken before it in both.
 */
typedef enum {
  RCLC_SEMANTICS_RCLCPP_EXECUTOR,
  RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME
} rclc_executor_semantics_t;

typedef enum {
  RCLC_EXECUTOR_NOT_INITIALIZED,
  RCLC_EXECUTOR_SINGLE_THREADED,
  RCLC_EXECUTOR_MULTI_THREADED,
  RCLC_EXECUTOR_NON_POSIX
} rclc_executor_type_t;

/* Whether the round takes and calls. `handles` has `size` of them, those in use first; `obj` is that of set_trigger. */
typedef bool (*rclc_executor_trigger_t)(rclc_executor_handle_t * handles, unsigned int size, void * obj);

typedef struct rclc_executor_t_s {
  rclc_executor_type_t type;
  rcl_context_t * context;
  rclc_executor_handle_t * handles; /* the library's; NULL: not initialized */
  size_t max_handles;
  size_t index; /* how many are in use */
  const rcl_allocator_t * allocator;
  rclc_executor_handle_counters_t info;
  uint64_t timeout_ns;
  rcutils_time_point_value_t invocation_time;
  rclc_executor_trigger_t trigger_function;
  void * trigger_object;
  rclc_executor_semantics_t data_comm_semantics;
} rclc_executor_t;

rclc_executor_t rclc_executor_get_zero_initialized_executor(void);

/*
 * Takes one of the pool's executors: RCL_RET_BAD_ALLOC when there is none (`pools: {executors: N}`). `number_of_handles` is
 * not needed: it must not be 0, and nothing else depends on it. `allocator` is kept and not called. The time-out is
 * 1 s, the trigger rclc_executor_trigger_any. RCL_RET_INVALID_ARGUMENT.
 */
rcl_ret_t rclc_executor_init(
  rclc_executor_t * executor, rcl_context_t * context, const size_t number_of_handles,
  const rcl_allocator_t * allocator);

/* How long rclc_executor_spin and rclc_executor_spin_period wait in a round at most. RCL_RET_ERROR, here and below, for an
 * executor that is not initialized. */
rcl_ret_t rclc_executor_set_timeout(rclc_executor_t * executor, const uint64_t timeout_ns);

rcl_ret_t rclc_executor_set_semantics(rclc_executor_t * executor, rclc_executor_semantics_t semantics);

/* RCL_RET_OK for an executor that is not initialized, too. */
rcl_ret_t rclc_executor_fini(rclc_executor_t * executor);

rcl_ret_t rclc_executor_add_guard_condition(
  rclc_executor_t * executor, rcl_guard_condition_t * gc, rclc_gc_callback_t callback);

rcl_ret_t rclc_executor_remove_guard_condition(
  rclc_executor_t * executor, const rcl_guard_condition_t * guard_condition);

/* There is nothing to prepare. */
rcl_ret_t rclc_executor_prepare(rclc_executor_t * executor);

/*
 * One round that waits `timeout_ns` at most: 0 does not wait, above INT64_MAX waits for ever. Carries the session on.
 * RCL_RET_OK whether a callback was called or not. Errors: RCL_RET_ERROR for a context that is not valid; …_INVALID for an
 * entity that was ended and not removed; what taking a message gave, after the others had their turn.
 */
rcl_ret_t rclc_executor_spin_some(rclc_executor_t * executor, const uint64_t timeout_ns);

/* Rounds without end. Returns the error when the context ends, or an entity that was not removed; goes on after
 * messages that could not be taken, which the entity counts. */
rcl_ret_t rclc_executor_spin(rclc_executor_t * executor);

/* A round every `period` nanoseconds; the session is carried on between them. Returns as rclc_executor_spin. */
rcl_ret_t rclc_executor_spin_period(rclc_executor_t * executor, const uint64_t period);

/* One of these: a round, and the rest of the period. */
rcl_ret_t rclc_executor_spin_one_period(rclc_executor_t * executor, const uint64_t period);

/* `trigger_object` goes to the function. */
rcl_ret_t rclc_executor_set_trigger(
  rclc_executor_t * executor, rclc_executor_trigger_t trigger_function, void * trigger_object);

/* All handles are ready. */
bool rclc_executor_trigger_all(rclc_executor_handle_t * handles, unsigned int size, void * obj);

/* One of them at least is. */
bool rclc_executor_trigger_any(rclc_executor_handle_t * handles, unsigned int size, void * obj);

/* In each round, also in one that has waited in vain. */
bool rclc_executor_trigger_always(rclc_executor_handle_t * handles, unsigned int size, void * obj);

/* The entity that is `obj` is ready. */
bool rclc_executor_trigger_one(rclc_executor_handle_t * handles, unsigned int size, void * obj);

#ifdef __cplusplus
}
#endif

#include "microros/executor_timer.h"

#endif /* MICROROS_RCLC_EXECUTOR_H */
