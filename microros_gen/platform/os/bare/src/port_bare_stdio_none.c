/* SPDX-License-Identifier: Apache-2.0 */
/* stdio: {to: none} */
#include "microros/port_stdio.h"

void port_stdio_put(uint8_t byte)
{
  (void)byte;
}
