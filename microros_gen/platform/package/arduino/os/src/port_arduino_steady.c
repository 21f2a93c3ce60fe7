/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

#include <Arduino.h>

/*
 * For one task. micros() wraps after 71 minutes and millis() after 49 days: the first has the resolution, the second says
 * how often it has wrapped. So this must be called at least once in 49 days: the component long_time does that.
 */
int64_t port_time_steady_ns(void)
{
  static const uint32_t us_per_ms = 1000u;
  static const int64_t ns_per_us = 1000;
  static uint64_t steady_us;
  static uint32_t last_ms;
  static uint32_t last_us;
  const uint32_t now_us = (uint32_t)micros();
  const uint32_t now_ms = (uint32_t)millis();
  const uint64_t about_us = (uint64_t)(now_ms - last_ms) * us_per_ms;
  const uint32_t passed_us = now_us - last_us;
  /* The true time is passed_us and a multiple of 2^32, and about_us is less than 2^31 from it. */
  const uint32_t rest_us = passed_us - (uint32_t)(about_us & UINT32_MAX);
  const int64_t correction_us = rest_us < 0x80000000u ? (int64_t)rest_us : (int64_t)rest_us - 0x100000000;

  steady_us += (uint64_t)((int64_t)about_us + correction_us);
  last_ms = now_ms;
  last_us = now_us;
  return (int64_t)steady_us * ns_per_us;
}
