/* SPDX-License-Identifier: Apache-2.0 */
/* Options of a session over CAN FD. */
#ifndef MICROROS_RMW_TRANSPORT_PARAMS_H
#define MICROROS_RMW_TRANSPORT_PARAMS_H

#include <stdint.h>

/* Size of a device's name including its NUL. */
#define RMW_UXRCE_MAX_CAN_DEVICE_SIZE 64u

/* 0 or empty: the plan's value. */
typedef struct rmw_uxrce_transport_params_t {
  uint32_t client_key;
  uint32_t can_id;
  char can_device[RMW_UXRCE_MAX_CAN_DEVICE_SIZE];
} rmw_uxrce_transport_params_t;

#endif /* MICROROS_RMW_TRANSPORT_PARAMS_H */
