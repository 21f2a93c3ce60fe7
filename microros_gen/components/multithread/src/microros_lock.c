/* SPDX-License-Identifier: Apache-2.0 */
/* What tasks share: the lock, and news for those that wait. */
#include "microros/lock.h"

#include "microros/wake.h"

bool microros_lock_silent;

void microros_lock_rest(void)
{
  port_unlock();
  port_sleep_ms(1);
  port_lock();
}

microros_shared_flag_t microros_is_woken;

static uint32_t news; /* with the lock */

void microros_note(void)
{
  ++news;
}

uint32_t microros_news(void)
{
  if (microros_flag_is_set(&microros_is_woken)) {
    microros_flag_clear(&microros_is_woken); /* first: who calls looks after it */
    ++news;
  }
  return news;
}
