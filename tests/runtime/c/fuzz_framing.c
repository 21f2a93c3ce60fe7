/* SPDX-License-Identifier: Apache-2.0 */
/* For libFuzzer: whatever came before on the line, a whole frame after it arrives, with the bytes that were sent. */
#include "microros/xrce_framing.h"

#include <stdlib.h>
#include <string.h>

struct xrce_transport_t {
  uint8_t bytes[16384];
  size_t size;
  size_t used;
  size_t piece;
};

static struct xrce_transport_t line;

int LLVMFuzzerTestOneInput(const uint8_t * data, size_t size);

size_t xrce_line_room(struct xrce_transport_t * to)
{
  return sizeof(to->bytes) - to->size;
}

bool xrce_line_write(struct xrce_transport_t * to, const uint8_t * data, size_t size)
{
  memcpy(&to->bytes[to->size], data, size);
  to->size += size;
  return true;
}

size_t xrce_line_read(struct xrce_transport_t * from, uint8_t * buffer, size_t capacity)
{
  size_t size = from->size - from->used;

  size = size < from->piece ? size : from->piece;
  size = size < capacity ? size : capacity;
  memcpy(buffer, &from->bytes[from->used], size);
  from->used += size;
  return size;
}

/* Takes all messages; returns the size of the last one. */
static size_t take_all(xrce_framing_t * framing, uint8_t * buffer, size_t capacity)
{
  size_t last = 0;

  while (line.used < line.size || framing->used < framing->held) {
    const int32_t got = xrce_framing_receive(framing, &line, buffer, capacity);

    if (got > 0) {
      last = (size_t)got;
      if (last > capacity) {
        abort();
      }
    }
  }
  return last;
}

int LLVMFuzzerTestOneInput(const uint8_t * data, size_t size)
{
  xrce_framing_t framing;
  size_t capacity;
  size_t length;
  uint8_t * buffer;

  if (size < 3u || size > 4000u) {
    return 0;
  }
  capacity = 1u + data[0];
  length = 1u + data[2] % capacity;
  length = length < size - 2u ? length : size - 2u;
  buffer = malloc(capacity);
  memset(&framing, 0, sizeof(framing));
  memset(&line, 0, sizeof(line));
  line.piece = 1u + data[1] % 40u;
  memcpy(line.bytes, data, size);
  line.size = size;
  (void)take_all(&framing, buffer, capacity);
  if (!xrce_framing_send(&line, &data[2], length)) {
    abort();
  }
  line.bytes[line.used + 1u] = 0; /* as the agent sends it: from address 0 to 1 */
  line.bytes[line.used + 2u] = 1;
  if (take_all(&framing, buffer, capacity) != length || memcmp(buffer, &data[2], length) != 0) {
    abort();
  }
  free(buffer);
  return 0;
}
