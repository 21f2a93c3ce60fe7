/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"

static const int64_t ns_per_ms = 1000000;

static int64_t port_bare_epoch_ns; /* at port_bare_epoch_ms; 0: not set */
static uint32_t port_bare_epoch_ms;

void port_bare_epoch_set(int64_t now_ns)
{
  port_bare_epoch_ms = port_time_ms();
  port_bare_epoch_ns = now_ns;
}

int64_t port_time_epoch_ns(void)
{
  const uint32_t now_ms = port_time_ms();

  if (port_bare_epoch_ns != 0) {
    port_bare_epoch_ns += (int64_t)(now_ms - port_bare_epoch_ms) * ns_per_ms;
    port_bare_epoch_ms = now_ms;
  }
  return port_bare_epoch_ns;
}
