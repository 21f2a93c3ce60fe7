/* SPDX-License-Identifier: Apache-2.0 */
/* Address of the agent and identity of this client. */
#ifndef MICROROS_RMW_MICROROS_INIT_OPTIONS_H
#define MICROROS_RMW_MICROROS_INIT_OPTIONS_H

#include <stdint.h>

#include "rmw/init_options.h"
#include "rmw/ret_types.h"
#include "rmw_microxrcedds_c/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * The transport is tcp: RMW_UXRCE_TRANSPORT_TCP is
 * defined. Functions of other transports are not declared: a call fails to compile with a name that says
 * what to set in microros.yaml.
 */

/*
 * Copies an address, IPv4 or, if the port supports it, IPv6, and a decimal port (1 to 65535); an
 * addition of this client. RMW_RET_INVALID_ARGUMENT: NULL, too long, not a number.
 */
rmw_ret_t rmw_uros_options_set_tcp_address(
  const char * ip, const char * port, rmw_init_options_t * rmw_options);
#define rmw_uros_options_set_can_device rmw_uros_options_set_can_device__needs__transport_type_canfd
#define rmw_uros_options_set_serial_device rmw_uros_options_set_serial_device__needs__transport_type_serial
#define rmw_uros_options_set_udp_address rmw_uros_options_set_udp_address__needs__transport_type_udp

/* Two clients with the same key take over each other's session. 0 is refused, as agents do. With `seal`, the handshake
 * proves the key of the plan: the agent denies any other. */
rmw_ret_t rmw_uros_options_set_client_key(uint32_t client_key, rmw_init_options_t * rmw_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_INIT_OPTIONS_H */
