/* SPDX-License-Identifier: Apache-2.0 */
/* Detects a lost session by unacknowledged reliable data; sends nothing by itself. */
#ifndef MICROROS_XRCE_LIVELINESS_ACKNACK_H
#define MICROROS_XRCE_LIVELINESS_ACKNACK_H

#include <stdint.h>

#include "microros/xrce_session.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct xrce_liveliness_acknack_t {
  uint32_t since_ms;    /* time of the last acknowledgement, or when nothing was unacknowledged */
  uint32_t received_ms; /* value of the session at that time */
  uint16_t first;       /* oldest unacknowledged message at that time */
} xrce_liveliness_acknack_t;

void xrce_liveliness_acknack_reset(xrce_liveliness_acknack_t * liveliness, uint32_t now);

/* Loses the session after MICROROS_LIVELINESS_WAIT_MS times MICROROS_LIVELINESS_ATTEMPTS. */
void xrce_liveliness_acknack_step(xrce_client_t * client, uint32_t now);

/* Returns when the session is lost unless an acknowledgement arrives. */
static inline uint32_t xrce_liveliness_acknack_due(const xrce_liveliness_acknack_t * liveliness)
{
  return liveliness->since_ms + (uint32_t)MICROROS_LIVELINESS_WAIT_MS * MICROROS_LIVELINESS_ATTEMPTS;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_LIVELINESS_ACKNACK_H */
