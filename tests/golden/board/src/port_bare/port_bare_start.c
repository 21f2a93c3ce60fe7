/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"

enum { RESTART_PAUSE_MS = 1000 };

typedef void (*start_function_t)(void);

/* From the linker script. */
extern const uint32_t port_data_load[];
extern uint32_t port_data_start[];
extern uint32_t port_data_end[];
extern uint32_t port_bss_start[];
extern uint32_t port_bss_end[];
extern const start_function_t port_init_start[];
extern const start_function_t port_init_end[];


extern int main(void);

static void start_set_up_variables(void)
{
  const uint32_t * from = port_data_load;

  for (uint32_t * to = port_data_start; to != port_data_end; ++to) {
    *to = *from;
    ++from;
  }
  for (uint32_t * to = port_bss_start; to != port_bss_end; ++to) {
    *to = 0;
  }
}

void port_bare_start(void)
{
  start_set_up_variables();
  port_bare_board_init();
  for (const start_function_t * init = port_init_start; init != port_init_end; ++init) {
    (*init)(); /* constructors of C++ */
  }
  (void)main(); /* its status has no receiver */
  port_sleep_ms(RESTART_PAUSE_MS);
  port_bare_reset();
}
