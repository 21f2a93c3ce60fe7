/* SPDX-License-Identifier: Apache-2.0 */
/* A pure sender with a port that does nothing: what is measured is the library. */
#include "types.h"

#include "microros/port.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publishers[2];
static std_msgs__msg__Int32 message;

volatile uint32_t sender_now_ms;
volatile char sender_error;

uint32_t port_time_ms(void)
{
  return sender_now_ms;
}

void port_sleep_ms(uint32_t duration_ms)
{
  sender_now_ms += duration_ms;
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  udp->handle = host[0] + (int)port;
  return true;
}

void port_udp_close(port_udp_t * udp)
{
  udp->handle = 0;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  udp->handle = data[size - 1u];
  return true;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  buffer[0] = (uint8_t)udp->handle;
  return (int32_t)(sender_now_ms % capacity);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "imu", "/arm", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publishers[0], &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "chatter") != RCL_RET_OK ||
    rclc_publisher_init_best_effort(
      &publishers[1], &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "imu/fast") != RCL_RET_OK) {
    sender_error = rcl_get_error_string().str[0];
    return 1;
  }
  for (;;) {
    ++message.data;
    if (
      rcl_publish(&publishers[0], &message, NULL) != RCL_RET_OK ||
      rcl_publish(&publishers[1], &message, NULL) != RCL_RET_OK) {
      break;
    }
    rclc_sleep_ms(100);
  }
  return rcl_publisher_fini(&publishers[0], &node) != RCL_RET_OK ||
         rcl_publisher_fini(&publishers[1], &node) != RCL_RET_OK || rcl_node_fini(&node) != RCL_RET_OK ||
         rclc_support_fini(&support) != RCL_RET_OK;
}
