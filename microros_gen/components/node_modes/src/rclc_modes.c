/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc_modes/rclc_modes.h"

#include "microros/epoch.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_modes_known.h"
#include "microros/rclc_modes_table.h"
#include "microros/rmw_by_place.h"
#include "microros/rmw_lifecycle.h"
#include "microros/rmw_modes.h"
#include "microros/rmw_parameters.h"
#include "microros/text.h"

#include <stddef.h>
#include <string.h>

/* As in rmw_qos_profile_services_default and in that of the publisher. */
enum { MODES_DEPTH = 10 };

/* The types of the services, in the order of the plan, which has their places. */
static const rosidl_service_type_support_t * const modes_offers[RCLC_EXECUTOR_MODES_HANDLES] = {
  &rclc_modes_change_type, &rclc_modes_get_available_type, &rclc_modes_get_type};

/* Closes what is open. Returns the first error. */
static rcl_ret_t modes_close(rclc_modes_t * modes)
{
  rcl_node_t * node = modes->lifecycle_node->node;
  rcl_ret_t first = RCL_RET_OK;

  if (rcl_service_is_valid(&modes->services[0])) {
    rmw_lifecycle_answer_large(rcl_service_get_rmw_handle(&modes->services[0]), false);
  }
  for (size_t i = 0; i < (size_t)RCLC_EXECUTOR_MODES_HANDLES; ++i) {
    const rcl_ret_t result = rcl_service_fini(&modes->services[i], node);

    first = first == RCL_RET_OK ? result : first;
  }
  if (rcl_publisher_is_valid(&modes->event_publisher)) {
    const rcl_ret_t result = rcl_publisher_fini(&modes->event_publisher, node);

    first = first == RCL_RET_OK ? result : first;
  }
  modes->table = NULL;
  return first;
}

static rcl_ret_t modes_open(rclc_modes_t * modes)
{
  const rcl_node_t * node = modes->lifecycle_node->node;
  rcl_ret_t result;
  uint16_t at = 0;

  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  result = rmw_publisher_open_by_place(
    node->impl, &rclc_modes_event_type, (uint16_t)MODES_DEPTH, &modes->event_publisher.impl);
  for (size_t i = 0; i < (size_t)RCLC_EXECUTOR_MODES_HANDLES && result == RCL_RET_OK; ++i) {
    result = rmw_replier_open_by_place(
      node->impl, modes_offers[i], (uint16_t)MODES_DEPTH, &at, &modes->services[i].impl);
  }
  if (result == RCL_RET_OK) {
    rmw_lifecycle_answer_large(rcl_service_get_rmw_handle(&modes->services[0]), true);
  }
  return result;
}

/* Sets the values of the mode before a sleep; those of __DEFAULT__ are there already. */
static rcl_ret_t modes_begin(rclc_modes_t * modes)
{
  const uint8_t before = rmw_modes_get(modes->lifecycle_node->node->impl);

  if (before == 0u || before >= modes->table->mode_count) {
    return RCL_RET_OK;
  }
  return rclc_modes_switch(modes, before, false);
}

rcl_ret_t rclc_modes_init(
  rclc_modes_t * modes, const rclc_modes_table_t * table, rclc_lifecycle_node_t * lifecycle_node,
  rclc_parameter_server_t * parameter_server)
{
  rcl_ret_t result;

  if (
    modes == NULL || table == NULL || lifecycle_node == NULL || parameter_server == NULL ||
    lifecycle_node->node == NULL || lifecycle_node->node != parameter_server->node) {
    return microros_error_refuse(
      RCL_RET_INVALID_ARGUMENT, "modes, table, lifecycle_node or parameter_server");
  }
  result = rcl_lifecycle_state_machine_is_initialized(lifecycle_node->state_machine);
  if (result != RCL_RET_OK) {
    return result;
  }
  (void)memset(modes, 0, sizeof(*modes)); /* it may be uninitialized memory */
  modes->table = table;
  modes->lifecycle_node = lifecycle_node;
  modes->parameter_server = parameter_server;
  result = modes_open(modes);
  if (result == RCL_RET_OK) {
    result = modes_begin(modes);
  }
  if (result != RCL_RET_OK) {
    (void)modes_close(modes); /* the first error is reported */
  } else {
    rclc_modes_register(modes);
  }
  return result;
}

static bool modes_are_initialized(const rclc_modes_t * modes)
{
  return modes != NULL && modes->table != NULL;
}

rcl_ret_t rclc_modes_fini(rclc_modes_t * modes)
{
  if (!modes_are_initialized(modes)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "modes");
  }
  rclc_modes_remove(modes);
  rmw_modes_set(modes->lifecycle_node->node->impl, 0u);
  return modes_close(modes);
}

uint8_t rclc_modes_get(const rclc_modes_t * modes)
{
  return modes_are_initialized(modes) ? modes->mode : (uint8_t)RCLC_MODES_NONE;
}

const char * rclc_modes_name(const rclc_modes_t * modes, uint8_t mode)
{
  return modes_are_initialized(modes) && mode < modes->table->mode_count ? modes->table->modes[mode].name
                                                                         : NULL;
}

uint8_t rclc_modes_find(const rclc_modes_t * modes, const char * name)
{
  if (modes_are_initialized(modes) && name != NULL) {
    for (uint8_t i = 0; i < modes->table->mode_count; ++i) {
      if (microros_text_equals(modes->table->modes[i].name, name)) {
        return i;
      }
    }
  }
  return (uint8_t)RCLC_MODES_NONE;
}

rcl_ret_t rclc_modes_refuse(rcl_ret_t result, const char * name, const char * why)
{
  microros_error_set(microros_error_mode, name, why, 0, 0);
  return result;
}

uint8_t rclc_modes_state(const rclc_modes_t * modes)
{
  const rcl_lifecycle_state_t * state = modes->lifecycle_node->state_machine->current_state;

  return state != NULL ? state->id : 0u;
}

rcl_ret_t rclc_modes_may_change(const rclc_modes_t * modes, uint8_t mode)
{
  const char * name = rclc_modes_name(modes, mode);
  uint8_t state;

  if (name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "modes or mode");
  }
  if (modes->on_callback || modes->parameter_server->on_callback) {
    return rclc_modes_refuse(
      RCLC_PARAMETER_DISABLED_ON_CALLBACK, name, MICROROS_ERROR_WORDS("not to be changed by a callback"));
  }
  state = rclc_modes_state(modes);
  if (
    state != (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE &&
    state != (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_INACTIVE) {
    return rclc_modes_refuse(
      RCL_RET_ERROR, name, MICROROS_ERROR_WORDS("the node is neither active nor inactive"));
  }
  return RCL_RET_OK;
}

rcl_ret_t rclc_modes_switch(rclc_modes_t * modes, uint8_t mode, bool asks)
{
  rcl_ret_t result;

  if (asks && modes->on_change != NULL) {
    bool accepted;

    modes->on_callback = true;
    accepted = modes->on_change(modes->mode, mode, modes->context);
    modes->on_callback = false;
    if (!accepted) {
      return rclc_modes_refuse(
        RCLC_PARAMETER_MODIFICATION_REJECTED, rclc_modes_name(modes, mode),
        MICROROS_ERROR_WORDS("the callback refused it"));
    }
  }
  result = rclc_modes_apply(modes->parameter_server, modes->table, mode, asks);
  if (result == RCL_RET_OK) {
    microros_lock(); /* a request of this device compares it */
    modes->mode = mode;
    microros_unlock();
    rmw_modes_set(modes->lifecycle_node->node->impl, mode);
  }
  return result;
}

void rclc_modes_publish(rclc_modes_t * modes)
{
  microros_lock(); /* the task of the session publishes it, too */
  if (
    modes->event_is_due && rmw_parameters_have_room(rcl_publisher_get_rmw_handle(&modes->event_publisher)) &&
    rcl_publish(&modes->event_publisher, modes, NULL) == RCL_RET_OK) {
    modes->event_is_due = false;
  }
  microros_unlock();
}

void rclc_modes_notify(rclc_modes_t * modes, uint8_t start_mode)
{
  microros_lock();
  if (!modes->event_is_due) {
    modes->event_start = start_mode;
  }
  modes->event_goal = modes->mode;
  modes->event_time_ns = (uint64_t)microros_epoch_known_ns();
  modes->event_is_due = true;
  rclc_modes_publish(modes);
  microros_unlock();
}

rcl_ret_t rclc_modes_change(rclc_modes_t * modes, uint8_t mode)
{
  rcl_ret_t result = rclc_modes_may_change(modes, mode);

  if (result == RCL_RET_OK) {
    const uint8_t start_mode = modes->mode;

    result = rclc_modes_switch(modes, mode, true);
    if (result == RCL_RET_OK) {
      rclc_modes_notify(modes, start_mode);
    }
  }
  return result;
}
