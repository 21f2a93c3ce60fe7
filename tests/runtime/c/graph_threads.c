/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An executor that follows the graph and answers the logger services in one task, queries in four others, which receive
 * for all, too, and find the graph busy at times.
 */
#define _POSIX_C_SOURCE 200809L
#include <rcl/error_handling.h>
#include <rcl/graph.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>

enum { QUERIES = 150, SUBSCRIBERS = 2, TASKS = 5 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static unsigned changes;
static unsigned asking = TASKS - 1;

static void check(bool good, const char * what)
{
  if (!good) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    abort();
  }
}

static void changed(void)
{
  ++changes;
}

static unsigned asking_after(unsigned ended)
{
  unsigned left;

  (void)pthread_mutex_lock(&mutex);
  asking -= ended;
  left = asking;
  (void)pthread_mutex_unlock(&mutex);
  return left;
}

static void * spin(void * argument)
{
  (void)argument;
  while (asking_after(0) != 0u) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(5));
  }
  return NULL;
}

static void * ask(void * argument)
{
  unsigned answered = 0;

  (void)argument;
  while (answered < QUERIES) {
    size_t count = 0;
    const rcl_ret_t result = rcl_count_subscribers(&node, "/arm/count", &count);

    check(result == RCL_RET_OK || result == RCL_RET_ERROR, "query"); /* another query is being made */
    check(result != RCL_RET_OK || count == SUBSCRIBERS, "count");
    answered += result == RCL_RET_OK ? 1u : 0u;
    rcl_reset_error();
    (void)sched_yield();
  }
  (void)asking_after(1);
  return NULL;
}

int main(void)
{
  static void * (*const tasks[TASKS])(void *) = {spin, ask, ask, ask, ask};
  static rcl_guard_condition_t condition;
  pthread_t threads[TASKS];

  allocator = rcl_get_default_allocator();
  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK, "support");
  check(rclc_node_init_default(&node, "device", "arm", &support) == RCL_RET_OK, "node");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK, "executor");
  condition = *rcl_node_get_graph_guard_condition(&node);
  check(rclc_executor_add_guard_condition(&executor, &condition, changed) == RCL_RET_OK, "guard condition");
  for (size_t i = 0; i < TASKS; ++i) {
    check(pthread_create(&threads[i], NULL, tasks[i], NULL) == 0, "thread");
  }
  for (size_t i = 0; i < TASKS; ++i) {
    check(pthread_join(threads[i], NULL) == 0, "join");
  }
  (void)printf("changes %s\n", changes != 0u ? "seen" : "missed");
  check(rclc_executor_fini(&executor) == RCL_RET_OK, "end of the executor");
  check(rcl_node_fini(&node) == RCL_RET_OK && rclc_support_fini(&support) == RCL_RET_OK, "end");
  return 0;
}
