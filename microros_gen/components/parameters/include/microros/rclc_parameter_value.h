/* SPDX-License-Identifier: Apache-2.0 */
/* Writes values of the store as CDR. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_VALUE_H
#define MICROROS_RCLC_PARAMETER_VALUE_H

#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameters.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What messages have for a name that is not known, and for a deleted parameter: no value. */
extern const rclc_parameter_place_t rclc_parameter_nothing;

/* Writes an rcl_interfaces/msg/ParameterValue. */
void rclc_parameter_out_value(parameter_out_t * out, const rclc_parameter_place_t * place);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_VALUE_H */
