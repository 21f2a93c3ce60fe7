/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The first node, which has the client of the graph, is closed and opened again while another task spins and a third one
 * queries. The task that spins is slow wherever it reads the time, so that the node is closed between any two steps of it.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit.h"

#include <microros/port.h>
#include <rcl/error_handling.h>
#include <rcl/graph.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

enum { ROUNDS = 30, SLOW_MS = 3 };

static rclc_support_t support;
static rcl_node_t first;
static rcl_node_t second;
static rcl_guard_condition_t condition;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static atomic_bool ends;
static atomic_bool closes;
static pthread_t spinning;

void port_sleep_ms(uint32_t duration_ms)
{
  const struct timespec duration = {(time_t)(duration_ms / 1000u), (long)(duration_ms % 1000u) * 1000000L};

  (void)nanosleep(&duration, NULL);
}

uint32_t port_time_ms(void)
{
  struct timespec now = {0, 0};

  if (atomic_load(&closes) && pthread_equal(pthread_self(), spinning)) {
    port_sleep_ms(SLOW_MS);
  }
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint32_t)((uint64_t)now.tv_sec * 1000u + (uint64_t)now.tv_nsec / 1000000u);
}

int64_t port_time_epoch_ns(void)
{
  return 0;
}

static void nothing(void)
{
}

static void * spin(void * argument)
{
  (void)argument;
  spinning = pthread_self();
  while (!atomic_load(&ends)) {
    CHECK(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(1)) == RCL_RET_OK);
  }
  return NULL;
}

/* While the first node is closed, or being opened, a query has an error. */
static void * ask(void * argument)
{
  (void)argument;
  while (!atomic_load(&ends)) {
    size_t count = 0;
    const rcl_ret_t result = rcl_count_publishers(&second, "/count", &count);

    CHECK(result == RCL_RET_OK || rcl_error_is_set());
    rcl_reset_error();
  }
  return NULL;
}

static void reopen(uint32_t after_ms)
{
  atomic_store(&closes, true);
  port_sleep_ms(after_ms);
  CHECK(rcl_node_fini(&first) == RCL_RET_OK);
  atomic_store(&closes, false);
  first = rcl_get_zero_initialized_node();
  CHECK(rclc_node_init_default(&first, "first", "", &support) == RCL_RET_OK);
}

int main(void)
{
  pthread_t thread;
  pthread_t asking;

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&first, "first", "", &support) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&second, "second", "", &support) == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  condition = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&condition, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(rclc_executor_add_guard_condition(&executor, &condition, nothing) == RCL_RET_OK);
  CHECK(pthread_create(&thread, NULL, spin, NULL) == 0);
  CHECK(pthread_create(&asking, NULL, ask, NULL) == 0);
  for (uint32_t i = 0; i < ROUNDS; ++i) {
    reopen(i);
  }
  atomic_store(&ends, true);
  CHECK(pthread_join(thread, NULL) == 0);
  CHECK(pthread_join(asking, NULL) == 0);
  return 0;
}
