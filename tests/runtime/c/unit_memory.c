/* SPDX-License-Identifier: Apache-2.0 */
/* The arena and what stands on it: 512 bytes. */
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcutils/types/uint8_array.h>

#include <stdint.h>
#include <string.h>

enum { PIECES = 20 };

static void test_takes_and_gives_back(rcl_allocator_t a)
{
  void * piece[PIECES];
  size_t count = 0;

  for (; count < PIECES; ++count) {
    piece[count] = a.allocate(24, a.state);
    if (piece[count] == NULL) {
      break;
    }
    CHECK((uintptr_t)piece[count] % sizeof(uint64_t) == 0u);
    memset(piece[count], (int)count, 24);
  }
  CHECK(count >= 8u && count < PIECES);
  CHECK(strstr(rcl_get_error_string().str, "memory: {arena: ") != NULL);
  for (size_t i = 0; i < count; ++i) {
    CHECK(*(uint8_t *)piece[i] == i);
  }
  for (size_t i = 0; i < count; i += 2u) {
    a.deallocate(piece[i], a.state);
  }
  CHECK(a.allocate(200, a.state) == NULL); /* the free memory is fragmented */
  for (size_t i = 1; i < count; i += 2u) {
    a.deallocate(piece[i], a.state);
  }
  piece[0] = a.allocate(400, a.state);
  CHECK(piece[0] != NULL); /* joined again */
  a.deallocate(piece[0], a.state);
}

static void test_reallocates(rcl_allocator_t a)
{
  char * text = a.allocate(8, a.state);
  char * other;

  strcpy(text, "seven77");
  other = a.allocate(8, a.state);
  text = a.reallocate(text, 100, a.state); /* moves: something is after it */
  CHECK(text != NULL && strcmp(text, "seven77") == 0 && text != other);
  CHECK(a.reallocate(text, 200, a.state) == text); /* grows in place */
  CHECK(a.reallocate(text, 10, a.state) == text);
  CHECK(a.reallocate(text, 4000, a.state) == NULL);
  CHECK(strcmp(text, "seven77") == 0);
  a.deallocate(text, a.state);
  a.deallocate(other, a.state);
  text = a.reallocate(NULL, 16, a.state);
  CHECK(text != NULL);
  a.deallocate(text, a.state);
}

static void test_zeroes(rcl_allocator_t a)
{
  uint8_t * bytes = a.allocate(64, a.state);

  memset(bytes, 0xff, 64);
  a.deallocate(bytes, a.state);
  bytes = a.zero_allocate(8, 8, a.state);
  for (size_t i = 0; i < 64u; ++i) {
    CHECK(bytes[i] == 0u);
  }
  a.deallocate(bytes, a.state);
  CHECK(a.zero_allocate(SIZE_MAX / 2u, 4, a.state) == NULL);
  CHECK(a.zero_allocate(SIZE_MAX, SIZE_MAX, a.state) == NULL);
  CHECK(a.allocate(SIZE_MAX, a.state) == NULL);
}

static void test_leaves_foreign_pointers_alone(rcl_allocator_t a)
{
  static char foreign[64];
  char * mine = a.allocate(16, a.state);

  a.deallocate(foreign, a.state);
  a.deallocate(NULL, a.state);
  a.deallocate(mine + 8, a.state);
  CHECK(a.allocate(16, a.state) != mine);
  a.deallocate(mine, a.state);
  a.deallocate(mine, a.state); /* twice */
  CHECK(a.allocate(16, a.state) == mine);
}

/* Random sizes against a shadow: blocks never overlap, contents stay. */
static void test_random(rcl_allocator_t a)
{
  uint8_t * piece[PIECES] = {NULL};
  size_t size[PIECES] = {0};
  uint32_t seed = 1;

  for (int round = 0; round < 20000; ++round) {
    seed = seed * 1664525u + 1013904223u;
    size_t i = (seed >> 8) % PIECES;

    if (piece[i] == NULL) {
      size[i] = (seed >> 16) % 60u;
      piece[i] = a.allocate(size[i], a.state);
      if (piece[i] != NULL) {
        memset(piece[i], (int)i, size[i]);
      }
    } else {
      for (size_t k = 0; k < size[i]; ++k) {
        CHECK(piece[i][k] == i);
      }
      a.deallocate(piece[i], a.state);
      piece[i] = NULL;
    }
  }
  for (size_t i = 0; i < PIECES; ++i) {
    a.deallocate(piece[i], a.state);
  }
}

static void test_uint8_array(rcl_allocator_t a)
{
  rcutils_uint8_array_t array = rcutils_get_zero_initialized_uint8_array();

  CHECK(rcutils_uint8_array_init(&array, 16, &a) == RCUTILS_RET_OK && array.buffer_capacity == 16u);
  memcpy(array.buffer, "0123456789abcdef", 16);
  array.buffer_length = 16;
  CHECK(
    rcutils_uint8_array_resize(&array, 64) == RCUTILS_RET_OK &&
    memcmp(array.buffer, "0123456789abcdef", 16) == 0);
  CHECK(rcutils_uint8_array_resize(&array, 4) == RCUTILS_RET_OK && array.buffer_length == 4u);
  CHECK(rcutils_uint8_array_resize(&array, 5000) == RCUTILS_RET_BAD_ALLOC && array.buffer_capacity == 4u);
  CHECK(rcutils_uint8_array_resize(&array, 0) == RCUTILS_RET_INVALID_ARGUMENT);
  CHECK(rcutils_uint8_array_fini(&array) == RCUTILS_RET_OK && array.buffer == NULL);
  CHECK(rcutils_uint8_array_init(&array, 16, NULL) == RCUTILS_RET_INVALID_ARGUMENT);
}

static size_t calls;

static void * counting_allocate(size_t size, void * state)
{
  (void)state;
  ++calls;
  return malloc(size);
}

static void counting_deallocate(void * pointer, void * state)
{
  (void)state;
  free(pointer);
}

static void * counting_reallocate(void * pointer, size_t size, void * state)
{
  (void)state;
  return realloc(pointer, size);
}

static void * counting_zero_allocate(size_t count, size_t size, void * state)
{
  (void)state;
  return calloc(count, size);
}

static void test_another_default(void)
{
  rcutils_allocator_t mine = rcutils_get_zero_initialized_allocator();
  rcutils_allocator_t now;
  void * memory;

  CHECK(!rcutils_set_default_allocator(&mine));
  CHECK(!rcutils_set_default_allocator(NULL));
  mine.allocate = counting_allocate;
  mine.deallocate = counting_deallocate;
  mine.reallocate = counting_reallocate;
  mine.zero_allocate = counting_zero_allocate;
  CHECK(rcutils_set_default_allocator(&mine));
  now = rcl_get_default_allocator();
  memory = now.allocate(5, now.state);
  CHECK(memory != NULL && calls == 1u);
  memory = rcutils_reallocf(memory, 50, &now);
  CHECK(memory != NULL);
  now.deallocate(memory, now.state);
}

int main(void)
{
  rcl_allocator_t a = rcl_get_default_allocator();

  CHECK(rcutils_allocator_is_valid(&a));
  test_takes_and_gives_back(a);
  test_reallocates(a);
  test_zeroes(a);
  test_random(a);
  test_uint8_array(a);
  test_leaves_foreign_pointers_alone(a);
  test_another_default();
  return 0;
}
