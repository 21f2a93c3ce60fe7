/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions that tasks may call at once wait for the lock while another task has it. A function that does not take it
 * returns, whatever the other task does; one that takes it cannot. The application file is that of test_locks.py.
 */
#include "unit.h"

#include <microros/port.h>
#include <microros/rcl_clock.h>
#include <rcl/rcl.h>
#include <rmw_microros/on_silence.h>

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

enum { SOME_MS = 30 };

static rcl_clock_t device_clock;
static int first;
static int second;
static uint32_t calls;
static pthread_mutex_t steps_lock = PTHREAD_MUTEX_INITIALIZER;
static bool begun; /* with steps_lock */
static bool ended;

void stop_motors(void)
{
}

static void on_jump(const rcl_time_jump_t * jump, bool before_jump, void * user_data)
{
  (void)jump;
  (void)before_jump;
  (void)user_data;
  ++calls;
}

static void add(void)
{
  const rcl_jump_threshold_t threshold = {true, {1}, {-1}};

  CHECK(rcl_clock_add_jump_callback(&device_clock, threshold, on_jump, &second) == RCL_RET_OK);
}

static void remove_one(void)
{
  CHECK(rcl_clock_remove_jump_callback(&device_clock, on_jump, &second) == RCL_RET_OK);
}

static void jump_time(void)
{
  const rcl_time_jump_t jump = {RCL_ROS_TIME_NO_CHANGE, {1000}};

  rcl_clock_call_callbacks(&device_clock, &jump, false);
}

static void remove_all(void)
{
  rcl_clock_remove_callbacks(&device_clock);
}

static void ask_silences(void)
{
  CHECK(rmw_uros_silences() == 0u);
}

static void set(bool * step)
{
  (void)pthread_mutex_lock(&steps_lock);
  *step = true;
  (void)pthread_mutex_unlock(&steps_lock);
}

static bool is_set(const bool * step)
{
  bool value;

  (void)pthread_mutex_lock(&steps_lock);
  value = *step;
  (void)pthread_mutex_unlock(&steps_lock);
  return value;
}

typedef struct function_t {
  void (*call)(void);
  const char * name;
} function_t;

static void * call_other(void * argument)
{
  const function_t * function = argument;

  set(&begun);
  function->call();
  set(&ended);
  return NULL;
}

/* Calls a function in another task, while this one has the lock. */
static void holds_off(const function_t * function)
{
  pthread_t other;

  begun = false;
  ended = false;
  port_lock();
  CHECK(pthread_create(&other, NULL, call_other, (void *)function) == 0);
  while (!is_set(&begun)) {
    port_sleep_ms(1);
  }
  port_sleep_ms(SOME_MS);
  if (is_set(&ended)) {
    (void)fprintf(stderr, "%s does not take the lock\n", function->name);
    CHECK(false);
  }
  port_unlock();
  CHECK(pthread_join(other, NULL) == 0 && is_set(&ended));
}

int main(void)
{
  static const function_t functions[] = {
    {add, "rcl_clock_add_jump_callback"},
    {jump_time, "rcl_clock_call_callbacks"},
    {remove_one, "rcl_clock_remove_jump_callback"},
    {remove_all, "rcl_clock_remove_callbacks"},
    {ask_silences, "rmw_uros_silences"},
  };
  rcl_allocator_t allocator = rcl_get_default_allocator();
  const rcl_jump_threshold_t threshold = {true, {1}, {-1}};

  CHECK(rcl_ros_clock_init(&device_clock, &allocator) == RCL_RET_OK);
  CHECK(rcl_clock_add_jump_callback(&device_clock, threshold, on_jump, &first) == RCL_RET_OK);
  for (size_t i = 0; i < sizeof(functions) / sizeof(functions[0]); ++i) {
    holds_off(&functions[i]);
  }
  CHECK(calls == 2u);
  CHECK(rcl_ros_clock_fini(&device_clock) == RCL_RET_OK);
  return 0;
}
