/* SPDX-License-Identifier: Apache-2.0 */
#ifndef UROS_NETWORK_INTERFACES_H
#define UROS_NETWORK_INTERFACES_H

#include "esp_err.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Joins the Wi-Fi network of menuconfig, and waits until there is an address. Call it once, in a task, before
 * rclc_support_init. It initializes flash storage, network interfaces and the default event loop; each may be initialized
 * already.
 * Returns ESP_FAIL after CONFIG_ESP_MAXIMUM_RETRY failed attempts, or the error of the first function that failed. A network
 * that is lost later is joined again without an end. */
esp_err_t uros_network_interface_initialize(void);

#ifdef __cplusplus
}
#endif

#endif /* UROS_NETWORK_INTERFACES_H */
