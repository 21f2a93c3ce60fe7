/* SPDX-License-Identifier: Apache-2.0 */
/* What a transport has for its sealed messages. Internal. */
#ifndef MICROROS_XRCE_SEAL_H
#define MICROROS_XRCE_SEAL_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_largest_sent.h"
#include "microros/xrce_messages.h"
#include "microros/xrce_noise.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  XRCE_SEAL_HELLO = 12,  /* bytes in front of the first message of a handshake, and of the second one */
  XRCE_SEAL_WAITING = 64 /* bytes of the message that waits for the handshake: CREATE_CLIENT, GET_INFO */
};

/* Bytes of the largest record that is received, and of the largest one of both directions. */
#define XRCE_SEAL_RECORD \
  (MICROROS_INPUT_SIZE + XRCE_SEAL_OVERHEAD > XRCE_SEAL_FIRST ? MICROROS_INPUT_SIZE + XRCE_SEAL_OVERHEAD \
                                                              : XRCE_SEAL_FIRST)
#define XRCE_SEAL_LARGEST (XRCE_LARGEST_SENT > XRCE_SEAL_RECORD ? XRCE_LARGEST_SENT : XRCE_SEAL_RECORD)

/* Why there is no session, in the order of what `xrce_transport_open` needs. */
typedef enum xrce_seal_fault_t {
  XRCE_SEAL_FINE,
  XRCE_SEAL_NO_KEY,    /* microros_seal_psk failed */
  XRCE_SEAL_NO_CRYPTO, /* another function of microros/seal.h failed */
  XRCE_SEAL_SILENT,    /* the agent has not answered the handshake */
  XRCE_SEAL_REFUSED,   /* it answered that it refuses the key; anyone can say so */
  XRCE_SEAL_FORGED     /* its answer is not made with the key */
} xrce_seal_fault_t;

typedef struct xrce_seal_t {
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
  uint32_t refused;     /* messages that are not of the session, or forged */
  uint32_t replayed;    /* records that arrived before, or are too old to tell */
  xrce_noise_t noise;   /* of the handshake; zeros without one */
  uint8_t sending[MICROROS_SEAL_KEY];
  uint8_t receiving[MICROROS_SEAL_KEY];
  uint8_t first[XRCE_SEAL_FIRST];
  uint8_t waiting[XRCE_SEAL_WAITING];
} xrce_seal_t;

/* One record on its way out and, where a transport receives messages as a whole, on its way in. */
extern uint8_t xrce_seal_record[XRCE_SEAL_LARGEST];

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SEAL_H */
