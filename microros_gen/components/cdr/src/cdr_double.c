/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/cdr_double.h"

/* Fields of a binary32, and of the upper half of a binary64 (IEEE 754, 3.4). */
#define SIGN 0x80000000U
#define SINGLE_FRACTION 0x007FFFFFU
#define SINGLE_ONE 0x00800000U /* the leading bit, which a normal number does not store */
#define SINGLE_INFINITY 0x7F800000U
#define SINGLE_EXPONENTS 0xFFU
#define SINGLE_BITS 23U
#define DOUBLE_FRACTION 0x000FFFFFU
#define DOUBLE_EXPONENTS 0x7FFU
#define DOUBLE_BITS 20U /* of the fraction, in the upper half */

#define MORE_BITS 3U /* SINGLE_BITS - DOUBLE_BITS: bits of the lower half that a binary32 has */
#define LOST_BITS 29U
#define BIASES 896U /* 1023 - 127 */

void cdr_double_widen(uint8_t * to, uint32_t bits)
{
  uint32_t fraction = bits & SINGLE_FRACTION;
  uint32_t exponent = (bits >> SINGLE_BITS) & SINGLE_EXPONENTS;

  if (exponent == SINGLE_EXPONENTS) {
    exponent = DOUBLE_EXPONENTS;
  } else if (exponent != 0U) {
    exponent += BIASES;
  } else if (fraction != 0U) {
    exponent = BIASES + 1U; /* subnormal: normal as a binary64 */
    while ((fraction & SINGLE_ONE) == 0U) {
      fraction <<= 1U;
      --exponent;
    }
    fraction &= SINGLE_FRACTION;
  } else {
    /* zero */
  }
  const uint32_t upper = (bits & SIGN) | (exponent << DOUBLE_BITS) | (fraction >> MORE_BITS);
  const uint32_t lower = fraction << LOST_BITS;
  for (uint32_t i = 0U; i < 4U; ++i) {
    to[i] = (uint8_t)((lower >> (8U * i)) & 0xFFU);
    to[4U + i] = (uint8_t)((upper >> (8U * i)) & 0xFFU);
  }
}

/* Returns `value` rounded by `rest`, the bits after it: half of its last bit is 0x80000000. Ties to even. */
static uint32_t double_round(uint32_t value, uint32_t rest)
{
  const uint32_t half = 0x80000000U;
  const bool up = (rest > half) || ((rest == half) && ((value & 1U) != 0U));

  return up ? (value + 1U) : value;
}

/* Returns the bits, without sign, of a number below the least normal binary32: one with the exponent field `exponent`
 * would be normal, and `significand` has its leading bit. */
static uint32_t double_subnormal(uint32_t significand, uint32_t rest, uint32_t exponent)
{
  const uint32_t shift = (BIASES + 1U) - exponent;

  if (shift > (SINGLE_BITS + 1U)) {
    return 0U; /* below half of the least one */
  }
  return double_round(significand >> shift, (significand << (32U - shift)) | ((rest != 0U) ? 1U : 0U));
}

/* Returns the bits, without sign, of an infinity or a NaN. */
static uint32_t double_special(uint32_t fraction, uint32_t rest)
{
  const bool is_lost =
    (fraction == 0U) && (rest != 0U); /* of a NaN only lower bits: it must not become infinity */

  return SINGLE_INFINITY | (is_lost ? 1U : fraction);
}

uint32_t cdr_double_narrow(uint32_t upper, uint32_t lower)
{
  const uint32_t exponent = (upper >> DOUBLE_BITS) & DOUBLE_EXPONENTS;
  const uint32_t fraction = ((upper & DOUBLE_FRACTION) << MORE_BITS) | (lower >> LOST_BITS);
  const uint32_t rest = lower << MORE_BITS;
  uint32_t bits;

  if (exponent == DOUBLE_EXPONENTS) {
    bits = double_special(fraction, rest);
  } else if (exponent >= (BIASES + SINGLE_EXPONENTS)) {
    bits = SINGLE_INFINITY;
  } else if (exponent > BIASES) {
    /* A carry goes on into the exponent, from the largest number to infinity. */
    bits = double_round(((exponent - BIASES) << SINGLE_BITS) | fraction, rest);
  } else {
    bits =
      double_subnormal(fraction | SINGLE_ONE, rest, exponent); /* also zero, and what is subnormal itself */
  }
  return (upper & SIGN) | bits;
}
