/* SPDX-License-Identifier: Apache-2.0 */
/* Joins the Wi-Fi network that `idf.py menuconfig` was told (Example Connection Configuration), then counts. */
#include "../../counter.h"

#include <esp_err.h>
#include <esp_event.h>
#include <esp_netif.h>
#include <nvs_flash.h>
#include <protocol_examples_common.h>

void app_main(void);

void app_main(void)
{
  ESP_ERROR_CHECK(nvs_flash_init());
  ESP_ERROR_CHECK(esp_netif_init());
  ESP_ERROR_CHECK(esp_event_loop_create_default());
  ESP_ERROR_CHECK(example_connect());
  for (;;) {
    counter_run(); /* again until there is an agent */
  }
}
