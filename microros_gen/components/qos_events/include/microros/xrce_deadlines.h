/* SPDX-License-Identifier: Apache-2.0 */
/* Deadlines of publishers and subscriptions; internal. */
#ifndef MICROROS_XRCE_DEADLINES_H
#define MICROROS_XRCE_DEADLINES_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_client.h"
#include "rmw/event_callback_type.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One for each publisher and subscription. Zero-initialized: not observed. */
typedef struct xrce_deadline_s {
  rmw_event_callback_t callback;
  const void * user_data;
  uint32_t period_ms; /* 0: nothing is ever missed */
  uint32_t due_ms;    /* while `running`: when the next period without a message ends */
  uint32_t total;
  uint32_t taken;  /* of `total` */
  uint32_t before; /* samples before the current message of the agent */
  bool observed;
  bool running;
} xrce_deadline_t;

/* One at least, which C requires of an array. */
enum {
  XRCE_TIMED_ENDPOINTS = MICROROS_PUBLISHERS_MAX + MICROROS_SUBSCRIPTIONS_MAX,
  XRCE_DEADLINES = XRCE_TIMED_ENDPOINTS != 0 ? XRCE_TIMED_ENDPOINTS : 1
};

/* Begins to observe the endpoint; NULL: it is observed already. */
xrce_deadline_t * xrce_deadline_open(const xrce_endpoint_t * endpoint);

/* Called for each message of the endpoint of this index: starts a new period. */
void xrce_deadline_meet(const xrce_client_t * client, uint16_t index);

/* Returns the deadline of the endpoint of this index. */
xrce_deadline_t * xrce_deadline_at(uint16_t index);

/* Counts periods that have ended. */
void xrce_deadlines_step(const xrce_client_t * client, uint32_t now);

/* Returns the time until the next period ends, at most `left`. */
uint32_t xrce_deadlines_left(const xrce_client_t * client, uint32_t left, uint32_t now);

/* Called before and after a message from the agent is handled. */
void xrce_deadlines_before(const xrce_client_t * client);
void xrce_deadlines_after(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_DEADLINES_H */
