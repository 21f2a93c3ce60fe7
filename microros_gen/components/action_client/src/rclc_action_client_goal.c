/* SPDX-License-Identifier: Apache-2.0 */
/* Places of goals. All functions are called with the lock. */
#include "microros/epoch.h"
#include "microros/port.h"
#include "microros/rclc_action_client.h"
#include "microros/rmw_action_client.h"
#include "microros/rmw_client.h"

#include <string.h>

rclc_action_goal_handle_t * rclc_action_client_find(const rclc_action_client_t * client, const uint8_t * uuid)
{
  /* at most MICROROS_REQUESTS_MAX / 3 rounds */
  for (size_t i = 0; i < client->goal_handles_memory_size; ++i) {
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (goal->is_used && memcmp(goal->goal_id.uuid, uuid, UUID_SIZE) == 0) {
      return goal;
    }
  }
  return NULL;
}

static void goal_put_4(uint8_t * to, uint32_t number)
{
  to[0] = (uint8_t)(number >> 24);
  to[1] = (uint8_t)(number >> 16 & UINT8_MAX);
  to[2] = (uint8_t)(number >> 8 & UINT8_MAX);
  to[3] = (uint8_t)(number & UINT8_MAX);
}

/*
 * Device, time of day, time since the start, and number of the goal. A server refuses an id that it still knows: a board
 * without the time of day would have to send a goal in the same millisecond after its start.
 */
static void goal_identify(uint8_t * uuid)
{
  static uint32_t goals_sent; /* of all clients */
  const uint64_t epoch_ns = (uint64_t)microros_epoch_known_ns();

  ++goals_sent;
  goal_put_4(&uuid[0], rmw_client_key());
  goal_put_4(&uuid[4], (uint32_t)(epoch_ns >> 16 & UINT32_MAX));
  goal_put_4(&uuid[8], port_time_ms());
  goal_put_4(&uuid[12], goals_sent);
}

rclc_action_goal_handle_t * rclc_action_client_take_place(rclc_action_client_t * client)
{
  for (size_t i = 0; i < client->goals_at_once; ++i) { /* at most MICROROS_REQUESTS_MAX / 3 rounds */
    rclc_action_goal_handle_t * goal = &client->declared->goals[i];

    if (!goal->is_used) {
      (void)memset(goal, 0, sizeof(*goal));
      goal->action_client = client;
      goal->is_used = true;
      goal_identify(goal->goal_id.uuid);
      return goal;
    }
  }
  return NULL;
}

void rclc_action_client_free_place(rclc_action_goal_handle_t * goal)
{
  const rcl_action_client_t * opened = &goal->action_client->rcl_handle;

  goal->is_used = false;
  if (goal->awaits_goal_response) {
    rmw_action_client_abandon(opened->goal_client.impl, goal->goal_request_sequence_number);
  }
  if (goal->awaits_result_response) {
    rmw_action_client_abandon(opened->result_client.impl, goal->result_request_sequence_number);
  }
  if (goal->awaits_cancel_response) {
    rmw_action_client_abandon(opened->cancel_client.impl, goal->cancel_request_sequence_number);
  }
}

bool rclc_action_client_has(const rclc_action_goal_handle_t * goal)
{
  return goal->is_used && goal->action_client != NULL && goal->action_client->declared != NULL;
}
