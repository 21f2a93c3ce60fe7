/* SPDX-License-Identifier: Apache-2.0 */
/* One task alone calls a library for several. */
#include "microros/port.h"

void port_lock(void)
{
}

void port_unlock(void)
{
}
