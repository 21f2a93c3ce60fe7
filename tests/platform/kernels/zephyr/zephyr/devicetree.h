/* SPDX-License-Identifier: Apache-2.0 */
/* A devicetree whose only alias is microros-uart; it exists with KERNEL_ALIAS. */
#ifndef STAND_IN_ZEPHYR_DEVICETREE_H
#define STAND_IN_ZEPHYR_DEVICETREE_H

#include "zephyr/device.h"

extern const struct device kernel_uart;

#ifdef KERNEL_ALIAS
#define DT_NODE_EXISTS(node) 1
#else
#define DT_NODE_EXISTS(node) 0
#endif
#define DT_ALIAS(name) name
#define DEVICE_DT_GET(node) (&kernel_uart)

#endif /* STAND_IN_ZEPHYR_DEVICETREE_H */
