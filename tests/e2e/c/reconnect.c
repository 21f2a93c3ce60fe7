/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A sender as users of rclc have them: only the usual API, nothing of this project's own. It looks for the agent,
 * creates its entities, publishes, and begins again when the agent is gone.
 */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <stdio.h>

#define CHECK(call) \
  do { \
    rcl_ret_t result = (call); \
    if (result != RCL_RET_OK) { \
      fprintf(stderr, #call ": status %d\n", (int)result); \
      return false; \
    } \
  } while (0)

static rcl_allocator_t allocator;
static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static std_msgs__msg__Int32 message;

static bool create_entities(void)
{
  rcl_init_options_t init_options = rcl_get_zero_initialized_init_options();

  allocator = rcl_get_default_allocator();
  CHECK(rcl_init_options_init(&init_options, allocator));
  CHECK(rcl_init_options_set_domain_id(&init_options, 0));
  CHECK(rclc_support_init_with_options(&support, 0, NULL, &init_options, &allocator));
  CHECK(rcl_init_options_fini(&init_options));
  CHECK(rclc_node_init_default(&node, "usual_node", "", &support));
  CHECK(rclc_publisher_init_default(
    &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "usual_count"));
  return true;
}

static void destroy_entities(void)
{
  rmw_context_t * rmw_context = rcl_context_get_rmw_context(&support.context);

  (void)rmw_uros_set_context_entity_destroy_session_timeout(rmw_context, 0);
  rcl_ret_t result = rcl_publisher_fini(&publisher, &node);
  result += rcl_node_fini(&node);
  result += rclc_support_fini(&support);
  RCLC_UNUSED(result);
}

int main(int argc, const char * argv[])
{
  enum { WAITING_AGENT, AGENT_CONNECTED, AGENT_DISCONNECTED } state = WAITING_AGENT;
  const int64_t period_ns = RCL_MS_TO_NS(10);
  int since_ping = 0;

  RCLC_UNUSED(argc);
  RCLC_UNUSED(argv);
  setvbuf(stdout, NULL, _IOLBF, 0);
  for (;;) {
    switch (state) {
      case WAITING_AGENT:
        if (rmw_uros_ping_agent(100, 1) == RMW_RET_OK) {
          state = create_entities() ? AGENT_CONNECTED : AGENT_DISCONNECTED;
          printf("%s\n", state == AGENT_CONNECTED ? "connected" : "failed");
        }
        break;
      case AGENT_CONNECTED:
        if (++since_ping >= 20) {
          since_ping = 0;
          if (rmw_uros_ping_agent(100, 3) != RMW_RET_OK) {
            state = AGENT_DISCONNECTED;
            break;
          }
        }
        message.data++;
        RCLC_UNUSED(rcl_publish(&publisher, &message, NULL));
        break;
      case AGENT_DISCONNECTED:
      default:
        destroy_entities();
        printf("disconnected\n");
        state = WAITING_AGENT;
        break;
    }
    rclc_sleep_ms((unsigned int)RCL_NS_TO_MS(period_ns));
  }
}
