/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Links with other boards (OMG DDS-XRCE 1.0 without an agent). On a link each board is the client of one session,
 * which it opens with CREATE_CLIENT, and the agent of the other board's. Entities are preconfigured: the index of a
 * data writer is that of its topic in the table of the link, which both images have; that of a requester and a replier is
 * that of their service. A client writes with WRITE_DATA; an agent answers with STATUS_AGENT, ACKNACK, and RESET to
 * messages of a session that it does not know, or cannot follow.
 *
 * A client key is the hash of the table (24 bits) and a number, which follows in the session id: messages of an earlier
 * session are recognized. Who asks for a session with a key that is in use, or was before, gets ALREADY_EXISTS and
 * takes the next number: so a board that has restarted gets a new session, and a CREATE_CLIENT that arrives twice ends
 * none. Internal. */
#ifndef MICROROS_XRCE_PEER_H
#define MICROROS_XRCE_PEER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_local.h"
#include "microros/xrce_objects.h"
#include "microros/xrce_transport.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An endpoint and the topic of a link: its index among the publishers or subscriptions, and in the table. */
typedef struct xrce_peer_route_t {
  uint16_t endpoint;
  uint16_t topic;
} xrce_peer_route_t;

/* A service or client on a link: its index among those of the image, and the service in the table of the link. */
typedef struct xrce_peer_service_t {
  uint16_t endpoint;
  uint16_t service;
  uint8_t link;
  uint8_t requests; /* of a service: how many its clients there have under way at most */
} xrce_peer_service_t;

/* A link, from the plan. */
typedef struct xrce_peer_line_t {
  const char * board;  /* name of the other board */
  const char * remote; /* its address, or the own device */
  uint16_t remote_port;
  uint16_t local_port;
  const xrce_peer_route_t * writers;
  const xrce_peer_route_t * readers;
  uint16_t writer_count;
  uint16_t reader_count;
  uint32_t key;     /* of the first session */
  uint16_t mtu;     /* bytes of a message */
  uint8_t position; /* 0: first end of the link, 1: second */
} xrce_peer_line_t;

extern const xrce_peer_line_t xrce_peer_lines[MICROROS_PEERS];

/* With messages in fragments: the largest reliable message on each link, bytes; from the plan. */
extern const uint32_t xrce_peer_largest[MICROROS_PEERS];

/* The extended identifiers of the frames that a board sends on a link over CAN FD, and that it receives. */
typedef struct xrce_peer_frames_t {
  uint32_t sent;
  uint32_t received;
} xrce_peer_frames_t;

/* Over CAN FD; from the plan. */
extern const xrce_peer_frames_t xrce_peer_frames[MICROROS_PEERS];

/* The transport of a link. It stays open when a session with an agent is opened again, and does not survive a sleep. */
typedef struct xrce_peer_port_t {
  xrce_transport_t transport;
  bool is_open;
} xrce_peer_port_t;

extern xrce_peer_port_t xrce_peer_ports[MICROROS_PEERS];

/* State of a link. Zero-initialized: no session. */
typedef struct xrce_peer_t {
  uint32_t due_ms;     /* when to send CREATE_CLIENT, or a HEARTBEAT */
  uint32_t since_ms;   /* start of connecting */
  uint32_t key;        /* of the own session; 0: none was asked for */
  uint32_t other_key;  /* of the other board's session; 0: not known */
  uint32_t former_key; /* of the one before */
  uint32_t early_ms;   /* since when the next reliable message waits for its subscription */
  uint16_t number;     /* of the next best-effort message */
  uint16_t first;      /* number of the oldest message that is not acknowledged */
  uint16_t unsent;     /* which of these have to be sent, from the first on */
  uint16_t newest;     /* number of the newest best-effort message of the other board */
  uint16_t next;       /* of its next reliable message */
  uint16_t done;       /* acknowledged fragments of the oldest message */
  uint8_t head;        /* slot of the oldest message */
  uint8_t count;       /* messages that wait in a slot */
  uint8_t pauses;      /* doublings of the pause before the next HEARTBEAT */
  bool ready : 1;      /* the own session */
  bool received : 1;   /* something arrived in the other board's session */
  bool lost : 1;       /* the device of the line is gone */
  bool more : 1;       /* more may have arrived than a pump takes */
  /* the next reliable message is not acknowledged: the program has not opened its subscription yet */
  bool early : 1;
  bool begun : 1;     /* no message waits for a subscription any more */
  bool requested : 1; /* a gap has been reported; until it is closed, only HEARTBEATs are answered */
} xrce_peer_t;

/* The part of a key that counts sessions; the rest identifies the table. */
#define XRCE_PEER_NUMBER 0xffu

/* Returns the id of a session: of the first board of a link 0x81, 0x83, … 0xbf, of the second one 0x82, 0x84, … 0xc0. */
static inline uint8_t xrce_peer_session(uint32_t key, uint8_t position)
{
  return (uint8_t)((uint32_t)XRCE_SESSION_ID + position + 2u * (key & 0x1fu));
}

/* Return the ids of the current sessions of a link. */
static inline uint8_t xrce_peer_own(const xrce_peer_t * peer, const xrce_peer_line_t * line)
{
  return xrce_peer_session(peer->key, line->position);
}

static inline uint8_t xrce_peer_other(const xrce_peer_t * peer, const xrce_peer_line_t * line)
{
  return xrce_peer_session(peer->other_key, (uint8_t)(1u - line->position));
}

/* Returns whether a session id is one of this board. */
static inline bool xrce_peer_is_own(uint8_t session, const xrce_peer_line_t * line)
{
  return ((uint32_t)session - XRCE_SESSION_ID) % 2u == line->position;
}

/* After a sleep: the messages of a link are gone, its sessions begin again. */
void xrce_peer_wake(xrce_client_t * client);

/* Receives, and sends what is due. Never blocks. */
void xrce_peer_step(xrce_client_t * client, uint32_t now);

/* Waits until all messages are acknowledged and sent, at most client->close_timeout_ms. The session with the agent ends
 * afterwards: a task that opens the next one waits for that. */
void xrce_peer_leave(xrce_client_t * client);

void xrce_peer_close(void);

/* Returns whether the client looks for an agent: not if it has nothing there, and the line may be that of a link. */
static inline bool xrce_peer_looks_for_agent(void)
{
  /* cppcheck-suppress knownConditionTrueFalse ; a constant of the plan */
  return !xrce_image_is_local();
}

/* Returns the time until a link has work to do, at most `left`. */
uint32_t xrce_peer_left(const xrce_client_t * client, uint32_t left, uint32_t now);

/* --- output; `index` is that of the link --- */

/* Returns room for a submessage of xrce_peer_capacity bytes; NULL if no slot is free. */
uint8_t * xrce_peer_reserve(const xrce_client_t * client, uint8_t index, bool reliable);

/* Returns the largest submessage of a link in bytes. */
size_t xrce_peer_capacity(uint8_t index, bool reliable);

/* Sends `size` reserved bytes, a reliable message until it is acknowledged. Returns false if a best-effort one was not
 * sent. */
bool xrce_peer_commit(xrce_client_t * client, uint8_t index, bool reliable, size_t size, uint32_t now);

/* Sends one message. Returns false if the line has no room for it. */
bool xrce_peer_send(xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size);

/* Called when the own session begins: all messages that wait are numbered from 0. */
void xrce_peer_renumber(xrce_peer_t * peer, uint8_t index, uint32_t now);

/* Called when the other board may answer again: what waits for it is asked for a HEARTBEAT's period from now, however long
 * it has been silent. */
void xrce_peer_hurry(xrce_peer_t * peer, uint32_t now);

/* Sends what has to be sent, and a HEARTBEAT when it is due. */
void xrce_peer_flow(xrce_client_t * client, uint8_t index, uint32_t now);

/* Sends a HEARTBEAT: a board that does not know the session answers with RESET. */
void xrce_peer_heartbeat(xrce_client_t * client, uint8_t index);

/* Takes the payload of an ACKNACK. */
void xrce_peer_acknowledged(
  xrce_peer_t * peer, uint8_t index, const uint8_t * payload, size_t size, uint8_t flags, uint32_t now);

/* --- input --- */

/* Called for a new session of the other board. */
void xrce_peer_in_reset(xrce_peer_t * peer, uint8_t index);

/* How long a reliable message waits for its subscription, milliseconds: as long as a program may take to open all of
 * them. Then, and once it has closed one of the link, what has no subscription is dropped and counted. */
#define XRCE_PEER_EARLY_MS 10000u

/* Called when the program closes a receiver of any kind: if it is a subscription of a link, no message waits for one
 * there any more. */
void xrce_peer_in_closed(const xrce_endpoint_t * endpoint);

/* Takes a message of the other board's session, which is complete. */
void xrce_peer_in_take(
  xrce_client_t * client, uint8_t index, const uint8_t * message, size_t size, uint32_t now);

/* Returns the buffer into which a link receives; a message begins at MICROROS_PEER_HEAD. */
uint8_t * xrce_peer_input(uint8_t index);

/* Returns whether the submessages fill the message. */
bool xrce_peer_is_whole(const uint8_t * message, size_t size);

/* Opens the transport of a link. Returns false without a network, or if the line does not exist. */
bool xrce_peer_open(xrce_transport_t * transport, uint8_t index);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_H */
