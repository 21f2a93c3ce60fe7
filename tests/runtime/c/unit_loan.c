/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Samples that are decoded where they are: texts and numbers of each width at every position, in both byte orders, and
 * any bytes at all, of which nothing outside is read or written.
 */
#include "unit.h"

#include "microros/cdr_loan.h"
#include "sensor_msgs/msg/detail/image__decode.h"
#include "sensor_msgs/msg/detail/laser_scan__decode.h"

#include <rosidl_runtime_c/primitives_sequence.h>

#include <string.h>

enum { ROOM = 128, ROUNDS = 20000 };

typedef struct message_t {
  rosidl_runtime_c__String text;
  rosidl_runtime_c__uint8__Sequence bytes;
  rosidl_runtime_c__uint16__Sequence words;
  rosidl_runtime_c__double__Sequence reals;
  rosidl_runtime_c__uint32__Sequence numbers;
  rosidl_runtime_c__String last;
} message_t;

static const double reals[] = {0.5, -3.25};
static const uint16_t words[] = {0x0102, 0xfffe, 7};
static const uint32_t numbers[] = {0x01020304u, 0xdeadbeefu};

static uint64_t storage[ROOM / 8 + 1];
static bool swapped;
static uint32_t size;

static void decode(cdr_in_t * in, void * untyped)
{
  message_t * message = untyped;

  cdr_get_string(in, &message->text, 12u, "text");
  cdr_get_sequence_1(in, &message->bytes, CDR_UNBOUNDED, "bytes");
  cdr_get_sequence_2(in, &message->words, CDR_UNBOUNDED, "words");
  cdr_get_sequence_8(in, &message->reals, 3u, "reals");
  cdr_get_sequence_4(in, &message->numbers, CDR_UNBOUNDED, "numbers");
  cdr_get_string(in, &message->last, CDR_UNBOUNDED, "last");
}

static const microros_message_type_t type = {.dds_type_name = "test", .decode = decode};

/* Appends numbers after their padding, in the byte order of the body. */
static void put(uint8_t * body, const void * values, uint32_t width, uint32_t count)
{
  const uint8_t * from = values;

  while (size % width != 0u) {
    body[size] = 0xee;
    ++size;
  }
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t k = 0; k < width; ++k) {
      body[size] = from[i * width + (swapped ? width - 1u - k : k)];
      ++size;
    }
  }
}

static void put_length(uint8_t * body, uint32_t length)
{
  put(body, &length, 4, 1);
}

static void put_text(uint8_t * body, const char * text, bool has_end)
{
  const uint32_t length = (uint32_t)strlen(text) + (has_end ? 1u : 0u);

  put_length(body, length);
  put(body, text, 1, length);
}

/* `shift` moves everything after the text. */
static bool read(message_t * message, uint32_t base, uint32_t shift, bool has_end, cdr_fault_t * fault)
{
  static const char letters[] = "abcdefghij";
  uint8_t * body = &((uint8_t *)storage)[base];
  char text[sizeof(letters)];

  (void)memcpy(text, letters, sizeof(text));
  text[shift] = '\0';
  size = 0;
  (void)memset(storage, 0xcc, sizeof(storage));
  put_text(body, text, has_end);
  put_length(body, shift);
  put(body, letters, 1, shift);
  put_length(body, 3);
  put(body, words, 2, 3);
  put_length(body, 2);
  put(body, reals, 8, 2);
  put_length(body, 2);
  put(body, numbers, 4, 2);
  put_text(body, "end", has_end);
  CHECK(size <= ROOM);
  (void)memset(message, 0, sizeof(*message));
  return cdr_loan_decode(&type, body, size, swapped, message, fault);
}

static bool is_inside(const void * data)
{
  return (const uint8_t *)data >= (const uint8_t *)storage &&
         (const uint8_t *)data < (const uint8_t *)storage + sizeof(storage);
}

static void check(uint32_t base, uint32_t shift, bool has_end)
{
  cdr_fault_t fault;
  message_t message;

  CHECK(read(&message, base, shift, has_end, &fault));
  CHECK(
    message.text.size == shift && strlen(message.text.data) == shift && message.text.capacity == shift + 1u);
  CHECK(strncmp(message.text.data, "abcdefghij", shift) == 0 && is_inside(message.text.data));
  CHECK(message.bytes.size == shift && (shift == 0u || memcmp(message.bytes.data, "abcdefghij", shift) == 0));
  CHECK(message.words.size == 3u && message.words.capacity == 3u && is_inside(message.words.data));
  CHECK(message.reals.size == 2u && (uintptr_t)message.reals.data % sizeof(double) == 0u);
  for (size_t i = 0; i < 3u; ++i) {
    CHECK(message.words.data[i] == words[i]);
  }
  CHECK(memcmp(message.reals.data, reals, sizeof(reals)) == 0);
  CHECK(message.numbers.data[0] == numbers[0] && message.numbers.data[1] == numbers[1]);
  CHECK(strcmp(message.last.data, "end") == 0 && message.last.size == 3u);
}

static void test_bounds(void)
{
  cdr_fault_t fault;
  message_t message;
  uint8_t * body = (uint8_t *)storage;

  CHECK(read(&message, 0, 9, true, &fault));
  size = 0;
  put_text(body, "more than twelve", true);
  CHECK(!cdr_loan_decode(&type, body, size, swapped, &message, &fault));
  CHECK(fault.kind == CDR_FAULT_BOUND && strcmp(fault.field, "text") == 0);
  size = 0;
  put_text(body, "", false);
  put_length(body, 0);
  put_length(body, 0);
  put_length(body, 4);
  put(body, reals, 8, 2);
  put(body, reals, 8, 2);
  CHECK(!cdr_loan_decode(&type, body, size, swapped, &message, &fault));
  CHECK(fault.kind == CDR_FAULT_BOUND && strcmp(fault.field, "reals") == 0);
  CHECK(message.text.size == 0u && message.text.data[0] == '\0');
}

/* A message with memory is still copied: only the decoder of a loan lends. */
static void test_others_copy(void)
{
  char text[16];
  uint8_t bytes[16];
  uint16_t some_words[4];
  double some_reals[4];
  uint32_t some_numbers[4];
  char last[8];
  cdr_fault_t fault;
  message_t message;

  CHECK(read(&message, 0, 3, true, &fault));
  CHECK(read(&message, 0, 3, true, &fault)); /* the bytes as they were */
  message.text = (rosidl_runtime_c__String){text, 0, sizeof(text)};
  message.bytes = (rosidl_runtime_c__uint8__Sequence){bytes, 0, 16};
  message.words = (rosidl_runtime_c__uint16__Sequence){some_words, 0, 4};
  message.reals = (rosidl_runtime_c__double__Sequence){some_reals, 0, 4};
  message.numbers = (rosidl_runtime_c__uint32__Sequence){some_numbers, 0, 4};
  message.last = (rosidl_runtime_c__String){last, 0, sizeof(last)};
  (void)cdr_decode(&type, (const uint8_t *)storage, size, swapped, &message, &fault);
  CHECK(message.text.data == text && message.words.data == some_words);
}

/* Bytes that make long texts and sequences, more or less. */
static void test_any_bytes(void)
{
  static const microros_message_type_t types[] = {
    {.dds_type_name = "image", .decode = sensor_msgs__msg__Image__decode},
    {.dds_type_name = "scan", .decode = sensor_msgs__msg__LaserScan__decode},
    {.dds_type_name = "test", .decode = decode}};
  static union {
    message_t own;
    sensor_msgs__msg__Image image;
    sensor_msgs__msg__LaserScan scan;
  } message;
  uint32_t random = 2463534242u;

  for (int round = 0; round < ROUNDS; ++round) {
    const uint32_t length = random % (ROOM + 1u);
    uint8_t * body = malloc(length + 4u);
    cdr_fault_t fault;

    CHECK(body != NULL);
    for (uint32_t i = 0; i < length; ++i) {
      random ^= random << 13;
      random ^= random >> 17;
      random ^= random << 5;
      body[i] = (random & 3u) != 0u ? 0u : (uint8_t)((random >> 8) & 15u);
    }
    (void)memset(&message, 0, sizeof(message));
    (void)cdr_loan_decode(&types[round % 3], body, length, (round & 4) != 0, &message, &fault);
    free(body);
  }
}

int main(void)
{
  for (int round = 0; round < 2; ++round) {
    swapped = round == 1;
    for (uint32_t base = 0; base <= 4u; base += 4u) {
      for (uint32_t shift = 0; shift <= 10u; ++shift) {
        check(base, shift, true);
        check(base, shift, false);
      }
    }
    test_bounds();
  }
  swapped = false;
  test_others_copy();
  test_any_bytes();
  return 0;
}
