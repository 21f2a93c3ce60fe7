/* SPDX-License-Identifier: Apache-2.0 */
/* What the library asks of the Pico SDK. */
#include "microros/port.h"

#include "pico/mutex.h"
#include "pico/time.h"
#include "pico/unique_id.h"

#include <stddef.h>

auto_init_recursive_mutex(lock);

uint32_t port_time_ms(void)
{
  return to_ms_since_boot(get_absolute_time());
}

int64_t port_time_steady_ns(void)
{
  return (int64_t)to_us_since_boot(get_absolute_time()) * 1000;
}

/* 0: a Pico does not know the time of day. `+time_sync` asks the agent. */
int64_t port_time_epoch_ns(void)
{
  return 0;
}

uint32_t port_time_us(void)
{
  return (uint32_t)to_us_since_boot(get_absolute_time());
}

void port_sleep_ms(uint32_t duration_ms)
{
  sleep_ms(duration_ms);
}

/* Between the two processors; without inheritance of priorities, since they have none. */
void port_lock(void)
{
  recursive_mutex_enter_blocking(&lock);
}

void port_unlock(void)
{
  recursive_mutex_exit(&lock);
}

/* The library waits in the transport's read function. */
void port_wake(void)
{
}

/* FNV-1a of the number of the flash memory or of the chip, so that each of its bytes counts. */
uint32_t port_unique_id(void)
{
  pico_unique_board_id_t board;
  uint32_t id = 2166136261u;

  pico_get_unique_board_id(&board);
  for (size_t i = 0; i < sizeof(board.id); ++i) {
    id = (id ^ board.id[i]) * 16777619u;
  }
  return id == 0u ? 1u : id;
}
