/* SPDX-License-Identifier: Apache-2.0 */
/* Frames produced byte by byte: the line's interrupt frames a message in place. */
#include "microros/xrce_framing_kept.h"

/* Chunk size for copying a frame to the line. */
enum { CHUNK = 16 };

void xrce_frame_begin(xrce_frame_t * frame, const uint8_t * message, uint16_t size)
{
  frame->message = message;
  frame->at = 0;
  frame->size = size;
  frame->crc = 0;
  frame->stuffed = 0;
}

/* Returns the unstuffed byte at position `at` after the flag. */
static uint8_t frame_byte(xrce_frame_t * frame, uint32_t at)
{
  if (at < XRCE_FRAME_HEADER) {
    const uint8_t header[XRCE_FRAME_HEADER] = {
      XRCE_FRAME_ADDRESS_CLIENT, XRCE_FRAME_ADDRESS_AGENT, (uint8_t)((uint32_t)frame->size & 0xffu),
      (uint8_t)((uint32_t)frame->size >> 8)};

    return header[at];
  }
  at -= XRCE_FRAME_HEADER;
  if (at < frame->size) {
    frame->crc = xrce_framing_crc(frame->crc, frame->message[at]);
    return frame->message[at];
  }
  return (uint8_t)((uint32_t)frame->crc >> (8u * (at - frame->size)) & 0xffu);
}

int32_t xrce_frame_next(void * context)
{
  xrce_frame_t * frame = (xrce_frame_t *)context;
  const uint32_t at = frame->at;
  uint8_t byte = frame->stuffed;

  frame->stuffed = 0;
  if (byte != 0u) {
    return byte;
  }
  if (at > (uint32_t)frame->size + XRCE_FRAME_HEADER + XRCE_FRAME_CRC) {
    return -1;
  }
  frame->at = at + 1u;
  if (at == 0u) {
    return XRCE_FRAME_FLAG;
  }
  byte = frame_byte(frame, at - 1u);
  if (byte == XRCE_FRAME_FLAG || byte == XRCE_FRAME_ESCAPE) {
    frame->stuffed = byte ^ XRCE_FRAME_FLIP;
    return XRCE_FRAME_ESCAPE;
  }
  return byte;
}

/* Returns the size of the stuffed frame. */
static size_t frame_size(const uint8_t * message, uint16_t size)
{
  xrce_frame_t frame;
  size_t count = 0;

  xrce_frame_begin(&frame, message, size);
  /* at most 2 * (MICROROS_MTU + MICROROS_PEER_MTU) + 13 or 2 * MICROROS_MTU + 13 rounds */
  while (xrce_frame_next(&frame) >= 0) {
    ++count;
  }
  return count;
}

/* The line accepts a frame completely or not at all, so its room is checked first. */
bool xrce_framing_send(struct xrce_transport_t * line, const uint8_t * message, size_t size)
{
  xrce_frame_t frame;
  uint8_t chunk[CHUNK];
  size_t left;

  if (size > UINT16_MAX) {
    return false;
  }
  left = frame_size(message, (uint16_t)size);
  if (left > xrce_line_room(line)) {
    return false;
  }
  xrce_frame_begin(&frame, message, (uint16_t)size);
  /* at most (MICROROS_MTU + MICROROS_PEER_MTU) / 8 + 2 or MICROROS_MTU / 8 + 2 rounds */
  while (left != 0u) {
    size_t count = 0;

    while (count < sizeof(chunk) && left != 0u) { /* at most CHUNK rounds */
      chunk[count] = (uint8_t)((uint32_t)xrce_frame_next(&frame) & 0xffu);
      ++count;
      --left;
    }
    if (!xrce_line_write(line, chunk, count)) {
      return false;
    }
  }
  return true;
}
