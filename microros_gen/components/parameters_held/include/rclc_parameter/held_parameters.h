/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of a node whose values a parameter server holds (`parameters: {at: agent}`): one inside the agent, or
 * `microros-gen parameter-server`. The application uses rclc_parameter/rclc_parameter.h as usual, and the functions
 * below. Not part of rclc. Both functions belong to the task of the executor that runs the server.
 */
#ifndef RCLC_PARAMETER_HELD_PARAMETERS_H
#define RCLC_PARAMETER_HELD_PARAMETERS_H

#include "rclc_parameter/rclc_parameter.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Returns RCL_RET_OK if the parameter server has all declarations and changes of the node. RCL_RET_TIMEOUT: the server
 * is away or has not asked yet; the text says how many parameters it does not have, and since when. Nothing is lost:
 * the node has the values, and the server gets them later.
 */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_check_held(const rclc_parameter_server_t * parameter_server);

/* Returns how many values of the node were overruled by other writers before the server received them, modulo 2^32. */
RCLC_PARAMETER_PUBLIC
uint32_t rclc_parameter_count_overruled(const rclc_parameter_server_t * parameter_server);

#ifdef __cplusplus
}
#endif

#endif /* RCLC_PARAMETER_HELD_PARAMETERS_H */
