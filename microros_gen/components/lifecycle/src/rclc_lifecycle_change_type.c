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

/* Where the label begins, after its length. Of a request that is too large only the id and its padding arrive. */
enum { CHANGE_BEGINNING = 4, CHANGE_LABEL_AT = CHANGE_BEGINNING + 4 };

/* Returns the length of the label, with its NUL; 0 if the body ends before it. */
static uint32_t change_length(const cdr_in_t * in)
{
  uint32_t length = 0;

  if (in->size >= (uint32_t)CHANGE_LABEL_AT) {
    (void)memcpy(&length, &in->body[CHANGE_BEGINNING], sizeof(length));
  }
  return in->swap ? length >> 24 | (length >> 8 & 0xff00u) | (length << 8 & 0xff0000u) | length << 24
                  : length;
}

static void change_decode(cdr_in_t * in, void * message)
{
  lifecycle_msgs__srv__ChangeState_Request * request = message;
  rosidl_runtime_c__String * label = &request->transition.label;
  const bool is_beginning = in->size == (uint32_t)CHANGE_BEGINNING;
  uint32_t length = change_length(in);
  const void * from = change_unknown;

  if (
    !is_beginning &&
    (in->size < (uint32_t)CHANGE_LABEL_AT || length > in->size - (uint32_t)CHANGE_LABEL_AT)) {
    cdr_in_refuse(in, CDR_FAULT_END, "label", (uint64_t)length + CHANGE_LABEL_AT, in->size);
    return;
  }
  if (is_beginning || length > label->capacity) {
    length = sizeof(change_unknown);
  } else {
    from = &in->body[CHANGE_LABEL_AT];
  }
  request->transition.id = in->body[0];
  label->size = length == 0u ? 0u : (size_t)length - 1u;
  (void)memcpy(label->data, from, (size_t)length);
  label->data[label->size] = '\0';
}

static uint32_t change_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const lifecycle_msgs__srv__ChangeState_Response * response = message;

  (void)fault;
  body[0] = response->success ? 1u : 0u;
  return 1u;
}

static const microros_message_type_t change_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::ChangeState_Request_"),
  .max_encoded_size = lifecycle_msgs__srv__ChangeState_Request__MAX_ENCODED_SIZE,
  .decode = change_decode};
static const microros_message_type_t change_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("lifecycle_msgs::srv::dds_::ChangeState_Response_"),
  .max_encoded_size = lifecycle_msgs__srv__ChangeState_Response__MAX_ENCODED_SIZE,
  .encode = change_encode};
static const microros_service_type_t change_service = {
  .dds_type_name = MICROROS_FLASH_NAME("lifecycle_msgs::srv::dds_::ChangeState_"),
  .request = &change_request,
  .response = &change_response};
const rosidl_service_type_support_t rclc_lifecycle_change_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &change_service};
