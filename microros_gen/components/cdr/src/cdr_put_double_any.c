/* SPDX-License-Identifier: Apache-2.0 */
/* For sources of every processor: the size of a double selects one of the branches when this file is compiled. */
#include "microros/cdr_double.h"

CDR_STATIC_ASSERT(
  cdr_assert_double_has_4_or_8_bytes, (sizeof(double) == 8U) || (sizeof(double) == sizeof(uint32_t)));

void cdr_put_double(uint8_t * to, double value)
{
  if (sizeof(value) == 8U) {
    cdr_put_8(to, &value);
  } else {
    uint32_t bits;

    (void)memcpy(&bits, &value, sizeof(bits));
    cdr_double_widen(to, bits);
  }
}

void cdr_put_array_double(uint8_t * to, const double * from, size_t count)
{
  for (size_t i = 0U; i < count; ++i) {
    cdr_put_double(&to[i * 8U], from[i]);
  }
}

uint32_t cdr_put_sequence_double(uint8_t * body, uint32_t position, const double * data, size_t size)
{
  uint32_t start = cdr_put_length(body, position, size);

  if (size > 0U) {
    start = cdr_align_8(body, start);
    cdr_put_array_double(&body[start], data, size);
  }
  return start + ((uint32_t)size * 8U);
}
