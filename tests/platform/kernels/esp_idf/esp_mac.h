/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of ESP-IDF that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_ESP_MAC_H
#define STAND_IN_ESP_MAC_H

#include <stdint.h>

typedef int esp_err_t;
#define ESP_OK 0

esp_err_t esp_efuse_mac_get_default(uint8_t * mac);

#endif /* STAND_IN_ESP_MAC_H */
