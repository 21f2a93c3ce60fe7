/* SPDX-License-Identifier: Apache-2.0 */
/* The functions that carry the messages of this client: set them before rclc_support_init. */
#ifndef MICROROS_RMW_MICROROS_CUSTOM_TRANSPORT_H
#define MICROROS_RMW_MICROROS_CUSTOM_TRANSPORT_H

#include <stdbool.h>

#include "rmw/init_options.h"
#include "rmw/ret_types.h"
#include "rmw_microxrcedds_c/config.h"
#include "uxr/client/transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Values for `framing`: a byte stream (UART, USB CDC), or a medium that preserves message boundaries
 * (UDP). */
#define MICROROS_TRANSPORTS_FRAMING_MODE 1
#define MICROROS_TRANSPORTS_PACKET_MODE 0

/*
 * Sets the functions for sessions whose options set none; `args` is passed to them as transport->args and
 * must stay valid as long as they are called. An open session keeps its functions.
 * RMW_RET_INVALID_ARGUMENT: a function is NULL; RMW_RET_UNSUPPORTED: `transport: {framing: …}` of
 * microros.yaml excludes this kind of framing.
 */
rmw_ret_t rmw_uros_set_custom_transport(
  bool framing, void * args, open_custom_func open_cb, close_custom_func close_cb, write_custom_func write_cb,
  read_custom_func read_cb);

/* Same for sessions with these options. */
rmw_ret_t rmw_uros_options_set_custom_transport(
  bool framing, void * args, open_custom_func open_cb, close_custom_func close_cb, write_custom_func write_cb,
  read_custom_func read_cb, rmw_init_options_t * rmw_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_CUSTOM_TRANSPORT_H */
