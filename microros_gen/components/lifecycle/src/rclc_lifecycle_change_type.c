/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A request to change the state is answered whatever it contains: its own decoder takes a label that is too long
 * for one that no transition has.
 */
#include "microros/cdr_decode.h"
#include "microros/error.h"
#include "microros/rclc_lifecycle_change.h"
#include "microros/service_type.h"

#include <string.h>

/* No label of ROS 2 begins with a space. */
static const char change_unknown[] = " ";

/* Of a request that is too large only this much arrives: the id and its padding. */
enum { CHANGE_BEGINNING = 4 };

static void change_decode(cdr_in_t * in, void * message)
{
  lifecycle_msgs__srv__ChangeState_Request * request = message;
  rosidl_runtime_c__String * label = &request->transition.label;
  uint32_t length;

  cdr_get_1(in, &request->transition.id, 1u, "id");
  if (!in->failed && in->size == (uint32_t)CHANGE_BEGINNING) {
    in->position = in->size; /* a request that is too large: so is its label */
    label->size = sizeof(change_unknown) - 1u;
    (void)memcpy(label->data, change_unknown, sizeof(change_unknown));
    return;
  }
  length = cdr_in_length(in, 1u, "label");
  if (in->failed) {
    return;
  }
  label->size = length == 0u ? 0u : length - 1u;
  if (length > label->capacity) {
    label->size = sizeof(change_unknown) - 1u;
    (void)memcpy(label->data, change_unknown, sizeof(change_unknown));
  } else if (length != 0u) {
    (void)memcpy(label->data, &in->body[in->position], length);
    label->data[length - 1u] = '\0';
  }
  in->position += length;
}

static uint32_t change_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const lifecycle_msgs__srv__ChangeState_Response * response = message;

  (void)fault;
  body[0] = response->success ? 1u : 0u;
  return 1u;
}

static const microros_message_type_t change_request = {
  .dds_type_name = MICROROS_ERROR_WORDS("lifecycle_msgs::srv::dds_::ChangeState_Request_"),
  .max_encoded_size = lifecycle_msgs__srv__ChangeState_Request__MAX_ENCODED_SIZE,
  .decode = change_decode};
static const microros_message_type_t change_response = {
  .dds_type_name = MICROROS_ERROR_WORDS("lifecycle_msgs::srv::dds_::ChangeState_Response_"),
  .max_encoded_size = lifecycle_msgs__srv__ChangeState_Response__MAX_ENCODED_SIZE,
  .encode = change_encode};
static const microros_service_type_t change_service = {
  .dds_type_name = "lifecycle_msgs::srv::dds_::ChangeState_",
  .request = &change_request,
  .response = &change_response};
const rosidl_service_type_support_t rclc_lifecycle_change_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &change_service};
