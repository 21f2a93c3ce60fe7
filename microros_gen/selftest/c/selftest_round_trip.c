/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest_round_trip.h"

#include "selftest_config.h"
#include "selftest_report.h"

#include <string.h>

static uint8_t reference[SELFTEST_BODY];
static uint8_t encoded[SELFTEST_BODY];

/* Fills the message and `reference`; returns the size of the body. */
uint32_t selftest_refer(
  const selftest_type_t * tested, selftest_content_t content, bool is_big_endian, uint8_t * body)
{
  selftest_walk_t walk = {body, SELFTEST_BODY, 0, 0, content, is_big_endian, false};

  tested->bind();
  tested->walk(&walk);
  return walk.is_over ? 0u : walk.position;
}

static const char * encode(const selftest_type_t * tested, selftest_content_t content, uint32_t * size)
{
  const microros_message_type_t * type = tested->type;
  cdr_fault_t fault;

  *size = selftest_refer(tested, content, false, reference);
  if (*size == 0u || *size > type->max_encoded_size) {
    return "a body above the largest size";
  }
  if (type->encoded_size(tested->message, &fault) != *size) {
    return "another encoded size";
  }
  (void)memset(encoded, UINT8_MAX, sizeof(encoded));
  if (type->encode(tested->message, encoded, &fault) != *size) {
    return "an encoder that refuses";
  }
  return memcmp(encoded, reference, *size) == 0 ? NULL : "other encoded bytes";
}

void selftest_round_trip(const selftest_type_t * tested)
{
  const char * wrong = NULL;

  for (int i = 0; i < (int)SELFTEST_CONTENTS && wrong == NULL; ++i) {
    uint32_t size = 0;

    wrong = encode(tested, (selftest_content_t)i, &size);
    if (wrong == NULL) {
      wrong = selftest_decode(tested, (selftest_content_t)i, reference, encoded, size);
    }
  }
  selftest_true(tested->name, wrong == NULL, wrong, "a message that stays the same");
}
