/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions that try to take longer than the analysis of loops and calls says. Each attack_* is called between two marks with
 * what makes it longest, in the order of this file. What the comments of loops say is true here; what has no bound that a
 * source tells has no comment.
 */
#include "measured.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>

#include <limits.h>
#include <string.h>
#include <sys/queue.h>

#define ROWS 3
#define COLUMNS (ROWS + 4)
#define LOOSE 2 + 6 /* no parentheses: 16 - LOOSE is 20 */
#define REPEAT(times) for (uint32_t r = 0; r < (times); ++r)
#define ATTACK __attribute__((noinline, used))
#ifdef MEASURED_NOTHING
#define CHOSEN 90
#else
#define CHOSEN 100
#endif
#if 1
#define TWICE 80
#else
#define TWICE 2
#endif
#define OCTAL 010

enum { FEW = 3, MANY = 100, NEXT };

typedef void (*work_t)(void);

struct link_t {
  SLIST_ENTRY(link_t) next;
};

static SLIST_HEAD(, link_t) links = SLIST_HEAD_INITIALIZER(links);
static struct link_t all_links[MANY];
static volatile uint32_t sink;
static volatile uint8_t bytes[256];
static char text[256];
static char other[256];
static uint32_t words[64];

__attribute__((noinline)) static void work(void)
{
  ++sink;
}

__attribute__((noinline)) static void work_more(void)
{
  for (uint32_t i = 0; i < MANY; ++i) {
    ++sink;
  }
}

ATTACK uint32_t attack_nested(void)
{
  uint32_t sum = 0;

  for (uint32_t i = 0; i < ROWS; ++i) {
    for (uint32_t k = 0; k < COLUMNS; ++k) {
      for (uint32_t n = 0; n < (uint32_t)NEXT; ++n) {
        sum += bytes[n] ^ k;
      }
    }
  }
  return sum;
}

ATTACK uint32_t attack_nested_while(const volatile uint8_t * at)
{
  uint32_t sum = 0;

  for (uint32_t i = 0; i < ROWS; ++i) {
    while (*at != 0u) { /* at most MANY rounds */
      sum += *at;
      ++at;
    }
    at -= MANY;
  }
  return sum;
}

ATTACK uint32_t attack_continue(uint32_t seed)
{
  uint32_t sum = 0;

  for (uint32_t i = 0; i < MANY; ++i) {
    if ((bytes[i] & 1u) != 0u) {
      sum += seed;
      continue;
    }
    if (bytes[i] == 77u) {
      break;
    }
    for (uint32_t k = 0; k < FEW; ++k) {
      sum ^= bytes[k];
    }
    if (sum == UINT32_MAX) {
      return 0;
    }
  }
  return sum;
}

ATTACK uint32_t attack_fall_through(uint32_t kind)
{
  uint32_t sum = 0;

  switch (kind) {
    case 0:
      sum += 1;
      work();
      /* falls through */
    case 1:
      sum += 2;
      work_more();
      /* falls through */
    case 2:
      work();
      sum *= 3;
      /* falls through */
    case 3:
      work_more();
      break;
    case 4:
      work();
      break;
    default:
      sum = 9;
      break;
  }
  return sum;
}

static void inner(void)
{
  for (uint32_t i = 0; i < MANY; ++i) {
    work();
  }
}

ATTACK void attack_callee(void)
{
  for (uint32_t i = 0; i < ROWS; ++i) {
    inner();
  }
}

static const work_t table[] = {work, work_more};

ATTACK void attack_table(uint32_t which)
{
  for (uint32_t i = 0; i < FEW; ++i) {
    table[which]();
  }
}

static uint32_t tail(uint32_t sum)
{
  for (uint32_t i = 0; i < MANY; ++i) {
    sum += bytes[i];
  }
  return sum;
}

ATTACK uint32_t attack_shared_tail(uint32_t kind)
{
  if (kind == 0u) {
    return tail(1) + tail(2);
  }
  if (kind == 1u) {
    work();
    return tail(3);
  }
  return tail(4) + 7u;
}

ATTACK void attack_branches(uint32_t few)
{
  if (few != 0u) {
    for (uint32_t i = 0; i < FEW; ++i) {
      ++sink;
    }
  } else {
    for (uint32_t i = 0; i < MANY; ++i) {
      ++sink;
    }
  }
}

ATTACK void attack_unrolled(void)
{
  for (uint32_t i = 0; i < 4u; ++i) {
    words[i] = sink + i;
  }
  for (uint32_t i = 0; i < 63u; ++i) {
    words[i + 1u] = words[i] * 3u + 1u;
  }
}

ATTACK void attack_wrap(uint8_t from)
{
  for (uint8_t i = from; i != 0u; --i) {
    ++sink;
  }
}

ATTACK void attack_wrap_for(uint8_t to)
{
  for (uint8_t i = 0; i < to; ++i) {
    ++sink;
  }
}

ATTACK void attack_memcpy(size_t size)
{
  (void)memcpy(text, other, size);
}

ATTACK void attack_memcpy_constant(void)
{
  (void)memcpy(text, &other[1], 203);
  (void)memset(other, 7, 199);
  (void)memmove(&text[1], text, 201);
}

ATTACK size_t attack_strlen(const char * of)
{
  return strlen(of);
}

ATTACK void attack_strncat(const char * of)
{
  (void)strncat(text, of, 4);
}

ATTACK void attack_strncpy(const char * of)
{
  (void)strncpy(text, of, 200);
}

ATTACK uint64_t attack_division(uint64_t a, uint64_t b)
{
  return a / b + a % b;
}

ATTACK uint32_t attack_tail_call(uint32_t kind)
{
  if (kind != 0u) {
    return attack_continue(kind);
  }
  return attack_nested();
}

ATTACK void attack_macro(void)
{
  for (uint32_t i = 0; i < FEW; ++i) {
    REPEAT(MANY)
    {
      ++sink;
    }
  }
}

ATTACK void attack_foreign_macro(void)
{
  const struct link_t * link;

  for (uint32_t i = 0; i < FEW; ++i) {
    SLIST_FOREACH(link, &links, next)
    {
      ++sink;
    }
  }
}

/* clang-format off */
ATTACK void attack_one_line(void)
{
  for (uint32_t i = 0; i < FEW; ++i) { for (uint32_t k = 0; k < MANY; ++k) { ++sink; } }
}
/* clang-format on */

ATTACK void attack_goto(uint32_t times)
{
  for (uint32_t i = 0; i < FEW; ++i) {
    uint32_t left = times;

  again:
    ++sink;
    --left;
    if (left != 0u) {
      goto again;
    }
  }
}

ATTACK void attack_goto_around(uint32_t times)
{
again:
  for (uint32_t i = 0; i < FEW; ++i) {
    ++sink;
  }
  --times;
  if (times != 0u) {
    goto again;
  }
}

ATTACK void attack_do_in_do(void)
{
  uint32_t i = 0;
  uint32_t k = 0;

  do {   /* at most MANY rounds */
    do { /* at most FEW rounds */
      ++sink;
      ++k;
    } while (k % FEW != 0u);
    ++i;
  } while (i < MANY);
}

ATTACK void attack_end_of_two(uint32_t * at, uint32_t count, bool is_few)
{
  const uint32_t * const end = is_few ? at + 8 : at + count;

  while (at != end) {
    *at = 1;
    ++at;
  }
}

ATTACK void attack_chosen(void)
{
  for (uint32_t i = 0; i < CHOSEN; ++i) {
    ++sink;
  }
  for (uint32_t i = 0; i < TWICE; ++i) {
    ++sink;
  }
  for (uint32_t i = 0; i < 16 - LOOSE; ++i) {
    ++sink;
  }
  for (uint32_t i = 0; i < 40 - OCTAL; ++i) {
    ++sink;
  }
}

static void same_few(const volatile uint8_t * at)
{
  while (*at != 0u) { /* at most FEW rounds */
    sink += *at;
    ++at;
  }
  sink = sink * 5u + 3u;
}

static void same_many(const volatile uint8_t * at)
{
  while (*at != 0u) { /* at most MANY rounds */
    sink += *at;
    ++at;
  }
  sink = sink * 5u + 3u;
}

ATTACK void attack_same(const volatile uint8_t * few, const volatile uint8_t * many)
{
  same_few(few);
  same_few(few);
  same_few(few);
  same_many(many);
  same_many(many);
  same_many(many);
}

static uint32_t down(uint32_t n)
{
  return n == 0u ? 0u : bytes[n] + down(n - 1u);
}

ATTACK uint32_t attack_recursion(void)
{
  uint32_t sum = 0;

  for (uint32_t i = 0; i < FEW; ++i) {
    sum += down(MANY);
  }
  return sum;
}

ATTACK void attack_changed(void)
{
  uint32_t most = FEW;

  for (uint32_t i = 0; i < most; ++i) {
    if (i == 1u) {
      most = MANY;
    }
    ++sink;
  }
}

static void twice(uint32_t * i)
{
  if (sink % 2u != 0u) {
    *i = *i - 1u;
  }
  ++sink;
}

ATTACK void attack_by_pointer(void)
{
  for (uint32_t i = 0; i < MANY; ++i) {
    uint32_t * const other_name = &i;

    twice(other_name);
  }
}

ATTACK uint32_t attack_part(uint32_t count)
{
  /* at most MANY rounds */
  for (uint32_t i = 0; i < count; ++i) {
    if (bytes[i] > 200u) {
      work_more(); /* at most 2 calls */
    }
    work();
  }
  return sink;
}

ATTACK void attack_conditional(uint32_t a)
{
  for (uint32_t i = 0; i < MANY; ++i) {
    if ((a >> (i & 31u) & 1u) != 0u) {
      ++sink;
    } else {
      sink -= 3u;
    }
  }
}

#define MEASURE(call) \
  do { \
    mark(); \
    call; \
    mark(); \
  } while (0)

static void fill(uint32_t size, uint8_t value)
{
  for (volatile uint32_t i = 0; i < sizeof(bytes); ++i) {
    bytes[i] = i < size ? value : 0u;
  }
}

static volatile bool is_running;

int main(void)
{
  static volatile uint8_t few[] = {1, 1, 1, 0};

  if (is_running) { /* the tool compares the plan of an image with that of its library */
    rcl_allocator_t allocator = rcl_get_default_allocator();
    rclc_support_t support;

    (void)rclc_support_init(&support, 0, NULL, &allocator);
  }
  (void)memset(other, 'x', sizeof(other) - 1u);
  for (uint32_t i = 0; i < (uint32_t)MANY; ++i) {
    SLIST_INSERT_HEAD(&links, &all_links[i], next);
  }
  fill(MANY, 2);
  MEASURE(sink = attack_nested());
  MEASURE(sink = attack_nested_while(bytes));
  MEASURE(sink = attack_continue(5));
  MEASURE(sink = attack_fall_through(0));
  MEASURE(attack_callee());
  MEASURE(attack_table(1));
  MEASURE(sink = attack_shared_tail(0));
  MEASURE(attack_branches(0));
  MEASURE(attack_unrolled());
  MEASURE(attack_wrap(255));
  MEASURE(attack_wrap_for(255));
  MEASURE(attack_memcpy(255));
  MEASURE(attack_memcpy_constant());
  MEASURE(sink = attack_strlen(other));
  (void)memset(text, 'y', 240);
  text[240] = '\0';
  MEASURE(attack_strncat("abc"));
  MEASURE(attack_strncpy(other));
  MEASURE(sink = (uint32_t)attack_division(UINT64_MAX - sink, 0x100000003u));
  MEASURE(sink = attack_tail_call(0));
  MEASURE(attack_macro());
  MEASURE(attack_foreign_macro());
  MEASURE(attack_one_line());
  MEASURE(attack_goto(200));
  MEASURE(attack_goto_around(200));
  MEASURE(attack_do_in_do());
  MEASURE(attack_end_of_two(words, 64, false));
  MEASURE(attack_chosen());
  MEASURE(attack_same(few, bytes));
  MEASURE(sink = attack_recursion());
  MEASURE(attack_changed());
  MEASURE(attack_by_pointer());
  bytes[1] = 201u;
  bytes[2] = 201u;
  MEASURE(sink = attack_part(MANY));
  MEASURE(attack_conditional(0x0f0f0f0fu));
  finish();
  return 0;
}
