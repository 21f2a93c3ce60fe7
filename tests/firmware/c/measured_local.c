/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measured way of a message from a publisher to the callback of a subscription of the same image: the publish call,
 * and the executor up to the callback. With MEASURED_AGENT over the agent, which returns the sample in between, on the line
 * of MEASURED_LINE; with MEASURED_CHIP over the memory that two images share, and the other one sends it back. It is an Int32,
 * or the Pose of MEASURED_POSE. Done several times: the last one takes in what the agent said
 * to the one before.
 */
#ifdef MEASURED_LINE
#include "measured_serial.h"
#else
#include "measured.h"
#endif

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#ifdef MEASURED_POSE
#include <geometry_msgs/msg/pose.h>

enum { BODY = 56 };
typedef geometry_msgs__msg__Pose measured_t;
#define MEASURED_TYPE ROSIDL_GET_MSG_TYPE_SUPPORT(geometry_msgs, msg, Pose)
#else
#include <std_msgs/msg/int32.h>

enum { BODY = 4 };
typedef std_msgs__msg__Int32 measured_t;
#define MEASURED_TYPE ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32)
#endif

#ifdef MEASURED_CHIP
#include <microros/port_shared.h>

#include "microros/rmw_shared.h"

#define MEASURED_HEARD "heard"

/* The first ring is that of /count, the second one that of /heard. An end has three words: its key, its run and its count. */
enum { SENT, HEARD, END = 3, COUNT = 2 };

static uint32_t shared[MICROROS_SHARED_WORDS];

uint32_t * port_shared_region(size_t bytes)
{
  return bytes <= sizeof(shared) ? shared : NULL;
}

void port_shared_barrier(void)
{
  __asm volatile("dmb" ::: "memory");
}

void port_shared_notify(void)
{
}

/* The other image has read all and written as much. */
static void other_follows(void)
{
  const volatile uint32_t * from = &shared[rmw_shared_rings[SENT].ends];
  volatile uint32_t * reads = &shared[rmw_shared_rings[SENT].ends + END];
  volatile uint32_t * writes = &shared[rmw_shared_rings[HEARD].ends];

  for (uint32_t i = 0; i < (uint32_t)END; ++i) {
    reads[i] = from[i];
    writes[i] = from[i];
  }
}

/* Its writer has as many slots as this one. */
static void other_returns(void)
{
  const rmw_shared_ring_t * sent = &rmw_shared_rings[SENT];
  const rmw_shared_ring_t * heard = &rmw_shared_rings[HEARD];
  const uint32_t last = (shared[sent->ends + COUNT] + 2u * sent->slots - 1u) % sent->slots;

  for (volatile uint32_t i = 0; i < sent->words; ++i) {
    shared[heard->at + last * heard->words + i] = shared[sent->at + last * sent->words + i];
  }
  other_follows();
}
#else
#define MEASURED_HEARD "count"
#endif

enum { READER = 1, TIMES = 8, DATA_HEADER = 12 };

static void check(bool holds)
{
  if (!holds) {
    finish();
  }
}

/* The sample, all zero but for its first byte, comes back from the agent. Not inlined: its work does not count. */
__attribute__((noinline)) static void agent_returns(uint8_t value)
{
#ifdef MEASURED_AGENT
  static uint8_t data[DATA_HEADER + BODY] = {0x81, RELIABLE, 0, 0, 0x09, 0x01, 4 + BODY, 0};

  data[2] = (uint8_t)(output_sequence[1] & 0xffu);
  data[3] = (uint8_t)(output_sequence[1] >> 8);
  ++output_sequence[1];
  put(&data[8], read_ids[READER], 4);
  data[DATA_HEADER] = value;
  answer(data, sizeof(data));
#elif defined(MEASURED_CHIP)
  (void)value;
  other_returns();
#else
  (void)value;
#endif
}

static volatile uint8_t heard_first;

/* Ends a region: what the executor does after the callback belongs to neither way. */
static void on_message(const void * message)
{
  mark();
  heard_first = *(const uint8_t *)message;
}

int main(void)
{
  static measured_t said;
  static measured_t heard;
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  static rcl_subscription_t subscription;
  static rclc_executor_t executor;
  const rosidl_message_type_support_t * type = MEASURED_TYPE;
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  check(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  check(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  check(rclc_subscription_init_default(&subscription, &node, type, MEASURED_HEARD) == RCL_RET_OK);
  check(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  check(
    rclc_executor_add_subscription(&executor, &subscription, &heard, on_message, ON_NEW_DATA) == RCL_RET_OK);
  for (uint32_t i = 0; i < TIMES; ++i) {
    check(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  }
#ifdef MEASURED_CHIP
  other_follows();
  check(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
#endif
  mark();
  mark();
  for (uint8_t i = 1; i <= TIMES; ++i) {
    *(uint8_t *)&said = i;
    mark();
    check(rcl_publish(&publisher, &said, NULL) == RCL_RET_OK);
    mark();
    agent_returns(i);
    mark();
    check(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
    check(heard_first == i);
  }
  finish();
}
