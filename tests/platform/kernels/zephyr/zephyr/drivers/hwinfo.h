/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_ZEPHYR_HWINFO_H
#define STAND_IN_ZEPHYR_HWINFO_H

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#define RESET_PIN (1u << 0)
#define RESET_SOFTWARE (1u << 1)
#define RESET_BROWNOUT (1u << 2)
#define RESET_POR (1u << 3)
#define RESET_WATCHDOG (1u << 4)
#define RESET_CPU_LOCKUP (1u << 8)

int hwinfo_get_reset_cause(uint32_t * cause);
int hwinfo_clear_reset_cause(void);
ssize_t hwinfo_get_device_id(uint8_t * buffer, size_t length);

#endif /* STAND_IN_ZEPHYR_HWINFO_H */
