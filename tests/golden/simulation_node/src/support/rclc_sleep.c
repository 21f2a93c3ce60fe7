/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc/sleep.h"

#include "microros/port.h"

void rclc_sleep_ms(unsigned int ms)
{
  port_sleep_ms(ms);
}
