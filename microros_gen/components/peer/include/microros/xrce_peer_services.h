/* SPDX-License-Identifier: Apache-2.0 */
/* Requests and replies of links, as they arrive. Internal. */
#ifndef MICROROS_XRCE_PEER_SERVICES_H
#define MICROROS_XRCE_PEER_SERVICES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_peer.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * The GUID of a request of another board, which is a mark (0xffff: no vendor, so no GUID of DDS begins with it), the link,
 * the number of the other board's session here, and its client key. A request of the image continues the mark. Then the
 * halves of the sequence number (OMG DDS-XRCE 1.0, annex A), which is the number of the request in the other board. */
enum {
  XRCE_PEER_MARK = 0xff,
  XRCE_PEER_MARK_SIZE = 8,
  XRCE_PEER_LINK_AT = 8,
  XRCE_PEER_REST_AT = 9,
  XRCE_PEER_SESSION_AT = 10,
  XRCE_PEER_KEY_AT = 12,
  XRCE_PEER_GUID_SIZE = 16,
  XRCE_PEER_LOW_AT = 20
};

/* No object of the protocol has this id. */
enum { XRCE_PEER_NO_OBJECT = 0 };

/* WRITE_DATA in the buffer of its message. What precedes the body was taken already and may be overwritten. */
typedef struct xrce_peer_data_t {
  uint8_t * input;
  size_t at;   /* of the body in `input`: at least XRCE_IDENTITY_SIZE */
  size_t size; /* of the body, not 0 */
  uint16_t request;
  uint16_t object;
  uint8_t flags;
} xrce_peer_data_t;

/* Reads WRITE_DATA, at byte `at` of the message at MICROROS_PEER_HEAD of a buffer. Returns false if it is malformed. */
bool xrce_peer_services_read(xrce_peer_data_t * data, uint8_t * input, size_t at);

/* Puts bytes of the buffer of a link into the queue of a receiver. A full queue, or a receiver that is not open, gets
 * none; they are counted. */
void xrce_peer_services_keep(
  xrce_client_t * client, uint16_t receiver, const xrce_peer_data_t * data, uint32_t now);

/* Returns whether a client key is that of a GUID. */
bool xrce_peer_services_is_key(const uint8_t * guid, uint32_t key);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_SERVICES_H */
