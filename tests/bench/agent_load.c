/* SPDX-License-Identifier: Apache-2.0 */
/* Load for the bench of the agent: one XRCE client over UDP whose session and entities are there already (agent_client.py).
 *
 * agent_load TASK SOCKET ENTITY SIZE COUNT MTU STREAM OUT IN RATE PROGRESS
 *   send     COUNT samples through data writer ENTITY; reliable: as fast as the window of 16 lets, else RATE a second
 *   receive  COUNT samples of the data reader whose READ_DATA is in force; on a reliable stream one ACKNACK for each message
 *   ping     COUNT samples, each sent when the one before came back
 *   loopback COUNT datagrams of SIZE to another process and back: what the machine takes without any agent
 * SOCKET is a connected descriptor, OUT and IN are the next numbers of the reliable or best-effort stream STREAM, PROGRESS is a
 * descriptor that gets a byte for every PROGRESS_STEP samples that were received (-1: none). Samples are std_msgs/msg/String: SIZE
 * bytes of CDR whose text begins with their number. One line of JSON says what was seen.
 */
#define _GNU_SOURCE
#include "agent_load.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum {
  WINDOW = 16,
  MESSAGE_BYTES = 4096,
  RELIABLE = 0x80,
  WRITE_DATA = 0x07,
  DATA = 0x09,
  ACKNACK = 0x0a,
  HEARTBEAT = 0x0b,
  FRAGMENT = 0x0d,
  LAST_FRAGMENT = 0x02,
  HEADER = 4,
  IDS = 4,
  PATIENCE_MS = 100,
  SILENCE_MS = 2000,
  WARM_UP = 200
};

typedef struct {
  uint8_t bytes[MESSAGE_BYTES];
  size_t size;
} message_t;

typedef struct {
  int socket;
  uint16_t entity;
  size_t size;
  uint32_t count;
  size_t mtu;
  uint8_t stream;
  uint16_t out;            /* number of the next message to the agent */
  uint16_t unacknowledged; /* number of the first one that is not acknowledged */
  uint16_t in;             /* number of the next message from the agent */
  uint32_t rate;
  int progress;
  message_t kept[WINDOW];
  uint32_t repeated;
  uint32_t received;
  uint32_t lost;
  bool within_fragments;
  int64_t first_at;
  int64_t last_at;
} client_t;

static client_t client;

static int64_t now_ns(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void fail(const char * what)
{
  perror(what);
  exit(1);
}

static void transmit(const uint8_t * bytes, size_t size)
{
  if (send(client.socket, bytes, size, 0) < 0 && errno != ECONNREFUSED) {
    fail("send");
  }
}

static uint16_t word_at(const uint8_t * bytes)
{
  return (uint16_t)(bytes[0] | bytes[1] << 8);
}

static void put_word(uint8_t * bytes, uint32_t value)
{
  bytes[0] = (uint8_t)(value & 0xFFU);
  bytes[1] = (uint8_t)(value >> 8 & 0xFFU);
}

/* Acknowledge what came in order; `ahead` messages from the next one on are asked for again. */
static void send_acknack(unsigned ahead)
{
  uint8_t message[HEADER + 4 + 5] = {0x81, 0, 0, 0, ACKNACK, 1, 5, 0};
  unsigned missing = ahead >= 16U ? 0xFFFFU : (1U << ahead) - 1U;

  put_word(&message[8], client.in);
  message[10] = (uint8_t)(missing >> 8);
  message[11] = (uint8_t)(missing & 0xFFU);
  message[12] = client.stream;
  transmit(message, sizeof message);
}

static void send_heartbeat(void)
{
  uint8_t message[HEADER + 4 + 5] = {0x81, 0, 0, 0, HEARTBEAT, 1, 5, 0};

  put_word(&message[8], client.unacknowledged);
  put_word(&message[10], (uint32_t)client.out - 1U);
  message[12] = client.stream;
  transmit(message, sizeof message);
}

static void on_acknack(const uint8_t * payload)
{
  uint16_t first = word_at(payload);
  unsigned missing = (unsigned)payload[2] << 8 | payload[3];
  uint16_t waiting = (uint16_t)(client.out - client.unacknowledged);
  uint16_t done = (uint16_t)(first - client.unacknowledged);

  if (payload[4] != client.stream || done > waiting) {
    return;
  }
  client.unacknowledged = first;
  for (uint16_t i = 0; missing != 0U && i < waiting - done; ++i) {
    if ((missing >> i & 1U) != 0U) {
      const message_t * again = &client.kept[(uint16_t)(first + i) % WINDOW];
      transmit(again->bytes, again->size);
      ++client.repeated;
    }
  }
}

/* Count a sample; `body` is the CDR of a String. */
static void on_sample(const uint8_t * body, size_t size)
{
  uint32_t number;

  if (size < AGENT_LOAD_SAMPLE_MINIMUM) {
    return;
  }
  number = agent_load_number(body);
  client.last_at = now_ns();
  if (client.first_at == 0) {
    client.first_at = client.last_at;
  }
  if (number < client.received + client.lost) {
    fprintf(stderr, "agent_load: sample %u came twice or late\n", number);
    exit(1);
  }
  client.lost += number - client.received - client.lost;
  ++client.received;
  if (client.progress >= 0 && client.received % AGENT_LOAD_PROGRESS_STEP == 0U) {
    agent_load_credit(client.progress, 1);
  }
}

static void on_data(const uint8_t * message, size_t at, size_t length)
{
  uint8_t kind = message[at];
  const uint8_t * payload = &message[at + HEADER];

  if (kind == DATA && length > IDS) {
    on_sample(&payload[IDS], length - IDS);
    return;
  }
  if (kind == FRAGMENT) {
    if (!client.within_fragments && length > HEADER + IDS) {
      on_sample(&payload[HEADER + IDS], length - HEADER - IDS);
    }
    client.within_fragments = (message[at + 1] & LAST_FRAGMENT) == 0;
  }
}

/* Return whether the submessages of a message are to be looked at: it is the next one, or comes on no reliable stream. */
static bool in_order(const uint8_t * message)
{
  uint16_t ahead = (uint16_t)(word_at(&message[2]) - client.in);

  if (message[1] != client.stream || client.stream < RELIABLE) {
    return true;
  }
  if (ahead == 0U) {
    ++client.in;
  }
  send_acknack(ahead > 0U && ahead < WINDOW ? ahead + 1U : 0U);
  return ahead == 0U;
}

static void on_message(const uint8_t * message, size_t size)
{
  size_t at = HEADER;

  if (size < HEADER || !in_order(message)) {
    return;
  }
  while (at + HEADER <= size) {
    size_t length = word_at(&message[at + 2]);
    if (at + HEADER + length > size) {
      return;
    }
    if (message[at] == ACKNACK && length == 5U) {
      on_acknack(&message[at + HEADER]);
    } else if (message[at] == HEARTBEAT && length == 5U) {
      uint16_t behind = (uint16_t)(word_at(&message[at + HEADER + 2]) + 1U - client.in);
      send_acknack(behind <= WINDOW ? behind : 0U);
    } else {
      on_data(message, at, length);
    }
    at += HEADER + length;
    at = (at + 3U) & ~(size_t)3U;
  }
}

/* Take the available datagrams, waiting for the first one at most `wait_ms`; return whether there was any. */
static bool take_input(int wait_ms)
{
  static uint8_t message[65536];
  struct pollfd watched = {.fd = client.socket, .events = POLLIN, .revents = 0};
  bool any = false;

  for (;;) {
    ssize_t size = recv(client.socket, message, sizeof message, MSG_DONTWAIT);
    if (size >= 0) {
      on_message(message, (size_t)size);
      any = true;
    } else if (errno == EAGAIN && !any && wait_ms > 0) {
      if (poll(&watched, 1, wait_ms) <= 0) {
        return false;
      }
    } else if (errno == EAGAIN) {
      return any;
    } else if (errno != ECONNREFUSED) {
      fail("recv");
    }
  }
}

/* Number and send one message with a complete submessage. */
static void send_message(const uint8_t * submessage, size_t size)
{
  message_t * message = &client.kept[client.out % WINDOW];
  int silent_ms = 0;

  while (client.stream >= RELIABLE && (uint16_t)(client.out - client.unacknowledged) >= WINDOW) {
    if (!take_input(PATIENCE_MS)) {
      silent_ms += PATIENCE_MS;
      if (silent_ms > SILENCE_MS) {
        fprintf(stderr, "agent_load: no acknowledgement\n");
        exit(1);
      }
      send_heartbeat();
    }
  }
  message->bytes[0] = 0x81;
  message->bytes[1] = client.stream;
  put_word(&message->bytes[2], client.out);
  memcpy(&message->bytes[HEADER], submessage, size);
  message->size = HEADER + size;
  ++client.out;
  transmit(message->bytes, message->size);
}

/* Send sample `number`, in fragments when it does not fit a message. */
static void send_sample(uint32_t number)
{
  static uint8_t submessage[MESSAGE_BYTES] = {WRITE_DATA, 1};
  static uint8_t piece[MESSAGE_BYTES] = {FRAGMENT};
  size_t size = HEADER + IDS + client.size;
  size_t room = (client.mtu - HEADER - HEADER) & ~(size_t)3U;

  put_word(&submessage[2], (uint32_t)(IDS + client.size));
  submessage[4] = 0x01;
  submessage[6] = (uint8_t)(client.entity >> 8);
  submessage[7] = (uint8_t)(client.entity & 0xFFU);
  agent_load_fill(&submessage[HEADER + IDS], client.size, number);
  if (size <= client.mtu - HEADER) {
    send_message(submessage, size);
    return;
  }
  for (size_t at = 0; at < size; at += room) {
    size_t part = size - at < room ? size - at : room;
    piece[1] = (uint8_t)(at + part == size ? 1U | LAST_FRAGMENT : 1U);
    put_word(&piece[2], (uint32_t)part);
    memcpy(&piece[HEADER], &submessage[at], part);
    send_message(piece, HEADER + part);
  }
}

static void send_all(void)
{
  int64_t start = now_ns();

  for (uint32_t i = 0; i < client.count; ++i) {
    send_sample(i);
    if (client.rate > 0U) {
      agent_load_wait_until(start + ((int64_t)i + 1) * 1000000000 / client.rate);
    }
    (void)take_input(0);
  }
  for (int i = 0; client.stream >= RELIABLE && client.unacknowledged != client.out; ++i) {
    if (!take_input(PATIENCE_MS)) {
      send_heartbeat();
    }
    if (i > 100000) {
      fail("the last acknowledgement");
    }
  }
  printf(
    "{\"samples\": %u, \"seconds\": %.6f, \"repeated\": %u}\n", client.count,
    (double)(now_ns() - start) / 1e9, client.repeated);
}

static void receive_all(void)
{
  if (client.progress >= 0) {
    agent_load_credit(client.progress, AGENT_LOAD_CREDITS);
  }
  (void)take_input(5 * SILENCE_MS);
  while (client.received + client.lost < client.count && take_input(SILENCE_MS)) {
  }
  printf(
    "{\"samples\": %u, \"lost\": %u, \"seconds\": %.6f}\n", client.received, client.count - client.received,
    (double)(client.last_at - client.first_at) / 1e9);
}

static int by_size(const void * a, const void * b)
{
  int64_t left = *(const int64_t *)a;
  int64_t right = *(const int64_t *)b;

  return (left > right) - (left < right);
}

static void print_times(int64_t * times, size_t count, uint32_t lost)
{
  qsort(times, count, sizeof *times, by_size);
  printf(
    "{\"samples\": %zu, \"lost\": %u, \"median_us\": %.2f, \"p99_us\": %.2f}\n", count, lost,
    (double)times[count / 2U] / 1e3, (double)times[count * 99U / 100U] / 1e3);
}

static void ping(void)
{
  int64_t * times = calloc((size_t)client.count + 1U, sizeof *times);
  size_t done = 0;

  if (times == NULL) {
    fail("calloc");
  }
  for (uint32_t i = 0; i < client.count + WARM_UP; ++i) {
    int64_t start = now_ns();
    bool heard = true;
    send_sample(i);
    while (client.received + client.lost <= i && heard) {
      heard = take_input(SILENCE_MS);
    }
    if (i >= WARM_UP && client.received + client.lost == i + 1U) {
      times[done] = now_ns() - start;
      ++done;
    }
  }
  print_times(times, done, client.lost);
  free(times);
}

static void echo(int socket_)
{
  static uint8_t datagram[MESSAGE_BYTES];

  for (;;) {
    ssize_t size = recv(socket_, datagram, sizeof datagram, 0);
    if (size <= 0 || send(socket_, datagram, (size_t)size, 0) < 0) {
      _exit(0);
    }
  }
}

/* Two UDP sockets of 127.0.0.1, connected to each other. */
static void connect_pair(int pair[2])
{
  struct sockaddr_in place[2];
  socklen_t size = sizeof place[0];

  for (int i = 0; i < 2; ++i) {
    memset(&place[i], 0, sizeof place[i]);
    place[i].sin_family = AF_INET;
    place[i].sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    pair[i] = socket(AF_INET, SOCK_DGRAM, 0);
    if (
      pair[i] < 0 || bind(pair[i], (const struct sockaddr *)&place[i], size) != 0 ||
      getsockname(pair[i], (struct sockaddr *)&place[i], &size) != 0) {
      fail("socket");
    }
  }
  for (int i = 0; i < 2; ++i) {
    if (connect(pair[i], (const struct sockaddr *)&place[1 - i], size) != 0) {
      fail("connect");
    }
  }
}

static void loopback(void)
{
  int pair[2];
  uint8_t datagram[MESSAGE_BYTES] = {0};
  int64_t * times = calloc((size_t)client.count + 1U, sizeof *times);
  pid_t child;

  connect_pair(pair);
  child = fork();
  if (child < 0 || times == NULL) {
    fail("loopback");
  }
  if (child == 0) {
    echo(pair[1]);
  }
  for (uint32_t i = 0; i < client.count; ++i) {
    int64_t start = now_ns();
    if (
      send(pair[0], datagram, client.size, 0) < 0 ||
      recv(pair[0], datagram, sizeof datagram, 0) != (ssize_t)client.size) {
      fail("loopback");
    }
    times[i] = now_ns() - start;
  }
  (void)kill(child, SIGTERM);
  (void)waitpid(child, NULL, 0);
  print_times(times, client.count, 0);
  free(times);
}

static unsigned long number_of(const char * text)
{
  char * end = NULL;
  unsigned long value = strtoul(text, &end, 0);

  if (end == text || *end != '\0') {
    fprintf(stderr, "agent_load: '%s' is not a number\n", text);
    exit(2);
  }
  return value;
}

int main(int argc, char ** argv)
{
  if (argc != 12) {
    fprintf(stderr, "usage: agent_load TASK SOCKET ENTITY SIZE COUNT MTU STREAM OUT IN RATE PROGRESS\n");
    return 2;
  }
  client.socket = (int)number_of(argv[2]);
  client.entity = (uint16_t)number_of(argv[3]);
  client.size = number_of(argv[4]);
  client.count = (uint32_t)number_of(argv[5]);
  client.mtu = number_of(argv[6]);
  client.stream = (uint8_t)number_of(argv[7]);
  client.out = (uint16_t)number_of(argv[8]);
  client.unacknowledged = client.out;
  client.in = (uint16_t)number_of(argv[9]);
  client.rate = (uint32_t)number_of(argv[10]);
  client.progress = atoi(argv[11]);
  if (
    client.size < AGENT_LOAD_SAMPLE_MINIMUM || client.mtu > MESSAGE_BYTES ||
    client.size > MESSAGE_BYTES - HEADER - HEADER - IDS || client.mtu < 64U) {
    fprintf(stderr, "agent_load: sizes are from %d to %d\n", AGENT_LOAD_SAMPLE_MINIMUM, MESSAGE_BYTES - 12);
    return 2;
  }
  (void)prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  if (strcmp(argv[1], "send") == 0) {
    send_all();
  } else if (strcmp(argv[1], "receive") == 0) {
    receive_all();
  } else if (strcmp(argv[1], "ping") == 0) {
    ping();
  } else if (strcmp(argv[1], "loopback") == 0) {
    loopback();
  } else {
    fprintf(stderr, "agent_load: unknown task '%s'\n", argv[1]);
    return 2;
  }
  return 0;
}
