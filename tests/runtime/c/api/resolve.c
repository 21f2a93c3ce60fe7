/* SPDX-License-Identifier: Apache-2.0 */
/* Names of a node whose application file declares and remaps them. */
#include "tell.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/bool.h>

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;

static void resolve(const char * name)
{
  for (int i = 0; i < 4; ++i) {
    char * full = NULL;

    if (rcl_node_resolve_name(&node, name, heap, i / 2 != 0, i % 2 != 0, &full) != RCL_RET_OK) {
      abort();
    }
    SAY("%s %d\n", full, i);
    free(full);
  }
}

static void publish(const char * name)
{
  rcl_publisher_t publisher;
  const rcl_ret_t result =
    rclc_publisher_init_default(&publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Bool), name);

  SAY("%s %ld\n", result == RCL_RET_OK ? rcl_publisher_get_topic_name(&publisher) : "none", (long)result);
}

int main(int argc, char ** argv)
{
  allocator = heap;
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "imu", "/arm", &support) != RCL_RET_OK) {
    return 1;
  }
  for (int i = 1; i < argc; ++i) {
    resolve(argv[i]);
  }
  publish("data");
  publish("~/state");
  publish("{node}/free");
  publish("{ns}/other");
  publish("{ns}");
  return 0;
}
