/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_diagnosis.h"

uint32_t port_time_us(void)
{
  return (uint32_t)(((uint64_t)port_time_steady_ns() / 1000u) & UINT32_MAX);
}
