/* SPDX-License-Identifier: Apache-2.0 */
/* Strings and sequences of messages, with an arena and (argument "none") without. */
#include "unit.h"

#include <rcl/error_handling.h>
#include <rosidl_runtime_c/primitives_sequence_functions.h>
#include <rosidl_runtime_c/string_functions.h>
#include <rosidl_runtime_c/u16string_functions.h>

#include <math.h>
#include <string.h>

static void test_empty_and_user_buffers(void)
{
  static char buffer[8];
  rosidl_runtime_c__String s;
  rosidl_runtime_c__String own = {buffer, 0, sizeof(buffer)};

  CHECK(!rosidl_runtime_c__String__init(NULL));
  CHECK(rosidl_runtime_c__String__init(&s));
  CHECK(s.size == 0u && s.capacity == 1u && s.data[0] == '\0');
  CHECK(rosidl_runtime_c__String__assign(&s, ""));
  CHECK(rosidl_runtime_c__String__assign(&own, "seven77"));
  CHECK(own.data == buffer && own.size == 7u && strcmp(buffer, "seven77") == 0);
  CHECK(rosidl_runtime_c__String__assignn(&own, "abcdef", 3));
  CHECK(own.size == 3u && strcmp(buffer, "abc") == 0);
  CHECK(!rosidl_runtime_c__String__assign(&own, NULL));
  CHECK(!rosidl_runtime_c__String__assign(NULL, "x"));
  CHECK(!rosidl_runtime_c__String__are_equal(&own, &s));
  CHECK(!rosidl_runtime_c__String__are_equal(&own, NULL));
  rosidl_runtime_c__String__fini(&s);
  CHECK(s.data == NULL && s.capacity == 0u);
  rosidl_runtime_c__String__fini(&s);
  rosidl_runtime_c__String__fini(NULL);
}

static void test_without_memory(void)
{
  static char buffer[8];
  rosidl_runtime_c__String own = {buffer, 0, sizeof(buffer)};
  rosidl_runtime_c__String empty;
  rosidl_runtime_c__String__Sequence several;

  CHECK(rosidl_runtime_c__String__assign(&own, "seven77"));
  CHECK(!rosidl_runtime_c__String__assign(&own, "eight888"));
  CHECK(strcmp(own.data, "seven77") == 0 && own.size == 7u);
  CHECK(strstr(rcl_get_error_string().str, "no memory for 9 bytes: raise memory: {arena: ") != NULL);
  CHECK(rosidl_runtime_c__String__init(&empty));
  CHECK(!rosidl_runtime_c__String__assign(&empty, "x"));
  CHECK(empty.size == 0u);
  CHECK(rosidl_runtime_c__String__Sequence__init(&several, 0));
  CHECK(!rosidl_runtime_c__String__Sequence__init(&several, 1));
}

static void test_strings(void)
{
  const rosidl_runtime_c__String zeros = {NULL, 0, 0};
  rosidl_runtime_c__String a;
  rosidl_runtime_c__String b;

  CHECK(rosidl_runtime_c__String__init(&a) && rosidl_runtime_c__String__init(&b));
  CHECK(rosidl_runtime_c__String__assign(&a, "some words") && a.capacity == 11u);
  CHECK(rosidl_runtime_c__String__copy(&a, &b) && b.data != a.data);
  CHECK(rosidl_runtime_c__String__are_equal(&a, &b));
  b.data[0] = 'S';
  CHECK(!rosidl_runtime_c__String__are_equal(&a, &b));
  CHECK(rosidl_runtime_c__String__assign(&b, "less") && b.capacity == 11u);
  CHECK(!rosidl_runtime_c__String__copy(NULL, &b));
  CHECK(!rosidl_runtime_c__String__copy(&zeros, &b) && b.size == 4u); /* as ROS 2 does */
  rosidl_runtime_c__String__fini(&a);
  rosidl_runtime_c__String__fini(&b);
}

static void test_string_sequences(void)
{
  rosidl_runtime_c__String__Sequence * a = rosidl_runtime_c__String__Sequence__create(2);
  rosidl_runtime_c__String__Sequence b;

  CHECK(a != NULL && a->size == 2u && a->data[1].data[0] == '\0');
  CHECK(rosidl_runtime_c__String__assign(&a->data[0], "one"));
  CHECK(rosidl_runtime_c__String__Sequence__init(&b, 0));
  CHECK(!rosidl_runtime_c__String__Sequence__are_equal(a, &b));
  CHECK(rosidl_runtime_c__String__Sequence__copy(a, &b) && b.size == 2u);
  CHECK(rosidl_runtime_c__String__Sequence__are_equal(a, &b));
  a->size = 1;
  CHECK(rosidl_runtime_c__String__Sequence__copy(a, &b) && b.size == 1u && b.capacity == 2u);
  a->size = 2;
  rosidl_runtime_c__String__Sequence__destroy(a);
  rosidl_runtime_c__String__Sequence__destroy(NULL);
  rosidl_runtime_c__String__Sequence__fini(&b);
}

static void test_u16strings(void)
{
  static const uint16_t words[] = {'h', 0x00e4, 0x20ac, 0};
  rosidl_runtime_c__U16String a;
  rosidl_runtime_c__U16String b;
  rosidl_runtime_c__U16String__Sequence several;

  CHECK(rosidl_runtime_c__U16String__len(words) == 3u);
  CHECK(rosidl_runtime_c__U16String__init(&a) && rosidl_runtime_c__U16String__init(&b));
  CHECK(rosidl_runtime_c__U16String__assign(&a, words) && a.size == 3u && a.data[3] == 0u);
  CHECK(rosidl_runtime_c__U16String__copy(&a, &b) && rosidl_runtime_c__U16String__are_equal(&a, &b));
  CHECK(
    rosidl_runtime_c__U16String__resize(&b, 6) && b.size == 6u && b.data[2] == 0x20acu && b.data[5] == 0u);
  CHECK(rosidl_runtime_c__U16String__resize(&b, 1) && b.size == 1u && b.data[1] == 0u);
  CHECK(rosidl_runtime_c__U16String__assignn_from_char(&b, (const char *)words, 2) && b.data[1] == 0x00e4u);
  CHECK(rosidl_runtime_c__U16String__Sequence__init(&several, 2));
  rosidl_runtime_c__U16String__Sequence__fini(&several);
  rosidl_runtime_c__U16String__fini(&a);
  rosidl_runtime_c__U16String__fini(&b);
}

static void test_primitive_sequences(void)
{
  rosidl_runtime_c__double__Sequence a;
  rosidl_runtime_c__double__Sequence b = {NULL, 0, 0};
  rosidl_runtime_c__boolean__Sequence flags;

  CHECK(
    rosidl_runtime_c__double__Sequence__init(&a, 3) && a.size == 3u && a.capacity == 3u &&
    !(a.data[2] > 0.0));
  a.data[1] = 1.5;
  CHECK(
    rosidl_runtime_c__double__Sequence__copy(&a, &b) &&
    rosidl_runtime_c__float64__Sequence__are_equal(&a, &b));
  a.data[0] = (double)NAN;
  CHECK(!rosidl_runtime_c__double__Sequence__are_equal(&a, &a));
  a.data[0] = -0.0;
  CHECK(rosidl_runtime_c__double__Sequence__are_equal(&a, &b));
  a.size = 2;
  CHECK(rosidl_runtime_c__double__Sequence__copy(&a, &b) && b.size == 2u && b.capacity == 3u);
  CHECK(rosidl_runtime_c__bool__Sequence__init(&flags, 4) && !flags.data[3]);
  CHECK(!rosidl_runtime_c__double__Sequence__init(NULL, 4));
  rosidl_runtime_c__boolean__Sequence__fini(&flags);
  rosidl_runtime_c__double__Sequence__fini(&a);
  rosidl_runtime_c__double__Sequence__fini(&b);
  CHECK(a.data == NULL && b.capacity == 0u);
}

int main(void)
{
  test_empty_and_user_buffers();
  if (MICROROS_ARENA_SIZE == 0u) {
    test_without_memory();
    return 0;
  }
  for (int round = 0; round < 100; ++round) { /* a leak would fill the arena */
    test_strings();
    test_string_sequences();
    test_u16strings();
    test_primitive_sequences();
  }
  return 0;
}
