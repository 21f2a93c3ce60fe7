/* SPDX-License-Identifier: Apache-2.0 */
/* What the four boards of the robot share: a node with a life cycle, parameters and modes, and its executor. */
#ifndef EXAMPLES_MOBILE_ROBOT_BOARD_H
#define EXAMPLES_MOBILE_ROBOT_BOARD_H

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_lifecycle/rclc_lifecycle.h>
#include <rclc_modes/declared_modes.h>
#include <rclc_modes/rclc_modes.h>
#include <rclc_parameter/declared_parameters.h>
#include <rclc_parameter/rclc_parameter.h>

#include <stdbool.h>

extern rclc_support_t board_support;
extern rcl_node_t board_node;
extern rclc_executor_t board_executor;
extern rclc_lifecycle_node_t board_lifecycle;
extern rclc_parameter_server_t board_parameters;

/* What the application file of a board declares. */
typedef struct board_t {
  const char * node;
  rcl_ret_t (*declare_parameters)(rclc_parameter_server_t * server);
  const rclc_modes_table_t * modes;
} board_t;

/* Opens the session and the node with its services. Returns false if the agent does not answer; a board then starts
 * again. `handles`: what the application adds to the executor itself. */
bool board_begin(const board_t * board, size_t handles);

/* Spins until the program is ended; a board does so until it loses its supply. */
void board_run(void);

#endif /* EXAMPLES_MOBILE_ROBOT_BOARD_H */
