/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_arduino.h"

#include <Arduino.h>

/* No core tells when something arrives, so the caller looks again after a millisecond. */
void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  if (timeout_ms != 0u && !port_arduino_woken()) {
    delay(1);
  }
}
