/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fills a message and writes at the same time what its body must be, byte by byte: CDR as ROS 2 has it (XCDR1, positions
 * counted from the first byte). The generated encoders, which copy whole runs, are compared with that.
 */
#ifndef SELFTEST_WALK_H
#define SELFTEST_WALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rosidl_runtime_c/string.h"
#include "rosidl_runtime_c/u16string.h"

typedef enum selftest_content_t {
  SELFTEST_EMPTY,   /* strings and sequences empty, the lowest numbers */
  SELFTEST_FULL,    /* all as long as their storage, the largest numbers */
  SELFTEST_COUNTED, /* half as long, each byte another one; NaN with other bits each */
  SELFTEST_CONTENTS
} selftest_content_t;

typedef enum selftest_kind_t {
  SELFTEST_BOOL,
  SELFTEST_SIGNED,
  SELFTEST_UNSIGNED,
  SELFTEST_FLOAT
} selftest_kind_t;

/* `body` has room for `capacity` bytes; a message that needs more sets `is_over`. `counter` makes the values differ. */
typedef struct selftest_walk_t {
  uint8_t * body;
  uint32_t capacity;
  uint32_t position;
  uint32_t counter;
  selftest_content_t content;
  bool is_big_endian;
  bool is_over;
} selftest_walk_t;

/* Writes `count` numbers of `width` bytes (1, 2, 4, 8) to `numbers` and to the body. */
void selftest_numbers(
  selftest_walk_t * walk, void * numbers, size_t count, uint32_t width, selftest_kind_t kind);

void selftest_string(selftest_walk_t * walk, rosidl_runtime_c__String * text);
void selftest_wstring(selftest_walk_t * walk, rosidl_runtime_c__U16String * text);

/* Returns the size of a sequence with this capacity, and writes it to the body. */
size_t selftest_size(selftest_walk_t * walk, size_t capacity);

#endif /* SELFTEST_WALK_H */
