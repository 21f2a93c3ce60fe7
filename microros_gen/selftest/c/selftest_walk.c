/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest_walk.h"

#include <string.h>

enum { BITS = 8, LENGTH = 4, HALF = 4, LETTERS = 26, COUNTS = 0x7e };

static void put_byte(selftest_walk_t * walk, uint8_t byte)
{
  if (walk->position < walk->capacity) {
    walk->body[walk->position] = byte;
    ++walk->position;
  } else {
    walk->is_over = true;
  }
}

static void put_padding(selftest_walk_t * walk, uint32_t width)
{
  while (walk->position % width != 0u && !walk->is_over) {
    put_byte(walk, 0);
  }
}

static void put_number(selftest_walk_t * walk, uint64_t value, uint32_t width)
{
  put_padding(walk, width);
  for (uint32_t i = 0; i < width; ++i) {
    const uint32_t place = walk->is_big_endian ? width - 1u - i : i;

    put_byte(walk, (uint8_t)((value >> (place * (uint32_t)BITS)) & 0xffu));
  }
}

/* A byte from 1 to 126: no NUL, and none that begins a NaN. */
static uint8_t next_count(selftest_walk_t * walk)
{
  ++walk->counter;
  return (uint8_t)(1u + walk->counter % (uint32_t)COUNTS);
}

static uint64_t counted(selftest_walk_t * walk, uint32_t width)
{
  uint64_t value = 0;

  for (uint32_t i = 0; i < width; ++i) {
    value = (value << BITS) | next_count(walk);
  }
  return value;
}

/* A quiet NaN, whose other bits a copy must keep. */
static uint64_t counted_nan(selftest_walk_t * walk, uint32_t width)
{
  const uint64_t payload = counted(walk, width == (uint32_t)HALF ? 2u : 5u);

  return width == (uint32_t)HALF ? UINT64_C(0x7fc00000) | payload : UINT64_C(0x7ff8000000000000) | payload;
}

/* All bits of a number. */
static uint64_t ones(uint32_t width)
{
  uint64_t value = 0;

  for (uint32_t i = 0; i < width; ++i) {
    value = (value << BITS) | UINT8_MAX;
  }
  return value;
}

static uint64_t lowest(uint32_t width, selftest_kind_t kind)
{
  if (kind == SELFTEST_FLOAT) {
    return width == (uint32_t)HALF ? UINT64_C(0xff7fffff) : UINT64_C(0xffefffffffffffff);
  }
  return kind == SELFTEST_SIGNED ? ones(width) ^ (ones(width) >> 1) : 0u;
}

static uint64_t largest(uint32_t width, selftest_kind_t kind)
{
  if (kind == SELFTEST_FLOAT) {
    return width == (uint32_t)HALF ? UINT64_C(0x7f7fffff) : UINT64_C(0x7fefffffffffffff);
  }
  if (kind == SELFTEST_BOOL) {
    return 1;
  }
  return kind == SELFTEST_SIGNED ? ones(width) >> 1 : ones(width);
}

static uint64_t value_of(selftest_walk_t * walk, uint32_t width, selftest_kind_t kind)
{
  if (walk->content == SELFTEST_EMPTY) {
    return lowest(width, kind);
  }
  if (walk->content == SELFTEST_FULL) {
    return largest(width, kind);
  }
  if (kind == SELFTEST_FLOAT) {
    return counted_nan(walk, width);
  }
  return kind == SELFTEST_BOOL ? (uint64_t)(next_count(walk) & 1u) : counted(walk, width);
}

/* In the byte order of the processor. */
static void store(void * to, uint64_t value, uint32_t width, selftest_kind_t kind)
{
  const bool is_true = value != 0u;
  const uint8_t one = (uint8_t)(value & UINT8_MAX);
  const uint16_t two = (uint16_t)(value & UINT16_MAX);
  const uint32_t four = (uint32_t)(value & UINT32_MAX);

  if (kind == SELFTEST_BOOL) {
    (void)memcpy(to, &is_true, sizeof(is_true));
  } else if (width == sizeof(one)) {
    (void)memcpy(to, &one, sizeof(one));
  } else if (width == sizeof(two)) {
    (void)memcpy(to, &two, sizeof(two));
  } else if (width == sizeof(four)) {
    (void)memcpy(to, &four, sizeof(four));
  } else {
    (void)memcpy(to, &value, sizeof(value));
  }
}

void selftest_numbers(
  selftest_walk_t * walk, void * numbers, size_t count, uint32_t width, selftest_kind_t kind)
{
  uint8_t * to = numbers;

  for (size_t i = 0; i < count; ++i) {
    const uint64_t value = value_of(walk, width, kind);

    store(&to[i * width], value, width, kind);
    put_number(walk, value, width);
  }
}

static size_t size_of(const selftest_walk_t * walk, size_t most)
{
  if (walk->content == SELFTEST_EMPTY) {
    return 0;
  }
  return walk->content == SELFTEST_FULL ? most : (most + 1u) / 2u;
}

size_t selftest_size(selftest_walk_t * walk, size_t capacity)
{
  const size_t size = size_of(walk, capacity);

  put_number(walk, size, LENGTH);
  return size;
}

static char next_letter(selftest_walk_t * walk)
{
  return (char)('a' + (char)(next_count(walk) % (uint8_t)LETTERS));
}

void selftest_string(selftest_walk_t * walk, rosidl_runtime_c__String * text)
{
  const size_t size = text->capacity == 0u ? 0u : size_of(walk, text->capacity - 1u);

  text->size = size;
  put_number(walk, (uint64_t)size + 1u, LENGTH);
  for (size_t i = 0; i < size; ++i) {
    text->data[i] = next_letter(walk);
    put_byte(walk, (uint8_t)text->data[i]);
  }
  if (text->capacity != 0u) {
    text->data[size] = '\0';
  }
  put_byte(walk, 0);
}

/* Each unit takes four bytes, and there is no terminator. */
void selftest_wstring(selftest_walk_t * walk, rosidl_runtime_c__U16String * text)
{
  const size_t size = text->capacity == 0u ? 0u : size_of(walk, text->capacity - 1u);

  text->size = size;
  put_number(walk, size, LENGTH);
  for (size_t i = 0; i < size; ++i) {
    text->data[i] = (uint_least16_t)next_letter(walk);
    put_number(walk, text->data[i], LENGTH);
  }
  if (text->capacity != 0u) {
    text->data[size] = 0;
  }
}
