/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of a node whose values a parameter server holds (`parameters: {at: agent}`): one inside the agent, or
 * `microros-gen parameter-server`. The application uses rclc_parameter/rclc_parameter.h as usual; what follows is added. Not part
 * of rclc. Both functions belong to the task of the executor that runs the server.
 */
#ifndef RCLC_PARAMETER_HELD_PARAMETERS_H
#define RCLC_PARAMETER_HELD_PARAMETERS_H

#include "rclc_parameter/rclc_parameter.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Whether the parameter server has all that the node declared and changed. RCL_RET_TIMEOUT, with a text that says how much it
 * lacks and since when: it is away, or has not asked yet. Nothing is lost: the values are here, and it gets them later.
 */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_check_held(const rclc_parameter_server_t * parameter_server);

/* Returns how many values that the node had set were overruled by others before the server had them, modulo 2^32. */
RCLC_PARAMETER_PUBLIC
uint32_t rclc_parameter_count_overruled(const rclc_parameter_server_t * parameter_server);

#ifdef __cplusplus
}
#endif

#endif /* RCLC_PARAMETER_HELD_PARAMETERS_H */
