/* SPDX-License-Identifier: Apache-2.0 */
/* A firmware as vendors' tools make it: names of CMSIS, its own start-up; it publishes nothing. */
#include <microros/port.h>
#include <microros/port_bare.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

extern uint32_t _estack;

uint32_t SystemCoreClock = 25000000u;

void SystemInit(void)
{
}

#ifdef OWN_TIME
/* An RTOS below: it has the system timer, and time, sleep and waiting are its own. */
static volatile uint32_t vendor_ticks;

void SysTick_Handler(void)
{
  ++vendor_ticks;
}

uint32_t port_time_ms(void)
{
  return vendor_ticks;
}

void port_sleep_ms(uint32_t ms)
{
  const uint32_t start = vendor_ticks;
  while (vendor_ticks - start < ms) {
  }
}
#else
void SysTick_Handler(void)
{
  port_bare_tick();
}
#endif

void HardFault_Handler(void)
{
  for (;;) {
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK ? (int)port_time_ms() : 1;
}

void Reset_Handler(void)
{
  SystemInit();
  (void)main();
}

void * const g_pfnVectors[] __attribute__((section(".isr_vector"), used)) = {
  &_estack, Reset_Handler, HardFault_Handler, HardFault_Handler, [15] = SysTick_Handler};
