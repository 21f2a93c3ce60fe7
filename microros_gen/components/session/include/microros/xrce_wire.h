/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Encoding of DDS-XRCE 1.0 (OMG formal/2020-02-01), compatible with the public agent. Numbers are little
 * endian; request ids, object ids and the client key are byte arrays, most significant byte first. The
 * session id is 0x81: a message header has four bytes.
 */
#ifndef MICROROS_XRCE_WIRE_H
#define MICROROS_XRCE_WIRE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  XRCE_MESSAGE_HEADER = 4,
  XRCE_SUBMESSAGE_HEADER = 4,
  XRCE_OBJECT_PREFIX = 4,                                         /* request id and object id */
  XRCE_WRITE_PREFIX = XRCE_SUBMESSAGE_HEADER + XRCE_OBJECT_PREFIX /* before the body of WRITE_DATA */
};

enum { XRCE_SESSION_ID = 0x81, XRCE_SESSION_NONE = 0x80 };

enum {
  XRCE_STREAM_NONE = 0x00,
  XRCE_STREAM_BEST_EFFORT = 0x01,
  XRCE_STREAM_RELIABLE = 0x80,
  XRCE_STREAM_READING = 0x81 /* reliable, for READ_DATA only */
};

enum {
  XRCE_CREATE_CLIENT = 0x00,
  XRCE_CREATE = 0x01,
  XRCE_GET_INFO = 0x02,
  XRCE_DELETE = 0x03,
  XRCE_STATUS_AGENT = 0x04,
  XRCE_STATUS = 0x05,
  XRCE_INFO = 0x06,
  XRCE_WRITE_DATA = 0x07,
  XRCE_READ_DATA = 0x08,
  XRCE_DATA = 0x09,
  XRCE_ACKNACK = 0x0a,
  XRCE_HEARTBEAT = 0x0b,
  XRCE_RESET = 0x0c,
  XRCE_FRAGMENT = 0x0d,
  XRCE_TIMESTAMP = 0x0e,
  XRCE_TIMESTAMP_REPLY = 0x0f
};

/* Payload sizes of these two. */
enum { XRCE_ACKNACK_SIZE = 5, XRCE_HEARTBEAT_SIZE = 5 };

enum {
  XRCE_FLAG_LITTLE_ENDIAN = 0x01,
  XRCE_FLAG_REUSE = 0x02,        /* of CREATE */
  XRCE_FLAG_REPLACE = 0x04,      /* of CREATE */
  XRCE_FLAG_LAST_FRAGMENT = 0x02 /* of FRAGMENT */
};

enum {
  XRCE_STATUS_OK = 0x00,
  XRCE_STATUS_OK_MATCHED = 0x01,
  XRCE_STATUS_ALREADY_EXISTS = 0x82,
  XRCE_STATUS_INCOMPATIBLE = 0x86
};

enum {
  XRCE_REQUEST_NONE = 0x0000,
  XRCE_REQUEST_LOGIN = 0x0001,
  XRCE_REQUEST_LOGOUT = 0x0002,
  XRCE_REQUEST_PING = 0x000a,
  XRCE_REQUEST_FIRST = 0x000b
};

enum {
  XRCE_KIND_PARTICIPANT = 0x01,
  XRCE_KIND_TOPIC = 0x02,
  XRCE_KIND_PUBLISHER = 0x03,
  XRCE_KIND_SUBSCRIBER = 0x04,
  XRCE_KIND_DATAWRITER = 0x05,
  XRCE_KIND_DATAREADER = 0x06,
  XRCE_KIND_REQUESTER = 0x07,
  XRCE_KIND_REPLIER = 0x08
};

/* Before a received request (OMG DDS-XRCE 1.0, 7.7.14: SampleIdentity), and before a reply: the request's
 * number and object. */
enum { XRCE_IDENTITY_SIZE = 24, XRCE_RELATED_SIZE = 4 };

#define XRCE_OBJECT_AGENT 0xfffdu
#define XRCE_OBJECT_CLIENT 0xfffeu

enum { XRCE_QOS_RELIABLE = 0x01, XRCE_QOS_KEEP_LAST = 0x02, XRCE_QOS_TRANSIENT_LOCAL = 0x08 };

/* Object ids are computed from the index in the table: twelve bits of index, four of kind. */
static inline uint16_t xrce_object_id(uint16_t index, uint8_t kind)
{
  return (uint16_t)(((uint32_t)index << 4) | kind);
}

static inline uint16_t xrce_object_index(uint16_t id)
{
  return (uint16_t)(id >> 4);
}

/*
 * A processor that stores a number at any address does so at once: for ARM, compilers do not make one store of two bytes.
 */
#if defined(__ARM_FEATURE_UNALIGNED) && defined(__BYTE_ORDER__) && (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
static inline void xrce_put_le16(uint8_t * at, uint16_t value)
{
  (void)memcpy(at, &value, sizeof(value));
}

static inline void xrce_put_be16(uint8_t * at, uint16_t value)
{
  xrce_put_le16(at, (uint16_t)(((uint32_t)value << 8) | ((uint32_t)value >> 8)));
}

static inline void xrce_put_le32(uint8_t * at, uint32_t value)
{
  (void)memcpy(at, &value, sizeof(value));
}
#else
static inline void xrce_put_le16(uint8_t * at, uint16_t value)
{
  at[0] = (uint8_t)(value & 0xffu);
  at[1] = (uint8_t)(value >> 8);
}

static inline void xrce_put_be16(uint8_t * at, uint16_t value)
{
  at[0] = (uint8_t)(value >> 8);
  at[1] = (uint8_t)(value & 0xffu);
}

static inline void xrce_put_le32(uint8_t * at, uint32_t value)
{
  xrce_put_le16(&at[0], (uint16_t)(value & 0xffffu));
  xrce_put_le16(&at[2], (uint16_t)(value >> 16));
}
#endif

static inline uint16_t xrce_get_be16(const uint8_t * at)
{
  return (uint16_t)(((uint32_t)at[0] << 8) | at[1]);
}

static inline uint16_t xrce_get_le16(const uint8_t * at)
{
  return (uint16_t)(((uint32_t)at[1] << 8) | at[0]);
}

/* Reads a number of a payload in the byte order given by its submessage's flags. */
static inline uint16_t xrce_get_u16(const uint8_t * at, uint8_t flags)
{
  return (flags & XRCE_FLAG_LITTLE_ENDIAN) != 0u ? xrce_get_le16(at) : xrce_get_be16(at);
}

static inline void xrce_put_header(uint8_t * message, uint8_t session, uint8_t stream, uint16_t sequence)
{
  message[0] = session;
  message[1] = stream;
  xrce_put_le16(&message[2], sequence);
}

/* `size` is that of the payload. */
static inline void xrce_put_submessage(uint8_t * at, uint8_t id, uint8_t flags, uint16_t size)
{
  at[0] = id;
  at[1] = flags;
  xrce_put_le16(&at[2], size);
}

/* Parts of a received submessage, which starts at its header; its size is that of the payload only. */
static inline uint8_t xrce_flags_of(const uint8_t * submessage)
{
  return submessage[1];
}

static inline const uint8_t * xrce_payload_of(const uint8_t * submessage)
{
  return &submessage[XRCE_SUBMESSAGE_HEADER];
}

enum { XRCE_GET_INFO_SIZE = 16, XRCE_INFO_ACTIVITY = 2 };

/* Writes a message with GET_INFO (XRCE_GET_INFO_SIZE bytes). */
static inline void xrce_put_get_info(uint8_t * message, uint8_t session)
{
  xrce_put_header(message, session, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_GET_INFO, XRCE_FLAG_LITTLE_ENDIAN, XRCE_GET_INFO_SIZE - 8);
  xrce_put_be16(&message[8], XRCE_REQUEST_PING);
  xrce_put_be16(&message[10], XRCE_OBJECT_AGENT);
  xrce_put_le16(&message[12], XRCE_INFO_ACTIVITY);
  xrce_put_le16(&message[14], 0);
}

/* Returns the distance between two addresses in a message, which is smaller than 64 KiB. */
static inline uint16_t xrce_size_between(const uint8_t * begin, const uint8_t * end)
{
  return (uint16_t)(end - begin);
}

/* Returns whether `deadline` has passed at `now`; both in milliseconds that wrap to 0 after 2^32 - 1. */
static inline bool xrce_is_due(uint32_t now, uint32_t deadline)
{
  return now - deadline < 0x80000000u;
}

/*
 * Returns the time until the earlier of `left` ms from now, or `due`. Overdue work has just been tried
 * without success: it gets a millisecond. */
static inline uint32_t xrce_sooner(uint32_t left, uint32_t due, uint32_t now)
{
  const uint32_t until = xrce_is_due(now, due) ? 1u : due - now;

  return until < left ? until : left;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_WIRE_H */
