/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_SILENCE_HOOKS_H
#define MICROROS_XRCE_SILENCE_HOOKS_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is declared for a subscription. */
typedef struct xrce_silence_call_t {
  void (*call)(void);
  uint32_t after_ms;
  uint16_t receiver; /* its position among subscriptions */
} xrce_silence_call_t;

extern const xrce_silence_call_t xrce_silence_calls[MICROROS_SILENCES];

/* Called before and after a message of the agent is processed: a sample ends a silence. */
void xrce_silence_before(xrce_client_t * client);
void xrce_silence_after(xrce_client_t * client);

/* Called for an endpoint that the application opens: its time begins. */
void xrce_silence_opened(const xrce_endpoint_t * endpoint);

/* Calls the application for each subscription that has been silent for too long, once. */
void xrce_silence_step(xrce_client_t * client, uint32_t now);

/* Returns the time until the next one is silent for too long, at most `left`. */
uint32_t xrce_silence_left(const xrce_client_t * client, uint32_t left, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SILENCE_HOOKS_H */
