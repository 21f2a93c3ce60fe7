/* SPDX-License-Identifier: Apache-2.0 */
/* Internal. */
#ifndef MICROROS_RCLC_PARAMETER_HELD_LOG_H
#define MICROROS_RCLC_PARAMETER_HELD_LOG_H

#ifdef __cplusplus
extern "C" {
#endif

/* Logs that a value which the node had set is overruled, where the image has log messages. */
void rclc_parameter_held_log(const char * name);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_HELD_LOG_H */
