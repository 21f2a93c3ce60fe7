/* SPDX-License-Identifier: Apache-2.0 */
/* Calls a service and waits for the response, for at most a given time. */
#ifndef MICROROS_RCLC_SERVICE_CALL_H
#define MICROROS_RCLC_SERVICE_CALL_H

#include <stdint.h>

#include "rcl/client.h"
#include "rclc/executor.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sends `request` and decodes its response into `response`, which keeps its storage, or gets that of the
 * declaration if it has none. Waits for at most `timeout_ns`, rounded up to milliseconds; longer than 0,
 * at most 24 days. Runs the session meanwhile, but no callbacks: messages wait in their queues. Belongs to
 * the task that spins `executor`.
 *
 * RCL_RET_OK: `response` is valid. RCL_RET_TIMEOUT: no response; one that arrives later is discarded by
 * the next call. RCL_RET_INVALID_ARGUMENT: a pointer is NULL, or the time-out is out of range.
 * RCL_RET_CLIENT_INVALID. RCL_RET_ERROR, with a text: called in a callback of `executor`, whose other
 * callbacks would be late by the whole time-out; the executor runs the client, so that responses belong to
 * its callback; the request was not sent; the session was lost, so that the response may not arrive; or
 * the response exceeds a limit.
 */
rcl_ret_t rclc_executor_call_service(
  rclc_executor_t * executor, rcl_client_t * client, const void * request, void * response,
  uint64_t timeout_ns);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_SERVICE_CALL_H */
