/* SPDX-License-Identifier: Apache-2.0 */
/* What the options of a session say about a serial line. */
#ifndef MICROROS_RMW_TRANSPORT_PARAMS_H
#define MICROROS_RMW_TRANSPORT_PARAMS_H

#include <stdint.h>

/* Room for a path with its NUL. */
#define RMW_UXRCE_MAX_SERIAL_DEVICE_SIZE 64

/* 0 or empty: as the plan says. */
typedef struct rmw_uxrce_transport_params_t {
  uint32_t client_key;
  char serial_device[RMW_UXRCE_MAX_SERIAL_DEVICE_SIZE];
} rmw_uxrce_transport_params_t;

#endif /* MICROROS_RMW_TRANSPORT_PARAMS_H */
