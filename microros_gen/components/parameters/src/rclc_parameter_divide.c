/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameters.h"

uint64_t rclc_parameter_divide(uint64_t value, uint64_t by, uint64_t * rest)
{
  uint64_t quotient = 0;
  uint64_t left = value;
  uint64_t step = by;
  uint64_t bit = 1;

  if ((value | by) <= UINT32_MAX) { /* as most values of parameters: processors divide these */
    const uint32_t divisor = (uint32_t)by;
    const uint32_t whole = (uint32_t)value / divisor;
    const uint32_t remainder = (uint32_t)value - whole * divisor;

    *rest = remainder;
    return whole;
  }
  while (step <= left / 2u) {
    step <<= 1;
    bit <<= 1;
  }
  while (bit != 0u) {
    if (left >= step) {
      left -= step;
      quotient |= bit;
    }
    step >>= 1;
    bit >>= 1;
  }
  *rest = left;
  return quotient;
}
