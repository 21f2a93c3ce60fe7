/* SPDX-License-Identifier: Apache-2.0 */
/* Limits with their hysteresis, ages of values over a wrap of the clock, requests of modes, shares of times. */
#include "microros/port.h"
#include "microros/port_diagnosis.h"
#include "microros/rcl_diagnosis.h"
#include "microros/rcl_diagnosis_hooks.h"
#include "rclc_diagnosis/declared_checks.h"

#include <stdio.h>
#include <stdlib.h>

static uint32_t now_ms;
static uint32_t now_us;
static rcl_diagnosis_bits_t added;

#define EXPECT(condition) \
  do { \
    if (!(condition)) { \
      (void)fprintf(stderr, "line %d: %s\n", __LINE__, #condition); \
      exit(1); \
    } \
  } while (0)

uint32_t port_time_ms(void)
{
  return now_ms;
}

uint32_t port_time_us(void)
{
  return now_us;
}

void rcl_diagnosis_add(rcl_diagnosis_bits_t statuses)
{
  added |= statuses;
}

static uint8_t judged(const rcl_diagnosis_check_t * check, int32_t value, uint8_t before)
{
  return rcl_diagnosis_judge(check, value, before);
}

static void limits(void)
{
  const rcl_diagnosis_check_t above = {
    .warn = 80, .error = 90, .hysteresis = 5, .has_warn = true, .has_error = true, .is_above = true};
  const rcl_diagnosis_check_t below = {
    .warn = -10, .error = -20, .hysteresis = 5, .has_warn = true, .has_error = true};
  const rcl_diagnosis_check_t error = {.error = 90, .hysteresis = 100, .has_error = true, .is_above = true};
  const rcl_diagnosis_check_t extreme = {
    .error = INT32_MIN, .hysteresis = INT32_MAX, .has_error = true, .is_above = true};

  EXPECT(judged(&above, 80, DIAGNOSIS_OK) == DIAGNOSIS_OK);
  EXPECT(judged(&above, 81, DIAGNOSIS_OK) == DIAGNOSIS_WARN);
  EXPECT(judged(&above, 90, DIAGNOSIS_WARN) == DIAGNOSIS_WARN);
  EXPECT(judged(&above, 91, DIAGNOSIS_OK) == DIAGNOSIS_ERROR);
  EXPECT(judged(&above, 86, DIAGNOSIS_ERROR) == DIAGNOSIS_ERROR);
  EXPECT(judged(&above, 85, DIAGNOSIS_ERROR) == DIAGNOSIS_WARN);
  EXPECT(judged(&above, 76, DIAGNOSIS_WARN) == DIAGNOSIS_WARN);
  EXPECT(judged(&above, 75, DIAGNOSIS_WARN) == DIAGNOSIS_OK);
  EXPECT(judged(&above, 76, DIAGNOSIS_ERROR) == DIAGNOSIS_WARN);
  EXPECT(judged(&above, 76, DIAGNOSIS_OK) == DIAGNOSIS_OK);
  EXPECT(judged(&above, 76, DIAGNOSIS_STALE) == DIAGNOSIS_OK);
  EXPECT(judged(&below, -10, DIAGNOSIS_OK) == DIAGNOSIS_OK);
  EXPECT(judged(&below, -11, DIAGNOSIS_OK) == DIAGNOSIS_WARN);
  EXPECT(judged(&below, -21, DIAGNOSIS_OK) == DIAGNOSIS_ERROR);
  EXPECT(judged(&below, -16, DIAGNOSIS_ERROR) == DIAGNOSIS_ERROR);
  EXPECT(judged(&below, -15, DIAGNOSIS_ERROR) == DIAGNOSIS_WARN);
  EXPECT(judged(&below, -5, DIAGNOSIS_WARN) == DIAGNOSIS_OK);
  EXPECT(judged(&error, -9, DIAGNOSIS_ERROR) == DIAGNOSIS_ERROR);
  EXPECT(judged(&error, -10, DIAGNOSIS_ERROR) == DIAGNOSIS_OK);
  EXPECT(judged(&extreme, INT32_MIN, DIAGNOSIS_ERROR) == DIAGNOSIS_ERROR);
  EXPECT(judged(&extreme, INT32_MIN, DIAGNOSIS_OK) == DIAGNOSIS_OK);
  EXPECT(judged(&extreme, INT32_MAX, DIAGNOSIS_OK) == DIAGNOSIS_ERROR);
}

/* The check HEAT holds for 5 s, and requests a mode; the clock wraps in between. */
static void ages(void)
{
  const uint8_t heat = DIAGNOSIS_HEAT;

  EXPECT(rclc_diagnosis_level(heat) == RCLC_DIAGNOSIS_STALE);
  now_ms = UINT32_MAX - 1000u;
  rcl_diagnosis_age(now_ms);
  EXPECT(rcl_diagnosis_measured(heat)->level == DIAGNOSIS_STALE && added != 0u);
  added = 0;
  EXPECT(rclc_diagnosis_set(heat, 20) == RCL_RET_OK);
  EXPECT(rclc_diagnosis_level(heat) == RCLC_DIAGNOSIS_OK && added != 0u);
  added = 0;
  now_ms += 5000u;
  rcl_diagnosis_age(now_ms);
  EXPECT(rclc_diagnosis_level(heat) == RCLC_DIAGNOSIS_OK && added == 0u);
  now_ms += 1u;
  rcl_diagnosis_age(now_ms);
  EXPECT(rclc_diagnosis_level(heat) == RCLC_DIAGNOSIS_STALE && added != 0u);
  EXPECT(!rcl_diagnosis_measured(heat)->is_set);
  EXPECT(rclc_diagnosis_set(heat, 20) == RCL_RET_OK);
  EXPECT(rclc_diagnosis_level(heat) == RCLC_DIAGNOSIS_OK);
  EXPECT(rclc_diagnosis_set(2, 20) == RCL_RET_INVALID_ARGUMENT);
  EXPECT(rclc_diagnosis_level(2) == RCLC_DIAGNOSIS_STALE);
}

/* Tried at once, then once in a period, until it was done or the level is another one. */
static void requests(void)
{
  const uint8_t heat = DIAGNOSIS_HEAT;

  EXPECT(!rcl_diagnosis_take_request(heat));
  EXPECT(rclc_diagnosis_set(heat, 91) == RCL_RET_OK);
  EXPECT(rcl_diagnosis_take_request(heat));
  EXPECT(!rcl_diagnosis_take_request(heat));
  EXPECT(rclc_diagnosis_set(heat, 92) == RCL_RET_OK);
  EXPECT(!rcl_diagnosis_take_request(heat));
  rcl_diagnosis_age(now_ms);
  EXPECT(rcl_diagnosis_take_request(heat));
  rcl_diagnosis_requested(heat);
  rcl_diagnosis_age(now_ms);
  EXPECT(!rcl_diagnosis_take_request(heat));
  EXPECT(rclc_diagnosis_set(heat, 20) == RCL_RET_OK);
  EXPECT(rclc_diagnosis_set(heat, 91) == RCL_RET_OK);
  EXPECT(rclc_diagnosis_set(heat, 20) == RCL_RET_OK);
  EXPECT(!rcl_diagnosis_take_request(heat));
}

/* Over a wrap of the microseconds. */
static void times(void)
{
  now_us = UINT32_MAX - 50000u;
  rcl_diagnosis_times_begin();
  rcl_diagnosis_round_begins();
  now_us += 60000u;
  rcl_diagnosis_round_ends();
  EXPECT(
    rcl_diagnosis_longest_us() == 60000u && rcl_diagnosis_rounds() == 1u && rcl_diagnosis_missed() == 1u);
  rcl_diagnosis_rests();
  now_us += 140000u;
  rcl_diagnosis_rested();
  EXPECT(rcl_diagnosis_busy() == 30);
  EXPECT(rcl_diagnosis_busy() == -1);
  rcl_diagnosis_round_begins();
  now_us += 50000u;
  rcl_diagnosis_round_ends();
  EXPECT(rcl_diagnosis_missed() == 1u && rcl_diagnosis_longest_us() == 60000u);
  EXPECT(rcl_diagnosis_busy() == 100);
  rcl_diagnosis_rests();
  now_us += UINT32_MAX;
  rcl_diagnosis_rested();
  EXPECT(rcl_diagnosis_busy() == 0);
}

int main(void)
{
  limits();
  ages();
  requests();
  times();
  (void)printf("ok\n");
  return 0;
}
