/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_arduino.h"

#include <stdbool.h>

static int64_t arduino_epoch_offset_ns; /* of the time of day from the steady time */
static bool arduino_epoch_is_set;

void port_arduino_epoch_set(int64_t now_ns)
{
  arduino_epoch_offset_ns = now_ns - port_time_steady_ns();
  arduino_epoch_is_set = now_ns != 0;
}

int64_t port_time_epoch_ns(void)
{
  return arduino_epoch_is_set ? port_time_steady_ns() + arduino_epoch_offset_ns : 0;
}
