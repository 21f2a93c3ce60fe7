/* SPDX-License-Identifier: Apache-2.0 */
/* A program that a bootloader starts: with hooks, its own memories, and what it saw of them in booted_report. */
#include <microros/port.h>
#include <microros/port_cortex_m.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#define SYST_CSR 0xe000e010u
#define SCB_VTOR 0xe000ed08u
#define KEPT 0x20100000u /* RAM that the target file does not name: nobody clears it */

enum { PERIOD_MS = 20, CLOCKS_MARK = 0x434c4b };

typedef struct booted_report_t {
  uint32_t vectors;
  uint32_t clocks;   /* CLOCKS_MARK: the hook was called, and the system timer stood still */
  uint32_t watchdog; /* calls of the other hook */
  uint32_t cleared;  /* 1: .dma was zero */
} booted_report_t;

volatile booted_report_t booted_report;

__attribute__((section(".dma"))) uint8_t booted_buffer[256];

void booted_clocks(void);
void booted_watchdog(void);

void booted_clocks(void)
{
  PORT_CORTEX_M_REGISTER(KEPT) = (PORT_CORTEX_M_REGISTER(SYST_CSR) & 1u) == 0u ? (uint32_t)CLOCKS_MARK : 0u;
}

void booted_watchdog(void)
{
  booted_report.watchdog = booted_report.watchdog + 1u;
}

static bool is_zero(const volatile uint8_t * bytes, size_t size)
{
  uint32_t sum = 0;

  for (size_t i = 0; i < size; ++i) {
    sum += bytes[i];
  }
  return sum == 0u;
}

int main(void)
{
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  std_msgs__msg__Int32 message = {0};

  booted_report.vectors = PORT_CORTEX_M_REGISTER(SCB_VTOR);
  booted_report.clocks = PORT_CORTEX_M_REGISTER(KEPT);
  booted_report.cleared = is_zero(booted_buffer, sizeof(booted_buffer)) ? 1u : 0u;
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "booted", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rcl_publish(&publisher, &message, NULL);
    ++message.data;
    rclc_sleep_ms(PERIOD_MS);
  }
}
