/* SPDX-License-Identifier: Apache-2.0 */
/* Timer 1 counts the processor's clock from 0 to OCR1A in a millisecond (mode 4, CTC). `-u port_bare_board_init` of the target
 * links this file. */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_board.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

typedef char board_assert_timer_has_16_bits[PORT_BOARD_TICKS_PER_MS <= 65536UL ? 1 : -1];

void board_watchdog_off(void) __attribute__((naked, used, section(".init3")));
void board_restart(void) __attribute__((naked, used, section(".fini8")));
static void board_start(void) __attribute__((constructor, used));

enum { RESTART_PAUSE_MS = 1000 };

/* After a reset by the watchdog it stays on, with its shortest time, until this. */
void board_watchdog_off(void)
{
  MCUSR = 0;
  wdt_disable();
}

ISR(TIMER1_COMPA_vect)
{
  port_bare_tick();
}

void port_bare_board_init(void)
{
  TCCR1A = 0;
  OCR1A = (uint16_t)(PORT_BOARD_TICKS_PER_MS - 1u);
  TIMSK1 = _BV(OCIE1A);
  TCCR1B = _BV(WGM12) | _BV(CS10);
  sei();
}

/* The start-up code of avr-libc calls it before main(). */
static void board_start(void)
{
  port_bare_board_init();
}

/* After main() has returned, as on every board. */
void board_restart(void)
{
  port_sleep_ms(RESTART_PAUSE_MS);
  port_bare_reset();
}

void port_bare_reset(void)
{
  wdt_enable(WDTO_15MS);
  for (;;) {
  }
}
