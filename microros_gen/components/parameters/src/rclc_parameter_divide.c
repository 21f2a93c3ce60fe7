/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameters.h"

uint64_t rclc_parameter_divide(uint64_t value, uint64_t by, uint64_t * rest)
{
  uint64_t quotient = 0;
  uint64_t left = value;
  uint64_t step = by;
  uint64_t bit = 1;

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
