/* SPDX-License-Identifier: Apache-2.0 */
/* The stand-ins over POSIX, and what starts the application instead of ESP-IDF. */
#include "esp_event.h"
#include "esp_netif.h"
#include "esp_timer.h"
#include "freertos/task.h"
#include "nvs_flash.h"
#include "protocol_examples_common.h"

#include <time.h>
#include <unistd.h>

void app_main(void);

int64_t esp_timer_get_time(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

void vTaskDelay(TickType_t ticks)
{
  (void)usleep(ticks * 10000u);
}

int nvs_flash_init(void)
{
  return 0;
}

int esp_netif_init(void)
{
  return 0;
}

int esp_event_loop_create_default(void)
{
  return 0;
}

int example_connect(void)
{
  return 0;
}

int main(void)
{
  app_main();
  return 1;
}
