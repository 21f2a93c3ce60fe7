/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"

bool microros_lock_silent;

void microros_lock_rest(void)
{
  port_unlock();
  port_sleep_ms(1);
  port_lock();
}
