/* SPDX-License-Identifier: Apache-2.0 */
#include "uros_network_interfaces.h"

#include "sdkconfig.h"

#ifdef CONFIG_MICRO_ROS_ESP_NETIF_WLAN

#include "esp_event.h"
#include "esp_log.h"
#include "esp_netif.h"
#include "esp_wifi.h"
#include "freertos/FreeRTOS.h"
#include "freertos/event_groups.h"
#include "nvs_flash.h"

#include <stdbool.h>

enum { JOINED = 1, FAILED = 2 };

static const char * const tag = "micro-ROS";
static StaticEventGroup_t result_storage;
static EventGroupHandle_t result;
static bool was_joined;
static int attempts;

static void on_lost(void)
{
  ++attempts;
  if (was_joined || attempts <= CONFIG_ESP_MAXIMUM_RETRY) {
    ESP_LOGI(tag, "joining %s again", CONFIG_ESP_WIFI_SSID);
    (void)esp_wifi_connect();
  } else {
    (void)xEventGroupSetBits(result, (EventBits_t)FAILED);
  }
}

static void on_wifi(void * context, esp_event_base_t base, int32_t event, void * data)
{
  (void)context;
  (void)base;
  (void)data;
  if (event == (int32_t)WIFI_EVENT_STA_START) {
    (void)esp_wifi_connect();
  } else if (event == (int32_t)WIFI_EVENT_STA_DISCONNECTED) {
    on_lost();
  } else {
    /* not of interest */
  }
}

static void on_address(void * context, esp_event_base_t base, int32_t event, void * data)
{
  const ip_event_got_ip_t * got = (const ip_event_got_ip_t *)data;

  (void)context;
  (void)base;
  (void)event;
  ESP_LOGI(tag, "address " IPSTR, IP2STR(&got->ip_info.ip));
  was_joined = true;
  attempts = 0;
  (void)xEventGroupSetBits(result, (EventBits_t)JOINED);
}

static esp_err_t storage_begin(void)
{
  const esp_err_t error = nvs_flash_init();

  if (error != ESP_ERR_NVS_NO_FREE_PAGES && error != ESP_ERR_NVS_NEW_VERSION_FOUND) {
    return error;
  }
  return nvs_flash_erase() == ESP_OK ? nvs_flash_init() : error;
}

/* Initialized already by the application is as good. */
static esp_err_t network_begin(void)
{
  esp_err_t error = storage_begin();

  if (error == ESP_OK) {
    error = esp_netif_init();
  }
  if (error == ESP_OK || error == ESP_ERR_INVALID_STATE) {
    error = esp_event_loop_create_default();
  }
  return error == ESP_ERR_INVALID_STATE ? ESP_OK : error;
}

static esp_err_t station_begin(void)
{
  const wifi_init_config_t settings = WIFI_INIT_CONFIG_DEFAULT();
  wifi_config_t station = {.sta = {.ssid = CONFIG_ESP_WIFI_SSID, .password = CONFIG_ESP_WIFI_PASSWORD}};
  esp_err_t error = esp_netif_create_default_wifi_sta() != NULL ? esp_wifi_init(&settings) : ESP_ERR_NO_MEM;

  if (error == ESP_OK) {
    error = esp_event_handler_register(WIFI_EVENT, ESP_EVENT_ANY_ID, on_wifi, NULL);
  }
  if (error == ESP_OK) {
    error = esp_event_handler_register(IP_EVENT, IP_EVENT_STA_GOT_IP, on_address, NULL);
  }
  if (error == ESP_OK) {
    error = esp_wifi_set_mode(WIFI_MODE_STA);
  }
  if (error == ESP_OK) {
    error = esp_wifi_set_config(WIFI_IF_STA, &station);
  }
  return error == ESP_OK ? esp_wifi_start() : error;
}

esp_err_t uros_network_interface_initialize(void)
{
  esp_err_t error = network_begin();
  EventBits_t bits;

  result = xEventGroupCreateStatic(&result_storage);
  if (error == ESP_OK) {
    error = station_begin();
  }
  if (error != ESP_OK) {
    ESP_LOGE(tag, "Wi-Fi: %s", esp_err_to_name(error));
    return error;
  }
  bits = xEventGroupWaitBits(result, (EventBits_t)(JOINED | FAILED), pdFALSE, pdFALSE, portMAX_DELAY);
  if ((bits & (EventBits_t)JOINED) == 0u) {
    ESP_LOGE(tag, "cannot join %s: see its name and password in menuconfig", CONFIG_ESP_WIFI_SSID);
    return ESP_FAIL;
  }
  return ESP_OK;
}

#endif /* CONFIG_MICRO_ROS_ESP_NETIF_WLAN */
