/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest_lengths.h"

enum { EACH = 16, ODD = 7 };

static uint8_t byte_of(size_t at, size_t size)
{
  return (uint8_t)((at * (size_t)ODD + size) & 0xffu);
}

void selftest_fill(uint8_t * bytes, size_t size)
{
  for (size_t i = 0; i < size; ++i) {
    bytes[i] = byte_of(i, size);
  }
}

bool selftest_is_filled(const uint8_t * bytes, size_t size)
{
  for (size_t i = 0; i < size; ++i) {
    if (bytes[i] != byte_of(i, size)) {
      return false;
    }
  }
  return true;
}

size_t selftest_next_length(size_t length, size_t largest)
{
  size_t next = length < (size_t)EACH ? length + 1u : length * 2u;

  if (length >= largest) {
    return 0;
  }
  if (next + 1u >= largest) {
    next = length + 1u < largest ? largest - 1u : largest;
  }
  return next <= length ? largest : next;
}
