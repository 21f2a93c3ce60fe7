/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A session that sleeps: its client's tables, streams and queues are copied to memory that stays, and back. What the
 * agent has is then not created again. Pointers are not taken over: a place is `kept` until the application opens it again
 * as what it was, and with it come its name and type. Meanwhile the place goes on receiving.
 */
#ifndef MICROROS_XRCE_SLEEP_H
#define MICROROS_XRCE_SLEEP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All zero: the client has not slept. */
typedef struct xrce_sleep_t {
  uint32_t identity[XRCE_PLACES]; /* what each place was when the sleep began */
  uint16_t local;                 /* where the agent has its answers sent to, as the transport says */
  uint16_t taken;                 /* the place that was taken up last, plus 1 */
  bool over;                      /* the client was taken from memory and is to go on */
} xrce_sleep_t;

/* Whether the session can be kept as it is: it is ready, and nothing is being created or deleted. */
bool xrce_sleep_can_begin(const xrce_client_t * client);

/* Makes the client ready to be copied; only xrce_session_close may follow on this one. */
void xrce_sleep_begin(xrce_client_t * client);

/* Whether the client was taken from memory and is the one with this key, or any where `key` is 0; true once. */
bool xrce_sleep_is_over(xrce_client_t * client, uint32_t key);

/* Goes on with the session, for which session.transport is prepared: without a word, but a question to the agent where
 * there is `ping`. A transport that does not open is a session that is lost. */
void xrce_sleep_resume(xrce_client_t * client);

/* Whether a place is kept and its table has it filled in as it was. */
bool xrce_sleep_keeps(const xrce_client_t * client, uint16_t place);

/* The application opens a place, which is filled in. True: it is the one that was kept, and there is nothing to create. */
bool xrce_sleep_take_up(xrce_client_t * client, uint16_t place);

/* Whether that was the answer for this place the last time that one was opened. */
bool xrce_sleep_took_up(const xrce_client_t * client, uint16_t place);

/* A session is new: what was kept for the one before is no more. */
void xrce_sleep_forget(xrce_client_t * client);

/* Returns CRC-32 (IEEE 802.3) of some more bytes; `before` is that of those before, 0 at first. */
uint32_t xrce_sleep_check(uint32_t before, const uint8_t * bytes, size_t size);

/* --- one of xrce_sleep_<transport>.c --- */

bool xrce_sleep_open(xrce_transport_t * transport, uint16_t local);
uint16_t xrce_sleep_local(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SLEEP_H */
