/* SPDX-License-Identifier: Apache-2.0 */
#ifndef HOST_ZEPHYR_DEVICE_H
#define HOST_ZEPHYR_DEVICE_H

#include <stdbool.h>

struct device {
  const char * name;
};

extern const struct device host_uart;

bool device_is_ready(const struct device * device);

#endif /* HOST_ZEPHYR_DEVICE_H */
