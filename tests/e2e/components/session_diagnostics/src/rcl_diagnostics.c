/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_diagnostics.h"

#include "diagnostic_msgs/msg/diagnostic_array.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_node.h"
#include "rcl/publisher.h"
#include "rmw_microros/session.h"
#include "session_diagnostics/session_diagnostics.h"

#include <stddef.h>

enum {
  diagnostics_values = 6,
  diagnostics_digits = 11 /* of a uint32_t, with the NUL */
};

static rcl_publisher_t diagnostics_publisher;
static const rcl_node_t * diagnostics_node; /* whose it is; NULL: it is closed */
static uint32_t diagnostics_faults;         /* when they were published the last time */

rcl_ret_t rcl_diagnostics_open(rcl_node_t * node)
{
  const rosidl_message_type_support_t * type =
    ROSIDL_GET_MSG_TYPE_SUPPORT(diagnostic_msgs, msg, DiagnosticArray);
  xrce_client_t * client = rmw_client_instance();
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  rcl_ret_t result;

  if (diagnostics_node != NULL || rmw_node_index(node->impl) != 0u) {
    return RCL_RET_OK;
  }
  options.qos.depth = 1;
  diagnostics_publisher = rcl_get_zero_initialized_publisher();
  result = rcl_publisher_init(&diagnostics_publisher, node, type, "/diagnostics", &options);
  if (result == RCL_RET_OK) {
    diagnostics_node = node;
    diagnostics_faults = 0;
    client->diagnostics.due_ms = port_time_ms();
    client->diagnostics.is_due = false;
    client->diagnostics.running = true;
  }
  return result;
}

void rcl_diagnostics_close(rcl_node_t * node)
{
  if (node == diagnostics_node) {
    rmw_client_instance()->diagnostics.running = false;
    /* What cannot be deleted at the agent, the time-out of the session deletes. */
    (void)rcl_publisher_fini(&diagnostics_publisher, node);
    diagnostics_node = NULL;
  }
}

/* Points to text that is only read: a capacity of 0 says that it is not the message's own. */
static rosidl_runtime_c__String diagnostics_text(const char * text)
{
  rosidl_runtime_c__String string = {(char *)text, 0, 0};

  while (text[string.size] != '\0') {
    ++string.size;
  }
  return string;
}

/* Writes a number into the end of `digits`; returns where it begins. */
static const char * diagnostics_number(uint32_t number, char digits[diagnostics_digits])
{
  size_t at = diagnostics_digits - 1u;

  digits[at] = '\0';
  do {
    --at;
    digits[at] = (char)('0' + number % 10u);
    number /= 10u;
  } while (number != 0u);
  return &digits[at];
}

static void diagnostics_stamp(builtin_interfaces__msg__Time * stamp)
{
  const int64_t ns_per_s = 1000000000;
  const int64_t now = port_time_epoch_ns();

  stamp->sec = (int32_t)(now / ns_per_s);
  stamp->nanosec = (uint32_t)(now % ns_per_s);
}

static void diagnostics_send(const rmw_uros_statistics_t * statistics)
{
  const uint32_t faults = statistics->dropped + statistics->malformed + statistics->reconnects;
  const struct {
    const char * name;
    uint32_t value;
  } rows[diagnostics_values] = {
    {"sent", statistics->sent},         {"resent", statistics->resent},
    {"received", statistics->received}, {"malformed", statistics->malformed},
    {"dropped", statistics->dropped},   {"reconnects", statistics->reconnects},
  };
  char digits[diagnostics_values][diagnostics_digits];
  diagnostic_msgs__msg__KeyValue values[diagnostics_values];
  diagnostic_msgs__msg__DiagnosticStatus status = {0};
  diagnostic_msgs__msg__DiagnosticArray message = {0};

  for (size_t i = 0; i < (size_t)diagnostics_values; ++i) {
    values[i].key = diagnostics_text(rows[i].name);
    values[i].value = diagnostics_text(diagnostics_number(rows[i].value, digits[i]));
  }
  status.level = faults == diagnostics_faults ? diagnostic_msgs__msg__DiagnosticStatus__OK
                                              : diagnostic_msgs__msg__DiagnosticStatus__WARN;
  status.name = diagnostics_text("micro-ROS session");
  status.message = diagnostics_text(faults == diagnostics_faults ? "no new faults" : "new faults");
  status.hardware_id = diagnostics_text("");
  status.values.data = values;
  status.values.size = diagnostics_values;
  diagnostics_stamp(&message.header.stamp);
  message.header.frame_id = diagnostics_text("");
  message.status.data = &status;
  message.status.size = 1;
  diagnostics_faults = faults;
  /* What is dropped is counted, and published with the next message. */
  (void)rcl_publish(&diagnostics_publisher, &message, NULL);
}

void rcl_diagnostics_publish(void)
{
  xrce_client_t * client = rmw_client_instance();
  rmw_context_t * context;
  rmw_uros_statistics_t statistics;

  if (diagnostics_node == NULL || !client->diagnostics.is_due) {
    return;
  }
  client->diagnostics.is_due = false;
  context = rcl_context_get_rmw_context(diagnostics_node->context);
  if (rmw_uros_is_connected(context) && rmw_uros_get_statistics(context, &statistics) == RMW_RET_OK) {
    diagnostics_send(&statistics);
  }
}

void session_diagnostics_now(void)
{
  xrce_client_t * client = rmw_client_instance();

  if (diagnostics_node != NULL) {
    client->diagnostics.due_ms = port_time_ms() + MICROROS_DIAGNOSTICS_PERIOD_MS;
    client->diagnostics.is_due = true;
  }
}
