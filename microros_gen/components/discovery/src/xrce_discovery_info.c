/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_discovery.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* Before the members of INFO: the headers, request and object, two bytes of status. */
enum { RESULT_SIZE = 6, CONFIG_SIZE = 9 /* kind, "XRCE", version, vendor */, REQUEST_DISCOVERY = 9 };

/* Kinds of locators; numbers in them are aligned to their size from the start of the payload. */
enum { LOCATOR_SMALL = 0, LOCATOR_MEDIUM = 1, LOCATOR_LARGE = 2 };

typedef struct reader_t {
  const uint8_t * payload;
  size_t size;
  size_t at;
  uint8_t flags;
  bool ended; /* a read passed the end; all further values are 0 */
} reader_t;

static const uint8_t * reader_take(reader_t * reader, size_t size, size_t alignment)
{
  static const uint8_t nothing[4] = {0};
  const size_t begin = (reader->at + alignment - 1u) & ~(alignment - 1u);

  if (reader->ended || begin > reader->size || size > reader->size - begin) {
    reader->ended = true;
    return nothing;
  }
  reader->at = begin + size;
  return &reader->payload[begin];
}

static uint32_t reader_take_u32(reader_t * reader)
{
  const uint8_t * at = reader_take(reader, 4, 4);
  const uint32_t first = xrce_get_u16(at, reader->flags);
  const uint32_t second = xrce_get_u16(&at[2], reader->flags);

  return (reader->flags & XRCE_FLAG_LITTLE_ENDIAN) != 0u ? first | (second << 16) : second | (first << 16);
}

static bool reader_take_flag(reader_t * reader)
{
  return *reader_take(reader, 1, 1) != 0u;
}

static void reader_skip_string(reader_t * reader)
{
  (void)reader_take(reader, reader_take_u32(reader), 1);
}

static void reader_skip_properties(reader_t * reader)
{
  for (uint32_t left = reader_take_u32(reader); left != 0u && !reader->ended; --left) {
    reader_skip_string(reader);
    reader_skip_string(reader);
  }
}

/* Adds a new locator if there is room. */
static void discovery_add(xrce_discovery_t * discovery, const uint8_t * address, uint16_t port, bool first)
{
  xrce_place_t * place = &discovery->places[discovery->count];

  for (uint8_t i = 0; i < discovery->count; ++i) {
    if (
      discovery->places[i].port == port &&
      memcmp(discovery->places[i].address, address, PORT_MULTICAST_ADDRESS) == 0) {
      return;
    }
  }
  if (discovery->count == XRCE_DISCOVERY_PLACES || port == 0u) {
    return;
  }
  if (first) {
    *place = discovery->places[discovery->next];
    place = &discovery->places[discovery->next];
  }
  (void)memcpy(place->address, address, PORT_MULTICAST_ADDRESS);
  place->port = port;
  ++discovery->count;
}

/* Returns the port of a locator that was read; 0: none was. */
static uint16_t discovery_take_locator(
  xrce_discovery_t * discovery, reader_t * reader, const uint8_t * sender)
{
  uint16_t port = 0;

  switch (*reader_take(reader, 1, 1)) {
    case LOCATOR_SMALL:
      (void)reader_take(reader, 3, 1);
      break;
    case LOCATOR_MEDIUM: {
      const uint8_t * address = reader_take(reader, PORT_MULTICAST_ADDRESS, 1);
      const uint8_t * at = reader_take(reader, 2, 2);

      if (!reader->ended) {
        port = xrce_get_u16(at, reader->flags);
        discovery_add(discovery, address, port, memcmp(address, sender, PORT_MULTICAST_ADDRESS) == 0);
      }
      break;
    }
    case LOCATOR_LARGE:
      (void)reader_take(reader, 16, 1);
      (void)reader_take_u32(reader);
      break;
    default:
      reader_skip_string(reader);
      break;
  }
  return port;
}

void xrce_discovery_on_info(
  xrce_discovery_t * discovery, const uint8_t * message, size_t size, const uint8_t * sender)
{
  reader_t reader = {&message[8], 0, RESULT_SIZE, 0, false};
  uint16_t port = 0;

  if (
    size < 8u + RESULT_SIZE || message[0] != XRCE_SESSION_NONE || message[4] != XRCE_INFO ||
    xrce_get_be16(&message[8]) != REQUEST_DISCOVERY) {
    return;
  }
  reader.size = size - 8u;
  reader.flags = message[5];
  if (reader_take_flag(&reader)) {
    (void)reader_take(&reader, CONFIG_SIZE, 1);
    if (reader_take_flag(&reader)) {
      reader_skip_properties(&reader);
    }
  }
  if (!reader_take_flag(&reader)) {
    return;
  }
  (void)reader_take(&reader, 1, 1); /* the kind of object: an agent */
  (void)reader_take(&reader, 2, 2); /* whether it is available */
  for (uint32_t left = reader_take_u32(&reader); left != 0u && !reader.ended; --left) {
    const uint16_t taken = discovery_take_locator(discovery, &reader, sender);

    port = taken != 0u ? taken : port;
  }
  if (reader.ended) { /* the most reachable locator may have been truncated */
    discovery_add(discovery, sender, port, true);
  }
}

void xrce_discovery_write_request(uint8_t * message)
{
  enum { MASK_CONFIG_AND_ACTIVITY = 3 };

  xrce_put_header(message, XRCE_SESSION_NONE, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_GET_INFO, XRCE_FLAG_LITTLE_ENDIAN, XRCE_DISCOVERY_REQUEST - 8);
  xrce_put_be16(&message[8], REQUEST_DISCOVERY);
  xrce_put_be16(&message[10], XRCE_OBJECT_AGENT);
  xrce_put_le16(&message[12], MASK_CONFIG_AND_ACTIVITY);
  xrce_put_le16(&message[14], 0);
}
