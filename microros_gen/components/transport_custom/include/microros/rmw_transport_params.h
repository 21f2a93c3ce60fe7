/* SPDX-License-Identifier: Apache-2.0 */
/* Options of a session with a custom transport. */
#ifndef MICROROS_RMW_TRANSPORT_PARAMS_H
#define MICROROS_RMW_TRANSPORT_PARAMS_H

#include <stdint.h>

#include "uxr/client/transport.h"

/* `client_key` 0: that of the plan. `custom.open` NULL: the functions of rmw_uros_set_custom_transport. */
typedef struct rmw_uxrce_transport_params_t {
  uint32_t client_key;
  uxrCustomTransport custom;
} rmw_uxrce_transport_params_t;

#endif /* MICROROS_RMW_TRANSPORT_PARAMS_H */
