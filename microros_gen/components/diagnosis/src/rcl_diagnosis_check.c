/* SPDX-License-Identifier: Apache-2.0 */
/* The last values of checks. */
#include "microros/port.h"
#include "microros/rcl_diagnosis.h"

static rcl_diagnosis_measure_t diagnosis_measures[MICROROS_DIAGNOSIS_CHECKS];

static void check_go(uint8_t check, uint8_t level)
{
  rcl_diagnosis_measure_t * measure = &diagnosis_measures[check];
  const rcl_diagnosis_check_t * declared = &rcl_diagnosis_checks[check];

  if (level == measure->level) {
    return;
  }
  measure->level = level;
  measure->is_requested = declared->mode != NULL && level == (uint8_t)DIAGNOSIS_ERROR;
  measure->is_due = measure->is_requested;
  rcl_diagnosis_add((rcl_diagnosis_bits_t)1 << declared->status);
}

void rcl_diagnosis_set(uint8_t check, int32_t value)
{
  rcl_diagnosis_measure_t * measure = &diagnosis_measures[check];

  measure->value = value;
  measure->set_ms = port_time_ms();
  measure->is_set = true;
  check_go(check, rcl_diagnosis_judge(&rcl_diagnosis_checks[check], value, measure->level));
}

void rcl_diagnosis_note(uint8_t check, int32_t value)
{
  if (value >= 0) {
    rcl_diagnosis_set(check, value);
  }
}

static void check_age(uint8_t check, uint32_t now)
{
  rcl_diagnosis_measure_t * measure = &diagnosis_measures[check];
  const uint32_t timeout_ms = rcl_diagnosis_checks[check].timeout_ms;

  measure->is_due = measure->is_requested;
  /* The age is looked at once in a period, so it cannot wrap unnoticed. */
  if (measure->is_set && timeout_ms != 0u && now - measure->set_ms > timeout_ms) {
    measure->is_set = false;
  }
  if (!measure->is_set) {
    check_go(check, (uint8_t)DIAGNOSIS_STALE);
  }
}

void rcl_diagnosis_age(uint32_t now)
{
  for (uint8_t check = 0; check < (uint8_t)MICROROS_DIAGNOSIS_CHECKS; ++check) {
    check_age(check, now);
  }
}

const rcl_diagnosis_measure_t * rcl_diagnosis_measured(uint8_t check)
{
  return &diagnosis_measures[check];
}

bool rcl_diagnosis_take_request(uint8_t check)
{
  const bool is_due = diagnosis_measures[check].is_due;

  diagnosis_measures[check].is_due = false;
  return is_due;
}

void rcl_diagnosis_requested(uint8_t check)
{
  diagnosis_measures[check].is_requested = false;
}
