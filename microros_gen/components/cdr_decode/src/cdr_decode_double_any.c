/* SPDX-License-Identifier: Apache-2.0 */
/* For sources of every processor: the size of a double selects one of the branches when this file is compiled. */
#include "microros/cdr_decode_double.h"

#include "microros/cdr_double.h"

/* A binary64, lower half first: cdr_get_8 turns it to the target's byte order. */
typedef struct double_halves_t {
  uint32_t lower;
  uint32_t upper;
} double_halves_t;

CDR_STATIC_ASSERT(cdr_assert_halves_are_little_endian, CDR_HOST_IS_LITTLE_ENDIAN || (sizeof(double) == 8U));

void cdr_get_double(cdr_in_t * in, double * to, size_t count, const char * field)
{
  if (sizeof(double) == 8U) {
    cdr_get_8(in, to, count, field);
  } else {
    for (size_t i = 0U; i < count; ++i) {
      double_halves_t halves = {0U, 0U};

      cdr_get_8(in, &halves, 1U, field);
      const uint32_t bits = cdr_double_narrow(halves.upper, halves.lower);
      (void)memcpy(&to[i], &bits, sizeof(bits));
    }
  }
}

/* The length is checked with the width on the wire; cdr_get_size would take one byte for each. */
static void double_sequence_narrow(
  cdr_in_t * in, rosidl_runtime_c__double__Sequence * sequence, uint32_t bound, const char * field)
{
  const size_t capacity = (sequence->data == NULL) ? 0U : sequence->capacity;
  const uint32_t limit = cdr_in_limit(capacity, bound);
  uint32_t size = cdr_in_length(in, 8U, field);

  if (size > limit) {
    cdr_in_refuse_above(in, field, size, limit, bound);
    size = 0U;
  }
  sequence->size = (size_t)size;
  cdr_get_double(in, sequence->data, (size_t)size, field);
}

void cdr_get_sequence_double(
  cdr_in_t * in, rosidl_runtime_c__double__Sequence * sequence, uint32_t bound, const char * field)
{
  if (sizeof(double) == 8U) {
    cdr_get_sequence_8(in, sequence, bound, field);
  } else {
    double_sequence_narrow(in, sequence, bound, field);
  }
}
