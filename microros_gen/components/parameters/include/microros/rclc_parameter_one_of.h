/* SPDX-License-Identifier: Apache-2.0 */
/* Lists of accepted values. If the plan has no such list, every value is accepted. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_ONE_OF_H
#define MICROROS_RCLC_PARAMETER_ONE_OF_H

#include "microros/rclc_parameters.h"

#ifdef __cplusplus
extern "C" {
#endif

#if MICROROS_PARAMETER_ONE_OF

/* Returns whether the requested value, which has the type of the place, is accepted. */
bool rclc_parameter_one_of(const rclc_parameter_place_t * place, const parameter_requested_t * requested);

#else

static inline bool rclc_parameter_one_of(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  (void)place;
  (void)requested;
  return true;
}

#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_ONE_OF_H */
