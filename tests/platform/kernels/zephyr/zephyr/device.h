/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_ZEPHYR_DEVICE_H
#define STAND_IN_ZEPHYR_DEVICE_H

#include <stdbool.h>

struct device {
  const char * name;
};

const struct device * device_get_binding(const char * name);
bool device_is_ready(const struct device * device);

#endif /* STAND_IN_ZEPHYR_DEVICE_H */
