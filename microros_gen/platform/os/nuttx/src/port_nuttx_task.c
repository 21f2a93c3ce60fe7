/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_posix_task.h"

#include <nuttx/config.h>
#include <sched.h>
#include <string.h>

enum { STACK_FILL = 0xa5 };

#ifdef CONFIG_STACK_COLORATION
static const uint32_t fill = 0xdeadbeefu; /* of the kernel, which fills the stack as well */
#else
static const uint32_t fill = 0xa5a5a5a5u;
#endif

/* Above the shell and the other programs of the application, which have the default. */
int port_posix_task_priority(uint8_t level)
{
  return SCHED_PRIORITY_DEFAULT + (int)level;
}

void port_posix_task_fill(void * stack, uint32_t size)
{
  (void)memset(stack, (int)STACK_FILL, size);
}

/* The lowest addresses have what the kernel keeps of the thread: the unused words are above it. */
uint32_t port_posix_task_unused(const void * stack, uint32_t size)
{
  const uint32_t * words = (const uint32_t *)stack;
  const uint32_t count = size / (uint32_t)sizeof(fill);
  uint32_t first = 0;
  uint32_t last;

  while (first < count && words[first] != fill) {
    ++first;
  }
  last = first;
  while (last < count && words[last] == fill) {
    ++last;
  }
  return (last - first) * (uint32_t)sizeof(fill);
}
