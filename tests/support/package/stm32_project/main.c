/* SPDX-License-Identifier: Apache-2.0 */
#include "main.h"

#include "publisher.h"

#include <stdlib.h>

extern UART_HandleTypeDef huart1;
void hal_begin(void);

int main(void)
{
  char * agent = getenv("STM32_AGENT");

  hal_begin();
  if (agent != NULL) {
    microros_publisher(false, agent);
  } else {
    microros_publisher(true, &huart1);
  }
  return 0;
}
