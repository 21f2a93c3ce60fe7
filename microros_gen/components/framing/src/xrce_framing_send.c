/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_framing.h"

#include "microros/xrce_wire.h"

/* Chunk size for copying a frame to the line. */
enum { CHUNK = 32 };

/* Largest overhead of a frame: the flag, and header and CRC with every byte stuffed. */
enum { FRAME_OVERHEAD = 1 + 2 * (XRCE_FRAME_HEADER + XRCE_FRAME_CRC) };

/* A frame being sent, one chunk at a time. */
typedef struct frame_writer_t {
  struct xrce_transport_t * line;
  bool fine;
  uint8_t held;
  uint8_t chunk[CHUNK];
} frame_writer_t;

static bool frame_is_escaped(uint8_t byte)
{
  return byte == XRCE_FRAME_FLAG || byte == XRCE_FRAME_ESCAPE;
}

/* Extends `crc` by the bytes; returns their stuffed size. */
static size_t frame_measure(const uint8_t * bytes, size_t size, uint16_t * crc)
{
  uint16_t sum = 0;
  size_t stuffed = size;

  /* at most size of xrce_framing_send or MICROROS_MTU + MICROROS_PEER_MTU or XRCE_SEALED_MOST or MICROROS_MTU rounds */
  for (size_t i = 0; i < size; ++i) {
    sum = xrce_framing_crc(sum, bytes[i]);
    stuffed += frame_is_escaped(bytes[i]) ? 1u : 0u;
  }
  *crc = sum;
  return stuffed;
}

static void writer_flush(frame_writer_t * writer)
{
  writer->fine = writer->fine && xrce_line_write(writer->line, writer->chunk, writer->held);
  writer->held = 0;
}

/* Writes bytes, stuffed. */
static void writer_put(frame_writer_t * writer, const uint8_t * bytes, size_t size)
{
  /* at most size of writer_put or MICROROS_MTU + MICROROS_PEER_MTU or XRCE_SEALED_MOST or MICROROS_MTU rounds */
  for (size_t i = 0; i < size && writer->fine; ++i) {
    uint8_t byte = bytes[i];

    if (writer->held > CHUNK - 2) { /* no room for an escape pair */
      writer_flush(writer);
    }
    if (frame_is_escaped(byte)) {
      writer->chunk[writer->held++] = XRCE_FRAME_ESCAPE;
      byte ^= XRCE_FRAME_FLIP;
    }
    writer->chunk[writer->held++] = byte;
  }
}

/* The line accepts a frame completely or not at all, so its room is checked first. */
bool xrce_framing_send(struct xrce_transport_t * line, const uint8_t * message, size_t size)
{
  uint8_t header[XRCE_FRAME_HEADER] = {XRCE_FRAME_ADDRESS_CLIENT, XRCE_FRAME_ADDRESS_AGENT, 0, 0};
  uint8_t trailer[XRCE_FRAME_CRC];
  uint16_t crc;
  frame_writer_t writer;

  if (size > UINT16_MAX) {
    return false;
  }
  if (FRAME_OVERHEAD + frame_measure(message, size, &crc) > xrce_line_room(line)) {
    return false;
  }
  xrce_put_le16(&header[2], (uint16_t)size);
  xrce_put_le16(trailer, crc);
  writer.line = line;
  writer.fine = true;
  writer.chunk[0] = XRCE_FRAME_FLAG;
  writer.held = 1;
  writer_put(&writer, header, sizeof(header));
  writer_put(&writer, message, size);
  writer_put(&writer, trailer, sizeof(trailer));
  writer_flush(&writer);
  return writer.fine;
}
