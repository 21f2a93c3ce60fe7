/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SELFTEST_ROUND_TRIP_H
#define SELFTEST_ROUND_TRIP_H

#include "microros/message_type.h"
#include "selftest_walk.h"

/* A message type and its test message: `bind` empties the message and gives it its storage, `walk` visits its members. */
typedef struct selftest_type_t {
  const char * name; /* "std_msgs/msg/Int32" */
  const microros_message_type_t * type;
  void * message;
  void (*bind)(void);
  void (*walk)(selftest_walk_t * walk);
} selftest_type_t;

/* Encodes messages of several contents; where the library decodes the type, decodes each of both byte orders and encodes it
 * again, and has bodies refused that end too early. Prints one line. */
void selftest_round_trip(const selftest_type_t * tested);

/* Fills the message and the body of SELFTEST_BODY bytes in a byte order; returns the size of the body, 0 if it is larger. */
uint32_t selftest_refer(
  const selftest_type_t * tested, selftest_content_t content, bool is_big_endian, uint8_t * body);

/* Part of it, where the library has decoders (selftest_decode.c) or none (selftest_decode_none.c). Returns what is wrong;
 * NULL: nothing. `reference` and `encoded` have SELFTEST_BODY bytes; the
 * first has the body of `size` bytes in little endian, before and after. */
const char * selftest_decode(
  const selftest_type_t * tested, selftest_content_t content, uint8_t * reference, uint8_t * encoded,
  uint32_t size);

#endif /* SELFTEST_ROUND_TRIP_H */
