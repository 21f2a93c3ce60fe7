/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/executor.h"

#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/lock.h"
#include "microros_config.h"

#include <string.h>

static const uint64_t first_timeout_ns = 1000000000u;

typedef struct executor_place_t {
  rclc_executor_handle_t handles[MICROROS_HANDLES_MAX];
  const void *
    owner; /* NULL: free; the executor, or the handles themselves if only a copy of the executor remains */
} executor_place_t;

static executor_place_t executor_places[MICROROS_EXECUTORS_MAX];

/* Returns the place of this owner; NULL: it has no place. */
static executor_place_t * executor_find(const void * owner)
{
  for (size_t i = 0; i < MICROROS_EXECUTORS_MAX; ++i) {
    if (executor_places[i].owner == owner) {
      return &executor_places[i];
    }
  }
  return NULL;
}

rclc_executor_t rclc_executor_get_zero_initialized_executor(void)
{
  rclc_executor_t executor;

  (void)memset(&executor, 0, sizeof(executor));
  return executor;
}

/* An executor that is initialized again keeps its place. If its handles are not those of the place, it was
 * copied, and the copy owns the handles now. */
static rclc_executor_handle_t * executor_take(const rclc_executor_t * executor)
{
  executor_place_t * place = executor_find(executor);

  if (place != NULL && executor->handles != place->handles) {
    place->owner = place->handles;
    place = NULL;
  }
  if (place == NULL) {
    place = executor_find(NULL);
  }
  if (place == NULL) {
    microros_error_set(
      microros_error_of_pool(microros_error_pool_full, MICROROS_EXECUTORS_MAX), "executors", NULL,
      MICROROS_EXECUTORS_MAX, MICROROS_EXECUTORS_MAX + 1u);
    return NULL;
  }
  place->owner = executor;
  /* As rclc_executor_handle_init leaves one. */
  (void)memset(place->handles, 0, sizeof(place->handles[0]));
  place->handles[0].type = RCLC_NONE;
  place->handles[0].invocation = ON_NEW_DATA;
  place->handles[0].index = MICROROS_HANDLES_MAX;
  for (size_t i = 1; i < MICROROS_HANDLES_MAX; ++i) {
    place->handles[i] = place->handles[0];
  }
  return place->handles;
}

rcl_ret_t rclc_executor_init(
  rclc_executor_t * executor, rcl_context_t * context, const size_t number_of_handles,
  const rcl_allocator_t * allocator)
{
  rclc_executor_handle_t * handles;

  if (executor == NULL || context == NULL || allocator == NULL || number_of_handles == 0u) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "executor, context, number_of_handles or allocator");
  }
  microros_lock();
  handles = executor_take(executor);
  microros_unlock();
  (void)memset(executor, 0, sizeof(*executor));
  if (handles == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  executor->handles = handles;
  executor->type = RCLC_EXECUTOR_SINGLE_THREADED;
  executor->context = context;
  executor->max_handles = MICROROS_HANDLES_MAX;
  executor->allocator = allocator;
  executor->timeout_ns = first_timeout_ns;
  executor->trigger_function = rclc_executor_trigger_any;
  return RCL_RET_OK;
}

/* Found by its handles: `executor` may be a copy. */
static void executor_release(const rclc_executor_t * executor)
{
  microros_lock();
  for (size_t i = 0; i < MICROROS_EXECUTORS_MAX; ++i) {
    if (executor_places[i].handles == executor->handles) {
      executor_places[i].owner = NULL;
    }
  }
  microros_unlock();
}

rcl_ret_t rclc_executor_fini(rclc_executor_t * executor)
{
  if (executor != NULL && executor->handles != NULL) {
    executor_release(executor);
    (void)memset(executor, 0, sizeof(*executor));
    executor->timeout_ns = first_timeout_ns;
  }
  return RCL_RET_OK;
}

static rcl_ret_t executor_check(const rclc_executor_t * executor)
{
  if (executor == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor");
  }
  return executor->handles != NULL ? RCL_RET_OK : microros_error_refuse(RCL_RET_ERROR, "executor");
}

rcl_ret_t rclc_executor_set_timeout(rclc_executor_t * executor, const uint64_t timeout_ns)
{
  const rcl_ret_t result = executor_check(executor);

  if (result == RCL_RET_OK) {
    executor->timeout_ns = timeout_ns;
  }
  return result;
}

rcl_ret_t rclc_executor_set_semantics(rclc_executor_t * executor, rclc_executor_semantics_t semantics)
{
  const rcl_ret_t result = executor_check(executor);

  if (result == RCL_RET_OK) {
    executor->data_comm_semantics = semantics;
  }
  return result;
}

rclc_executor_handle_t * rclc_executor_add_handle(
  rclc_executor_t * executor, rclc_executor_handle_type_t type, const rclc_handle_kind_t * kind)
{
  rclc_executor_handle_t * handle;

  if (executor->handles == NULL) {
    (void)executor_check(executor); /* sets the error text */
    return NULL;
  }
  if (executor->index == executor->max_handles) {
    microros_error_set(
      microros_error_of_pool(microros_error_pool_full, MICROROS_HANDLES_MAX), "handles", NULL,
      MICROROS_HANDLES_MAX, MICROROS_HANDLES_MAX + 1u);
    return NULL;
  }
  handle = &executor->handles[executor->index];
  handle->type = type;
  handle->kind = kind;
  handle->initialized = true;
  ++executor->index;
  return handle;
}

static size_t executor_search(const rclc_executor_t * executor, const void * entity)
{
  size_t i = 0;

  while (i < executor->index && rclc_executor_handle_get_ptr(&executor->handles[i]) != entity) {
    ++i;
  }
  return i;
}

rcl_ret_t rclc_executor_remove_handle(rclc_executor_t * executor, const void * entity)
{
  size_t i;

  if (executor == NULL || entity == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor or what to remove");
  }
  i = executor_search(executor, entity);
  if (i == executor->index) {
    return microros_error_named(
      RCL_RET_ERROR, microros_error_executor, "it does not run what is to be removed");
  }
  --executor->index;
  for (; i < executor->index; ++i) {
    executor->handles[i] = executor->handles[i + 1u];
  }
  return rclc_executor_handle_init(&executor->handles[executor->index], executor->max_handles);
}

rcl_ret_t rclc_executor_prepare(rclc_executor_t * executor)
{
  return executor != NULL ? RCL_RET_OK : microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor");
}
