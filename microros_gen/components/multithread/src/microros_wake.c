/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/wake.h"

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
