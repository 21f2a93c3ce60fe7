/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How deep the stack really gets: runs the library on a stack filled with a pattern against an agent of a few lines, in one process.
 * It has the functions of the port itself, so no system call adds to the depth. Prints the bytes below work()'s caller.
 */
#define _XOPEN_SOURCE 700 /* pthread_attr_setstack */

#include <microros/port.h>
#include <pthread.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/u_int8.h>

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { STACK_SIZE = 1 << 18, MARGIN = 256, PAINT = 0xA5, HEADER = 4, QUEUE = 8, ANSWER = 32 };

void work(void);

static unsigned char stack[STACK_SIZE] __attribute__((aligned(64)));
static uint8_t answers[QUEUE][ANSWER];
static size_t answer_sizes[QUEUE];
static unsigned answers_in;
static unsigned answers_out;
static uint32_t clock_ms;
static const unsigned char * caller;
static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t fast;
static rcl_publisher_t sure;
static int failed;

static void answer(uint8_t id, const uint8_t * payload, size_t size)
{
  uint8_t * to = answers[answers_in % QUEUE];

  memset(to, 0, ANSWER);
  to[0] = 0x81;
  to[4] = id;
  to[5] = 1;
  to[6] = (uint8_t)size;
  memcpy(&to[8], payload, size);
  answer_sizes[answers_in % QUEUE] = 8 + size;
  ++answers_in;
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  (void)udp;
  (void)host;
  return port != 0;
}

void port_udp_close(port_udp_t * udp)
{
  (void)udp;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  static const uint8_t agent[11] = {0, 0, 'X', 'R', 'C', 'E', 1, 0, 1, 15, 0};

  (void)udp;
  for (size_t at = HEADER; at + 4 <= size;) {
    const uint8_t id = data[at];
    const size_t length = (size_t)data[at + 2] | (size_t)data[at + 3] << 8;
    uint8_t status[6] = {data[at + 4], data[at + 5], data[at + 6], data[at + 7], 0, 0};
    const uint8_t all[5] = {0x03, 0x00, 0x00, 0x00, 0x80}; /* ACKNACK: everything below 3 arrived */

    if (id == 0) {
      answer(4, agent, sizeof(agent));
    } else if (id == 1 || id == 3) {
      answer(5, status, sizeof(status));
    } else if (id == 11) {
      answer(10, all, sizeof(all));
    }
    at += (4 + length + 3) & ~(size_t)3;
  }
  return true;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  size_t size;

  (void)udp;
  if (answers_in == answers_out) {
    return 0;
  }
  size = answer_sizes[answers_out % QUEUE];
  size = size < capacity ? size : capacity;
  memcpy(buffer, answers[answers_out % QUEUE], size);
  ++answers_out;
  return (int32_t)size;
}

uint32_t port_time_ms(void)
{
  return clock_ms += 5;
}

int64_t port_time_epoch_ns(void)
{
  return (int64_t)clock_ms * 1000000;
}

void port_sleep_ms(uint32_t duration_ms)
{
  clock_ms += duration_ms;
}

uint32_t port_unique_id(void)
{
  return 7;
}

void work(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  std_msgs__msg__UInt8 small = {1};
  std_msgs__msg__Int32 large = {2};

  caller = (const unsigned char *)__builtin_frame_address(0) + 2 * sizeof(void *);
  failed |= rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK;
  failed |= rclc_node_init_default(&node, "probe", "", &support) != RCL_RET_OK;
  failed |= rclc_publisher_init_best_effort(
              &fast, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, UInt8), "fast") != RCL_RET_OK;
  failed |= rclc_publisher_init_default(
              &sure, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "sure") != RCL_RET_OK;
  for (int i = 0; i < 3; ++i) {
    failed |= rcl_publish(&fast, &small, NULL) != RCL_RET_OK;
    failed |= rcl_publish(&sure, &large, NULL) != RCL_RET_OK;
    clock_ms += 200;
  }
  (void)rcl_publish(&sure, NULL, NULL);
  failed |= rcl_publisher_fini(&sure, &node) != RCL_RET_OK;
  failed |= rcl_publisher_fini(&fast, &node) != RCL_RET_OK;
  failed |= rcl_node_fini(&node) != RCL_RET_OK;
  (void)rclc_support_fini(&support);
}

static void * on_painted_stack(void * unused)
{
  void (*volatile run)(void) = work;
  const unsigned char * here = (const unsigned char *)&run;
  const size_t below = (size_t)(here - stack) - MARGIN;
  size_t untouched = 0;

  (void)unused;
  for (size_t i = 0; i < below; ++i) {
    ((volatile unsigned char *)stack)[i] = PAINT;
  }
  run();
  while (stack[untouched] == PAINT) {
    ++untouched;
  }
  (void)printf("%d %ld\n", failed, (long)(caller - &stack[untouched]));
  return NULL;
}

int main(void)
{
  pthread_attr_t attributes;
  pthread_t thread;

  if (
    pthread_attr_init(&attributes) != 0 || pthread_attr_setstack(&attributes, stack, STACK_SIZE) != 0 ||
    pthread_create(&thread, &attributes, on_painted_stack, NULL) != 0) {
    return 2;
  }
  return pthread_join(thread, NULL) == 0 ? 0 : 1;
}
