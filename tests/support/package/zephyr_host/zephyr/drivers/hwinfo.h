/* SPDX-License-Identifier: Apache-2.0 */
#ifndef HOST_ZEPHYR_HWINFO_H
#define HOST_ZEPHYR_HWINFO_H

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

ssize_t hwinfo_get_device_id(uint8_t * buffer, size_t length);

#endif /* HOST_ZEPHYR_HWINFO_H */
