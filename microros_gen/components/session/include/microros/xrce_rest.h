/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How a call that waits for the agent rests between two pumps. A component that can wait for the transport
 * replaces this header. Internal. */
#ifndef MICROROS_XRCE_REST_H
#define MICROROS_XRCE_REST_H

#include "microros/lock.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Rests for a millisecond; other tasks may run meanwhile. */
static inline void xrce_rest(const xrce_client_t * client)
{
  (void)client;
  microros_pause();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_REST_H */
