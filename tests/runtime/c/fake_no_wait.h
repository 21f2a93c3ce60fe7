/* SPDX-License-Identifier: Apache-2.0 */
/* Nothing arrives at a program in the hands of a test before the test says so: no test lets the executor wait. */
#ifndef FAKE_NO_WAIT_H
#define FAKE_NO_WAIT_H

#include "microros/port.h"

#include <stdlib.h>

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  (void)timeout_ms;
  abort();
}

void port_wake(void)
{
}

#endif /* FAKE_NO_WAIT_H */
