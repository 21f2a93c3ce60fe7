/* SPDX-License-Identifier: Apache-2.0 */
/* Why a parameter was not set, in the words of rclcpp. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_REASON_H
#define MICROROS_RCLC_PARAMETER_REASON_H

#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameters.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the reason for the `outcome` (parameter_outcome_t) of a request; an empty one for success. */
void rclc_parameter_out_reason(
  parameter_out_t * out, const rclc_parameter_server_t * server, const parameter_requested_t * requested,
  uint8_t outcome);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_REASON_H */
