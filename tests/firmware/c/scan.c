/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Takes sensor_msgs/msg/LaserScan at depth 1 into its own buffers (storage: none): its RAM is a figure of
 * docs/verification/figures.md. SCAN_RANGES is the limit of both sequences, SCAN_INIT the function that opens the subscription.
 */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <sensor_msgs/msg/laser_scan.h>
#ifdef SCAN_UDP
#include <microros/port.h>
#endif

enum { FRAME_ID = 16 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static sensor_msgs__msg__LaserScan scan;
static char frame_id[FRAME_ID + 1];
static float ranges[SCAN_RANGES];
static float intensities[SCAN_RANGES];
static volatile float nearest;

#ifdef SCAN_UDP
/* A board has no network: what is measured is memory. */
bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  (void)udp;
  (void)host;
  (void)port;
  return true;
}

void port_udp_close(port_udp_t * udp)
{
  (void)udp;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  (void)udp;
  (void)data;
  (void)size;
  return true;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  (void)udp;
  (void)buffer;
  (void)capacity;
  return 0;
}
#endif

static void take(const void * message)
{
  const sensor_msgs__msg__LaserScan * taken = message;

  nearest = taken->ranges.size != 0u ? taken->ranges.data[0] : 0.0f;
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  scan.header.frame_id.data = frame_id;
  scan.header.frame_id.capacity = sizeof(frame_id);
  scan.ranges.data = ranges;
  scan.ranges.capacity = SCAN_RANGES;
  scan.intensities.data = intensities;
  scan.intensities.capacity = SCAN_RANGES;
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "eyes", "", &support) != RCL_RET_OK ||
    SCAN_INIT(&subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, LaserScan), "scan") !=
      RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 1, &allocator) != RCL_RET_OK ||
    rclc_executor_add_subscription(&executor, &subscription, &scan, take, ON_NEW_DATA) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
  }
}
