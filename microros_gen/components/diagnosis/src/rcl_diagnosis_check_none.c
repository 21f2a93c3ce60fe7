/* SPDX-License-Identifier: Apache-2.0 */
/* No status has a check. */
#include "microros/rcl_diagnosis.h"

void rcl_diagnosis_age(uint32_t now)
{
  (void)now;
}

const rcl_diagnosis_measure_t * rcl_diagnosis_measured(uint8_t check)
{
  static const rcl_diagnosis_measure_t nothing;

  (void)check;
  return &nothing;
}
