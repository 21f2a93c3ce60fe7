/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Modes of a node with a life cycle: each is a set of values of its parameters, which the application file declares
 * below `modes:` and which is a constant. The first mode is __DEFAULT__. Services and events are those of the package
 * system_modes: ~/change_mode, ~/get_available_modes, ~/get_mode and ~/mode_event.
 *
 * A mode belongs to the state `active`. In `inactive` it can be changed as well: the node is in it once it is active.
 * In all other states a change is refused. The node keeps its mode when it is deactivated and activated again, when
 * the agent restarts, and during a sleep in retained memory. Parameters that somebody else sets do not change the mode.
 *
 * All functions are called by one task, that of the executor, and none allocates.
 */
#ifndef MICROROS_RCLC_MODES_RCLC_MODES_H
#define MICROROS_RCLC_MODES_RCLC_MODES_H

#include <stdbool.h>
#include <stdint.h>

#include "rcl/error_handling.h"
#include "rcl/publisher.h"
#include "rcl/service.h"
#include "rclc/executor.h"
#include "rclc_lifecycle/rclc_lifecycle.h"
#include "rclc_parameter/rclc_parameter.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Executor handles that the modes of a node need. */
#define RCLC_EXECUTOR_MODES_HANDLES 3

/* The position of no mode. */
#define RCLC_MODES_NONE 255

/* Modes of a node, as rclc_modes/declared_modes.h names them. */
typedef struct rclc_modes_table_t rclc_modes_table_t;

/*
 * Called before a mode is applied: false refuses it, and nothing changes. The callback of the parameter server follows,
 * for each value, and can refuse as well. Neither may change parameters or modes of the node.
 */
typedef bool (*rclc_modes_callback_t)(uint8_t start_mode, uint8_t goal_mode, void * context);

/* The modes of a node. Its members are internal; do not move or copy the struct after its initialization. */
typedef struct rclc_modes_t {
  uint64_t event_time_ns; /* of the last change that an event tells */
  const rclc_modes_table_t * table;
  rclc_lifecycle_node_t * lifecycle_node;
  rclc_parameter_server_t * parameter_server;
  rclc_modes_callback_t on_change;
  void * context;
  rcl_publisher_t event_publisher;
  rcl_service_t services[RCLC_EXECUTOR_MODES_HANDLES];
  uint8_t mode;
  uint8_t requested; /* by the request that is being answered */
  uint8_t event_start;
  uint8_t event_goal;
  bool event_is_due;
  bool succeeded; /* what that request asked for */
  bool on_callback;
} rclc_modes_t;

/*
 * Gives modes to a node with a life cycle and a parameter server, to which the parameters have been added. `table`:
 * of rclc_modes/declared_modes.h. The mode is __DEFAULT__, whose values are the defaults of the parameters; or, after a
 * sleep, the one before it, whose values are set without asking the callbacks again. Opens the publisher and the three
 * services; each waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS. The structs belong to the application and
 * stay where they are. RCL_RET_INVALID_ARGUMENT: NULL, not initialized, or both of different nodes; otherwise the codes
 * of rcl_publisher_init and rcl_service_init, with nothing left open.
 */
rcl_ret_t rclc_modes_init(
  rclc_modes_t * modes, const rclc_modes_table_t * table, rclc_lifecycle_node_t * lifecycle_node,
  rclc_parameter_server_t * parameter_server);

/* Closes them. Finalize the executor before it spins again; finalize life cycle and parameter server after this. */
rcl_ret_t rclc_modes_fini(rclc_modes_t * modes);

/* Lets the executor answer the services, with RCLC_EXECUTOR_MODES_HANDLES handles. `on_change` may be NULL: every
 * change is accepted. `context` is passed to it. */
rcl_ret_t rclc_executor_add_modes(
  rclc_executor_t * executor, rclc_modes_t * modes, rclc_modes_callback_t on_change, void * context);

/* Returns the position of the mode that the node is in when it is active; RCLC_MODES_NONE: not initialized. */
uint8_t rclc_modes_get(const rclc_modes_t * modes);

/* Returns the name of a mode, a constant; NULL: the node has no mode at that position. */
const char * rclc_modes_name(const rclc_modes_t * modes, uint8_t mode);

/* Returns the position of a mode; RCLC_MODES_NONE: it has none of that name. */
uint8_t rclc_modes_find(const rclc_modes_t * modes, const char * name);

/*
 * Changes the mode: asks the callbacks, sets all parameters of the mode or none, and publishes ~/mode_event. The state of
 * the life cycle stays. The present mode can be requested again: its values are set again. Without room in the stream
 * or without the agent the event waits, together with changes in between. Any other code than RCL_RET_OK has changed
 * nothing:
 *   RCL_RET_INVALID_ARGUMENT               NULL, or no such mode
 *   RCL_RET_ERROR                          the node is neither active nor inactive, or lacks a parameter
 *   RCLC_PARAMETER_MODIFICATION_REJECTED   a callback refused
 *   RCLC_PARAMETER_DISABLED_ON_CALLBACK    called by a callback of modes or parameters
 */
rcl_ret_t rclc_modes_change(rclc_modes_t * modes, uint8_t mode);

/*
 * Reconfigures the node: deactivates it, sets the parameters of the mode, which the callbacks check, and activates it. A
 * node that is inactive stays so. Codes as above; RCL_RET_ERROR also if a transition failed. After a failure:
 *   deactivation        the state is the one that the life cycle has then; mode and parameters are as before
 *   a callback refused  the node is active in its former mode, or where this activation leads
 *   activation          the former mode with its values, which no callback is asked about, and a second activation; if
 *                       that fails too, the state is the one that the life cycle has then
 */
rcl_ret_t rclc_modes_reconfigure(rclc_modes_t * modes, uint8_t mode);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_MODES_RCLC_MODES_H */
