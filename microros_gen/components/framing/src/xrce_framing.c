/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_framing.h"

#include "microros/xrce_wire.h"

enum { FLAG = 0x7e, ESCAPE = 0x7d, FLIP = 0x20 };

enum { ADDRESS_CLIENT = 0x01, ADDRESS_AGENT = 0x00 };

/* Bytes before and after the payload, the flag left out. */
enum { FRAME_HEADER = 4, FRAME_CRC = 2 };

/* One call takes no more chunks than this: who floods us must not stop us. */
enum { CHUNKS_PER_CALL = 64 };

/* A frame on its way out, a chunk at a time. */
typedef struct frame_writer_t {
  struct xrce_transport_t * line;
  uint16_t crc;
  bool fine;
  uint8_t held;
  uint8_t chunk[XRCE_FRAMING_CHUNK];
} frame_writer_t;

/*
 * CRC-16/ARC: x^16 + x^15 + x^2 + 1, reflected, from 0, nothing added at the end. The polynomial has so few terms
 * that its table is the parity of the byte and two shifts: as small as the loop over eight bits, and three times
 * as fast; the usual table of 512 bytes would gain little more.
 */
static uint16_t crc_add(uint16_t crc, uint8_t byte)
{
  const uint32_t low = (crc ^ byte) & 0xffu;
  uint32_t parity = low ^ (low >> 4);

  parity ^= parity >> 2;
  parity ^= parity >> 1;
  return (uint16_t)(((uint32_t)crc >> 8) ^ (low << 6) ^ (low << 7) ^ ((parity & 1u) != 0u ? 0xc001u : 0u));
}

static void writer_flush(frame_writer_t * writer)
{
  writer->fine = writer->fine && xrce_line_write(writer->line, writer->chunk, writer->held);
  writer->held = 0;
}

static void writer_put(frame_writer_t * writer, uint8_t byte)
{
  if (writer->held == XRCE_FRAMING_CHUNK) {
    writer_flush(writer);
  }
  writer->chunk[writer->held] = byte;
  ++writer->held;
}

/* Puts bytes, stuffed, and makes their CRC the writer's. */
static void writer_put_stuffed(frame_writer_t * writer, const uint8_t * bytes, size_t size)
{
  uint16_t crc = 0;

  for (size_t i = 0; i < size && writer->fine; ++i) {
    uint8_t byte = bytes[i];

    crc = crc_add(crc, byte);
    if (byte == FLAG || byte == ESCAPE) {
      writer_put(writer, ESCAPE);
      byte ^= FLIP;
    }
    writer_put(writer, byte);
  }
  writer->crc = crc;
}

bool xrce_framing_send(struct xrce_transport_t * line, const uint8_t * message, size_t size)
{
  uint8_t header[FRAME_HEADER] = {ADDRESS_CLIENT, ADDRESS_AGENT, 0, 0};
  frame_writer_t writer;

  if (size > UINT16_MAX) {
    return false;
  }
  xrce_put_le16(&header[2], (uint16_t)size);
  writer.line = line;
  writer.fine = true;
  writer.held = 0;
  writer_put(&writer, FLAG);
  writer_put_stuffed(&writer, header, sizeof(header));
  writer_put_stuffed(&writer, message, size);
  xrce_put_le16(header, writer.crc);
  writer_put_stuffed(&writer, header, FRAME_CRC);
  writer_flush(&writer);
  return writer.fine;
}

/* Takes one unstuffed byte of a frame; returns what xrce_framing_receive does. */
static int32_t reader_take(xrce_framing_t * framing, uint8_t byte, uint8_t * buffer, size_t capacity)
{
  const uint32_t at = framing->next - 1u;
  bool right = true;

  if (at == 0u) {
    right = byte == ADDRESS_AGENT;
  } else if (at == 1u) {
    right = byte == ADDRESS_CLIENT;
  } else if (at == 2u) {
    framing->size = byte;
  } else if (at == 3u) {
    framing->size = (uint16_t)(framing->size | ((uint32_t)byte << 8));
    framing->crc = 0;
    right = framing->size != 0u && framing->size <= capacity;
  } else {
    const uint32_t place = at - FRAME_HEADER;

    framing->crc = crc_add(framing->crc, byte); /* with its own CRC behind it, what was sent comes to 0 */
    if (place < framing->size) {
      buffer[place] = byte;
    } else if (place == (uint32_t)framing->size + 1u) {
      framing->next = 0;
      return framing->crc == 0u ? (int32_t)framing->size : -1;
    }
  }
  framing->next = right ? framing->next + 1u : 0u;
  return right ? 0 : -1;
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
  if (!escaped && byte == ESCAPE) {
    framing->escaped = true;
    return 0;
  }
  if (escaped) {
    byte ^= FLIP;
    if (byte != FLAG && byte != ESCAPE) {
      framing->next = 0;
      return -1;
    }
  }
  return reader_take(framing, byte, buffer, capacity);
}

int32_t xrce_framing_receive(
  xrce_framing_t * framing, struct xrce_transport_t * line, uint8_t * buffer, size_t capacity)
{
  for (uint8_t i = 0; i < CHUNKS_PER_CALL; ++i) {
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
