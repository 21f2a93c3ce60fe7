/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages of modes, written from the tables: no text is copied before. A request to change the mode is answered
 * whatever it contains; a name that is too long is that of no mode. On the wire the name of a service is enough; the
 * names of its messages occur only in error texts.
 */
#include "microros/cdr_decode.h"
#include "microros/error.h"
#include "microros/rclc_modes_table.h"
#include "microros/rclc_parameter_out.h"
#include "microros/service_type.h"
#include "system_modes_msgs/msg/mode_event.h"
#include "system_modes_msgs/srv/change_mode.h"
#include "system_modes_msgs/srv/get_available_modes.h"
#include "system_modes_msgs/srv/get_mode.h"

#include <stddef.h>

/* Of a request that is too large only the length of its name arrives. */
enum { MODES_BEGINNING = 4 };

static bool modes_is_name(const char * name, const uint8_t * text, uint32_t size)
{
  uint32_t i = 0;

  while (i < size && name[i] != '\0' && (uint8_t)name[i] == text[i]) {
    ++i;
  }
  return i == size && name[i] == '\0';
}

static void modes_decode_change(cdr_in_t * in, void * message)
{
  rclc_modes_t * modes = message;
  uint32_t length;

  modes->requested = (uint8_t)RCLC_MODES_NONE;
  if (in->size == (uint32_t)MODES_BEGINNING) {
    in->position = in->size;
    return;
  }
  length = cdr_in_length(in, 1u, "mode_name");
  for (uint8_t i = 0; i < modes->table->mode_count && length > 1u; ++i) {
    if (modes_is_name(modes->table->modes[i].name, &in->body[in->position], length - 1u)) {
      modes->requested = i;
    }
  }
  in->position += length;
}

/* Other requests have no contents. */
static void modes_decode(cdr_in_t * in, void * message)
{
  (void)in;
  (void)message;
}

/* Returns the length of a body whose limits are those of the tables. */
static uint32_t modes_end(const parameter_out_t * out, const rclc_modes_t * modes, cdr_fault_t * fault)
{
  if (out->full) {
    (void)cdr_refuse(fault, CDR_FAULT_LIMIT, "modes", modes->table->mode_count, 0u);
  }
  return out->full ? 0u : out->position;
}

static uint32_t modes_encode_change(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_modes_t * modes = message;

  (void)fault;
  body[0] = modes->succeeded ? 1u : 0u;
  return 1u;
}

static uint32_t modes_encode_available(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_modes_t * modes = message;
  parameter_out_t out = {
    body, 0, system_modes_msgs__srv__GetAvailableModes_Response__MAX_ENCODED_SIZE, false};

  rclc_parameter_out_4(&out, modes->table->mode_count);
  for (uint8_t i = 0; i < modes->table->mode_count; ++i) {
    rclc_parameter_out_text(&out, modes->table->modes[i].name);
  }
  return modes_end(&out, modes, fault);
}

static uint32_t modes_encode_get(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_modes_t * modes = message;
  parameter_out_t out = {body, 0, system_modes_msgs__srv__GetMode_Response__MAX_ENCODED_SIZE, false};
  const bool is_active = rclc_modes_state(modes) == (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE;

  rclc_parameter_out_text(&out, is_active ? modes->table->modes[modes->mode].name : "");
  return modes_end(&out, modes, fault);
}

static uint32_t modes_encode_event(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_modes_t * modes = message;
  parameter_out_t out = {body, 0, system_modes_msgs__msg__ModeEvent__MAX_ENCODED_SIZE, false};

  rclc_parameter_out_8(&out, &modes->event_time_ns);
  rclc_parameter_out_text(&out, modes->table->modes[modes->event_start].name);
  rclc_parameter_out_text(&out, modes->table->modes[modes->event_goal].name);
  return modes_end(&out, modes, fault);
}

static const microros_message_type_t modes_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("system_modes_msgs::srv::dds_::GetMode_Request_"),
  .max_encoded_size = system_modes_msgs__srv__GetMode_Request__MAX_ENCODED_SIZE,
  .decode = modes_decode};

static const microros_message_type_t modes_change_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("system_modes_msgs::srv::dds_::ChangeMode_Request_"),
  .max_encoded_size = system_modes_msgs__srv__ChangeMode_Request__MAX_ENCODED_SIZE,
  .decode = modes_decode_change};
static const microros_message_type_t modes_change_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("system_modes_msgs::srv::dds_::ChangeMode_Response_"),
  .max_encoded_size = system_modes_msgs__srv__ChangeMode_Response__MAX_ENCODED_SIZE,
  .encode = modes_encode_change};
static const microros_service_type_t modes_change_service = {
  .dds_type_name = MICROROS_FLASH_NAME("system_modes_msgs::srv::dds_::ChangeMode_"),
  .request = &modes_change_request,
  .response = &modes_change_response};
const rosidl_service_type_support_t rclc_modes_change_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &modes_change_service};

static const microros_message_type_t modes_available_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("system_modes_msgs::srv::dds_::GetAvailableModes_Response_"),
  .max_encoded_size = system_modes_msgs__srv__GetAvailableModes_Response__MAX_ENCODED_SIZE,
  .encode = modes_encode_available};
static const microros_service_type_t modes_available_service = {
  .dds_type_name = MICROROS_FLASH_NAME("system_modes_msgs::srv::dds_::GetAvailableModes_"),
  .request = &modes_request,
  .response = &modes_available_response};
const rosidl_service_type_support_t rclc_modes_get_available_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &modes_available_service};

static const microros_message_type_t modes_get_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("system_modes_msgs::srv::dds_::GetMode_Response_"),
  .max_encoded_size = system_modes_msgs__srv__GetMode_Response__MAX_ENCODED_SIZE,
  .encode = modes_encode_get};
static const microros_service_type_t modes_get_service = {
  .dds_type_name = MICROROS_FLASH_NAME("system_modes_msgs::srv::dds_::GetMode_"),
  .request = &modes_request,
  .response = &modes_get_response};
const rosidl_service_type_support_t rclc_modes_get_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &modes_get_service};

static const microros_message_type_t modes_event_message = {
  .dds_type_name = MICROROS_FLASH_NAME("system_modes_msgs::msg::dds_::ModeEvent_"),
  .max_encoded_size = system_modes_msgs__msg__ModeEvent__MAX_ENCODED_SIZE,
  .encode = modes_encode_event};
const rosidl_message_type_support_t rclc_modes_event_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &modes_event_message};
