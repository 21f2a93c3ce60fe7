/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_ESP_NETIF_H
#define STAND_IN_ESP_NETIF_H

int esp_netif_init(void);

#endif /* STAND_IN_ESP_NETIF_H */
