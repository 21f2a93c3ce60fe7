/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the service types of all actions have in common. A goal request is decoded to the place of its goal, and one that
 * cannot be accepted only as far as it can be answered; a result is encoded when the goal ends, and copied afterwards.
 */
#include "microros/action_type.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"

#include <string.h>

/* Of a request that is too large for its queue only these bytes arrive (XRCE_PARAMETERS_BEGINNING). */
enum { ACTION_BEGINNING = 4, ACTION_STAMP_AT = 4 };

static void action_decode_refuse(rclc_action_incoming_t * incoming, const char * why)
{
  incoming->goal->is_used = false;
  incoming->goal = NULL;
  incoming->refused = why;
}

/* Decodes to the place; a fault refuses the goal, and not the request. */
static void action_decode_place(cdr_in_t * in, rclc_action_incoming_t * incoming, const uint8_t * uuid)
{
  const microros_action_type_t * type = incoming->server->type;
  const microros_message_type_t * request = type->goal_request->data;

  incoming->goal->is_used = true;
  incoming->goal->status = GOAL_STATE_UNKNOWN;
  incoming->goal->goal_cancelled = false;
  incoming->goal->result_sent = false;
  incoming->goal->waiting = 0u;
  (void)memcpy(incoming->goal->goal_id.uuid, uuid, UUID_SIZE);
  request->decode(in, incoming->goal->ros_goal_request);
  if (in->failed) {
    in->failed = false;
    action_decode_refuse(incoming, MICROROS_ERROR_WORDS("it is above its limits: raise them"));
  }
}

void rclc_action_decode_goal(cdr_in_t * in, void * incoming)
{
  rclc_action_incoming_t * request = incoming;

  request->goal = NULL;
  if (in->size == (uint32_t)ACTION_BEGINNING) {
    request->refused = MICROROS_ERROR_WORDS("it is above its limits: raise them");
    return;
  }
  if (in->size < (uint32_t)UUID_SIZE) {
    cdr_in_refuse(in, CDR_FAULT_END, "goal_id", UUID_SIZE, in->size);
    return;
  }
  microros_lock();
  if (rclc_action_find(request->server, in->body) != NULL) {
    request->refused = MICROROS_ERROR_WORDS("a goal with this id exists");
  } else {
    request->refused = MICROROS_ERROR_WORDS("all its goals are in use: raise its goals");
    request->goal = rclc_action_take_place(request->server);
    if (request->goal != NULL) {
      action_decode_place(in, request, in->body);
    }
  }
  microros_unlock();
}

/* Both numbers have four bytes; the wire is little endian. */
static void action_encode_4(uint8_t * at, uint32_t number)
{
  at[0] = (uint8_t)(number & 0xffu);
  at[1] = (uint8_t)(number >> 8 & 0xffu);
  at[2] = (uint8_t)(number >> 16 & 0xffu);
  at[3] = (uint8_t)(number >> 24 & 0xffu);
}

uint32_t rclc_action_encode_answer(const void * answer, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_action_answer_t * response = answer;

  (void)fault;
  (void)memset(body, 0, ACTION_STAMP_AT);
  body[0] = response->accepted ? 1u : 0u;
  action_encode_4(&body[ACTION_STAMP_AT], (uint32_t)response->stamp.sec);
  action_encode_4(&body[ACTION_STAMP_AT + 4], response->stamp.nanosec);
  return RCLC_ACTION_ANSWER_SIZE;
}

void rclc_action_decode_id(cdr_in_t * in, void * uuid)
{
  cdr_get_1(in, uuid, UUID_SIZE, "goal_id");
}

uint32_t rclc_action_encode_outcome(const void * outcome, uint8_t * body, cdr_fault_t * fault)
{
  const rclc_action_outcome_t * response = outcome;

  if (response->body == NULL) {
    return response->type->encode(response->message, body, fault);
  }
  (void)memcpy(body, response->body, (size_t)response->size);
  return response->size;
}

const microros_message_type_t rclc_action_answer_type = {
  .dds_type_name = MICROROS_ERROR_TYPE("SendGoal_Response_"),
  .max_encoded_size = RCLC_ACTION_ANSWER_SIZE,
  .encode = rclc_action_encode_answer};
const microros_message_type_t rclc_action_id_type = {
  .dds_type_name = MICROROS_ERROR_TYPE("GetResult_Request_"),
  .max_encoded_size = UUID_SIZE,
  .decode = rclc_action_decode_id};
