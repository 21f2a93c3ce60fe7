/* SPDX-License-Identifier: Apache-2.0 */
/* Called by the store and its server if another node holds the values (parameters_held). Internal. */
#ifndef MICROROS_RCLC_PARAMETER_HELD_H
#define MICROROS_RCLC_PARAMETER_HELD_H

#include <stdint.h>

#include "microros/rclc_parameters.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Seconds between two notices while the server has not asked: at first, and at most; after each notice the wait doubles.
 * A request of a server and a new session with the agent begin it again. */
enum { RCLC_PARAMETER_HELD_FIRST_S = 2, RCLC_PARAMETER_HELD_MOST_S = 32 };

/* The type of the service, whose messages are the server, and its callback. */
extern const rosidl_service_type_support_t rclc_parameter_exchange_type;
void rclc_parameter_exchange(const void * request, void * response, void * context);

/* Opens the publisher of notices. */
rcl_ret_t rclc_parameter_held_open(rclc_parameter_server_t * server, const rcl_node_t * node);

/* From now on a value that the node sets is a change; earlier ones are declared values. */
void rclc_parameter_held_begin(rclc_parameter_server_t * server);

/* Notes that a place has changed. */
void rclc_parameter_held_note(
  rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t event);

/* Publishes a notice again while the server has not asked; lowers *look_again_ns to when the next one is due. */
void rclc_parameter_held_look(rclc_parameter_server_t * server, int64_t * look_again_ns);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_HELD_H */
