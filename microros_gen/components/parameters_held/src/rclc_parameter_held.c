/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Changes that the server does not know yet, and the notices about them. A place has an `event` until the server has
 * acknowledged it.
 */
#include "microros/rclc_parameter_held.h"

#include "microros/error.h"
#include "microros/port.h"
#include "microros/rclc_parameter_descriptor.h"
#include "microros/rclc_parameter_held_log.h"
#include "microros/rmw_client.h"
#include "microros/rmw_parameters.h"
#include "rclc/publisher.h"
#include "microros_parameter_msgs/msg/notice.h"
#include "rclc_parameter/held_parameters.h"

#include <stddef.h>

static uint32_t held_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_parameter_server_t * server = message;
  parameter_out_t out = {body, 0, microros_parameter_msgs__msg__Notice__MAX_ENCODED_SIZE, false};

  rclc_parameter_out_node(&out, server->node);
  rclc_parameter_out_4(&out, rmw_client_key());
  rclc_parameter_out_4(&out, server->held.own_session);
  rclc_parameter_out_4(&out, server->held.own_revision);
  if (out.full) {
    (void)cdr_refuse(fault, CDR_FAULT_LIMIT, "node", 0u, 0u);
  }
  return out.full ? 0u : out.position;
}

static const microros_message_type_t held_message = {
  .dds_type_name = MICROROS_FLASH_NAME("microros_parameter_msgs::msg::dds_::Notice_"),
  .max_encoded_size = microros_parameter_msgs__msg__Notice__MAX_ENCODED_SIZE,
  .encode = held_encode};

rcl_ret_t rclc_parameter_held_open(rclc_parameter_server_t * server, const rcl_node_t * node)
{
  static const rosidl_message_type_support_t type = {
    .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &held_message};
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  qos.depth = 1;
  return rclc_publisher_init(&server->event_publisher, node, &type, "/microros_parameters/notices", &qos);
}

void rclc_parameter_held_begin(rclc_parameter_server_t * server)
{
  for (size_t i = 0; i < server->count; ++i) {
    if (server->places[i].event != (uint8_t)PARAMETER_EVENT_DELETED) {
      server->places[i].event = (uint8_t)PARAMETER_EVENT_NEW;
    }
  }
  server->held.requested_ns = port_time_steady_ns();
  server->held.has_begun = true;
  server->held.wait_s = (uint8_t)RCLC_PARAMETER_HELD_FIRST_S;
  server->held.notice_is_due = true;
}

void rclc_parameter_held_note(
  rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t event)
{
  rclc_parameter_held_t * const held = &server->held;

  if (held->is_setting && event != (uint32_t)PARAMETER_EVENT_DELETED) {
    if (place->event == (uint8_t)PARAMETER_EVENT_CHANGED) {
      ++held->overruled;
      rclc_parameter_held_log(place->about->name);
    }
    place->event = (uint8_t)PARAMETER_EVENT_NONE;
    return;
  }
  ++held->own_revision;
  place->event = (uint8_t)event;
  place->own_revision = held->own_revision;
  place->changed_ns = port_time_steady_ns();
  held->notice_is_due = true;
}

/* Returns how many places have a state that the server does not know. */
static uint32_t held_news(const rclc_parameter_server_t * server)
{
  uint32_t count = 0;

  for (size_t i = 0; i < server->count; ++i) {
    count += server->places[i].event != (uint8_t)PARAMETER_EVENT_NONE ? 1u : 0u;
  }
  return count;
}

/* An agent that was away or was replaced has no notice. */
static void held_follow_session(rclc_parameter_server_t * server)
{
  const uint32_t reconnects = rmw_client_reconnects();

  if (reconnects != server->held.reconnects) {
    server->held.reconnects = reconnects;
    server->held.notice_is_due = true;
    server->held.wait_s = (uint8_t)RCLC_PARAMETER_HELD_FIRST_S;
  }
}

void rclc_parameter_publish(rclc_parameter_server_t * server)
{
  rclc_parameter_held_t * const held = &server->held;

  if (!held->has_begun || held->is_setting || !rcl_publisher_is_valid(&server->event_publisher)) {
    return;
  }
  held_follow_session(server);
  if (
    held->notice_is_due && rmw_parameters_have_room(rcl_publisher_get_rmw_handle(&server->event_publisher)) &&
    rcl_publish(&server->event_publisher, server, NULL) == RCL_RET_OK) {
    held->notice_is_due = false; /* else the executor tries again when there is room */
    held->noticed_ns = port_time_steady_ns();
  }
}

static int64_t held_wait_ns(const rclc_parameter_held_t * held)
{
  return (int64_t)held->wait_s * 1000000000;
}

void rclc_parameter_held_look(rclc_parameter_server_t * server, int64_t * look_again_ns)
{
  rclc_parameter_held_t * const held = &server->held;
  int64_t left;

  if (!held->has_begun || held->notice_is_due || (held->own_session != 0u && held_news(server) == 0u)) {
    return;
  }
  left = held->noticed_ns + held_wait_ns(held) - port_time_steady_ns();
  if (left <= 0) {
    if (held->wait_s < (uint8_t)RCLC_PARAMETER_HELD_MOST_S) {
      held->wait_s = (uint8_t)(held->wait_s * 2u);
    }
    held->notice_is_due = true;
    rclc_parameter_publish(server);
    left = held_wait_ns(held);
  }
  if (left < *look_again_ns) {
    *look_again_ns = left;
  }
}

rcl_ret_t rclc_parameter_check_held(const rclc_parameter_server_t * parameter_server)
{
  const uint64_t ns_per_ms = 1000000;
  uint64_t rest;
  uint64_t age_ms;
  uint32_t count;

  if (parameter_server == NULL || parameter_server->node == NULL) {
    return rclc_parameter_refuse_argument();
  }
  count = held_news(parameter_server);
  if (count == 0u && parameter_server->held.own_session != 0u) {
    return RCL_RET_OK;
  }
  age_ms = rclc_parameter_divide(
    (uint64_t)port_time_steady_ns() - (uint64_t)parameter_server->held.requested_ns, ns_per_ms, &rest);
  microros_error_set(
    microros_error_parameters_away, rcl_node_get_name(parameter_server->node), NULL,
    age_ms < UINT32_MAX ? (uint32_t)age_ms : UINT32_MAX, count);
  return RCL_RET_TIMEOUT;
}

uint32_t rclc_parameter_count_overruled(const rclc_parameter_server_t * parameter_server)
{
  return parameter_server != NULL ? parameter_server->held.overruled : 0u;
}
