/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_diagnosis.h"

#include <Arduino.h>

uint32_t port_time_us(void)
{
  return (uint32_t)micros();
}
