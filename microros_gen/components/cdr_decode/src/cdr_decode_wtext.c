/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/cdr_decode.h"

/* On the wire each UTF-16 unit takes four bytes. */
enum { UNIT_SIZE = 4 };

void cdr_get_wstring(cdr_in_t * in, rosidl_runtime_c__U16String * text, uint32_t bound, const char * field)
{
  const uint32_t largest_unit = 0xFFFFU;
  const size_t capacity = (text->data == NULL) ? 0U : text->capacity;
  const uint32_t limit = cdr_in_limit((capacity == 0U) ? 0U : (capacity - 1U), bound);
  uint32_t size = cdr_in_length(in, UNIT_SIZE, field);

  if (size > limit) {
    cdr_in_refuse_above(in, field, size, limit, bound);
    size = 0U;
  }
  /* at most BYTES_READ / 4 rounds */
  for (uint32_t i = 0U; i < size; ++i) {
    uint32_t unit = 0U;
    cdr_get_4(in, &unit, 1U, field);
    if (unit > largest_unit) {
      cdr_in_refuse(in, CDR_FAULT_VALUE, field, unit, largest_unit);
      unit = 0U;
    }
    text->data[i] = (uint_least16_t)unit;
  }
  if ((capacity > 1U) || ((capacity == 1U) && (text->data[0] != 0U))) {
    text->data[size] = 0U;
  }
  text->size = (size_t)size;
}

void cdr_get_wstrings(
  cdr_in_t * in, rosidl_runtime_c__U16String * texts, size_t count, uint32_t bound, const char * field)
{
  /* at most BYTES_READ / 4 + 1 rounds */
  for (size_t i = 0U; (i < count) && !in->failed; ++i) {
    cdr_get_wstring(in, &texts[i], bound, field);
  }
}
