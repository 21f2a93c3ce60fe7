/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr.h"

#if !defined(CONFIG_PRIORITY_CEILING) || CONFIG_PRIORITY_CEILING > 0
#error "prj.conf: let CONFIG_PRIORITY_CEILING admit the priorities of all threads that call the library (-127: all)"
#endif

static K_MUTEX_DEFINE(lock); /* mutexes of the kernel are recursive, and inherit priority */

void port_lock(void)
{
  (void)k_mutex_lock(&lock, K_FOREVER); /* waits without a limit */
}

void port_unlock(void)
{
  (void)k_mutex_unlock(&lock);
}
