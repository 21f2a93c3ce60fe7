/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc_diagnosis/callbacks.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port_diagnosis.h"
#include "microros/rclc_diagnosis_times.h"
#include "microros/rclc_handle_call.h"

#include <stddef.h>

static const void * watched_entities[MICROROS_DIAGNOSIS_CALLBACKS]; /* compared, never dereferenced */
static rclc_diagnosis_callback_t watched_times[MICROROS_DIAGNOSIS_CALLBACKS];

/* Returns the position of an entity; MICROROS_DIAGNOSIS_CALLBACKS: nobody watches it. */
static uint8_t watched_find(const void * entity)
{
  for (uint8_t i = 0; i < (uint8_t)MICROROS_DIAGNOSIS_CALLBACKS; ++i) {
    if (entity != NULL && watched_entities[i] == entity) {
      return i;
    }
  }
  return (uint8_t)MICROROS_DIAGNOSIS_CALLBACKS;
}

static void watched_note(uint8_t callback, uint32_t took_us)
{
  rclc_diagnosis_callback_t * times = &watched_times[callback];

  ++times->runs;
  times->last_us = took_us;
  if (took_us > times->longest_us) {
    times->longest_us = took_us;
  }
  if (rcl_diagnosis_limits_us[callback] != 0u && took_us > rcl_diagnosis_limits_us[callback]) {
    ++times->overruns;
  }
}

static uint32_t watched_now(void)
{
  uint32_t now_us;

  microros_lock(); /* two tasks never ask at the same time */
  now_us = port_time_us();
  microros_unlock();
  return now_us;
}

static void watched_end(const void * entity, uint32_t begin_us)
{
  uint8_t callback;

  microros_lock();
  callback = watched_find(entity);
  if (callback < (uint8_t)MICROROS_DIAGNOSIS_CALLBACKS) {
    watched_note(callback, port_time_us() - begin_us);
  }
  microros_unlock();
}

/* The start is on the stack of the task: a callback may spin another executor, and several tasks may run callbacks. The
 * entity is asked for before the call, because the callback may remove its handle. */
rcl_ret_t rclc_handle_call(rclc_executor_handle_t * handle)
{
  const void * entity = rclc_executor_handle_get_ptr(handle);
  const uint32_t begin_us = watched_now();
  const rcl_ret_t result = handle->kind->call(handle);

  watched_end(entity, begin_us);
  return result;
}

rcl_ret_t rclc_diagnosis_watch(uint8_t callback, const void * entity)
{
  bool is_free;

  if (callback >= (uint8_t)MICROROS_DIAGNOSIS_CALLBACKS) {
    return microros_error_named(RCL_RET_INVALID_ARGUMENT, microros_error_diagnosis, "no such callback");
  }
  microros_lock();
  is_free =
    watched_entities[callback] == entity || watched_find(entity) == (uint8_t)MICROROS_DIAGNOSIS_CALLBACKS;
  if (is_free) {
    watched_entities[callback] = entity;
  }
  microros_unlock();
  return is_free ? RCL_RET_OK
                 : microros_error_named(
                     RCL_RET_INVALID_ARGUMENT, microros_error_diagnosis, "another callback has this entity");
}

rcl_ret_t rclc_diagnosis_get_callback(uint8_t callback, rclc_diagnosis_callback_t * times)
{
  if (callback >= (uint8_t)MICROROS_DIAGNOSIS_CALLBACKS) {
    return microros_error_named(RCL_RET_INVALID_ARGUMENT, microros_error_diagnosis, "no such callback");
  }
  if (times == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "times");
  }
  microros_lock();
  *times = watched_times[callback];
  microros_unlock();
  return RCL_RET_OK;
}

const rclc_diagnosis_callback_t * rclc_diagnosis_times(uint8_t callback)
{
  return &watched_times[callback];
}
