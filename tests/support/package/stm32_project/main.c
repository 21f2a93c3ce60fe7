/* SPDX-License-Identifier: Apache-2.0 */
#include "main.h"

#include "publisher.h"

extern UART_HandleTypeDef huart1;
void hal_begin(void);

int main(void)
{
  hal_begin();
  microros_publisher(true, &huart1);
  return 0;
}
