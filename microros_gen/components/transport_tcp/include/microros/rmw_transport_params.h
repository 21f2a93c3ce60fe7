/* SPDX-License-Identifier: Apache-2.0 */
/* What the options of a session say about TCP. */
#ifndef MICROROS_RMW_TRANSPORT_PARAMS_H
#define MICROROS_RMW_TRANSPORT_PARAMS_H

#include <stdint.h>

/* Room for an IPv4 or IPv6 address in digits, and for "65535", each with its NUL. */
#define RMW_UXRCE_MAX_HOST_SIZE 46
#define RMW_UXRCE_MAX_PORT_SIZE 6

/* Where the agent is, and the key of the session. Empty or 0: as the plan says. */
typedef struct rmw_uxrce_transport_params_t {
  uint32_t client_key;
  char agent_address[RMW_UXRCE_MAX_HOST_SIZE];
  char agent_port[RMW_UXRCE_MAX_PORT_SIZE];
} rmw_uxrce_transport_params_t;

#endif /* MICROROS_RMW_TRANSPORT_PARAMS_H */
