/* SPDX-License-Identifier: Apache-2.0 */
/* When a device reports on itself next. Internal. */
#ifndef MICROROS_XRCE_DIAGNOSIS_H
#define MICROROS_XRCE_DIAGNOSIS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct xrce_diagnosis_t {
  uint32_t due_ms; /* of port_time_ms; while `running` */
  bool running;    /* the publisher is open, or was before a sleep */
} xrce_diagnosis_t;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_DIAGNOSIS_H */
