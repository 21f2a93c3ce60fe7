/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_arrivals.h"
#include "microros/xrce_deadlines.h"

void xrce_deadlines_before(const xrce_client_t * client)
{
  for (uint16_t i = 0; i < (uint16_t)MICROROS_SUBSCRIPTIONS_MAX; ++i) {
    xrce_deadline_at((uint16_t)(MICROROS_PUBLISHERS_MAX + i))->before = xrce_arrivals(client, i);
  }
}

void xrce_deadlines_after(const xrce_client_t * client)
{
  for (uint16_t i = 0; i < (uint16_t)MICROROS_SUBSCRIPTIONS_MAX; ++i) {
    const uint16_t index = (uint16_t)(MICROROS_PUBLISHERS_MAX + i);

    if (xrce_arrivals(client, i) != xrce_deadline_at(index)->before) {
      xrce_deadline_meet(client, index);
    }
  }
}
