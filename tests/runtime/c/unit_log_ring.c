/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The lines that survive a reset, cut off at every access to them: each access goes through ring_memory, which ends the
 * program's turn as a reset does. What is found afterwards are whole lines, in order, and at most the oldest or the one
 * that was on its way are missing. Then memory with any content.
 */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#pragma GCC diagnostic ignored "-Wstrict-prototypes"
#define microros_log_kept (*ring_memory())
#include "rcutils_ring.c"
#undef microros_log_kept

enum { LINES = 12, TURNS = 20000, LINE_SIZE = 100, PUBLISHED_MOST = 64 };

static volatile ring_kept_t memory;
static jmp_buf reset;
static long accesses_left = -1; /* negative: no reset */
static bool is_open = true;
static uint32_t published;
static uint32_t published_size[PUBLISHED_MOST];
static uint8_t published_body[PUBLISHED_MOST][RING_LINE_MAX];
static uint32_t announced;

static volatile ring_kept_t * ring_memory()
{
  if (accesses_left == 0) {
    accesses_left = -1;
    longjmp(reset, 1);
  }
  accesses_left -= accesses_left > 0 ? 1 : 0;
  return &memory;
}

bool xrce_rosout_is_open(const xrce_client_t * client)
{
  (void)client;
  return is_open;
}

bool xrce_rosout_has_room(uint32_t size)
{
  return size <= RING_LINE_MAX && published < PUBLISHED_MOST;
}

bool xrce_rosout_put(const uint8_t * body, uint32_t size)
{
  memcpy(published_body[published], body, size);
  published_size[published] = size;
  ++published;
  return true;
}

void microros_rosout_publish(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * text)
{
  (void)timestamp;
  announced += location == NULL && severity == RCUTILS_LOG_SEVERITY_INFO && strcmp(name, "microros") == 0 &&
                   text[0] == 'l' && !microros_ring_takes(RCUTILS_LOG_SEVERITY_FATAL)
                 ? 1u
                 : 100u;
}

int64_t port_time_epoch_ns(void)
{
  return 0;
}

static void expect(bool is_true, const char * what, long place)
{
  if (!is_true) {
    printf("%s, %ld\n", what, place);
    exit(1);
  }
}

/* Everything but the memory of the lines begins from the start. */
static void restart(void)
{
  ring_before = 0;
  ring_is_checked = false;
  ring_is_announced = false;
  published = 0;
  announced = 0;
}

static uint32_t size_of(uint32_t number)
{
  return LINE_SIZE + number * 7u % 90u;
}

static void put(uint32_t number)
{
  uint8_t body[RING_LINE_MAX];

  for (uint32_t i = 0; i < size_of(number); ++i) {
    body[i] = (uint8_t)(number + i);
  }
  microros_ring_put(body, size_of(number));
}

/* Returns the number of the line that was published as `index`; checks that it is whole. */
static uint32_t number_of(uint32_t index, long place)
{
  const uint32_t number = published_body[index][0];

  expect(published_size[index] == size_of(number), "size", place);
  for (uint32_t i = 0; i < size_of(number); ++i) {
    expect(published_body[index][i] == (uint8_t)(number + i), "body", place);
  }
  return number;
}

/* Puts lines until the reset; returns how many were complete, and whether all were. */
static bool put_until_reset(uint32_t * complete)
{
  *complete = 0;
  if (setjmp(reset) != 0) {
    return false;
  }
  for (uint32_t number = 0; number < LINES; ++number) {
    put(number);
    ++*complete;
  }
  accesses_left = -1;
  return true;
}

/* Returns whether a reset came. */
static bool cut(long accesses)
{
  static uint32_t complete;
  static bool is_whole;
  uint32_t bytes = 0;

  memset((void *)(uintptr_t)&memory, 0xa5, sizeof(memory));
  restart();
  accesses_left = accesses;
  is_whole = put_until_reset(&complete);
  restart();
  microros_ring_step(NULL);
  expect(announced == (published != 0u ? 1u : 0u), "announced", accesses);
  for (uint32_t i = 0; i < published; ++i) {
    const uint32_t number = number_of(i, accesses);

    expect(i == 0u || number == number_of(i - 1u, accesses) + 1u, "order", accesses);
    bytes += RING_HEADER + size_of(number);
  }
  if (complete != 0u) {
    /* The last complete line is there, or the one that was being put. */
    const uint32_t last = published == 0u ? LINES : number_of(published - 1u, accesses);

    expect(last + 1u == complete || last == complete, "last", accesses);
    /* What is missing made room for at most one more line. */
    expect(
      number_of(0, accesses) == 0u || bytes + 2u * (RING_HEADER + LINE_SIZE + 90u) > MICROROS_LOG_RING_SIZE,
      "too few", accesses);
  }
  restart();
  microros_ring_step(NULL);
  expect(published == 0u && announced == 0u, "published twice", accesses);
  return !is_whole;
}

/* Nothing is read or written outside, and each line that is found has its checksum. */
static void any_content(uint32_t seed)
{
  uint32_t state = seed * 2654435761u + 1u;

  restart();
  for (uint32_t number = 0; number < LINES; ++number) {
    put(number);
  }
  for (uint32_t change = 0; change < 1u + seed % 40u; ++change) {
    state = state * 1664525u + 1013904223u;
    ((volatile uint8_t *)&memory)[state % sizeof(memory)] = (uint8_t)(state >> 24);
  }
  if (seed % 3u == 0u) {
    memory.mark = ring_mark;
    memory.place = state;
  }
  restart();
  microros_ring_step(NULL);
  put(3);
  restart();
  microros_ring_step(NULL);
  expect(published >= 1u && number_of(published - 1u, seed) == 3u, "the line after it", seed);
}

static void without_session(void)
{
  restart();
  put(1);
  restart();
  is_open = false;
  microros_ring_step(NULL);
  expect(published == 0u && announced == 0u, "without a session", 0);
  restart();
  is_open = true;
  microros_ring_step(NULL);
  expect(published == 1u && announced == 1u, "later", 0);
}

int main(void)
{
  long accesses = 1;

  while (cut(accesses)) {
    ++accesses;
  }
  for (uint32_t seed = 0; seed < TURNS; ++seed) {
    any_content(seed);
  }
  without_session();
  expect(microros_ring_takes(MICROROS_LOG_RING_LEVEL), "level", 0);
  expect(!microros_ring_takes(MICROROS_LOG_RING_LEVEL - 1), "level below", 0);
  printf("%ld resets\n", accesses);
  return 0;
}
