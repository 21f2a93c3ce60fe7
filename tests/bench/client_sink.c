/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The agent's side for the bench of the client, over UDP on loopback: grants sessions and entities, acknowledges reliable
 * messages, and returns each sample through the reader that asked last (how many it wants is not looked at). One thread, no DDS:
 * what is measured is the client.
 *
 * client_sink
 * Prints `port N`; a datagram `?` is answered with `bytes datagrams samples` since the last one, in text. A datagram of one digit says
 * that from now on each N-th reliable message is acknowledged; the remaining ones after a millisecond without input.
 */
#include <arpa/inet.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>

enum {
  CREATE_CLIENT = 0x00,
  CREATE = 0x01,
  DELETE = 0x03,
  WRITE_DATA = 0x07,
  READ_DATA = 0x08,
  DATA = 0x09,
  ACKNACK = 0x0a,
  HEARTBEAT = 0x0b,
  FRAGMENT = 0x0d,
  BEST_EFFORT = 0x01,
  RELIABLE = 0x80,
  HEADER = 4,
  IDS = 4,
  DATAGRAM = 2048
};

static int descriptor;
static struct sockaddr_in client;
static uint16_t sent[256];  /* next number of each stream to the client */
static uint16_t awaited;    /* next number of the client's reliable stream */
static uint8_t reader[IDS]; /* request and object of the last READ_DATA */
static uint8_t reader_stream;
static unsigned acknowledge_each = 1;
static unsigned unacknowledged;
static unsigned long long bytes;
static unsigned long long datagrams;
static unsigned long long samples;

static void reply(const uint8_t * message, size_t size)
{
  (void)sendto(descriptor, message, size, 0, (const struct sockaddr *)&client, sizeof(client));
}

/* Begins a message of one submessage; returns where its payload goes. */
static uint8_t * begin(uint8_t * message, uint8_t stream, uint8_t id, size_t payload)
{
  message[0] = 0x81;
  message[1] = stream;
  message[2] = (uint8_t)(sent[stream] & 0xffu);
  message[3] = (uint8_t)(sent[stream] >> 8);
  sent[stream] = stream == 0 ? 0 : (uint16_t)(sent[stream] + 1u);
  message[4] = id;
  message[5] = 0x01;
  message[6] = (uint8_t)(payload & 0xffu);
  message[7] = (uint8_t)(payload >> 8);
  return &message[2 * HEADER];
}

static void grant_session(void)
{
  static const uint8_t granted[11] = {0, 0, 0, 0x58, 0x52, 0x43, 0x45, 0x01, 0x00, 0x01, 0x0f};
  uint8_t message[2 * HEADER + 11];

  (void)memset(sent, 0, sizeof(sent));
  awaited = 0;
  reader_stream = 0;
  (void)memcpy(begin(message, 0, 0x04, sizeof(granted)), granted, sizeof(granted));
  reply(message, sizeof(message));
}

static void grant_entity(uint8_t stream, const uint8_t * ids)
{
  uint8_t message[2 * HEADER + IDS + 2] = {0};

  (void)memcpy(begin(message, stream >= RELIABLE ? RELIABLE : BEST_EFFORT, 0x05, IDS + 2), ids, (size_t)IDS);
  reply(message, sizeof(message));
}

static void acknowledge(void)
{
  uint8_t message[2 * HEADER + 5] = {0};
  uint8_t * payload = begin(message, 0, ACKNACK, 5);

  payload[0] = (uint8_t)(awaited & 0xffu);
  payload[1] = (uint8_t)(awaited >> 8);
  payload[4] = RELIABLE;
  reply(message, sizeof(message));
  unacknowledged = 0;
}

static void give_back(const uint8_t * sample, size_t size)
{
  uint8_t message[DATAGRAM];
  uint8_t * payload;

  if (reader_stream == 0 || size + 2u * HEADER + IDS > sizeof(message)) {
    return;
  }
  payload = begin(message, reader_stream, DATA, IDS + size);
  (void)memcpy(payload, reader, IDS);
  (void)memcpy(&payload[IDS], sample, size);
  reply(message, 2u * HEADER + IDS + size);
}

static void take(uint8_t stream, uint8_t id, const uint8_t * payload, size_t size)
{
  if (id == CREATE_CLIENT) {
    grant_session();
  } else if (id == CREATE || id == DELETE) {
    grant_entity(stream, payload);
  } else if (id == READ_DATA && size > IDS) {
    (void)memcpy(reader, payload, IDS);
    reader_stream = payload[IDS];
  } else if (id == WRITE_DATA && size > IDS) {
    ++samples;
    give_back(&payload[IDS], size - IDS);
  } else if (id == HEARTBEAT) {
    acknowledge();
  }
}

static void take_message(const uint8_t * message, size_t size)
{
  const uint8_t stream = message[1];
  /* A session is opened without a key in the header (session 0x80 and below has one). */
  const size_t header = message[0] < 0x80u ? 2u * HEADER : HEADER;

  if (stream >= RELIABLE) {
    const uint16_t number = (uint16_t)(message[2] | message[3] << 8);

    if (number != awaited) {
      acknowledge();
      return;
    }
    ++awaited;
  }
  for (size_t at = header; at + HEADER <= size;) {
    const size_t payload = message[at + 2u] | (size_t)message[at + 3u] << 8;

    if (at + HEADER + payload > size) {
      break;
    }
    take(stream, message[at], &message[at + HEADER], payload);
    at = (at + HEADER + payload + 3u) & ~(size_t)3u;
  }
  if (stream >= RELIABLE && ++unacknowledged >= acknowledge_each) {
    acknowledge();
  }
}

static void tell(void)
{
  char text[96];
  const int size = snprintf(text, sizeof(text), "%llu %llu %llu", bytes, datagrams, samples);

  reply((const uint8_t *)text, (size_t)size);
  bytes = 0;
  datagrams = 0;
  samples = 0;
}

int main(void)
{
  struct sockaddr_in here = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
  socklen_t length = sizeof(here);
  const struct timeval patience = {0, 1000};
  static uint8_t message[65536];

  descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  if (
    descriptor < 0 || bind(descriptor, (const struct sockaddr *)&here, sizeof(here)) != 0 ||
    getsockname(descriptor, (struct sockaddr *)&here, &length) != 0) {
    perror("client_sink");
    return 1;
  }
  (void)setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  (void)printf("port %u\n", (unsigned)ntohs(here.sin_port));
  (void)fflush(stdout);
  for (;;) {
    struct sockaddr_in asker;
    socklen_t from = sizeof(asker);
    const ssize_t size = recvfrom(descriptor, message, sizeof(message), 0, (struct sockaddr *)&asker, &from);

    client = size > 0 ? asker : client;

    if (size == 1 && message[0] == '?') {
      tell();
    } else if (size == 1) {
      acknowledge_each = message[0] - (unsigned)'0';
    } else if (size < 0 && unacknowledged != 0u) {
      acknowledge();
    } else if (size >= HEADER) {
      bytes += (unsigned long long)size;
      ++datagrams;
      take_message(message, (size_t)size);
    }
  }
}
