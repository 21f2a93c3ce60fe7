/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest_link.h"

#include "microros/port.h"

#include <stdint.h>

enum { PAUSE_MS = 200, TRIES = 10 };

selftest_link_t selftest_link_again(bool (*open)(void), bool (*is_answered)(void), bool was_answered)
{
  selftest_link_t link = {false, false};

  for (uint8_t i = 0; i < (uint8_t)TRIES && !link.is_answered; ++i) {
    link.opens = open();
    link.is_answered = is_answered();
    if (!link.opens || !link.is_answered) {
      port_sleep_ms(PAUSE_MS);
    }
    if (link.opens && !was_answered) {
      break;
    }
  }
  return link;
}
