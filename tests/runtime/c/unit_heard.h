/* SPDX-License-Identifier: Apache-2.0 */
/* How many samples a subscription has had, for programs of several threads: on_sample is its callback. */
#ifndef UNIT_HEARD_H
#define UNIT_HEARD_H

#include <microros/port.h>

#include <stdint.h>

static uint32_t heard; /* the lock of the port guards it */

static void on_sample(const void * sample)
{
  (void)sample;
  port_lock();
  ++heard;
  port_unlock();
}

static uint32_t heard_now(void)
{
  uint32_t value;

  port_lock();
  value = heard;
  port_unlock();
  return value;
}

#endif /* UNIT_HEARD_H */
