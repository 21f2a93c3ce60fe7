/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_framing.h"

#include "microros/xrce_framing_addresses.h"
#include "microros/xrce_turn_bytes.h"

enum { FRAME_ADDRESSES = 2 };

enum { CHUNKS_PER_CALL = (int)XRCE_TURN_BYTES / (int)XRCE_FRAMING_CHUNK };

/*
 * CRC-16/ARC: x^16 + x^15 + x^2 + 1, reflected, initial value 0, no final XOR. With so few terms an entry
 * of the usual table is the parity of its index and two shifts. On a Cortex-M4 at -Os this takes 44 bytes
 * and 14 instructions per byte; a loop over the bits 28 and 53, a table of 16 entries 68 and 9, one of 256
 * more than 512.
 */
uint16_t xrce_framing_crc(uint16_t crc, uint8_t byte)
{
  const uint32_t low = (crc ^ byte) & 0xffu;
  uint32_t parity = low ^ (low >> 4);

  parity ^= parity >> 2;
  parity ^= parity >> 1;
  return (uint16_t)(((uint32_t)crc >> 8) ^ (low << 6) ^ (low << 7) ^ ((parity & 1u) != 0u ? 0xc001u : 0u));
}

/* Drops the frame. */
static int32_t reader_drop(xrce_framing_t * framing)
{
  framing->next = 0;
  return -1;
}

/* Processes one unstuffed byte of a frame; returns as xrce_framing_receive does. */
static int32_t reader_take(xrce_framing_t * framing, uint8_t byte, uint8_t * buffer, size_t capacity)
{
  const uint32_t at = framing->next - 1u;

  ++framing->next;
  if (at < FRAME_ADDRESSES) {
    return xrce_framing_is_address(at, byte) ? 0 : reader_drop(framing); /* source and destination */
  }
  if (at < XRCE_FRAME_HEADER) {
    framing->size = (uint16_t)(((uint32_t)framing->size >> 8) | ((uint32_t)byte << 8));
    framing->crc = 0;
    return at + 1u < XRCE_FRAME_HEADER || framing->size - 1u < capacity ? 0 : reader_drop(framing);
  }
  framing->crc = xrce_framing_crc(framing->crc, byte); /* data followed by its own CRC has the CRC 0 */
  if (at - XRCE_FRAME_HEADER < framing->size) {
    buffer[at - XRCE_FRAME_HEADER] = byte;
  } else if (at - XRCE_FRAME_HEADER > framing->size) {
    (void)reader_drop(framing);
    return framing->crc == 0u ? (int32_t)framing->size : -1;
  }
  return 0;
}

/* Processes one byte of the line. */
static int32_t reader_take_raw(xrce_framing_t * framing, uint8_t byte, uint8_t * buffer, size_t capacity)
{
  const bool escaped = framing->escaped;

  framing->escaped = false;
  if (byte == XRCE_FRAME_FLAG) {
    const bool broken_off = framing->next > 1u || escaped;

    framing->next = 1;
    return broken_off ? -1 : 0;
  }
  if (framing->next == 0u) {
    return 0;
  }
  if (escaped) {
    byte ^= XRCE_FRAME_FLIP;
    if (byte != XRCE_FRAME_FLAG && byte != XRCE_FRAME_ESCAPE) {
      return reader_drop(framing);
    }
  } else if (byte == XRCE_FRAME_ESCAPE) {
    framing->escaped = true;
    return 0;
  }
  return reader_take(framing, byte, buffer, capacity);
}

int32_t xrce_framing_receive(
  xrce_framing_t * framing, struct xrce_transport_t * line, uint8_t * buffer, size_t capacity)
{
  for (int i = 0; i < CHUNKS_PER_CALL; ++i) {
    if (framing->used >= framing->held) {
      framing->used = 0;
      framing->held = (uint8_t)xrce_line_read(line, framing->chunk, sizeof(framing->chunk));
    }
    if (framing->held == 0u) {
      return 0;
    }
    while (framing->used < framing->held) { /* at most XRCE_FRAMING_CHUNK rounds */
      const int32_t size = reader_take_raw(framing, framing->chunk[framing->used++], buffer, capacity);

      if (size != 0) {
        return size;
      }
    }
  }
  return XRCE_TURN_PARTIAL;
}
