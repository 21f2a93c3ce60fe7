/* SPDX-License-Identifier: Apache-2.0 */
/* What the session does for /tf_static, under its lock. Internal. */
#ifndef MICROROS_RCLC_STATIC_TF_H
#define MICROROS_RCLC_STATIC_TF_H

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new session: its agent has no transform yet. */
void rclc_static_tf_renew(const xrce_client_t * client);

/* Sends what is due, if there are a data writer and room in the stream. */
void rclc_static_tf_step(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_STATIC_TF_H */
