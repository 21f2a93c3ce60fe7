/* SPDX-License-Identifier: Apache-2.0 */
/* The high-water mark of a stack whose lowest addresses have what the kernel keeps of the thread. */
#include "unit.h"

#include "microros/port_posix_task.h"

#include <nuttx/config.h>
#include <string.h>

enum { SIZE = 512, KEPT = 64, USED = 112 };

#ifdef CONFIG_STACK_COLORATION
static const uint32_t fill = 0xdeadbeefu;
#else
static const uint32_t fill = 0xa5a5a5a5u;
#endif

int main(void)
{
  static uint32_t stack[(size_t)SIZE / sizeof(uint32_t)];

  port_posix_task_fill(stack, (uint32_t)SIZE);
  CHECK(port_posix_task_unused(stack, (uint32_t)SIZE) == (uint32_t)SIZE); /* the kernel has taken another stack */
  for (size_t i = 0; i < sizeof(stack) / sizeof(stack[0]); ++i) {
    stack[i] = fill;
  }
  (void)memset(stack, 0, KEPT);
  (void)memset((char *)stack + SIZE - USED, 1, USED);
  CHECK(port_posix_task_unused(stack, (uint32_t)SIZE) == (uint32_t)(SIZE - KEPT - USED));
  (void)memset(stack, 1, SIZE);
  CHECK(port_posix_task_unused(stack, (uint32_t)SIZE) == 0u);
  CHECK(port_posix_task_priority(1) > 100); /* SCHED_PRIORITY_DEFAULT */
  return 0;
}
