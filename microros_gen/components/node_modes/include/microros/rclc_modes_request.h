/* SPDX-License-Identifier: Apache-2.0 */
/* Modes that the device itself requests. Internal. */
#ifndef MICROROS_RCLC_MODES_REQUEST_H
#define MICROROS_RCLC_MODES_REQUEST_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reconfigures a node, by its index. Returns whether it is in that mode then; false: to be tried again. Called in the
 * task of the executor. */
bool rclc_modes_request(uint16_t node, const char * mode);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_MODES_REQUEST_H */
