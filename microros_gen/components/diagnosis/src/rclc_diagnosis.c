/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc_diagnosis/rclc_diagnosis.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_diagnosis.h"

rcl_ret_t rclc_diagnosis_set(uint8_t check, int32_t value)
{
  if (check >= (uint8_t)MICROROS_DIAGNOSIS_DECLARED) {
    return microros_error_named(RCL_RET_INVALID_ARGUMENT, microros_error_diagnosis, "no such check");
  }
  microros_lock();
  rcl_diagnosis_set(check, value);
  microros_unlock();
  return RCL_RET_OK;
}

uint8_t rclc_diagnosis_level(uint8_t check)
{
  uint8_t level = (uint8_t)RCLC_DIAGNOSIS_STALE;

  if (check < (uint8_t)MICROROS_DIAGNOSIS_DECLARED) {
    const rcl_diagnosis_measure_t * measure = rcl_diagnosis_measured(check);

    microros_lock();
    level = measure->is_set ? measure->level : level;
    microros_unlock();
  }
  return level;
}
