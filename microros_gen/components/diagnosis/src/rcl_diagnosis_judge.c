/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_diagnosis.h"

/* `is_in`: the value before was beyond the limit, which it leaves only by the hysteresis. */
static bool judge_exceeds(const rcl_diagnosis_check_t * check, int32_t limit, int32_t value, bool is_in)
{
  const int64_t margin = is_in ? (int64_t)check->hysteresis : 0;

  return check->is_above ? (int64_t)value > (int64_t)limit - margin
                         : (int64_t)value < (int64_t)limit + margin;
}

uint8_t rcl_diagnosis_judge(const rcl_diagnosis_check_t * check, int32_t value, uint8_t level)
{
  const bool was_error = level == (uint8_t)DIAGNOSIS_ERROR;
  const bool was_fault = was_error || level == (uint8_t)DIAGNOSIS_WARN;

  if (check->has_error && judge_exceeds(check, check->error, value, was_error)) {
    return (uint8_t)DIAGNOSIS_ERROR;
  }
  if (check->has_warn && judge_exceeds(check, check->warn, value, was_fault)) {
    return (uint8_t)DIAGNOSIS_WARN;
  }
  return (uint8_t)DIAGNOSIS_OK;
}

int32_t rcl_diagnosis_limit(const rcl_diagnosis_check_t * check, uint8_t level)
{
  return level == (uint8_t)DIAGNOSIS_ERROR ? check->error : check->warn;
}
