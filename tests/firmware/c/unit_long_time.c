/* SPDX-License-Identifier: Apache-2.0 */
/* The clock of a port while the library pumps and waits, and the program does not read it, over several wraps. */
#include "microros/port.h"
#include "microros/xrce_long_time.h"

#include "unit_expect.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

enum { RUNS = 200, WRAPS = 5 };

void EPOCH_SET(int64_t now_ns);
unsigned long millis(void);
unsigned long micros(void);

static const int64_t ns_per_ms = 1000000;
static uint64_t true_ms;

uint32_t port_time_ms(void)
{
  return (uint32_t)true_ms;
}

unsigned long millis(void)
{
  return (uint32_t)true_ms;
}

unsigned long micros(void)
{
  return (uint32_t)(true_ms * 1000u);
}

/* The longest waits that the library allows, and shorter ones that chance decides. */
static void live(uint64_t until_ms, bool by_chance)
{
  xrce_client_t client = {0};

  while (true_ms < until_ms) {
    const uint32_t most = xrce_long_time_left(UINT32_MAX);

    xrce_long_time_step(&client, port_time_ms());
    true_ms += by_chance ? 1u + (uint64_t)((double)rand() / ((double)RAND_MAX + 1.0) * most) : most;
  }
  xrce_long_time_step(&client, port_time_ms());
}

int main(void)
{
  static const int64_t epoch_ns = INT64_C(1790000000000000000);

  EXPECT(xrce_long_time_left(5) == 5u);
  EXPECT(port_time_epoch_ns() == 0);
  for (int run = 0; run < RUNS; ++run) {
    const uint64_t begin_ms = true_ms;
    const int64_t steady_ns = port_time_steady_ns();

    EPOCH_SET(epoch_ns);
    EXPECT(port_time_epoch_ns() == epoch_ns);
    live(begin_ms + ((uint64_t)WRAPS << 32), run % 2 != 0);
    EXPECT(port_time_steady_ns() - steady_ns == (int64_t)(true_ms - begin_ms) * ns_per_ms);
    EXPECT(port_time_epoch_ns() - epoch_ns == (int64_t)(true_ms - begin_ms) * ns_per_ms);
  }
  EPOCH_SET(0);
  EXPECT(port_time_epoch_ns() == 0);
  return failures == 0 ? 0 : 1;
}
