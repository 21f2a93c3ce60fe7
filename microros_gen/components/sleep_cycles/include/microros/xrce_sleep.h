/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A session that survives sleep: its client's tables, streams and queues are copied to retained memory and
 * back, so that objects at the agent need not be created again. Pointers are not retained: a place is
 * `kept` until the application opens it again with the same identity, which restores name and type.
 * Meanwhile the place continues to receive.
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

/* Zero-initialized: the client has not slept. */
typedef struct xrce_sleep_t {
  uint32_t identity[XRCE_PLACES]; /* identity of each place at the start of the sleep */
  uint16_t local;                 /* local address to which the agent sends, as reported by the transport */
  uint16_t taken;                 /* the place that was last taken up, plus 1 */
  bool over;                      /* the client was restored and will be resumed */
} xrce_sleep_t;

/* Returns whether the session can be retained: it is ready, and no creation or deletion is in progress. */
bool xrce_sleep_can_begin(const xrce_client_t * client);

/* Prepares the client for the copy; only xrce_session_close may follow on it. */
void xrce_sleep_begin(xrce_client_t * client);

/* Returns once true if the client was restored and has this key, or any key if `key` is 0. */
bool xrce_sleep_is_over(xrce_client_t * client, uint32_t key);

/* Resumes the session, for which session.transport is prepared. Sends nothing, except for a ping if that
 * component is selected. If the transport does not open, the session counts as lost. */
void xrce_sleep_resume(xrce_client_t * client);

/* Returns whether a place is kept and its table is filled in as before. */
bool xrce_sleep_keeps(const xrce_client_t * client, uint16_t place);

/*
 * Called when the application opens a place, which is filled in. True: the preserved one, nothing has to
 * be created. */
bool xrce_sleep_restore(xrce_client_t * client, uint16_t place);

/* Returns the result of xrce_sleep_restore for this place when it was last opened. */
bool xrce_sleep_was_restored(const xrce_client_t * client, uint16_t place);

/* Called for a new session: discards everything kept from the previous one. */
void xrce_sleep_clear(xrce_client_t * client);

/* Returns the CRC-32 (IEEE 802.3) of `before` continued by these bytes; `before` is 0 for the first ones. */
uint32_t xrce_sleep_check(uint32_t before, const MICROROS_ANYWHERE uint8_t * bytes, size_t size);

/* --- implemented by one of xrce_sleep_<transport>.c --- */

bool xrce_sleep_open(xrce_transport_t * transport, uint16_t local);
uint16_t xrce_sleep_local(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SLEEP_H */
