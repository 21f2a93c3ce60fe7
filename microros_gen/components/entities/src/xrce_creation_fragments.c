/* SPDX-License-Identifier: Apache-2.0 */
/*
 * creation: reliable, where a CREATE may be larger than the transport's messages. Such a request is sent as fragments
 * (OMG DDS-XRCE 1.0, 8.3.5.14) with the sequence numbers after the last acknowledged one. A repetition has the same
 * numbers and bytes, so the agent executes the request once, and what it lacks is filled in. The stream holds
 * back the application's messages until STATUS arrives.
 */
#include "microros/xrce_client.h"
#include "microros/xrce_creation_stream.h"
#include "microros/xrce_wire.h"

#include <string.h>

enum {
  FRAGMENT_HEADER = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER,
  FRAGMENT_SIZE = MICROROS_MTU - FRAGMENT_HEADER,
  WHOLE_SIZE = MICROROS_MTU - XRCE_MESSAGE_HEADER
};

uint8_t * xrce_creation_room(xrce_client_t * client)
{
  return &client->creation[FRAGMENT_HEADER];
}

/* Sends one fragment; its header overwrites what precedes it in the buffer, which is restored. */
static void creation_send_fragment(
  xrce_session_t * session, uint8_t * fragment, uint16_t sequence, size_t size, bool last)
{
  const uint8_t flags = last ? XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_LAST_FRAGMENT : XRCE_FLAG_LITTLE_ENDIAN;
  uint8_t kept[FRAGMENT_HEADER];

  (void)memcpy(kept, fragment, sizeof(kept));
  xrce_put_header(fragment, XRCE_SESSION_ID, XRCE_STREAM_RELIABLE, sequence);
  xrce_put_submessage(&fragment[XRCE_MESSAGE_HEADER], XRCE_FRAGMENT, flags, (uint16_t)size);
  (void)xrce_session_send(session, fragment, FRAGMENT_HEADER + size);
  (void)memcpy(fragment, kept, sizeof(kept));
}

/* Sends the request and returns how many numbers it takes from `sequence` on. */
static uint16_t creation_send_request(xrce_client_t * client, uint16_t sequence, size_t size)
{
  uint16_t count = 0;
  size_t at = 0;

  if (size <= WHOLE_SIZE) {
    uint8_t * message = &client->creation[FRAGMENT_HEADER - XRCE_MESSAGE_HEADER];

    xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_RELIABLE, sequence);
    (void)xrce_session_send(&client->session, message, XRCE_MESSAGE_HEADER + size);
    return 1;
  }
  while (at < size) {
    const size_t part = size - at < FRAGMENT_SIZE ? size - at : FRAGMENT_SIZE;

    creation_send_fragment(
      &client->session, &client->creation[at], (uint16_t)(sequence + count), part, at + part == size);
    at += part;
    ++count;
  }
  return count;
}

void xrce_creation_send(xrce_client_t * client, size_t size)
{
  const uint16_t first = client->reliable.first;
  uint16_t count = 0;

  if (first == 0u) {
    /* Ends a partial message of the previous session, which some agents would continue. */
    uint8_t ending[FRAGMENT_HEADER] = {0};

    creation_send_fragment(&client->session, ending, first, 0, true);
    count = 1;
  }
  count = (uint16_t)(count + creation_send_request(client, (uint16_t)(first + count), size));
  client->creation_numbers = count;
}

void xrce_creation_end(xrce_client_t * client)
{
  client->reliable.first = (uint16_t)(client->reliable.first + client->creation_numbers);
}
