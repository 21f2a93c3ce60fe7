/* SPDX-License-Identifier: Apache-2.0 */
/* Times of callbacks: tick with a limit of 2 ms, command and other without one. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port_diagnosis.h"
#include "microros/rclc_diagnosis_times.h"
#include "microros/rclc_handle_call.h"
#include "rclc_diagnosis/declared_checks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t now_us = UINT32_MAX - 5000u;
static int locks;
static int others[3]; /* entities: nothing of them is looked at */
static rclc_executor_handle_t outer;
static rclc_executor_handle_t inner;

#define EXPECT(condition) \
  do { \
    if (!(condition)) { \
      (void)fprintf(stderr, "line %d: %s\n", __LINE__, #condition); \
      exit(1); \
    } \
  } while (0)

void port_lock(void)
{
  ++locks;
}

void port_unlock(void)
{
  --locks;
}

uint32_t port_time_us(void)
{
  EXPECT(locks == (MICROROS_TASKS_SHARE != 0u ? 1 : 0));
  return now_us;
}

const char microros_error_diagnosis[] = "";

rcl_ret_t microros_error_named(rcl_ret_t result, microros_error_t error, const char * name)
{
  (void)error;
  (void)name;
  EXPECT(locks == 0);
  return result;
}

rcl_ret_t microros_error_refuse(rcl_ret_t result, const char * argument)
{
  (void)argument;
  EXPECT(locks == 0);
  return result;
}

void * rclc_executor_handle_get_ptr(rclc_executor_handle_t * handle)
{
  return handle->gc;
}

static rclc_diagnosis_callback_t of(uint8_t callback)
{
  rclc_diagnosis_callback_t times;

  EXPECT(rclc_diagnosis_get_callback(callback, &times) == RCL_RET_OK);
  EXPECT(memcmp(&times, rclc_diagnosis_times(callback), sizeof(times)) == 0);
  return times;
}

static bool is(uint8_t callback, uint32_t runs, uint32_t last_us, uint32_t longest_us, uint32_t overruns)
{
  const rclc_diagnosis_callback_t times = of(callback);

  return times.runs == runs && times.last_us == last_us && times.longest_us == longest_us &&
         times.overruns == overruns;
}

static rcl_ret_t take_2000(rclc_executor_handle_t * handle)
{
  (void)handle;
  EXPECT(locks == 0);
  now_us += 2000u;
  return RCL_RET_OK;
}

/* An error is returned, and the handle becomes another one. */
static rcl_ret_t take_2001(rclc_executor_handle_t * handle)
{
  (void)memset(handle, 0, sizeof(*handle));
  now_us += 2001u;
  return RCL_RET_TIMEOUT;
}

/* Spins another executor. */
static rcl_ret_t take_more(rclc_executor_handle_t * handle)
{
  (void)handle;
  now_us += 10u;
  return rclc_handle_call(&inner);
}

static rcl_ret_t move(rclc_executor_handle_t * handle)
{
  (void)handle;
  EXPECT(rclc_diagnosis_watch(RCLC_CALLBACK_COMMAND, NULL) == RCL_RET_OK);
  EXPECT(rclc_diagnosis_watch(RCLC_CALLBACK_OTHER, &others[1]) == RCL_RET_OK);
  now_us += 7u;
  return RCL_RET_OK;
}

static rcl_ret_t call(
  rclc_executor_handle_t * handle, int * entity, rcl_ret_t (*function)(rclc_executor_handle_t *))
{
  const rclc_handle_kind_t kind = {NULL, NULL, function};

  handle->gc = (void *)entity;
  handle->kind = &kind;
  return rclc_handle_call(handle);
}

int main(void)
{
  static const rclc_handle_kind_t kind = {NULL, NULL, take_2000};
  rclc_diagnosis_callback_t unused;

  EXPECT(rclc_diagnosis_watch(3, &others[0]) == RCL_RET_INVALID_ARGUMENT);
  EXPECT(rclc_diagnosis_get_callback(3, &unused) == RCL_RET_INVALID_ARGUMENT);
  EXPECT(rclc_diagnosis_get_callback(0, NULL) == RCL_RET_INVALID_ARGUMENT);
  EXPECT(call(&outer, &others[0], take_2000) == RCL_RET_OK); /* nobody watches it */
  EXPECT(call(&outer, NULL, take_2000) == RCL_RET_OK);       /* nor what has no entity */
  EXPECT(is(RCLC_CALLBACK_TICK, 0, 0, 0, 0));
  EXPECT(rclc_diagnosis_watch(RCLC_CALLBACK_TICK, &others[0]) == RCL_RET_OK);
  EXPECT(rclc_diagnosis_watch(RCLC_CALLBACK_TICK, &others[0]) == RCL_RET_OK);
  EXPECT(rclc_diagnosis_watch(RCLC_CALLBACK_COMMAND, &others[0]) == RCL_RET_INVALID_ARGUMENT);
  EXPECT(rclc_diagnosis_watch(RCLC_CALLBACK_COMMAND, &others[1]) == RCL_RET_OK);
  EXPECT(call(&outer, &others[0], take_2000) == RCL_RET_OK); /* over the wrap; not above the limit */
  EXPECT(now_us < 2000u && is(RCLC_CALLBACK_TICK, 1, 2000, 2000, 0));
  EXPECT(call(&outer, &others[0], take_2001) == RCL_RET_TIMEOUT);
  EXPECT(is(RCLC_CALLBACK_TICK, 2, 2001, 2001, 1));
  inner.gc = (void *)&others[1];
  inner.kind = &kind;
  EXPECT(call(&outer, &others[0], take_more) == RCL_RET_OK);
  EXPECT(is(RCLC_CALLBACK_TICK, 3, 2010, 2010, 2));
  EXPECT(is(RCLC_CALLBACK_COMMAND, 1, 2000, 2000, 0));
  EXPECT(call(&outer, &others[1], move) == RCL_RET_OK); /* what is watched after the call has its time */
  EXPECT(is(RCLC_CALLBACK_COMMAND, 1, 2000, 2000, 0));
  EXPECT(is(RCLC_CALLBACK_OTHER, 1, 7, 7, 0));
  EXPECT(rclc_diagnosis_watch(RCLC_CALLBACK_OTHER, NULL) == RCL_RET_OK);
  EXPECT(call(&outer, &others[1], take_2000) == RCL_RET_OK);
  EXPECT(is(RCLC_CALLBACK_OTHER, 1, 7, 7, 0));
  (void)printf("ok\n");
  return 0;
}
