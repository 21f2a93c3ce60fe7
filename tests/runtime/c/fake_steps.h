/* SPDX-License-Identifier: Apache-2.0 */
/* Waits of a program in the hands of a test: time passes in steps, and the test delivers between them. */
#ifndef FAKE_STEPS_H
#define FAKE_STEPS_H

#include "microros/port.h"

enum { STEP_MS = 5 };

void port_wait(intptr_t handle, uint32_t timeout_ms_)
{
  (void)handle;
  port_sleep_ms(timeout_ms_ < (uint32_t)STEP_MS ? timeout_ms_ : (uint32_t)STEP_MS);
}

void port_wake(void)
{
}

#endif /* FAKE_STEPS_H */
