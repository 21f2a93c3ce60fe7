/* SPDX-License-Identifier: Apache-2.0 */
/* A port whose time and network are in the hands of the test: it speaks lines over standard input and output.
 */
#include "port_fake.h"

#include "microros/port.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUEUE = 64, DATAGRAM = 2048, LINE = 2 * DATAGRAM + 64, INPUT_ON_STACK = 32 };

/* Where the linker puts memory that is not on the stack. */
extern char __data_start;
extern char _end;

typedef struct datagram_t {
  size_t size;
  uint8_t bytes[DATAGRAM];
} datagram_t;

static datagram_t queued[QUEUE];
static size_t queue_first;
static size_t queue_count;
static size_t read_already; /* bytes of the first one, where they are read as such */
static datagram_t group_answer;
static uint32_t fake_now_ms = 0xffffff00u;  /* soon begins again at 0: every test passes the wrap */
static int64_t fake_steady_ms = 5000000123; /* a device that has been on for eight weeks */
static unsigned lock_depth;
static bool lock_used;        /* there is a lock */
static int64_t fake_epoch_ms; /* stands still; 0: not set */
static bool send_fails;
static unsigned send_room = UINT32_MAX; /* messages that the transport still accepts */
static bool open_fails;

static void read_hex(datagram_t * datagram, const char * hex)
{
  unsigned value;

  for (datagram->size = 0; sscanf(&hex[2u * datagram->size], "%2x", &value) == 1; ++datagram->size) {
    datagram->bytes[datagram->size] = (uint8_t)value;
  }
}

static void take_datagram(const char * hex)
{
  if (queue_count == QUEUE) {
    abort();
  }
  read_hex(&queued[(queue_first + queue_count) % QUEUE], hex);
  ++queue_count;
}

static void fake_pass(uint32_t duration_ms)
{
  fake_now_ms += duration_ms;
  fake_steady_ms += (int64_t)duration_ms;
}

bool fake_take_line(const char * line)
{
  if (strncmp(line, "rx ", 3) == 0) {
    take_datagram(&line[3]);
  } else if (strncmp(line, "group ", 6) == 0) {
    read_hex(&group_answer, &line[6]);
  } else if (strncmp(line, "time ", 5) == 0) {
    fake_pass((uint32_t)strtoul(&line[5], NULL, 10));
  } else if (strncmp(line, "epoch ", 6) == 0) {
    fake_epoch_ms = strtoll(&line[6], NULL, 10);
  } else if (strncmp(line, "send_fails ", 11) == 0) {
    send_fails = line[11] == '1';
  } else if (strncmp(line, "send_room ", 10) == 0) {
    send_room = (unsigned)strtoul(&line[10], NULL, 10);
  } else if (strncmp(line, "open_fails ", 11) == 0) {
    open_fails = line[11] == '1';
  } else {
    return false;
  }
  return true;
}

char * fake_read_line(void)
{
  static char line[LINE];

  if (fgets(line, sizeof(line), stdin) == NULL) {
    exit(3);
  }
  line[strcspn(line, "\n")] = '\0';
  return line;
}

uint32_t port_time_ms(void)
{
  return fake_now_ms;
}

int64_t port_time_steady_ns(void)
{
  return fake_steady_ms * 1000000;
}

int64_t port_time_epoch_ns(void)
{
  return fake_epoch_ms * 1000000;
}

void port_lock(void)
{
  ++lock_depth;
  lock_used = true;
}

void port_unlock(void)
{
  if (lock_depth == 0u) {
    abort();
  }
  --lock_depth;
}

void fake_check_lock(void)
{
  if (lock_used && lock_depth == 0u) {
    fprintf(stderr, "the transport is used without the lock\n");
    abort();
  }
}

/* The test acts while the library sleeps, until it says "go". */
void port_sleep_ms(uint32_t duration_ms)
{
  const char * line;

  if (lock_depth > 1u) {
    fprintf(stderr, "the lock is not released\n");
    abort();
  }
  fake_pass(duration_ms);
  printf("sleep %u\n", (unsigned)duration_ms);
  (void)fflush(stdout);
  for (line = fake_read_line(); strcmp(line, "go") != 0; line = fake_read_line()) {
    if (!fake_take_line(line)) {
      exit(4);
    }
  }
}

uint32_t port_unique_id(void)
{
  return 0xfeedbeefu;
}

bool fake_open(const char * host, uint16_t port)
{
  fake_check_lock();
  printf("open %s %u\n", host, (unsigned)port);
  return !open_fails;
}

void fake_close(void)
{
  fake_check_lock();
  queue_count = 0;
  read_already = 0;
  printf("close\n");
}

bool fake_send(const uint8_t * data, size_t size)
{
  fake_check_lock();
  if (send_fails || send_room == 0u) {
    return false;
  }
  --send_room;
  printf("tx ");
  for (size_t i = 0; i < size; ++i) {
    printf("%02x", data[i]);
  }
  printf("\n");
  return true;
}

static void drop_first(void)
{
  queue_first = (queue_first + 1u) % QUEUE;
  --queue_count;
  read_already = 0;
}

/* What comes is not received on the stack, but for a few bytes of a line. */
static void check_buffer(const uint8_t * buffer, size_t capacity)
{
  const uintptr_t at = (uintptr_t)buffer;

  if ((at < (uintptr_t)&__data_start || at >= (uintptr_t)&_end) && capacity > INPUT_ON_STACK) {
    fprintf(stderr, "%zu bytes on the stack are to receive something\n", capacity);
    abort();
  }
}

size_t fake_read(uint8_t * buffer, size_t capacity)
{
  const datagram_t * datagram = &queued[queue_first];
  size_t size;

  check_buffer(buffer, capacity);
  fake_check_lock();
  if (queue_count == 0u) {
    return 0;
  }
  size = datagram->size - read_already < capacity ? datagram->size - read_already : capacity;
  memcpy(buffer, &datagram->bytes[read_already], size);
  read_already += size;
  if (read_already == datagram->size) {
    drop_first();
  }
  return size;
}

size_t fake_group_read(uint8_t * buffer, size_t capacity)
{
  const size_t size = group_answer.size < capacity ? group_answer.size : capacity;

  check_buffer(buffer, capacity);
  memcpy(buffer, group_answer.bytes, size);
  group_answer.size = 0;
  return size;
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  udp->handle = 7;
  return fake_open(host, port);
}

enum { LOCAL = 5555 };

bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local)
{
  if (local != LOCAL) {
    abort();
  }
  return port_udp_open(udp, host, port);
}

uint16_t port_udp_local(const port_udp_t * udp)
{
  return udp->handle == 7 ? LOCAL : 0u;
}

void port_udp_close(port_udp_t * udp)
{
  udp->handle = -1;
  fake_close();
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  (void)udp;
  return fake_send(data, size);
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  (void)udp;
  if (queue_count != 0u && queued[queue_first].size > capacity) {
    drop_first();
    return -1;
  }
  return (int32_t)fake_read(buffer, capacity);
}
