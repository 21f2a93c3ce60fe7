/* SPDX-License-Identifier: Apache-2.0 */
/* What the service types of all actions have in common. */
#include "microros/cdr_decode.h"
#include "microros/error.h"
#include "microros/rclc_action_client.h"

#include <string.h>

/* The members of a response: accepted, then the time at which it was, which nothing here needs. */
enum { ACTION_RESPONSE_SIZE = 12 };

static void action_decode_response(cdr_in_t * in, void * accepted)
{
  cdr_get_bool(in, accepted, 1, "accepted");
}

static uint32_t action_encode_id(const void * uuid, uint8_t * body, cdr_fault_t * fault)
{
  (void)fault;
  (void)memcpy(body, uuid, UUID_SIZE);
  return UUID_SIZE;
}

const microros_message_type_t rclc_action_client_response_type = {
  .dds_type_name = MICROROS_ERROR_TYPE("SendGoal_Response_"),
  .max_encoded_size = ACTION_RESPONSE_SIZE,
  .decode = action_decode_response};
const microros_message_type_t rclc_action_client_id_type = {
  .dds_type_name = MICROROS_ERROR_TYPE("GetResult_Request_"),
  .max_encoded_size = UUID_SIZE,
  .encode = action_encode_id};
