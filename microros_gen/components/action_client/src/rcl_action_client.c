/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_action/action_client.h"

#include <stddef.h>

rcl_action_client_t rcl_action_get_zero_initialized_client(void)
{
  const rcl_action_client_t client = {{NULL}, {NULL}, {NULL}, {NULL}};

  return client;
}

bool rcl_action_client_is_valid(const rcl_action_client_t * action_client)
{
  return action_client != NULL && rcl_client_is_valid(&action_client->goal_client) &&
         rcl_client_is_valid(&action_client->cancel_client) &&
         rcl_client_is_valid(&action_client->result_client) &&
         rcl_subscription_is_valid(&action_client->feedback_subscription);
}
