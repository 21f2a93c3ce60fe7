/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

#include <Arduino.h>

/* delay() yields to the tasks and the network of cores that have them. The current millisecond is not counted. */
void port_sleep_ms(uint32_t duration_ms)
{
  if (duration_ms == 0u) {
    yield();
  } else {
    delay((unsigned long)duration_ms + 1u);
  }
}
