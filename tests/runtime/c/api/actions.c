/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Calls of rcl_action that need no server, and what each returns: compiled against ROS 2's librcl_action and against the
 * generated library. Goals are brought into each state by ROS 2's functions, and here by the member that rclc sets.
 */
#include "tell.h"

#include <rcl/rcl.h>
#include <rcl_action/goal_state_machine.h>
#include <rcl_action/names.h>
#include <rcl_action/rcl_action.h>
#include <string.h>

#ifdef MICROROS_RCL_ACTION_TYPES_H
#include <rclc/action_goal_handle.h>
#endif

static char text[64];

static void states(void)
{
  for (int state = -2; state < GOAL_STATE_NUM_STATES + 2; ++state) {
    for (int event = 0; event < GOAL_EVENT_NUM_EVENTS + 2; ++event) {
      SAY("state %d event %d: ", state, event);
      TELL(rcl_action_transition_goal_state((rcl_action_goal_state_t)state, (rcl_action_goal_event_t)event));
    }
  }
}

/* --- goals in each state --- */

static const rcl_action_goal_info_t info = {{{7, 1, 2}}, {40, 50}};

#ifdef MICROROS_RCL_ACTION_TYPES_H
static rclc_action_goal_handle_t kept;

static rcl_action_goal_handle_t goal_in(rcl_action_goal_state_t state)
{
  const rcl_action_goal_handle_t handle = {&kept};

  kept.is_used = true;
  kept.status = state;
  kept.goal_id = info.goal_id;
  kept.stamp = info.stamp;
  return handle;
}

static void end_goal(rcl_action_goal_handle_t * handle)
{
  (void)handle;
  kept.is_used = false;
}
#else
static rcl_action_goal_handle_t goal_in(rcl_action_goal_state_t state)
{
  rcl_action_goal_handle_t handle = rcl_action_get_zero_initialized_goal_handle();

  (void)rcl_action_goal_handle_init(&handle, &info, heap);
  if (state == GOAL_STATE_CANCELING) {
    (void)rcl_action_update_goal_state(&handle, GOAL_EVENT_CANCEL_GOAL);
  } else if (state != GOAL_STATE_ACCEPTED) {
    (void)rcl_action_update_goal_state(&handle, GOAL_EVENT_EXECUTE);
  }
  if (state == GOAL_STATE_SUCCEEDED || state == GOAL_STATE_ABORTED) {
    (void)rcl_action_update_goal_state(
      &handle, state == GOAL_STATE_SUCCEEDED ? GOAL_EVENT_SUCCEED : GOAL_EVENT_ABORT);
  } else if (state == GOAL_STATE_CANCELED) {
    (void)rcl_action_update_goal_state(&handle, GOAL_EVENT_CANCEL_GOAL);
    (void)rcl_action_update_goal_state(&handle, GOAL_EVENT_CANCELED);
  }
  return handle;
}

static void end_goal(rcl_action_goal_handle_t * handle)
{
  (void)rcl_action_goal_handle_fini(handle);
}
#endif

static void goal(const rcl_action_goal_handle_t * handle)
{
  rcl_action_goal_info_t found = rcl_action_get_zero_initialized_goal_info();
  rcl_action_goal_state_t status = 99;

  TELL(rcl_action_goal_handle_is_valid(handle));
  TELL(rcl_action_goal_handle_is_active(handle));
  TELL(rcl_action_goal_handle_is_cancelable(handle));
  TELL(rcl_action_goal_handle_get_status(handle, &status));
  TELL(status);
  TELL(rcl_action_goal_handle_get_status(handle, NULL));
  TELL(rcl_action_goal_handle_get_info(handle, &found));
  TELL(uuidcmp(found.goal_id.uuid, info.goal_id.uuid));
  TELL(uuidcmpzero(found.goal_id.uuid));
  TELL(found.stamp.sec);
  TELL(found.stamp.nanosec);
  TELL(rcl_action_goal_handle_get_info(handle, NULL));
}

static void goals(void)
{
  rcl_action_goal_handle_t handle = rcl_action_get_zero_initialized_goal_handle();

  goal(NULL);
  goal(&handle);
  for (rcl_action_goal_state_t state = GOAL_STATE_ACCEPTED; state < GOAL_STATE_NUM_STATES; ++state) {
    handle = goal_in(state);
    goal(&handle);
    end_goal(&handle);
  }
}

/* --- lists of goals --- */

static void status_arrays(void)
{
  rcl_action_goal_status_array_t list = rcl_action_get_zero_initialized_goal_status_array();

  TELL(list.msg.status_list.data == NULL && list.msg.status_list.size == 0);
  TELL(rcl_action_goal_status_array_init(NULL, 2, heap));
  TELL(rcl_action_goal_status_array_init(&list, 0, heap));
  TELL(rcl_action_goal_status_array_init(&list, 2, rcutils_get_zero_initialized_allocator()));
  TELL(rcl_action_goal_status_array_fini(&list));
  TELL(rcl_action_goal_status_array_init(&list, 2, heap));
  TELL(list.msg.status_list.size);
  TELL(list.msg.status_list.data[1].status);
  TELL(rcl_action_goal_status_array_init(&list, 2, heap));
  TELL(rcl_action_goal_status_array_fini(&list));
  TELL(list.msg.status_list.size);
  TELL(list.msg.status_list.data == NULL);
  TELL(rcl_action_goal_status_array_fini(&list));
  TELL(rcl_action_goal_status_array_fini(NULL));
}

static void cancel_responses(void)
{
  rcl_action_cancel_request_t request = rcl_action_get_zero_initialized_cancel_request();
  rcl_action_cancel_response_t response = rcl_action_get_zero_initialized_cancel_response();

  TELL(uuidcmpzero(request.goal_info.goal_id.uuid));
  TELL(request.goal_info.stamp.sec + (int32_t)request.goal_info.stamp.nanosec);
  TELL(response.msg.goals_canceling.data == NULL && response.msg.goals_canceling.size == 0);
  TELL(response.msg.return_code);
  TELL(rcl_action_cancel_response_init(NULL, 3, heap));
  TELL(rcl_action_cancel_response_init(&response, 0, heap));
  TELL(rcl_action_cancel_response_init(&response, 3, rcutils_get_zero_initialized_allocator()));
  response.msg.return_code = 1;
  TELL(rcl_action_cancel_response_init(&response, 3, heap));
  response.msg.return_code = 0;
  TELL(rcl_action_cancel_response_init(&response, 3, heap));
  TELL(response.msg.goals_canceling.size);
  TELL(rcl_action_cancel_response_init(&response, 3, heap));
  TELL(rcl_action_cancel_response_fini(&response));
  TELL(response.msg.goals_canceling.data == NULL);
  TELL(rcl_action_cancel_response_fini(&response));
  TELL(rcl_action_cancel_response_fini(NULL));
}

/* --- names --- */

static void name(rcl_ret_t (*get)(const char *, rcl_allocator_t, char **))
{
  char * made = NULL;

  TELL(get(NULL, heap, &made));
  TELL(get("", heap, &made));
  TELL(get("/arm/walk", rcutils_get_zero_initialized_allocator(), &made));
  TELL(get("/arm/walk", heap, NULL));
  made = text;
  TELL(get("/arm/walk", heap, &made));
  made = NULL;
  TELL(get("/arm/walk", heap, &made));
  SAY("%s 0\n", made);
  free(made);
  made = NULL;
  TELL(get("no name", heap, &made));
  SAY("'%s' 0\n", made);
  free(made);
}

/* --- servers and clients that are not open --- */

static void closed(void)
{
  rcl_action_server_t server = rcl_action_get_zero_initialized_server();
  rcl_action_client_t client = rcl_action_get_zero_initialized_client();
  rcl_action_goal_handle_t ** handles = NULL;
  rcl_action_goal_status_array_t list = rcl_action_get_zero_initialized_goal_status_array();
  rcl_action_goal_info_t expired;
  size_t count = 3;

  for (int i = 0; i < 2; ++i) {
    const rcl_action_server_t * each = i == 0 ? &server : NULL;

    TELL(rcl_action_server_is_valid(each));
    TELL(rcl_action_server_is_valid_except_context(each));
    TELL(rcl_action_server_get_action_name(each) == NULL);
    TELL(rcl_action_server_get_goal_handles(each, &handles, &count));
    TELL(rcl_action_server_goal_exists(each, &info));
    TELL(rcl_action_get_goal_status_array(each, &list));
    TELL(rcl_action_publish_feedback(each, text));
    TELL(rcl_action_publish_status(each, &list.msg));
    TELL(rcl_action_expire_goals(each, &expired, 1, &count));
    TELL(rcl_action_expire_goals(each, NULL, 1, NULL));
  }
  TELL(count);
  TELL(rcl_action_client_is_valid(&client));
  TELL(rcl_action_client_is_valid(NULL));
  TELL(rcl_action_client_get_action_name(&client) == NULL);
  TELL(rcl_action_client_get_action_name(NULL) == NULL);
}

int main(void)
{
  states();
  goals();
  status_arrays();
  cancel_responses();
  name(rcl_action_get_goal_service_name);
  name(rcl_action_get_cancel_service_name);
  name(rcl_action_get_result_service_name);
  name(rcl_action_get_feedback_topic_name);
  name(rcl_action_get_status_topic_name);
  closed();
  return 0;
}
