/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_freertos.h"

#include "task.h"

#include <stdbool.h>

static int64_t offset_ns; /* of the time of day from the steady time */
static bool is_set;

void port_freertos_epoch_set(int64_t now_ns)
{
  const int64_t steady_ns = port_time_steady_ns();

  taskENTER_CRITICAL();
  offset_ns = now_ns - steady_ns;
  is_set = true;
  taskEXIT_CRITICAL();
}

/* 0 until it was set. */
int64_t port_time_epoch_ns(void)
{
  const int64_t steady_ns = port_time_steady_ns();
  int64_t now_ns;

  taskENTER_CRITICAL();
  now_ns = is_set ? steady_ns + offset_ns : 0;
  taskEXIT_CRITICAL();
  return now_ns;
}
