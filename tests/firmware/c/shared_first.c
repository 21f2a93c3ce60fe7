/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The image of CPU 0 on QEMU's mps2-an521. Starts CPU 1, whose image is that of shared_second.c, sends numbers on /ping until
 * each came back on /pong, and ends the emulator with status 0 if all went well. */
#include "emulator_end.h"
#include "shared_core.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>

enum { NUMBERS = 50, TRIES = 100 };

/* System control of the SSE-200, secure: where CPU 1 starts, and which cores wait (a bit each). */
static volatile uint32_t * const init_vectors = (volatile uint32_t *)0x50021114u;
static volatile uint32_t * const cpu_wait = (volatile uint32_t *)0x50021118u;
static const uint32_t second_vectors = 0x10200000u;

static int32_t heard;

static void on_number(const void * message)
{
  heard = ((const std_msgs__msg__Int32 *)message)->data;
}

/* Sends a number again and again until it came back: the other core may not have started yet. */
static void exchange(const rcl_publisher_t * publisher, rclc_executor_t * executor, int32_t number)
{
  const std_msgs__msg__Int32 message = {.data = number};

  for (uint32_t i = 0; i < TRIES && heard != number; ++i) {
    const rcl_ret_t said = rcl_publish(publisher, &message, NULL);

    check(
      said == RCL_RET_OK || said == RCL_RET_ERROR,
      4); /* an error: the ring is full, the other core is late */
    for (uint32_t k = 0; k < TRIES && heard != number; ++k) {
      check(rclc_executor_spin_some(executor, RCL_MS_TO_NS(1)) == RCL_RET_OK, 5);
    }
  }
  check(heard == number, 6);
}

int main(void)
{
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  static rcl_subscription_t subscription;
  static rclc_executor_t executor;
  static std_msgs__msg__Int32 received;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  for (uint32_t i = 0; i < SHARED_BYTES / sizeof(uint32_t); ++i) {
    shared_memory[i] = 0xa5a5a5a5u ^ i; /* at power-on anything may be there */
  }
  *init_vectors = second_vectors;
  *cpu_wait = 0;
  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK, 2);
  check(rclc_node_init_default(&node, "first", "", &support) == RCL_RET_OK, 2);
  check(rclc_publisher_init_default(&publisher, &node, type, "ping") == RCL_RET_OK, 2);
  check(rclc_subscription_init_default(&subscription, &node, type, "pong") == RCL_RET_OK, 2);
  check(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK, 3);
  check(
    rclc_executor_add_subscription(&executor, &subscription, &received, on_number, ON_NEW_DATA) == RCL_RET_OK,
    3);
  for (int32_t number = 1; number <= NUMBERS; ++number) {
    exchange(&publisher, &executor, number);
  }
  end(0);
}
