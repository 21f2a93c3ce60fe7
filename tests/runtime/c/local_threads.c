/* SPDX-License-Identifier: Apache-2.0 */
/* A task publishes, another one spins an executor: the application file is that of test_local_delivery.py. */
#include "unit.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <pthread.h>
#include <time.h>

enum { MESSAGES = 2000, AT_ONCE = 8 };

static rcl_publisher_t publisher;
static int32_t expected;

/* Read by the publisher, which does not overtake by more than the queue has slots. */
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t moved = PTHREAD_COND_INITIALIZER;
static int32_t heard;

static void * publish_all(void * unused)
{
  (void)unused;
  for (int32_t value = 0; value < MESSAGES; ++value) {
    const std_msgs__msg__Int32 message = {.data = value};

    CHECK(pthread_mutex_lock(&mutex) == 0);
    while (value - heard >= AT_ONCE) {
      CHECK(pthread_cond_wait(&moved, &mutex) == 0);
    }
    CHECK(pthread_mutex_unlock(&mutex) == 0);
    CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  }
  return NULL;
}

static void on_message(const void * message)
{
  const std_msgs__msg__Int32 * number = message;

  CHECK(number->data == expected);
  ++expected;
  CHECK(pthread_mutex_lock(&mutex) == 0);
  heard = expected;
  CHECK(pthread_cond_signal(&moved) == 0 && pthread_mutex_unlock(&mutex) == 0);
}

static double now_s(void)
{
  struct timespec now;

  CHECK(clock_gettime(CLOCK_MONOTONIC, &now) == 0);
  return (double)now.tv_sec + (double)now.tv_nsec / 1e9;
}

int main(void)
{
  static std_msgs__msg__Int32 message;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const double start = now_s();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  pthread_t task;

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "count") == RCL_RET_OK);
  CHECK(now_s() - start < 0.5); /* nothing waited for an agent */
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &message, on_message, ON_NEW_DATA) ==
    RCL_RET_OK);
  CHECK(pthread_create(&task, NULL, publish_all, NULL) == 0);
  while (expected < MESSAGES) { /* each rest ends with the next message: 2,000 of a second would not */
    CHECK(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(1000)) == RCL_RET_OK);
  }
  CHECK(pthread_join(task, NULL) == 0);
  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&subscription, &node) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&publisher, &node) == RCL_RET_OK);
  CHECK(rcl_node_fini(&node) == RCL_RET_OK && rclc_support_fini(&support) == RCL_RET_OK);
  return 0;
}
