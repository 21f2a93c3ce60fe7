/* SPDX-License-Identifier: Apache-2.0 */
/* When the first message of a handshake is sent again. Internal. */
#ifndef MICROROS_XRCE_SEAL_PAUSE_H
#define MICROROS_XRCE_SEAL_PAUSE_H

#include <stdint.h>

#include "microros_config.h"

/*
 * Returns the pause after a handshake that began `elapsed_ms` ago: half of it, within half of the session's limits. The
 * session repeats its CREATE_CLIENT in twice that time, so each of them finds the message due. */
static inline uint32_t xrce_seal_pause(uint32_t elapsed_ms)
{
  const uint32_t bounded =
    elapsed_ms < (uint32_t)MICROROS_RETRY_MOST_MS ? elapsed_ms : (uint32_t)MICROROS_RETRY_MOST_MS;
  const uint32_t pause =
    bounded > (uint32_t)MICROROS_RETRY_FIRST_MS ? bounded : (uint32_t)MICROROS_RETRY_FIRST_MS;

  return pause / 2u;
}

#endif /* MICROROS_XRCE_SEAL_PAUSE_H */
