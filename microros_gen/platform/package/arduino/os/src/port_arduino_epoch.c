/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_arduino.h"

static const int64_t ns_per_ms = 1000000;

static int64_t arduino_epoch_ns; /* at arduino_epoch_ms; 0: not set */
static uint32_t arduino_epoch_ms;

void port_arduino_epoch_set(int64_t now_ns)
{
  arduino_epoch_ms = port_time_ms();
  arduino_epoch_ns = now_ns;
}

int64_t port_time_epoch_ns(void)
{
  const uint32_t now_ms = port_time_ms();

  if (arduino_epoch_ns != 0) {
    arduino_epoch_ns += (int64_t)(now_ms - arduino_epoch_ms) * ns_per_ms;
    arduino_epoch_ms = now_ms;
  }
  return arduino_epoch_ns;
}
