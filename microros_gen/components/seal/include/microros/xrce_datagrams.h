/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The datagrams of the session, sealed: each carries one message in a record of a Noise session with the agent
 * (docs/howto/seal.md has the layouts). Replaces the header of `transport_udp`. The caller holds the lock of the
 * library. Internal. */
#ifndef MICROROS_XRCE_DATAGRAMS_H
#define MICROROS_XRCE_DATAGRAMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_noise.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  XRCE_SEAL_HELLO = 12,  /* bytes in front of the first message of a handshake, and of the second one */
  XRCE_SEAL_FIRST = 60,  /* bytes of either, with XRCE_NOISE_MESSAGE */
  XRCE_SEAL_WAITING = 64 /* bytes of the message that waits for the handshake: CREATE_CLIENT, GET_INFO */
};

/* The agent has one session of a client: that of the handshake that was confirmed last. */
#define XRCE_DATAGRAMS_ONE_SOCKET true

/* Why there is no session, in the order of what `xrce_datagrams_open` needs. */
typedef enum xrce_seal_fault_t {
  XRCE_SEAL_FINE,
  XRCE_SEAL_NO_KEY,    /* microros_seal_psk failed */
  XRCE_SEAL_NO_CRYPTO, /* another function of microros/seal.h failed */
  XRCE_SEAL_SILENT,    /* the agent has not answered the handshake */
  XRCE_SEAL_REFUSED,   /* it answered that it refuses the key; anyone can say so */
  XRCE_SEAL_FORGED     /* its answer is not made with the key */
} xrce_seal_fault_t;

typedef struct xrce_datagrams_t {
  port_udp_t socket;
  bool is_ready;        /* the session has keys */
  uint8_t fault;        /* xrce_seal_fault_t */
  uint8_t waiting_size; /* of `waiting`; 0: none */
  uint32_t own;         /* index that the agent puts in front of its records; new with each handshake */
  uint32_t peer;        /* the agent's */
  uint32_t next;        /* counter of the next record to the agent */
  uint32_t newest;      /* one more than the highest counter that arrived */
  uint32_t window;      /* bit i: the counter `newest - 1 - i` arrived */
  uint32_t since_ms;    /* beginning of the handshake */
  uint32_t due_ms;      /* its first message is not sent again earlier */
  uint32_t refused;     /* datagrams that are not of the session, or forged */
  uint32_t replayed;    /* records that arrived before, or are too old to tell */
  xrce_noise_t noise;   /* of the handshake; zeros without one */
  uint8_t sending[MICROROS_SEAL_KEY];
  uint8_t receiving[MICROROS_SEAL_KEY];
  uint8_t first[XRCE_SEAL_FIRST];
  uint8_t waiting[XRCE_SEAL_WAITING];
} xrce_datagrams_t;

/* Returns the handle for port_wait. */
static inline intptr_t xrce_datagrams_handle(const xrce_datagrams_t * datagrams)
{
  return datagrams->socket.handle;
}

/* Opens the socket and begins a handshake, whose first message the first call of send transmits. Without a key, or
 * if a function of microros/seal.h fails, it sets `fault` and returns false. */
bool xrce_datagrams_open(xrce_datagrams_t * datagrams, const char * host, uint16_t port);

/* Closes the socket and wipes all keys. */
void xrce_datagrams_close(xrce_datagrams_t * datagrams);

/*
 * Sends one message. Without a session it sends the first message of the handshake again, if that is due, and keeps
 * the latest message of up to XRCE_SEAL_WAITING bytes for the end of the handshake; it refuses larger ones. */
bool xrce_datagrams_send(xrce_datagrams_t * datagrams, const uint8_t * message, size_t size);

/* Receives one message. Returns its size, 0 if none has arrived or the handshake went on (more may
 * be waiting), -1 for a discarded one. */
int32_t xrce_datagrams_receive(xrce_datagrams_t * datagrams, uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_DATAGRAMS_H */
