/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/cdr_decode.h"

#include "microros/cdr_loan.h"

#include <string.h>

/** Returns how many of `length` characters (at least one) precede the first NUL. */
static size_t count_characters(const char * from, uint32_t length)
{
  size_t size = 0U;

  if (from[length - 1U] == '\0') {
    return strlen(from); /* at most BYTES_READ bytes */
  }
  /* at most BYTES_READ rounds */
  while ((size < length) && (from[size] != '\0')) {
    ++size;
  }
  return size;
}

void cdr_get_string(cdr_in_t * in, rosidl_runtime_c__String * text, uint32_t bound, const char * field)
{
  if (cdr_loan_string(in, text, bound, field)) {
    return;
  }
  const size_t capacity = (text->data == NULL) ? 0U : text->capacity;
  const uint32_t limit = cdr_in_limit((capacity == 0U) ? 0U : (capacity - 1U), bound);
  const uint32_t length = cdr_in_length(in, 1U, field);
  const uint8_t * from = NULL;
  size_t size = 0U;

  if (length > 0U) {
    from = &in->body[in->position];
    size = count_characters((const char *)from, length);
    in->position += length;
  }
  if (size > limit) {
    cdr_in_refuse_above(in, field, (uint32_t)size, limit, bound);
    size = 0U;
  }
  if (size > 0U) {
    /* at most BYTES_READ bytes */
    (void)memcpy(text->data, from, size);
  }
  if ((capacity > 1U) || ((capacity == 1U) && (text->data[0] != '\0'))) {
    text->data[size] =
      '\0'; /* do not write the NUL that all empty strings share (rosidl_runtime_c__String__init) */
  }
  text->size = size;
}

void cdr_get_strings(
  cdr_in_t * in, rosidl_runtime_c__String * texts, size_t count, uint32_t bound, const char * field)
{
  /* at most BYTES_READ / 4 + 1 rounds: each has a length, and one that is refused is the last one */
  for (size_t i = 0U; (i < count) && !in->failed; ++i) {
    cdr_get_string(in, &texts[i], bound, field);
  }
}
