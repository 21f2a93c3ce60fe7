/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages over a byte stream (OMG DDS-XRCE 1.0, annex C), compatible with the public agent:
 *
 *     7E source destination length(2) payload crc(2)
 *
 * Numbers are little endian. After the flag 7E, every 7E is sent as 7D 5E and every 7D as 7D 5D
 * (stuffing). The length is that of the unstuffed payload, which the CRC-16/ARC covers. Not thread-safe.
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

/* Transport that carries the frames, provided by the component that selects this one. */
struct xrce_transport_t;

enum { XRCE_FRAMING_CHUNK = MICROROS_FRAMING_CHUNK };

/* A frame being received. Zero-initialized: none. */
typedef struct xrce_framing_t {
  uint32_t next; /* 0: waiting for a flag; otherwise one more than the unstuffed bytes since the flag */
  uint16_t size; /* of the payload, from the header */
  uint16_t crc;
  bool escaped; /* the last byte was 7D */
  uint8_t held; /* bytes in `chunk`, and how many of them were processed */
  uint8_t used;
  uint8_t chunk[XRCE_FRAMING_CHUNK];
} xrce_framing_t;

/* Sends one message of at most 65535 bytes as a frame. Returns false if the line had no room and accepted
 * nothing, or if it failed in the middle; the peer then drops the partial frame and receives the next one. */
bool xrce_framing_send(struct xrce_transport_t * line, const uint8_t * message, size_t size);

/*
 * Receives until a frame is complete: returns the size of its message, 0 if none is complete yet, -1 for a
 * discarded frame (aborted, wrong stuffing, other address, longer than `capacity`, empty, wrong CRC); only
 * that frame is lost. `buffer` keeps the partial frame: pass the same one until a message was received.
 * Bytes between frames are skipped. One call processes at most XRCE_TURN_BYTES bytes; XRCE_TURN_PARTIAL (xrce_turn_bytes.h):
 * so many were there, and no frame was complete. Without a message it keeps no byte that it has read and not processed: only
 * what is in the line ends a wait.
 */
int32_t xrce_framing_receive(
  xrce_framing_t * framing, struct xrce_transport_t * line, uint8_t * buffer, size_t capacity);

/* Returns an upper bound of the bytes of the buffer that the current frame occupies. */
uint32_t xrce_framing_arrived(const xrce_framing_t * framing);

/* --- for this component only --- */

enum { XRCE_FRAME_FLAG = 0x7e, XRCE_FRAME_ESCAPE = 0x7d, XRCE_FRAME_FLIP = 0x20 };

enum { XRCE_FRAME_ADDRESS_CLIENT = 0x01, XRCE_FRAME_ADDRESS_AGENT = 0x00 };

/* Bytes before and after the payload, without the flag. */
enum { XRCE_FRAME_HEADER = 4, XRCE_FRAME_CRC = 2 };

/* Returns `crc` extended by `byte`; the initial value is 0. */
uint16_t xrce_framing_crc(uint16_t crc, uint8_t byte);

/* --- implemented by the transport --- */

/* Returns how many bytes the line accepts now; SIZE_MAX if that is unknown. */
size_t xrce_line_room(struct xrce_transport_t * line);

/* Queues all bytes. Returns false if some were not accepted. */
bool xrce_line_write(struct xrce_transport_t * line, const uint8_t * data, size_t size);

/* Reads received bytes, at most `capacity`; returns their number. */
size_t xrce_line_read(struct xrce_transport_t * line, uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_FRAMING_H */
