/* SPDX-License-Identifier: Apache-2.0 */
/* A client of parameters in the hands of the test: one call for each line of standard input. */
#include "parameter_client_calls.h"
#include "port_fake.h"

#include "microros/port.h"

enum { STEP_MS = 5 };

/* Time passes in steps: the test delivers between them. */
void port_wait(intptr_t handle, uint32_t timeout_ms_)
{
  (void)handle;
  port_sleep_ms(timeout_ms_ < (uint32_t)STEP_MS ? timeout_ms_ : (uint32_t)STEP_MS);
}

void port_wake(void)
{
}

int main(void)
{
  for (;;) {
    char * line = fake_read_line();

    if (strcmp(line, "quit") == 0) {
      return 0;
    }
    if (!fake_take_line(line)) {
      static char copy[4096]; /* the line's memory is used again when time passes */

      (void)snprintf(copy, sizeof(copy), "%s", line);
      calls_run(copy);
    }
  }
}
