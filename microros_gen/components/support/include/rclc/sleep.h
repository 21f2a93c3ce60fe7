/* SPDX-License-Identifier: Apache-2.0 */
/* Sleeping. */
#ifndef MICROROS_RCLC_SLEEP_H
#define MICROROS_RCLC_SLEEP_H

#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sleeps for `ms` milliseconds; the session is not run meanwhile. */
void rclc_sleep_ms(unsigned int ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_SLEEP_H */
