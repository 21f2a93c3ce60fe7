/* SPDX-License-Identifier: Apache-2.0 */
/* Modes that the device itself requests. Internal. */
#ifndef MICROROS_RCLC_MODES_REQUEST_H
#define MICROROS_RCLC_MODES_REQUEST_H

#include <stdbool.h>
#include <stdint.h>

#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Requests that a node, by its index, is reconfigured; returns whether it is in that mode already. The executor of its
 * modes does it when its next round begins. Callable in any task. */
bool rclc_modes_request(uint16_t node, const char * mode);

/* Reconfigures what was requested of the modes that this executor has. */
void rclc_modes_round_begins(const rclc_executor_t * executor);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_MODES_REQUEST_H */
