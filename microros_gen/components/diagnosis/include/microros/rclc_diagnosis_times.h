/* SPDX-License-Identifier: Apache-2.0 */
/* Times of the callbacks that the application file declares. Internal. */
#ifndef MICROROS_RCLC_DIAGNOSIS_TIMES_H
#define MICROROS_RCLC_DIAGNOSIS_TIMES_H

#include <stdint.h>

#include "microros_config.h"
#include "rclc_diagnosis/callbacks.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const uint32_t rcl_diagnosis_limits_us[MICROROS_DIAGNOSIS_CALLBACKS]; /* 0: none */

/* Returns the times of a declared callback, under the lock. */
const rclc_diagnosis_callback_t * rclc_diagnosis_times(uint8_t callback);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_DIAGNOSIS_TIMES_H */
