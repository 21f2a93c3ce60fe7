/* SPDX-License-Identifier: Apache-2.0 */
/* Options of a session over UDP. */
#ifndef MICROROS_RMW_TRANSPORT_PARAMS_H
#define MICROROS_RMW_TRANSPORT_PARAMS_H

#include <stdint.h>

/*
 * Sizes of a numeric address, an unabbreviated IPv6 one if the plan's is IPv6, and of "65535", each
 * including its NUL. */
#define RMW_UXRCE_MAX_HOST_SIZE 32
#define RMW_UXRCE_MAX_PORT_SIZE 6

/* Address of the agent, and key of the session. Empty or 0: the plan's value. */
typedef struct rmw_uxrce_transport_params_t {
  uint32_t client_key;
  char agent_address[RMW_UXRCE_MAX_HOST_SIZE];
  char agent_port[RMW_UXRCE_MAX_PORT_SIZE];
} rmw_uxrce_transport_params_t;

#endif /* MICROROS_RMW_TRANSPORT_PARAMS_H */
