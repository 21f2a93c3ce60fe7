/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages over a line of bytes (OMG DDS-XRCE 1.0, annex C), as the public agent speaks it:
 *
 *   7E source destination length(2) payload crc(2)
 *
 * Numbers are little endian. After the flag 7E every 7E goes as 7D 5E and every 7D as 7D 5D. The length is the
 * payload's before that, and so is what the CRC-16/ARC covers. Nothing here is thread-safe.
 */
#ifndef MICROROS_XRCE_FRAMING_H
#define MICROROS_XRCE_FRAMING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The transport that frames go over: whoever selects this component has one. */
struct xrce_transport_t;

enum { XRCE_FRAMING_CHUNK = MICROROS_FRAMING_CHUNK };

/* A frame that arrives. All zero: none is on its way. */
typedef struct xrce_framing_t {
  uint32_t next; /* 0: waits for a flag; else one more than the bytes since the flag, unstuffed */
  uint16_t size; /* of the payload, as the header says */
  uint16_t crc;
  bool escaped; /* the last byte was 7D */
  uint8_t held; /* bytes in `chunk`, and how many of them were looked at */
  uint8_t used;
  uint8_t chunk[XRCE_FRAMING_CHUNK];
} xrce_framing_t;

/* Writes one message of at most 65535 bytes as a frame. False: the line had no room for it and has nothing of it, or it
 * failed in the middle; then the peer drops the part, and the next frame is whole again. */
bool xrce_framing_send(struct xrce_transport_t * line, const uint8_t * message, size_t size);

/*
 * Takes what has arrived until a frame is whole: returns the size of its message, 0 when there is none yet, -1
 * for a frame that was thrown away (broken off, stuffed wrongly, of another address, longer than `capacity`,
 * empty, CRC); only that frame is lost. `buffer` keeps the part that is there: give the same one until a message
 * came. Bytes between frames are skipped. One call takes some 2,000 bytes at most.
 */
int32_t xrce_framing_receive(
  xrce_framing_t * framing, struct xrce_transport_t * line, uint8_t * buffer, size_t capacity);

/* Returns how many bytes of the buffer the frame on its way has touched at most. */
uint32_t xrce_framing_arrived(const xrce_framing_t * framing);

/* --- for this component alone --- */

enum { XRCE_FRAME_FLAG = 0x7e, XRCE_FRAME_ESCAPE = 0x7d, XRCE_FRAME_FLIP = 0x20 };

enum { XRCE_FRAME_ADDRESS_CLIENT = 0x01, XRCE_FRAME_ADDRESS_AGENT = 0x00 };

/* Bytes before and after the payload, the flag left out. */
enum { XRCE_FRAME_HEADER = 4, XRCE_FRAME_CRC = 2 };

/* Returns the CRC of what `crc` is that of and `byte` behind it; it begins with 0. */
uint16_t xrce_framing_crc(uint16_t crc, uint8_t byte);

/* --- what the transport implements --- */

/* Returns how many bytes the line takes now; SIZE_MAX where nobody can tell before. */
size_t xrce_line_room(struct xrce_transport_t * line);

/* Hands all bytes to the line. False: they were not all taken. */
bool xrce_line_write(struct xrce_transport_t * line, const uint8_t * data, size_t size);

/* Takes what has arrived, at most `capacity` bytes, and returns how many. */
size_t xrce_line_read(struct xrce_transport_t * line, uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_FRAMING_H */
