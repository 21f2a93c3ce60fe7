/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/cdr_decode.h"
#include "selftest_config.h"
#include "selftest_round_trip.h"

#include <string.h>

enum { EACH = 64 };

/* Into an empty message with all its storage. */
static bool decode(const selftest_type_t * tested, const uint8_t * body, uint32_t size, bool is_big_endian)
{
  static const uint16_t one = 1;
  uint8_t first;
  cdr_fault_t fault;

  (void)memcpy(&first, &one, sizeof(first));
  tested->bind();
  return cdr_decode(tested->type, body, size, (first == 0u) != is_big_endian, tested->message, &fault);
}

/* Decodes a body of one byte order and encodes the message: it is what was sent. */
static const char * goes_round(
  const selftest_type_t * tested, selftest_content_t content, bool is_big_endian, uint8_t * reference,
  uint8_t * encoded)
{
  const uint32_t size = selftest_refer(tested, content, is_big_endian, reference);
  cdr_fault_t fault;

  if (!decode(tested, reference, size, is_big_endian)) {
    return is_big_endian ? "a decoder that refuses big endian" : "a decoder that refuses";
  }
  (void)memset(encoded, UINT8_MAX, size);
  if (tested->type->encode(tested->message, encoded, &fault) != size) {
    return "a decoded message of another size";
  }
  (void)selftest_refer(tested, content, false, reference);
  if (memcmp(encoded, reference, size) != 0) {
    return is_big_endian ? "another message after big endian" : "another message";
  }
  return NULL;
}

/* A body without its end is refused: each size of a small one, some of a large one. */
static const char * takes_part_of(const selftest_type_t * tested, const uint8_t * reference, uint32_t size)
{
  const uint32_t step = 1u + size / (uint32_t)EACH;

  for (uint32_t left = size; left > 0u; left = left > step ? left - step : 0u) {
    if (decode(tested, reference, left - 1u, false)) {
      return "a decoder that takes part of a body";
    }
  }
  return NULL;
}

const char * selftest_decode(
  const selftest_type_t * tested, selftest_content_t content, uint8_t * reference, uint8_t * encoded,
  uint32_t size)
{
  const char * wrong;

  if (tested->type->decode == NULL) {
    return NULL;
  }
  wrong = goes_round(tested, content, false, reference, encoded);
  if (wrong == NULL) {
    wrong = goes_round(tested, content, true, reference, encoded);
  }
  return wrong != NULL ? wrong : takes_part_of(tested, reference, size);
}
