/* SPDX-License-Identifier: Apache-2.0 */
/* The ring of the console on the host: lines in order at each place of it, dropped lines, DMA, and printed bytes. */
#include "port_bare_console_ring.c"

#include "port_bare_stdio_ring.c"

#include "unit_expect.h"

#include <string.h>

enum { SIZE = PORT_BOARD_CONSOLE_SIZE };

static uint32_t asked; /* calls of port_console_send */
static uint32_t now_ms = UINT32_MAX - 20u; /* wraps while a byte waits for room */
static bool line_moves; /* one byte is sent each time that the time is read */
static uint8_t last_sent;

void port_console_send(void)
{
  ++asked;
}

uint32_t port_time_ms(void)
{
  ++now_ms;
  if (line_moves) {
    (void)port_console_next(&last_sent);
  }
  return now_ms;
}

/* Takes all bytes: one by one as an interrupt, or in transfers as DMA, at most two. */
static size_t drain(uint8_t * out, bool by_transfers)
{
  const volatile uint8_t * bytes;
  uint32_t transfers = 0;
  size_t size = 0;

  if (!by_transfers) {
    while (port_console_next(&out[size])) {
      ++size;
    }
    return size;
  }
  for (uint32_t count = port_console_unsent(&bytes); count != 0u; count = port_console_unsent(&bytes)) {
    for (uint32_t i = 0; i < count; ++i) {
      out[size++] = bytes[i];
    }
    EXPECT(!port_console_is_idle());
    port_console_sent(count);
    ++transfers;
  }
  EXPECT(transfers <= 2u);
  return size;
}

static void takes_what_fits_and_waits_for_nothing(void)
{
  char text[SIZE + 1];
  uint8_t out[SIZE + 1];

  for (uint32_t round = 0; round < 500u; ++round) { /* each begins at another place of the ring */
    const uint32_t first = round % SIZE;
    const uint32_t before = now_ms;

    for (uint32_t i = 0; i < SIZE; ++i) {
      text[i] = (char)('0' + (round + i) % 75u);
    }
    EXPECT(port_console_is_idle());
    asked = 0;
    EXPECT(!port_console_write(text, SIZE + 1u) && asked == 0u);
    EXPECT(port_console_write(text, first));
    EXPECT(port_console_write(&text[first], SIZE - first));
    EXPECT(asked == 2u && now_ms == before && !port_console_is_idle());
    EXPECT(drain(out, round % 2u == 0u) == SIZE && memcmp(out, text, SIZE) == 0);
    EXPECT(port_console_write(text, 7));
    EXPECT(drain(out, round % 2u != 0u) == 7u);
  }
}

static void takes_lines_again_when_half_is_free(void)
{
  const char text[SIZE] = {0};
  uint8_t byte;
  uint32_t sent = 0;

  EXPECT(port_console_write(text, SIZE));
  EXPECT(!port_console_write(text, 1));
  while (!port_console_write(text, 1)) {
    EXPECT(port_console_next(&byte));
    ++sent;
  }
  EXPECT(sent == SIZE / 2u);
  EXPECT(port_console_next(&byte) && port_console_write(text, 1)); /* nothing was dropped since then */
  while (port_console_next(&byte)) {
    ++sent;
  }
}

static void prints_through_the_ring(void)
{
  uint8_t out[SIZE + 1];
  uint32_t before;

  for (uint32_t i = 0; i < SIZE; ++i) {
    EXPECT(port_console_put((const uint8_t *)"x", 1));
  }
  before = now_ms;
  port_stdio_put(99); /* lost: the line sends nothing */
  EXPECT(now_ms - before > 40u && now_ms - before < 50u && now_ms < before);
  EXPECT(drain(out, false) == SIZE && out[SIZE - 1] == (uint8_t)'x');
  line_moves = true;
  for (uint32_t i = 0; i < 3u * SIZE; ++i) {
    port_stdio_put((uint8_t)i);
  }
  line_moves = false;
  (void)drain(out, false);
  EXPECT(out[0] == (uint8_t)(last_sent + 1u)); /* none is missing */
}

int main(void)
{
  takes_what_fits_and_waits_for_nothing();
  takes_lines_again_when_half_is_free();
  prints_through_the_ring();
  return failures == 0 ? 0 : 1;
}
