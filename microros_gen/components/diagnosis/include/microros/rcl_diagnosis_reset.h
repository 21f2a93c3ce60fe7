/* SPDX-License-Identifier: Apache-2.0 */
/* The cause of the last reset as a number of the list of words. Internal. */
#ifndef MICROROS_RCL_DIAGNOSIS_RESET_H
#define MICROROS_RCL_DIAGNOSIS_RESET_H

#include <stdint.h>

#include "microros/port_diagnosis.h"

static inline uint32_t rcl_diagnosis_reset(void)
{
  const port_reset_t cause = port_reset_cause();

  return (uint32_t)cause;
}

#endif /* MICROROS_RCL_DIAGNOSIS_RESET_H */
