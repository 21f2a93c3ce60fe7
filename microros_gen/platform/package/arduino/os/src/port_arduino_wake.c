/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_arduino.h"

static volatile bool wake_pending; /* one byte: read and written atomically */

void port_wake(void)
{
  wake_pending = true;
}

bool port_arduino_woken(void)
{
  const bool is_woken = wake_pending;

  if (is_woken) {
    wake_pending = false;
  }
  return is_woken;
}
