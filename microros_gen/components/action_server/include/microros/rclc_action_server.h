/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the files of the action server. Internal. */
#ifndef MICROROS_RCLC_ACTION_SERVER_INTERNAL_H
#define MICROROS_RCLC_ACTION_SERVER_INTERNAL_H

#include "action_msgs/msg/goal_info.h"
#include "action_msgs/msg/goal_status.h"
#include "microros/cdr_decode.h"
#include "microros/service_type.h"
#include "microros_config.h"
#include "rclc/action_server.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An action of the application file. Its arrays have `goals_max` elements; that of results has as many bodies. */
typedef struct rclc_action_declared_t {
  uint16_t node;
  uint16_t goal_at; /* positions in microros_declared_endpoints */
  uint16_t cancel_at;
  uint16_t result_at;
  uint16_t feedback_at;
  uint16_t status_at;
  uint16_t goals_max;
  uint32_t result_timeout_ms;
  uint32_t request_size; /* of the C type of a goal request, bytes */
  uint32_t result_size;  /* of the largest body of a response with a result, bytes */
  rosidl_service_type_support_t goal_type;
  rosidl_service_type_support_t result_type;
  const void * no_result;                           /* the response for a goal that is not known */
  void (*bind)(void * ros_goal_request, size_t at); /* NULL: a request needs no buffers */
  rclc_action_goal_handle_t * goals;
  uint8_t * results;
  action_msgs__msg__GoalStatus * statuses;
  action_msgs__msg__GoalInfo * canceling;
} rclc_action_declared_t;

extern const rclc_action_declared_t rclc_action_declared[MICROROS_ACTION_SERVERS];

/* What is decoded of a goal request: `goal` is the place that it was decoded to, NULL if it was refused. */
typedef struct rclc_action_incoming_t {
  rclc_action_server_t * server;
  rclc_action_goal_handle_t * goal;
  const char * refused;
} rclc_action_incoming_t;

/* A response to a goal request; the response types of all actions have the same members. */
typedef struct rclc_action_answer_t {
  bool accepted;
  builtin_interfaces__msg__Time stamp;
} rclc_action_answer_t;

/* A response with a result: `size` bytes of an encoded body, or a message where `body` is NULL. */
typedef struct rclc_action_outcome_t {
  const microros_message_type_t * type;
  const void * message;
  const uint8_t * body;
  uint32_t size;
} rclc_action_outcome_t;

/* --- members of the types above, for rclc_action_servers.c --- */

void rclc_action_decode_goal(cdr_in_t * in, void * incoming);
uint32_t rclc_action_encode_answer(const void * answer, uint8_t * body, cdr_fault_t * fault);
void rclc_action_decode_id(cdr_in_t * in, void * uuid);
uint32_t rclc_action_encode_outcome(const void * outcome, uint8_t * body, cdr_fault_t * fault);
enum { RCLC_ACTION_ANSWER_SIZE = 12 };
extern const microros_message_type_t rclc_action_answer_type;
extern const microros_message_type_t rclc_action_id_type;

/* --- goals; called with the lock --- */

static inline bool rclc_action_has_ended(const rclc_action_goal_handle_t * goal)
{
  return goal->status > GOAL_STATE_CANCELING;
}

/* Returns the goal with this id, or NULL. */
rclc_action_goal_handle_t * rclc_action_find(const rclc_action_server_t * server, const uint8_t * uuid);

/* Returns a place for a goal, or NULL: the place of an ended goal is used again once its result was sent. */
rclc_action_goal_handle_t * rclc_action_take_place(const rclc_action_server_t * server);

/* Returns the milliseconds until the place of a goal is freed; UINT32_MAX: it has not ended, or its result is awaited. */
uint32_t rclc_action_left(const rclc_action_goal_handle_t * goal, uint32_t result_timeout_ms, uint32_t now);

/* Returns the declared action of a server, and the number of goals of those before it; NULL, and 0, if no executor has
 * had the server since it was opened: it has no goals. */
const rclc_action_declared_t * rclc_action_goals_of(
  const rcl_action_server_t * action_server, size_t * first);

/* Returns whether a place has a goal of the server that was accepted. */
bool rclc_action_is_tracked(
  const rclc_action_goal_handle_t * goal, const rcl_action_server_t * action_server);

/* Frees the places of goals whose results were kept long enough; returns the milliseconds until the next one is due,
 * UINT32_MAX: none. */
uint32_t rclc_action_expire(const rclc_action_server_t * server, bool frees);

/* Sets the state after an event, if the goal has such a transition; returns whether it has. */
bool rclc_action_go(rclc_action_goal_handle_t * goal, rcl_action_goal_event_t event);

/* --- called by the executor --- */

/* Publish the states, and send results to those who wait for them, as far as there is room. */
rcl_ret_t rclc_action_publish_status(rclc_action_server_t * server);
rcl_ret_t rclc_action_send_results(rclc_action_server_t * server);

/* Return whether the function above has something to do now. */
bool rclc_action_has_status(const rclc_action_server_t * server);
bool rclc_action_has_results(const rclc_action_server_t * server);

/* Take one request each and answer it, now or later. */
rcl_ret_t rclc_action_serve_goal(rclc_action_server_t * server);
rcl_ret_t rclc_action_serve_cancel(rclc_action_server_t * server);
rcl_ret_t rclc_action_serve_result(rclc_action_server_t * server);

/* Returns the name of the action's goal service, for texts. */
const char * rclc_action_name(const rclc_action_server_t * server);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_ACTION_SERVER_INTERNAL_H */
