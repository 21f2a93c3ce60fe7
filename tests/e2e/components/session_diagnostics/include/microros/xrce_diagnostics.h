/* SPDX-License-Identifier: Apache-2.0 */
/* When the counters of the session are published next. Internal. */
#ifndef MICROROS_XRCE_DIAGNOSTICS_H
#define MICROROS_XRCE_DIAGNOSTICS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef MICROROS_DIAGNOSTICS_PERIOD_MS
#define MICROROS_DIAGNOSTICS_PERIOD_MS 1000u
#endif

typedef struct xrce_diagnostics_t {
  uint32_t due_ms; /* of port_time_ms; while `running` */
  bool running;    /* a publisher is open */
  bool is_due;
} xrce_diagnostics_t;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_DIAGNOSTICS_H */
