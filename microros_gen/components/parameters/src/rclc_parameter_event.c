/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/epoch.h"
#include "microros/rclc_parameter_descriptor.h"
#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameter_value.h"
#include "microros/rclc_parameters.h"
#include "microros/rmw_parameters.h"

#include <stddef.h>

static void event_out_stamp(parameter_out_t * out)
{
  const uint64_t ns_per_s = 1000000000;
  uint64_t nanoseconds;
  const uint32_t seconds =
    (uint32_t)rclc_parameter_divide((uint64_t)microros_epoch_known_ns(), ns_per_s, &nanoseconds);
  const uint32_t rest = (uint32_t)nanoseconds;
  uint8_t * to = rclc_parameter_out_take(out, 4u, 8u);

  if (to != NULL) {
    cdr_put_4(&to[0], &seconds);
    cdr_put_4(&to[4], &rest);
  }
}

/* Writes the parameters that the event lists as `what`; as in ROS 2, deleted ones have no value. */
static void event_out_list(parameter_out_t * out, const rclc_parameter_server_t * server, uint8_t what)
{
  const rclc_parameter_place_t * end = &server->places[server->count];
  const uint32_t at = rclc_parameter_out_begin(out);
  uint32_t count = 0;

  /* at most MICROROS_PARAMETERS_MAX rounds */
  for (const rclc_parameter_place_t * place = server->places; place != end; ++place) {
    if (place->event == what) {
      rclc_parameter_out_text(out, place->about->name);
      rclc_parameter_out_value(
        out, what == (uint8_t)PARAMETER_EVENT_DELETED ? &rclc_parameter_nothing : place);
      ++count;
    }
  }
  rclc_parameter_out_end(out, at, count);
}

static uint32_t event_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  parameter_out_t out = {body, 0, rcl_interfaces__msg__ParameterEvent__MAX_ENCODED_SIZE, false};

  event_out_stamp(&out);
  rclc_parameter_out_node(&out, server->node);
  for (uint8_t what = (uint8_t)PARAMETER_EVENT_NEW; what <= (uint8_t)PARAMETER_EVENT_DELETED; ++what) {
    event_out_list(&out, server, what); /* the message has them in the order of the enumeration */
  }
  if (out.full) {
    (void)cdr_refuse(fault, CDR_FAULT_LIMIT, "changed_parameters", server->count, 0u);
  }
  return out.full ? 0u : out.position;
}

static const microros_message_type_t event_message = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::msg::dds_::ParameterEvent_"),
  .max_encoded_size = rcl_interfaces__msg__ParameterEvent__MAX_ENCODED_SIZE,
  .encode = event_encode};

const rosidl_message_type_support_t rclc_parameter_event_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &event_message};

static bool event_is_due(const rclc_parameter_server_t * server)
{
  const rclc_parameter_place_t * end = &server->places[server->count];

  /* at most MICROROS_PARAMETERS_MAX rounds */
  for (const rclc_parameter_place_t * place = server->places; place != end; ++place) {
    if (place->event != (uint8_t)PARAMETER_EVENT_NONE) {
      return true;
    }
  }
  return false;
}

void rclc_parameter_publish(rclc_parameter_server_t * server)
{
  size_t i = 0;

  if (!event_is_due(server)) {
    return;
  }
  if (
    server->notify_changed_over_dds &&
    (!rmw_parameters_have_room(rcl_publisher_get_rmw_handle(&server->event_publisher)) ||
     rcl_publish(&server->event_publisher, server, NULL) != RCL_RET_OK)) {
    return; /* the executor tries again when there is room */
  }
  while (i < server->count) { /* at most MICROROS_PARAMETERS_MAX rounds */
    const bool deleted = server->places[i].event == (uint8_t)PARAMETER_EVENT_DELETED;

    server->places[i].event = (uint8_t)PARAMETER_EVENT_NONE;
    if (deleted) {
      rclc_parameter_remove(server, &server->places[i]);
    } else {
      ++i;
    }
  }
}
