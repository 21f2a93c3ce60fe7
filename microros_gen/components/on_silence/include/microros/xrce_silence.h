/* SPDX-License-Identifier: Apache-2.0 */
/* Subscriptions that must not be silent. Internal. */
#ifndef MICROROS_XRCE_SILENCE_H
#define MICROROS_XRCE_SILENCE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Zero-initialized: its subscription is not open. */
typedef struct xrce_silence_t {
  uint32_t due_ms; /* when it has been silent for too long; of one that is open and not silent */
  uint32_t before; /* samples before the current message of the agent */
  bool is_open;
  bool is_silent; /* the application was called, and no sample arrived since */
} xrce_silence_t;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SILENCE_H */
