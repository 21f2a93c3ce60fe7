/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_action/action_server.h"

#include <stddef.h>

rcl_action_server_t rcl_action_get_zero_initialized_server(void)
{
  const rcl_action_server_t server = {{NULL}, {NULL}, {NULL}, {NULL}, {NULL}};

  return server;
}

bool rcl_action_server_is_valid(const rcl_action_server_t * action_server)
{
  return action_server != NULL && rcl_service_is_valid(&action_server->goal_service) &&
         rcl_service_is_valid(&action_server->cancel_service) &&
         rcl_service_is_valid(&action_server->result_service) &&
         rcl_publisher_is_valid(&action_server->feedback_publisher) &&
         rcl_publisher_is_valid(&action_server->status_publisher);
}

bool rcl_action_server_is_valid_except_context(const rcl_action_server_t * action_server)
{
  return action_server != NULL && action_server->goal_service.impl != NULL &&
         action_server->cancel_service.impl != NULL && action_server->result_service.impl != NULL &&
         rcl_publisher_is_valid_except_context(&action_server->feedback_publisher) &&
         rcl_publisher_is_valid_except_context(&action_server->status_publisher);
}
