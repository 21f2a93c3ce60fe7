/* SPDX-License-Identifier: Apache-2.0 */
/* Which executors call callbacks now; internal. */
#ifndef MICROROS_RCLC_SERVICE_CALL_INTERNAL_H
#define MICROROS_RCLC_SERVICE_CALL_INTERNAL_H

#include <stdbool.h>

#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called by the executor before the callbacks of a round and after them; they may have finalized it. */
void rclc_service_call_round_begins(const rclc_executor_t * executor);
void rclc_service_call_round_ends(const rclc_executor_t * executor);

/* Returns whether a callback of the executor is running. */
bool rclc_service_call_is_in_round(const rclc_executor_t * executor);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_SERVICE_CALL_INTERNAL_H */
