/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What measured programs share: mark() stands between the phases; the trace of the emulator counts what lies between two
 * marks. The agent is inside the firmware, after the UDP group of the port, and answers at once, so that what is counted is
 * the client's work alone. It grants sessions, creations and deletions, acknowledges reliable messages, and gives requests
 * to services.
 */
#ifndef MEASURED_H
#define MEASURED_H

#include <microros/port.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ANSWERS = 8, ANSWER_SIZE = 128, HEADER = 4, SERVICES = 16 };
enum {
  CREATE_CLIENT = 0x00,
  CREATE = 0x01,
  GET_INFO = 0x02,
  DELETE = 0x03,
  WRITE_DATA = 0x07,
  READ_DATA = 0x08,
  RELIABLE = 0x80
};

typedef struct answer_t {
  uint8_t bytes[ANSWER_SIZE];
  size_t size;
} answer_t;

static answer_t answers[ANSWERS];
static size_t waiting;
static uint16_t output_sequence[2];
static uint8_t read_ids[SERVICES][4]; /* request and object of each READ_DATA, by the index of the object */
static volatile uint32_t written;     /* WRITE_DATA since the start */

/*
 * Takes the place of a loop, or of an array with initial values, that the compiler would make a call of memcpy, which is
 * the library's to count. */
static void put(uint8_t * at, const uint8_t * bytes, size_t size)
{
  for (volatile size_t i = 0; i < size; ++i) {
    at[i] = bytes[i];
  }
}

static void answer(const uint8_t * bytes, size_t size)
{
  if (waiting < ANSWERS) {
    put(answers[waiting].bytes, bytes, size);
    answers[waiting].size = size;
    ++waiting;
  }
}

static void answer_status(uint8_t stream, const uint8_t * ids)
{
  static const uint8_t begin[14] = {0x81, 1, 0, 0, 0x05, 0x01, 6, 0, 0, 0, 0, 0, 0, 0};
  uint16_t * sequence = &output_sequence[stream == RELIABLE ? 1 : 0];
  uint8_t status[sizeof(begin)];

  put(status, begin, sizeof(begin));
  if (stream == RELIABLE) {
    status[1] = RELIABLE;
  }
  status[2] = (uint8_t)(*sequence & 0xffu);
  status[3] = (uint8_t)(*sequence >> 8);
  ++*sequence;
  put(&status[8], ids, 4);
  answer(status, sizeof(status));
}

#ifdef MEASURED_FULL
/* As many submessages as a message has room for. All but the last one are of the kind MEASURED_FULL: an ACKNACK asks for every
 * message of the stream once more, and a HEARTBEAT for an ACKNACK. */
static void answer_acknack(const uint8_t * message)
{
  enum { PLACE = 12, ASKING = 4, LAST = HEADER + ASKING * PLACE, FULL = LAST + 9 };
  static const uint8_t begin[PLACE] = {0x0a, 0x01, 5, 0, 0, 0, 0xff, 0xff, 0, 0, 0, 0};
  const uint16_t sequence = (uint16_t)(message[2] | (uint32_t)message[3] << 8);
  const uint16_t next = (uint16_t)(sequence + 1u);
  uint8_t full[LAST + PLACE];

  put(full, (const uint8_t[HEADER]){0x81, 0, 0, 0}, HEADER);
  for (volatile size_t at = HEADER; at <= (size_t)LAST; at += (size_t)PLACE) {
    put(&full[at], begin, PLACE);
    full[at] = at == (size_t)LAST ? begin[0] : (uint8_t)MEASURED_FULL;
    full[at + 4u] = (uint8_t)((at == (size_t)LAST ? next : sequence) & 0xffu);
    full[at + 5u] = (uint8_t)((at == (size_t)LAST ? next : sequence) >> 8);
    full[at + 8u] = message[1];
  }
  full[LAST + 6] = 0;
  full[LAST + 7] = 0;
  answer(full, FULL);
}
#else
static void answer_acknack(const uint8_t * message)
{
  static const uint8_t begin[13] = {0x81, 0, 0, 0, 0x0a, 0x01, 5, 0, 0, 0, 0, 0, 0};
  const uint16_t next = (uint16_t)((message[2] | (uint32_t)message[3] << 8) + 1u);
  uint8_t acknack[sizeof(begin)];

  put(acknack, begin, sizeof(begin));
  acknack[8] = (uint8_t)(next & 0xffu);
  acknack[9] = (uint8_t)(next >> 8);
  acknack[12] = message[1];
  answer(acknack, sizeof(acknack));
}
#endif

static void answer_session(void)
{
  static const uint8_t granted[] = {
    0x81, 0, 0, 0, 0x04, 0x01, 0x0b, 0, 0, 0, 0x58, 0x52, 0x43, 0x45, 0x01, 0x00, 0x01, 0x0f, 0};

  output_sequence[0] = 0;
  output_sequence[1] = 0;
  answer(granted, sizeof(granted));
}

/* Gives a request to the service with this index among all objects of the client: an identity, then `body`. */
static inline void answer_request(uint32_t index, const uint8_t * body, size_t size)
{
  enum { IDENTITY = 24, BEFORE = 12 };
  uint8_t data[ANSWER_SIZE] = {0x81, RELIABLE, 0, 0, 0x09, 0x01, 0, 0};

  data[2] = (uint8_t)(output_sequence[1] & 0xffu);
  data[3] = (uint8_t)(output_sequence[1] >> 8);
  ++output_sequence[1];
  data[6] = (uint8_t)(4u + (size_t)IDENTITY + size);
  put(&data[8], read_ids[index], 4);
  data[BEFORE + IDENTITY - 1] = (uint8_t)output_sequence[1]; /* a new number of the sample */
  put(&data[BEFORE + IDENTITY], body, size);
  answer(data, (size_t)BEFORE + (size_t)IDENTITY + size);
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  (void)host;
  (void)port;
  udp->handle = 1;
  waiting = 0;
  return true;
}

void port_udp_close(port_udp_t * udp)
{
  udp->handle = 0;
}

/* Without a table, whose helper on a Cortex-M0 would count as work of the client. */
__attribute__((optimize("no-jump-tables"))) bool port_udp_send(
  port_udp_t * udp, const uint8_t * data, size_t size)
{
  (void)udp;
  if (data[1] >= RELIABLE) {
    answer_acknack(data);
  }
  for (size_t at = HEADER; at + HEADER <= size;) {
    const uint8_t id = data[at];

    if (id == CREATE_CLIENT) {
      answer_session();
    } else if (id == CREATE || id == DELETE) {
      answer_status(data[1], &data[at + HEADER]);
    } else if (id == READ_DATA) {
      put(read_ids[data[at + HEADER + 3u] >> 4], &data[at + HEADER], 4);
    } else if (id == WRITE_DATA) {
      ++written;
    }
    at = (at + HEADER + (data[at + 2] | (size_t)data[at + 3] << 8) + 3u) & ~(size_t)3u;
  }
  return true;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  int32_t size;

  (void)udp;
  if (waiting == 0 || answers[0].size > capacity) {
    return 0;
  }
  size = (int32_t)answers[0].size;
  put(buffer, answers[0].bytes, answers[0].size);
  --waiting;
  for (volatile size_t i = 0; i < waiting; ++i) {
    put(answers[i].bytes, answers[i + 1u].bytes, answers[i + 1u].size);
    answers[i].size = answers[i + 1u].size;
  }
  return size;
}

enum { SYS_EXIT = 0x18, APPLICATION_EXIT = 0x20026 };

void mark(void);
void finish(void);

/* Not inlined: its address is what the trace looks for. */
__attribute__((noinline)) void mark(void)
{
  __asm volatile("" ::: "memory");
}

/* Ends the emulator (semihosting). */
__attribute__((noinline)) void finish(void)
{
#ifdef __riscv
  register uintptr_t operation __asm__("a0") = SYS_EXIT;
  register uintptr_t reason __asm__("a1") = APPLICATION_EXIT;

  __asm volatile(
    ".option push\n.option norvc\n.balign 16\nslli x0, x0, 0x1f\nebreak\nsrai x0, x0, 7\n.option pop\n"
    :
    : "r"(operation), "r"(reason)
    : "memory");
#else
  register uintptr_t operation __asm__("r0") = SYS_EXIT;
  register uintptr_t reason __asm__("r1") = APPLICATION_EXIT;

  __asm volatile("bkpt 0xab" : : "r"(operation), "r"(reason) : "memory");
#endif
  for (;;) {
  }
}

#endif /* MEASURED_H */
