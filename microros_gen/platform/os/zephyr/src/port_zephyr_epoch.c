/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr.h"

#include <stdbool.h>

static struct k_spinlock guard;
static int64_t offset_ns; /* of the time of day from the steady time */
static bool is_set;

void port_zephyr_epoch_set(int64_t now_ns)
{
  const int64_t steady_ns = port_time_steady_ns();
  const k_spinlock_key_t key = k_spin_lock(&guard);

  offset_ns = now_ns - steady_ns;
  is_set = true;
  k_spin_unlock(&guard, key);
}

/* 0 until it was set. */
int64_t port_time_epoch_ns(void)
{
  const int64_t steady_ns = port_time_steady_ns();
  const k_spinlock_key_t key = k_spin_lock(&guard);
  const int64_t now_ns = is_set ? steady_ns + offset_ns : 0;

  k_spin_unlock(&guard, key);
  return now_ns;
}
