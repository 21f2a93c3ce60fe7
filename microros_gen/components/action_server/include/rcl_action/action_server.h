/* SPDX-License-Identifier: Apache-2.0 */
/* The server of an action below rclc: what it has open. */
#ifndef MICROROS_RCL_ACTION_ACTION_SERVER_H
#define MICROROS_RCL_ACTION_ACTION_SERVER_H

#include <stdbool.h>

#include "rcl/macros.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service.h"
#include "rcl_action/types.h"
#include "rcl_action/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Belongs to rclc_action_server_t. */
typedef struct rcl_action_server_s {
  rcl_service_t goal_service;
  rcl_service_t cancel_service;
  rcl_service_t result_service;
  rcl_publisher_t feedback_publisher;
  rcl_publisher_t status_publisher;
} rcl_action_server_t;

rcl_action_server_t rcl_action_get_zero_initialized_server(void);

/* Returns whether it is open. */
bool rcl_action_server_is_valid(const rcl_action_server_t * action_server);

/*
 * Returns whether the server has a goal with the id in `goal_info`, until the time of its result has expired. False, with a
 * text, for NULL and a server that is not open. May be called by any task.
 */
bool rcl_action_server_goal_exists(
  const rcl_action_server_t * action_server, const rcl_action_goal_info_t * goal_info);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_ACTION_SERVER_H */
