/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcutils_format_digits.h"

#include <string.h>

enum {
  GROUP = 10000,
  GROUP_DIGITS = 4,
  LIMB_BITS = 16,
  MANTISSA_BITS = 52,
  EXPONENT_MASK = 2047,
  WEIGHT_LEAST = -1074 /* of the last bit of the mantissa where the exponent is 0 or 1 */
};

/*
 * Each digit after the point uses up one bit of it, since ten is two times five. So all digits of a number shift at
 * most 16 * (1 + 2 + .. + 67) + 2 * 68 limbs: SHIFTED. PASSES is how often a conversion reads the digits of its number:
 * `g` looks for the first one and rounds, does both again with the other precision, and puts them.
 */
enum { SHIFTED = 36584, PASSES = 5 };

/* Sets the bit of 2^weight: before the point the limb of the smallest weights is the first, after it the largest. */
static void digits_set(microros_digits_t * digits, int32_t weight)
{
  const uint32_t at = (uint32_t)(weight >= 0 ? weight : -1 - weight);
  const uint32_t limb = at / (uint32_t)LIMB_BITS;
  const uint32_t bit = at % (uint32_t)LIMB_BITS;

  if (weight >= 0) {
    digits->whole[limb] = (uint16_t)(digits->whole[limb] | 1u << bit);
  } else {
    digits->part[limb] = (uint16_t)(digits->part[limb] | 0x8000u >> bit);
    digits->used = limb + 1u > digits->used ? limb + 1u : digits->used;
  }
}

/* Divides the first `size` limbs of the whole part by a group; returns the remainder. */
static uint32_t digits_divide(microros_digits_t * digits, uint32_t size)
{
  uint32_t remainder = 0;

  for (uint32_t i = size; i != 0u; --i) { /* at most MICROROS_DIGITS_LIMBS rounds */
    const uint32_t value = remainder << (uint32_t)LIMB_BITS | digits->whole[i - 1u];

    digits->whole[i - 1u] = (uint16_t)(value / (uint32_t)GROUP);
    remainder = value % (uint32_t)GROUP;
  }
  return remainder;
}

/*
 * Turns the whole part into groups of digits, in its place: groups grow from the end of the array, faster than limbs are
 * used up at its start, but the array has room for both. The last one has the last digits. */
static void digits_group(microros_digits_t * digits)
{
  uint32_t size = MICROROS_DIGITS_LIMBS;
  uint32_t first = MICROROS_DIGITS_GROUPS;

  while (size != 0u && digits->whole[size - 1u] == 0u) { /* at most MICROROS_DIGITS_LIMBS rounds */
    --size;
  }
  while (size != 0u) { /* at most MICROROS_DIGITS_GROUPS rounds */
    const uint32_t group = digits_divide(digits, size);

    /* at most MICROROS_DIGITS_LIMBS rounds in each microros_digits_begin */
    while (size != 0u && digits->whole[size - 1u] == 0u) {
      --size;
    }
    --first;
    digits->whole[first] = (uint16_t)group;
  }
  if (first == (uint32_t)MICROROS_DIGITS_GROUPS) { /* the one group of a number below 1 */
    --first;
  }
  digits->place = (MICROROS_DIGITS_GROUPS - (int32_t)first) * GROUP_DIGITS - 1;
}

void microros_digits_begin(microros_digits_t * digits, uint64_t bits)
{
  const uint32_t exponent = (uint32_t)(bits >> (uint32_t)MANTISSA_BITS) & (uint32_t)EXPONENT_MASK;
  const uint64_t mantissa = bits & (((uint64_t)1 << (uint32_t)MANTISSA_BITS) - 1u);
  const int32_t weight = exponent == 0u ? WEIGHT_LEAST : WEIGHT_LEAST - 1 + (int32_t)exponent;

  (void)memset(digits, 0, sizeof(*digits));
  for (uint32_t i = 0; i < (uint32_t)MANTISSA_BITS; ++i) {
    if ((mantissa >> i & 1u) != 0u) {
      digits_set(digits, weight + (int32_t)i);
    }
  }
  if (exponent != 0u) {
    digits_set(digits, weight + MANTISSA_BITS);
  }
  digits_group(digits);
}

/* Returns the group that a place before the point belongs to. */
static uint32_t digits_of(const microros_digits_t * digits, int32_t place)
{
  return digits->whole[MICROROS_DIGITS_GROUPS - 1 - place / GROUP_DIGITS];
}

static uint32_t digits_ten_to(int32_t power)
{
  uint32_t result = 1;

  for (int32_t i = 0; i < power; ++i) { /* at most GROUP_DIGITS rounds */
    result *= 10u;
  }
  return result;
}

/* Multiplies the part after the point by ten; returns what comes before it. */
static uint32_t digits_shift(microros_digits_t * digits)
{
  uint32_t carry = 0;

  /* at most MICROROS_DIGITS_LIMBS rounds, PASSES * SHIFTED in each microros_format_floating */
  for (uint32_t i = digits->used; i != 0u; --i) {
    const uint32_t value = digits->part[i - 1u] * 10u + carry;

    digits->part[i - 1u] = (uint16_t)(value & 0xffffu);
    carry = value >> (uint32_t)LIMB_BITS;
  }
  /* at most MICROROS_DIGITS_LIMBS rounds, PASSES * MICROROS_DIGITS_LIMBS in each microros_format_floating */
  while (digits->used != 0u && digits->part[digits->used - 1u] == 0u) {
    --digits->used;
  }
  return carry;
}

uint32_t microros_digits_next(microros_digits_t * digits)
{
  const int32_t place = digits->place;

  --digits->place;
  if (place < 0) {
    return digits_shift(digits);
  }
  return digits_of(digits, place) / digits_ten_to(place % GROUP_DIGITS) % 10u;
}

bool microros_digits_end(const microros_digits_t * digits)
{
  int32_t place = digits->place;

  if (digits->used != 0u) {
    return false;
  }
  if (place >= 0 && digits_of(digits, place) % digits_ten_to(place % GROUP_DIGITS + 1) != 0u) {
    return false;
  }
  /* at most MICROROS_DIGITS_GROUPS rounds */
  for (place -= GROUP_DIGITS; place >= 0; place -= GROUP_DIGITS) {
    if (digits_of(digits, place) != 0u) {
      return false;
    }
  }
  return true;
}
