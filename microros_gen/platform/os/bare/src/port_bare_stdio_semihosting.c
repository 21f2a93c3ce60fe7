/* SPDX-License-Identifier: Apache-2.0 */
/* stdio: {to: semihosting} */
#include "microros/port_stdio.h"

static const uint32_t operation_write_character = 0x03; /* SYS_WRITEC */

void port_stdio_put(uint8_t byte)
{
  (void)port_bare_semihosting(operation_write_character, &byte);
}
