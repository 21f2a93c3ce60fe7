/* SPDX-License-Identifier: Apache-2.0 */
/* Time, sleep, epoch and the rings of the serial line on the host, where their counters can be set before they wrap. */
#include "port_bare_time.c"

#include "port_bare_epoch.c"
#include "port_bare_steady.c"
#include "port_bare_serial.c"
#include "port_bare_sleep.c"

#include "unit_expect.h"

#include <string.h>

static uint32_t waits;
static uint32_t started;
static uint32_t asked; /* calls of port_uart_send */

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

void port_uart_send(void)
{
  ++asked;
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

static void opens_at_its_own_speed(void)
{
  port_serial_t serial;

  EXPECT(!port_serial_open(&serial, "", PORT_BOARD_UART_BAUD + 1u));
  EXPECT(started == 0);
  EXPECT(port_serial_open(&serial, "", PORT_BOARD_UART_BAUD));
  EXPECT(started == 1);
  port_serial_close(&serial);
  EXPECT(started == 0);
}

enum { OUTPUT_FITS = PORT_BOARD_OUTPUT_SIZE - 1 };

/* Takes everything out: byte by byte as an interrupt, or in transfers as DMA, at most two around the end. */
static size_t drain(uint8_t * out, bool by_transfers)
{
  size_t size = 0;

  if (by_transfers) {
    const volatile uint8_t * bytes;
    uint32_t transfers = 0;

    for (uint32_t count = port_uart_unsent(&bytes); count != 0u; count = port_uart_unsent(&bytes)) {
      for (uint32_t i = 0; i < count; ++i) {
        out[size++] = bytes[i];
      }
      EXPECT(port_serial_room(NULL) == OUTPUT_FITS - count || transfers == 0u);
      port_uart_sent(count);
      ++transfers;
    }
    EXPECT(transfers <= 2u);
    return size;
  }
  while (port_uart_next(&out[size])) {
    ++size;
  }
  return size;
}

static void takes_what_has_room_and_waits_for_nothing(void)
{
  uint8_t text[PORT_BOARD_OUTPUT_SIZE];
  uint8_t out[PORT_BOARD_OUTPUT_SIZE];

  for (uint32_t round = 0; round < 500u; ++round) { /* each begins at another place of the ring */
    const uint32_t first = round % OUTPUT_FITS;

    for (uint32_t i = 0; i < OUTPUT_FITS; ++i) {
      text[i] = (uint8_t)(round + i);
    }
    EXPECT(port_serial_is_idle(NULL) && port_serial_room(NULL) == OUTPUT_FITS);
    asked = 0;
    waits = 0;
    EXPECT(port_serial_write(NULL, text, first));
    EXPECT(port_serial_room(NULL) == OUTPUT_FITS - first);
    EXPECT(!port_serial_write(NULL, text, OUTPUT_FITS - first + 1u));
    EXPECT(port_serial_write(NULL, &text[first], OUTPUT_FITS - first));
    EXPECT(port_serial_room(NULL) == 0u && !port_serial_is_idle(NULL) && !port_serial_write(NULL, text, 1));
    EXPECT(asked == 2u && waits == 0u);
    EXPECT(drain(out, round % 2u == 0u) == OUTPUT_FITS && memcmp(out, text, OUTPUT_FITS) == 0);
    (void)port_serial_write(NULL, text, 7);
    EXPECT(drain(out, round % 2u != 0u) == 7u);
  }
}

/* A message that is not copied: KEPT_SIZE bytes, which count up from `first`. */
typedef struct source_t {
  uint8_t given;
  uint8_t first;
} source_t;

enum { KEPT_SIZE = 200 };

static int32_t give(void * context)
{
  source_t * source = (source_t *)context;

  if (source->given == KEPT_SIZE) {
    return -1;
  }
  ++source->given;
  return (uint8_t)(source->first + source->given - 1u);
}

/* It is sent after earlier bytes and before bytes that are written meanwhile; it may be larger than the ring. */
static void sends_what_it_does_not_copy_in_its_turn(void)
{
  uint8_t text[PORT_BOARD_OUTPUT_SIZE] = {0};
  uint8_t byte = 0;

  for (uint32_t round = 0; round < 200u; ++round) {
    const uint32_t before = round % OUTPUT_FITS;
    source_t source = {0, (uint8_t)round};

    EXPECT(port_serial_write(NULL, text, before));
    asked = 0;
    EXPECT(!port_serial_has_kept(NULL) && port_serial_send_kept(NULL, give, &source) && asked == 1u);
    EXPECT(port_serial_has_kept(NULL) && !port_serial_send_kept(NULL, give, &source));
    EXPECT(port_serial_room(NULL) == OUTPUT_FITS - before);
    for (uint32_t i = 0; i < before; ++i) {
      EXPECT(port_uart_next(&byte) && byte == 0u);
    }
    text[0] = 99;
    EXPECT(port_serial_write(NULL, text, 1));
    for (uint32_t i = 0; i < KEPT_SIZE; ++i) {
      EXPECT(!port_serial_is_idle(NULL) && port_uart_next(&byte) && byte == (uint8_t)(round + i));
    }
    EXPECT(port_serial_has_kept(NULL) && port_uart_next(&byte) && byte == 99u && !port_serial_has_kept(NULL));
    EXPECT(port_serial_is_idle(NULL) && !port_uart_next(&byte));
    text[0] = 0;
  }
}

static void breaks_off_what_it_does_not_copy(void)
{
  port_serial_t serial;
  source_t source = {0, 0};
  uint8_t byte = 7;

  EXPECT(port_serial_open(&serial, "", PORT_BOARD_UART_BAUD));
  EXPECT(port_serial_send_kept(&serial, give, &source) && port_uart_next(&byte));
  EXPECT(port_serial_write(&serial, &byte, 1));
  port_serial_break_off(&serial);
  EXPECT(
    !port_serial_has_kept(&serial) && port_uart_next(&byte) && !port_uart_next(&byte) && source.given == 1u);
  EXPECT(port_serial_send_kept(&serial, give, &source));
  port_serial_close(&serial);
  EXPECT(port_serial_is_idle(&serial) && !port_uart_next(&byte) && source.given == 1u);
}

static void gives_up_what_was_not_sent_when_it_is_closed(void)
{
  port_serial_t serial;
  uint8_t byte = 5;

  EXPECT(port_serial_open(&serial, "", PORT_BOARD_UART_BAUD));
  EXPECT(port_serial_write(&serial, &byte, 1));
  port_serial_close(&serial);
  EXPECT(port_serial_is_idle(&serial) && !port_uart_next(&byte));
}

int main(void)
{
  sleeps_at_least_as_long_as_asked();
  tells_the_epoch_over_a_wrap();
  keeps_what_fits_and_counts_the_rest();
  opens_at_its_own_speed();
  takes_what_has_room_and_waits_for_nothing();
  gives_up_what_was_not_sent_when_it_is_closed();
  sends_what_it_does_not_copy_in_its_turn();
  breaks_off_what_it_does_not_copy();
  return failures == 0 ? 0 : 1;
}
