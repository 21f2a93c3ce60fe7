/* SPDX-License-Identifier: Apache-2.0 */
/* Times or counts one call: argv is the message, the call, and `time` (nanoseconds) or how often to call it. */
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "codec.h"

enum { BATCHES = 101 };

static uint8_t copied[CODEC_BUFFER_SIZE];
static const double BATCH_NANOSECONDS = 100e3;

bool codec_copy(uint32_t size)
{
  (void)memcpy(copied, codec_buffer, size);
  __asm__ volatile("" : : "r"(copied) : "memory"); /* the copy is not left out */
  return true;
}

/** Call it `count` times: no pointer to it, which would cost as much as the smallest message. */
#define REPEAT(count, call) \
  for (long i = 0; i < (count); ++i) { \
    right = (call) && right; \
  }

/** Make the call `count` times; return whether each succeeded. */
static bool repeat(const char * what, const codec_case_t * one, uint32_t size, long count)
{
  bool right = true;
  if (strcmp(what, "codec_encode") == 0) {
    REPEAT(count, codec_encode(one->handle, one->message) == size);
  } else if (strcmp(what, "codec_encode_again") == 0) {
    REPEAT(count, codec_encode_again(one->handle, one->message) == size);
  } else if (strcmp(what, "codec_decode") == 0) {
    REPEAT(count, codec_decode(one->handle, size, one->target));
  } else if (strcmp(what, "codec_decode_again") == 0) {
    REPEAT(count, codec_decode_again(one->handle, size, one->target));
  } else {
    REPEAT(count, codec_copy(size));
  }
  return right;
}

static double now(void)
{
  struct timespec time;
  (void)clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec * 1e9 + (double)time.tv_nsec;
}

/** Return nanoseconds of one of `count` calls in a row. */
static double batch(const char * what, const codec_case_t * one, uint32_t size, long count)
{
  const double start = now();
  const bool right = repeat(what, one, size, count);
  const double end = now();
  if (!right) {
    exit(1);
  }
  return (end - start) / (double)count;
}

static int ascending(const void * one, const void * other)
{
  const double a = *(const double *)one, b = *(const double *)other;
  return (a > b) - (a < b);
}

/** Print the median of the batches, each long enough for the clock. */
static void measure(const char * what, const codec_case_t * one, uint32_t size)
{
  static double times[BATCHES];
  long count = 16;
  while (batch(what, one, size, count) * (double)count < BATCH_NANOSECONDS) {
    count *= 2;
  }
  for (int i = 0; i < BATCHES; ++i) {
    times[i] = batch(what, one, size, count);
  }
  qsort(times, BATCHES, sizeof(*times), ascending);
  printf("%.2f ns\n", times[BATCHES / 2]);
}

/** Print the bytes of the body, and a number that tells whether they are the same ones (FNV-1a). */
static void show(uint32_t size)
{
  uint32_t hash = 2166136261u;
  for (uint32_t i = 0; i < size; ++i) {
    hash = (hash ^ codec_buffer[i]) * 16777619u;
  }
  printf("%u bytes %08x\n", (unsigned)size, (unsigned)hash);
}

int main(int argc, char ** argv)
{
  const codec_case_t * const one = argc == 4 ? codec_case(argv[1]) : NULL;
  if (one == NULL) {
    return 2;
  }
  const uint32_t size = codec_encode(one->handle, one->message);
  if (size == 0u || !codec_decode(one->handle, size, one->target)) {
    return 1;
  }
  if (codec_encode_again(one->handle, one->target) != size) { /* the bytes read equal the bytes written */
    return 1;
  }
  show(size);
  if (strcmp(argv[3], "time") == 0) {
    measure(argv[2], one, size);
    return 0;
  }
  return repeat(argv[2], one, size, strtol(argv[3], NULL, 10)) ? 0 : 1;
}
