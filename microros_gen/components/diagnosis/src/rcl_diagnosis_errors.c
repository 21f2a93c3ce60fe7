/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error_count.h"
#include "microros/rcl_diagnosis.h"

static uint32_t errors_count;

void microros_error_count(void)
{
  ++errors_count;
}

uint32_t rcl_diagnosis_errors(void)
{
  return errors_count;
}
