/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_framing.h"

#include "microros/xrce_wire.h"

enum { FLAG = 0x7e, ESCAPE = 0x7d, FLIP = 0x20 };

enum { ADDRESS_CLIENT = 0x01, ADDRESS_AGENT = 0x00 };

/* Bytes before and after the payload, the flag left out. */
enum { FRAME_ADDRESSES = 2, FRAME_HEADER = 4, FRAME_CRC = 2 };

/* Bytes around the payload, with the flag, where each of the others is stuffed. */
enum { FRAME_AROUND = 1 + 2 * (FRAME_HEADER + FRAME_CRC) };

/* One call takes no more chunks than this: who floods us must not stop us. */
enum { CHUNKS_PER_CALL = 64 };

/* A frame on its way out, a chunk at a time. */
typedef struct frame_writer_t {
  struct xrce_transport_t * line;
  bool fine;
  uint8_t held;
  uint8_t chunk[XRCE_FRAMING_CHUNK];
} frame_writer_t;

/*
 * CRC-16/ARC: x^16 + x^15 + x^2 + 1, reflected, from 0, nothing added at the end. With so few terms an entry of the
 * usual table is the parity of its index and two shifts. On a Cortex-M4 at -Os this takes 44 bytes and 14
 * instructions a byte; a loop over the bits 28 and 53, a table of 16 entries 68 and 9, one of 256 more than 512.
 */
static uint16_t crc_add(uint16_t crc, uint8_t byte)
{
  const uint32_t low = (crc ^ byte) & 0xffu;
  uint32_t parity = low ^ (low >> 4);

  parity ^= parity >> 2;
  parity ^= parity >> 1;
  return (uint16_t)(((uint32_t)crc >> 8) ^ (low << 6) ^ (low << 7) ^ ((parity & 1u) != 0u ? 0xc001u : 0u));
}

static bool frame_stuffs(uint8_t byte)
{
  return byte == FLAG || byte == ESCAPE;
}

/* Makes `crc` that of the bytes; returns how many they are on the line, stuffed. */
static size_t frame_measure(const uint8_t * bytes, size_t size, uint16_t * crc)
{
  uint16_t sum = 0;
  size_t stuffed = size;

  for (size_t i = 0; i < size; ++i) {
    sum = crc_add(sum, bytes[i]);
    stuffed += frame_stuffs(bytes[i]) ? 1u : 0u;
  }
  *crc = sum;
  return stuffed;
}

static void writer_flush(frame_writer_t * writer)
{
  writer->fine = writer->fine && xrce_line_write(writer->line, writer->chunk, writer->held);
  writer->held = 0;
}

/* Puts bytes, stuffed. */
static void writer_put(frame_writer_t * writer, const uint8_t * bytes, size_t size)
{
  for (size_t i = 0; i < size && writer->fine; ++i) {
    uint8_t byte = bytes[i];

    if (writer->held > XRCE_FRAMING_CHUNK - 2) { /* no room for a pair */
      writer_flush(writer);
    }
    if (frame_stuffs(byte)) {
      writer->chunk[writer->held++] = ESCAPE;
      byte ^= FLIP;
    }
    writer->chunk[writer->held++] = byte;
  }
}

/* The line gets a frame whole or not at all: so its room is asked for first. */
bool xrce_framing_send(struct xrce_transport_t * line, const uint8_t * message, size_t size)
{
  uint8_t header[FRAME_HEADER] = {ADDRESS_CLIENT, ADDRESS_AGENT, 0, 0};
  uint8_t trailer[FRAME_CRC];
  uint16_t crc;
  frame_writer_t writer;

  if (size > UINT16_MAX) {
    return false;
  }
  if (FRAME_AROUND + frame_measure(message, size, &crc) > xrce_line_room(line)) {
    return false;
  }
  xrce_put_le16(&header[2], (uint16_t)size);
  xrce_put_le16(trailer, crc);
  writer.line = line;
  writer.fine = true;
  writer.chunk[0] = FLAG;
  writer.held = 1;
  writer_put(&writer, header, sizeof(header));
  writer_put(&writer, message, size);
  writer_put(&writer, trailer, sizeof(trailer));
  writer_flush(&writer);
  return writer.fine;
}

/* Drops the frame. */
static int32_t reader_drop(xrce_framing_t * framing)
{
  framing->next = 0;
  return -1;
}

/* Takes one unstuffed byte of a frame; returns what xrce_framing_receive does. */
static int32_t reader_take(xrce_framing_t * framing, uint8_t byte, uint8_t * buffer, size_t capacity)
{
  const uint32_t at = framing->next - 1u;

  ++framing->next;
  if (at < FRAME_ADDRESSES) {
    return byte == at ? 0 : reader_drop(framing); /* source and destination: ADDRESS_AGENT, ADDRESS_CLIENT */
  }
  if (at < FRAME_HEADER) {
    framing->size = (uint16_t)(((uint32_t)framing->size >> 8) | ((uint32_t)byte << 8));
    framing->crc = 0;
    return at + 1u < FRAME_HEADER || framing->size - 1u < capacity ? 0 : reader_drop(framing);
  }
  framing->crc = crc_add(framing->crc, byte); /* with its own CRC behind it, what was sent comes to 0 */
  if (at - FRAME_HEADER < framing->size) {
    buffer[at - FRAME_HEADER] = byte;
  } else if (at - FRAME_HEADER > framing->size) {
    (void)reader_drop(framing);
    return framing->crc == 0u ? (int32_t)framing->size : -1;
  }
  return 0;
}

/* Takes one byte of the line. */
static int32_t reader_take_raw(xrce_framing_t * framing, uint8_t byte, uint8_t * buffer, size_t capacity)
{
  const bool escaped = framing->escaped;

  framing->escaped = false;
  if (byte == FLAG) {
    const bool broken_off = framing->next > 1u || escaped;

    framing->next = 1;
    return broken_off ? -1 : 0;
  }
  if (framing->next == 0u) {
    return 0;
  }
  if (escaped) {
    byte ^= FLIP;
    if (byte != FLAG && byte != ESCAPE) {
      return reader_drop(framing);
    }
  } else if (byte == ESCAPE) {
    framing->escaped = true;
    return 0;
  }
  return reader_take(framing, byte, buffer, capacity);
}

int32_t xrce_framing_receive(
  xrce_framing_t * framing, struct xrce_transport_t * line, uint8_t * buffer, size_t capacity)
{
  for (int i = 0; i < CHUNKS_PER_CALL; ++i) {
    while (framing->used < framing->held) {
      const int32_t size = reader_take_raw(framing, framing->chunk[framing->used++], buffer, capacity);

      if (size != 0) {
        return size;
      }
    }
    framing->used = 0;
    framing->held = (uint8_t)xrce_line_read(line, framing->chunk, sizeof(framing->chunk));
    if (framing->held == 0u) {
      break;
    }
  }
  return 0;
}
