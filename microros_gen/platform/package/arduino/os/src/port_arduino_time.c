/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

#include <Arduino.h>

uint32_t port_time_ms(void)
{
  return (uint32_t)millis();
}
