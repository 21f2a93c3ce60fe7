/* SPDX-License-Identifier: Apache-2.0 */
/* The vector table (Arm Architecture Reference Manuals, "Vector tables"). The linker script places it first, by the name of its section. */
#include "microros/port_bare.h"
#include "microros/port_board.h"
#include "microros/port_cortex_m.h"

typedef void (* port_cortex_m_handler_t)(void);

typedef struct port_cortex_m_vectors_t {
  const uint32_t * stack;
  port_cortex_m_handler_t exceptions[15];
  port_cortex_m_handler_t interrupts[PORT_BOARD_INTERRUPTS];
} port_cortex_m_vectors_t;

extern const uint32_t port_stack_high[];
extern const port_cortex_m_vectors_t port_cortex_m_vectors;

const port_cortex_m_vectors_t port_cortex_m_vectors = {
  port_stack_high,
  {
    port_cortex_m_reset, /* 1 */
    port_cortex_m_fault, /* 2 */
    port_cortex_m_fault, /* 3 */
    port_cortex_m_fault, /* 4 */
    port_cortex_m_fault, /* 5 */
    port_cortex_m_fault, /* 6 */
    port_cortex_m_fault, /* 7 */
    port_cortex_m_fault, /* 8 */
    port_cortex_m_fault, /* 9 */
    port_cortex_m_fault, /* 10 */
    port_cortex_m_fault, /* 11 */
    port_cortex_m_fault, /* 12 */
    port_cortex_m_fault, /* 13 */
    port_cortex_m_fault, /* 14 */
    port_bare_tick, /* 15: SysTick */
  },
  {
    port_cortex_m_uart_interrupt, /* 16: interrupt 0 */
    port_cortex_m_uart_interrupt, /* 17: interrupt 1 */
  },
};
