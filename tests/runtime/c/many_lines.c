/* SPDX-License-Identifier: Apache-2.0 */
/* Opens the devices that it is called with, and prints how many of them can be open at once. */
#include "microros/port.h"

#include <stdio.h>

enum { MOST = 16, BAUD = 115200 };

int main(int argc, char ** argv)
{
  static port_serial_t lines[MOST];
  int count = 0;

  while (count + 1 < argc && count < (int)MOST && port_serial_open(&lines[count], argv[count + 1], BAUD)) {
    ++count;
  }
  printf("%d\n", count);
  for (int i = 0; i < count; ++i) {
    port_serial_close(&lines[i]);
  }
  return 0;
}
