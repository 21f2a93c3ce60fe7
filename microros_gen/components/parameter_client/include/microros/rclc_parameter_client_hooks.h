/* SPDX-License-Identifier: Apache-2.0 */
/* Called by the executor for parameter clients. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_CLIENT_HOOKS_H
#define MICROROS_RCLC_PARAMETER_CLIENT_HOOKS_H

#include "rclc/executor.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called before the callbacks of a round and after them; they may have finalized the executor. */
void rclc_parameter_client_round_begins(const rclc_executor_t * executor);
void rclc_parameter_client_round_ends(const rclc_executor_t * executor);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_CLIENT_HOOKS_H */
