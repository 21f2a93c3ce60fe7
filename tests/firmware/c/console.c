/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Logs a burst of lines to the console, then lets the library run, without an agent. CONSOLE_MARKS: mark() follows each
 * line, for the trace of the emulator, which ends after the burst.
 */
#include <microros/port.h>
#include <microros/port_bare.h>
#include <microros/port_console_uart.h>
#ifdef CONSOLE_OWN
#include <microros/port_cortex_m.h>
#endif
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>

enum { LINES = 60, DONE = 1 };

typedef struct console_report_t {
  uint32_t done;
  uint32_t dropped;
  uint32_t elapsed_ms;
  uint32_t idle;
} console_report_t;

volatile console_report_t console_report;

#ifdef CONSOLE_UDP
/* The agent is not reachable: only the console uses the UART of the board. */
bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  udp->handle = host != NULL && port != 0u ? 1 : 0;
  return true;
}

void port_udp_close(port_udp_t * udp)
{
  udp->handle = 0;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  return udp->handle != 0 && data != NULL && size != 0u;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  return udp->handle != 0 && buffer != NULL && capacity == 0u ? -1 : 0;
}
#endif

#ifdef CONSOLE_OWN
/* A driver of the application for the UART of Arm's CMSDK, whose transfers are one byte, as those of a DMA controller. */
#define OWN_REGISTER(offset) (*(volatile uint32_t *)(0x40004000u + (offset)))

enum { OWN_DATA = 0x00, OWN_STATE = 0x04, OWN_CTRL = 0x08, OWN_INTCLEAR = 0x0c, OWN_BAUDDIV = 0x10 };
enum { OWN_OUTPUT = 0x05, OWN_FULL = 0x01, OWN_IRQ = 1 };

void own_console_interrupt(void);

void own_console_interrupt(void)
{
  static uint32_t transfer;
  const volatile uint8_t * bytes;

  OWN_REGISTER(OWN_INTCLEAR) = 1u;
  if ((OWN_REGISTER(OWN_STATE) & OWN_FULL) != 0u) {
    return;
  }
  port_console_sent(transfer);
  transfer = port_console_unsent(&bytes) != 0u ? 1u : 0u;
  if (transfer != 0u) {
    OWN_REGISTER(OWN_DATA) = bytes[0];
  }
}

void port_console_send(void)
{
  if (OWN_REGISTER(OWN_CTRL) != OWN_OUTPUT) {
    OWN_REGISTER(OWN_BAUDDIV) = 217u;
    OWN_REGISTER(OWN_CTRL) = OWN_OUTPUT;
    port_cortex_m_interrupt_enable(OWN_IRQ);
  }
  port_cortex_m_interrupt_pend(OWN_IRQ);
}
#endif

void mark(void);

/* Not inlined: its address is what the trace looks for. */
__attribute__((noinline)) void mark(void)
{
  __asm volatile("" ::: "memory");
}

/* Ends the emulator (semihosting: SYS_EXIT, ADP_Stopped_ApplicationExit). */
static void finish(void)
{
#ifdef CONSOLE_MARKS
  register uintptr_t operation __asm__("r0") = 0x18u;
  register uintptr_t reason __asm__("r1") = 0x20026u;

  __asm volatile("bkpt 0xab" : : "r"(operation), "r"(reason) : "memory");
#endif
}

int main(void)
{
  static rclc_support_t support;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  const uint32_t start = port_time_ms();

  mark();
  for (int i = 0; i < LINES; ++i) {
    RCUTILS_LOG_INFO_NAMED("board", "burst %d", i);
    mark();
  }
  finish();
  console_report.elapsed_ms = port_time_ms() - start;
  console_report.dropped = rcutils_logging_get_counts().dropped;
  console_report.idle = port_console_is_idle() ? 1u : 0u;
  console_report.done = DONE;
  for (;;) {
    (void)rclc_support_init(&support, 0, NULL, &allocator);
    console_report.idle = port_console_is_idle() ? 1u : 0u;
  }
}
