/* SPDX-License-Identifier: Apache-2.0 */
/* Time, sleep, epoch and the ring of the serial line on the host, where their counters can be set before they wrap. */
#include "port_bare_time.c"

#include "port_bare_epoch.c"
#include "port_bare_serial.c"
#include "port_bare_sleep.c"

#include <stdio.h>

static int failures;
static uint32_t waits;
static bool stuck;
static uint32_t started;
static uint8_t sent[64];
static size_t sent_size;

#define EXPECT(condition) \
  do { \
    if (!(condition)) { \
      (void)printf("%d: %s\n", __LINE__, #condition); \
      ++failures; \
    } \
  } while (0)

void port_bare_wait(void)
{
  ++waits;
  port_bare_tick();
}

void port_uart_start(void)
{
  ++started;
}

void port_uart_stop(void)
{
  --started;
}

bool port_uart_put(uint8_t byte)
{
  if (!stuck) {
    sent[sent_size++] = byte;
  }
  return !stuck;
}

static void sleeps_at_least_as_long_as_asked(void)
{
  waits = 0;
  port_sleep_ms(0);
  EXPECT(waits == 0);
  port_sleep_ms(5);
  EXPECT(waits == 6);
  port_bare_now_ms = UINT32_MAX - 2u;
  waits = 0;
  port_sleep_ms(5);
  EXPECT(waits == 6);
  EXPECT(port_time_ms() == 3u);
}

static void tells_the_epoch_over_a_wrap(void)
{
  EXPECT(port_time_epoch_ns() == 0);
  port_bare_now_ms = UINT32_MAX - 9u;
  EXPECT(port_time_epoch_ns() == 0);
  port_bare_epoch_set(1700000000000000000);
  port_sleep_ms(19);
  EXPECT(port_time_epoch_ns() == 1700000000020000000);
  port_bare_now_ms += UINT32_MAX;
  EXPECT(port_time_epoch_ns() == 1700000000020000000 + (int64_t)UINT32_MAX * 1000000);
}

static void keeps_what_fits_and_counts_the_rest(void)
{
  enum { FITS = PORT_BOARD_RING_SIZE - 1 };
  uint8_t taken[PORT_BOARD_RING_SIZE];

  for (uint32_t round = 0; round < 500u; ++round) { /* each begins at another place of the ring */
    for (uint32_t i = 0; i < FITS; ++i) {
      port_uart_received((uint8_t)(round + i));
    }
    for (uint32_t i = 0; i < FITS; ++i) {
      EXPECT(port_serial_read(NULL, &taken[i], 1) == 1u && taken[i] == (uint8_t)(round + i));
    }
    EXPECT(port_serial_read(NULL, taken, sizeof(taken)) == 0u);
  }
  EXPECT(port_bare_serial_lost() == 0u);
  for (uint32_t i = 0; i < FITS + 3u; ++i) {
    port_uart_received((uint8_t)i);
  }
  EXPECT(port_bare_serial_lost() == 3u);
  EXPECT(port_serial_read(NULL, taken, sizeof(taken)) == FITS);
  EXPECT(taken[0] == 0u && taken[FITS - 1] == (uint8_t)(FITS - 1));
}

static void opens_at_its_own_speed_and_gives_up_on_a_line_that_stands_still(void)
{
  port_serial_t serial;
  const uint8_t text[3] = {1, 2, 3};

  EXPECT(!port_serial_open(&serial, "", PORT_BOARD_UART_BAUD + 1u));
  EXPECT(started == 0);
  EXPECT(port_serial_open(&serial, "", PORT_BOARD_UART_BAUD));
  EXPECT(started == 1);
  EXPECT(port_serial_write(&serial, text, sizeof(text)));
  EXPECT(sent_size == 3 && sent[2] == 3);
  stuck = true;
  EXPECT(!port_serial_write(&serial, text, sizeof(text)));
  port_serial_close(&serial);
  EXPECT(started == 0);
}

int main(void)
{
  sleeps_at_least_as_long_as_asked();
  tells_the_epoch_over_a_wrap();
  keeps_what_fits_and_counts_the_rest();
  opens_at_its_own_speed_and_gives_up_on_a_line_that_stands_still();
  return failures == 0 ? 0 : 1;
}
