/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages that were sent and are not written yet, one after the other, each after two bytes with its size. Only the task
 * of the session removes some, and nobody touches the oldest one while that task writes it without the lock.
 */
#include "microros/lock.h"
#include "microros/xrce_client.h"
#include "microros/xrce_turn.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

#include <string.h>

enum { OUTBOX_SIZE_BYTES = 2, OUTBOX_STREAM_AT = OUTBOX_SIZE_BYTES + 1 };

static struct {
  size_t used; /* bytes */
  bool is_writing;
  uint8_t messages[MICROROS_OUTBOX_SIZE];
} outbox;

static size_t outbox_oldest(void)
{
  return xrce_get_le16(outbox.messages);
}

static void outbox_remove(void)
{
  const size_t size = (size_t)OUTBOX_SIZE_BYTES + outbox_oldest();

  outbox.used -= size;
  /* at most MICROROS_OUTBOX_SIZE bytes */
  (void)memmove(outbox.messages, &outbox.messages[size], outbox.used);
}

static bool outbox_put(const uint8_t * message, size_t size)
{
  const bool fits =
    size <= UINT16_MAX && (size_t)OUTBOX_SIZE_BYTES + size <= sizeof(outbox.messages) - outbox.used;

  if (fits) {
    xrce_put_le16(&outbox.messages[outbox.used], (uint16_t)size);
    /* at most MICROROS_OUTBOX_SIZE bytes */
    (void)memcpy(&outbox.messages[outbox.used + (size_t)OUTBOX_SIZE_BYTES], message, size);
    outbox.used += (size_t)OUTBOX_SIZE_BYTES + size;
  }
  return fits;
}

bool xrce_turn_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_turn_is_taken() ? outbox_put(message, size) : xrce_transport_send(transport, message, size);
}

bool xrce_turn_is_sent(void)
{
  return outbox.used == 0u;
}

/* The session repeats the others. */
static bool outbox_oldest_is_lost(void)
{
  return outbox.messages[OUTBOX_STREAM_AT] == (uint8_t)XRCE_STREAM_BEST_EFFORT &&
         outbox.messages[(size_t)OUTBOX_SIZE_BYTES + (size_t)XRCE_MESSAGE_HEADER] == (uint8_t)XRCE_WRITE_DATA;
}

uint32_t xrce_turn_close(void)
{
  uint32_t dropped = 0;

  while (outbox.is_writing) { /* by the task of the session, so the caller is another one */
    microros_pause();
  }
  while (outbox.used != 0u) {
    dropped += outbox_oldest_is_lost() ? 1u : 0u;
    outbox_remove();
  }
  return dropped;
}

bool xrce_turn_write(xrce_client_t * client)
{
  xrce_transport_t * transport = &client->session.transport;
  size_t size = 0;
  bool is_written = false;

  microros_lock();
  if (client->session.transport_open && outbox.used != 0u) {
    size = outbox_oldest();
    outbox.is_writing = true;
  }
  microros_unlock();
  if (size != 0u) {
    is_written = xrce_transport_send(transport, &outbox.messages[OUTBOX_SIZE_BYTES], size);
    microros_lock();
    outbox.is_writing = false;
    if (is_written) {
      outbox_remove();
    }
    microros_unlock();
  }
  return is_written;
}
