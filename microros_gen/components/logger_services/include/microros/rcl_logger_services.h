/* SPDX-License-Identifier: Apache-2.0 */
/* The services ~/get_logger_levels and ~/set_logger_levels of each node. Internal. */
#ifndef MICROROS_RCL_LOGGER_SERVICES_H
#define MICROROS_RCL_LOGGER_SERVICES_H

#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new node. Waits for the agent and returns the same codes as rcl_service_init. */
rcl_ret_t rcl_logger_services_open(rcl_node_t * node);

/* Called before a node is closed. */
void rcl_logger_services_close(rcl_node_t * node);

/* Called when the executor has received: answers requests. */
void rcl_logger_services_answer(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LOGGER_SERVICES_H */
