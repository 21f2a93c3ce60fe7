/* SPDX-License-Identifier: Apache-2.0 */
/* For an Arduino without an agent: sends the texts of two errors on the line, each with its NUL. */
#include <avr/io.h>
#include <rcl/error_handling.h>
#include <rclc/rclc.h>

static void send_error(void)
{
  const rcl_error_string_t text = rcl_get_error_string();
  const char * at = text.str;

  do {
    while ((UCSR0A & _BV(UDRE0)) == 0) {
    }
    UDR0 = (uint8_t)*at;
  } while (*at++ != '\0');
  rcl_reset_error();
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();

  UBRR0 = 16;
  UCSR0A = _BV(U2X0);
  UCSR0B = _BV(TXEN0);
  if (rclc_support_init(NULL, 0, NULL, &allocator) != RCL_RET_OK) {
    send_error();
  }
  if (
    rcl_init_options_init(&options, allocator) == RCL_RET_OK &&
    rcl_init_options_set_domain_id(&options, 1000) != RCL_RET_OK) {
    send_error();
  }
  for (;;) {
  }
}
