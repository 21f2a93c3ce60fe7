/* SPDX-License-Identifier: Apache-2.0 */
/* Early messages wait in slots. */
#include "microros/xrce_stream_reliable_input.h"

#include <string.h>

/* Returns the slot of the message with this number; XRCE_RELIABLE_INPUT_HELD if it is not stored. */
static uint8_t input_slot(const xrce_stream_reliable_input_t * stream, uint16_t sequence)
{
  uint8_t slot = 0;

  /* at most XRCE_RELIABLE_INPUT_HELD rounds */
  while (slot < XRCE_RELIABLE_INPUT_HELD &&
         (stream->size[slot] == 0u || stream->sequence[slot] != sequence)) {
    ++slot;
  }
  return slot;
}

void xrce_stream_reliable_input_keep(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, const uint8_t * message, size_t size)
{
  uint8_t slot = 0;

  /* at most XRCE_RELIABLE_INPUT_HELD rounds */
  while (slot < XRCE_RELIABLE_INPUT_HELD && stream->size[slot] != 0u) {
    ++slot;
  }
  if (
    slot == XRCE_RELIABLE_INPUT_HELD || size > MICROROS_RELIABLE_INPUT_SLOT_SIZE ||
    input_slot(stream, sequence) != XRCE_RELIABLE_INPUT_HELD) {
    return;
  }
  /* at most MICROROS_RELIABLE_INPUT_SLOT_SIZE bytes */
  (void)memcpy(stream->message[slot], message, size);
  stream->size[slot] = (uint16_t)size;
  stream->sequence[slot] = sequence;
}

const uint8_t * xrce_stream_reliable_input_kept(
  xrce_stream_reliable_input_t * stream, uint16_t sequence, size_t * size)
{
  const uint8_t slot = input_slot(stream, sequence);

  if (slot == XRCE_RELIABLE_INPUT_HELD) {
    return NULL;
  }
  *size = stream->size[slot];
  stream->size[slot] = 0;
  return stream->message[slot];
}

uint16_t xrce_stream_reliable_input_map(const xrce_stream_reliable_input_t * stream)
{
  uint32_t map = 0;

  for (uint32_t slot = 0; slot < XRCE_RELIABLE_INPUT_HELD; ++slot) {
    if (stream->size[slot] != 0u) {
      map |= (uint32_t)1u << ((uint32_t)(stream->sequence[slot] - stream->next) & 0x0fu);
    }
  }
  return (uint16_t)map;
}
