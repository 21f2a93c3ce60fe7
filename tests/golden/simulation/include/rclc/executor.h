/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The executor: one task that waits for entities and calls their callbacks in the order in which they were
 * added. Its handles are in a pool of the library, sized by the application file: MICROROS_EXECUTORS_MAX
 * executors with MICROROS_HANDLES_MAX handles each. All functions belong to the task that spins, except
 * rcl_trigger_guard_condition.
 *
 * A round waits until an entity is ready, calls the trigger function, and if that returns true, takes
 * messages and calls callbacks. Entities stay ready between rounds: messages remain in their queues, guard
 * conditions remain set until their callback was called. While the trigger returns false, the next round
 * waits until another entity becomes ready, or for its time-out.
 *
 * A callback may add and remove any handle, including its own, and finalize any entity whose handle it
 * removes: the round continues with the other handles; an added one has its first turn in the next round.
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
 * RCLCPP_EXECUTOR: each message is taken directly before its callback, so that a callback sees the changes
 * of earlier ones. LOGICAL_EXECUTION_TIME: all messages are taken before the first callback; requests,
 * which only their own callback sees, are taken directly before it in both.
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

/*
 * Returns whether the round takes and calls. `handles` has `size` entries, those in use first; `obj` is
 * the one passed to set_trigger. */
typedef bool (*rclc_executor_trigger_t)(rclc_executor_handle_t * handles, unsigned int size, void * obj);

typedef struct rclc_executor_t_s {
  rclc_executor_type_t type;
  rcl_context_t * context;
  rclc_executor_handle_t * handles; /* owned by the library; NULL: not initialized */
  size_t max_handles;
  size_t index; /* number in use */
  const rcl_allocator_t * allocator;
  rclc_executor_handle_counters_t info;
  uint64_t timeout_ns;
  rcutils_time_point_value_t invocation_time;
  rclc_executor_trigger_t trigger_function;
  void * trigger_object;
  rclc_executor_semantics_t data_comm_semantics;
} rclc_executor_t;

typedef rcl_ret_t (*rclc_executor_func_t)(rclc_executor_t * executor);

rclc_executor_t rclc_executor_get_zero_initialized_executor(void);

/*
 * Uses one of the pool's executors; RCL_RET_BAD_ALLOC if all are in use (`pools: {executors: N}`).
 * `number_of_handles` must not be 0 and is otherwise ignored. `allocator` is stored and never called. The
 * time-out is 1 s, the trigger rclc_executor_trigger_any. RCL_RET_INVALID_ARGUMENT.
 */
rcl_ret_t rclc_executor_init(
  rclc_executor_t * executor, rcl_context_t * context, const size_t number_of_handles,
  const rcl_allocator_t * allocator);

/* Longest wait of a round of rclc_executor_spin and rclc_executor_spin_period. RCL_RET_ERROR, here and
 * below, for an executor that is not initialized. */
rcl_ret_t rclc_executor_set_timeout(rclc_executor_t * executor, const uint64_t timeout_ns);

rcl_ret_t rclc_executor_set_semantics(rclc_executor_t * executor, rclc_executor_semantics_t semantics);

/* Returns RCL_RET_OK for an executor that is not initialized, too. */
rcl_ret_t rclc_executor_fini(rclc_executor_t * executor);

rcl_ret_t rclc_executor_add_guard_condition(
  rclc_executor_t * executor, rcl_guard_condition_t * gc, rclc_gc_callback_t callback);

rcl_ret_t rclc_executor_remove_guard_condition(
  rclc_executor_t * executor, const rcl_guard_condition_t * guard_condition);

/* Does nothing: no preparation is needed. */
rcl_ret_t rclc_executor_prepare(rclc_executor_t * executor);

/*
 * Runs one round that waits for at most `timeout_ns`: 0 does not wait, above INT64_MAX waits without a
 * time-out. Runs the session. Returns RCL_RET_OK whether or not a callback was called. Errors:
 * RCL_RET_ERROR for an invalid context; …_INVALID for an entity that was finalized and not removed; the
 * error of taking a message, after all other handles had their turn.
 */
rcl_ret_t rclc_executor_spin_some(rclc_executor_t * executor, const uint64_t timeout_ns);

/*
 * Writes the time in nanoseconds until a timer of the executor or the session has something to do; 0: a handle is ready;
 * INT64_MAX: not before a message arrives, or something else makes a handle ready. For an application that sleeps itself: call
 * it after rclc_executor_spin_some, in the same task, and sleep at most so long. What arrives on the line, and who triggers a
 * guard condition, has to end the sleep. Errors are those of a handle, as in a round.
 */
rcl_ret_t rclc_executor_time_until_due(const rclc_executor_t * executor, int64_t * duration_ns);

/* Runs rounds until the context ends, or an entity was finalized and not removed; returns that error.
 * Continues after messages that could not be taken, which the entity counts. */
rcl_ret_t rclc_executor_spin(rclc_executor_t * executor);

/* Runs a round every `period` nanoseconds and the session in between. Returns as rclc_executor_spin does. */
rcl_ret_t rclc_executor_spin_period(rclc_executor_t * executor, const uint64_t period);

/* Runs one round, then rests until the period is over. */
rcl_ret_t rclc_executor_spin_one_period(rclc_executor_t * executor, const uint64_t period);

/* `trigger_object` is passed to the function. */
rcl_ret_t rclc_executor_set_trigger(
  rclc_executor_t * executor, rclc_executor_trigger_t trigger_function, void * trigger_object);

/* True if all handles are ready. */
bool rclc_executor_trigger_all(rclc_executor_handle_t * handles, unsigned int size, void * obj);

/* True if at least one handle is ready. */
bool rclc_executor_trigger_any(rclc_executor_handle_t * handles, unsigned int size, void * obj);

/* Always true, also after a time-out. */
bool rclc_executor_trigger_always(rclc_executor_handle_t * handles, unsigned int size, void * obj);

/* True if the entity `obj` is ready. */
bool rclc_executor_trigger_one(rclc_executor_handle_t * handles, unsigned int size, void * obj);

#ifdef __cplusplus
}
#endif

#include "microros/executor_subscription.h"

#include "microros/executor_timer.h"

#endif /* MICROROS_RCLC_EXECUTOR_H */
