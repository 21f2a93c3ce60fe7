/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_posix_task.h"

#include <nuttx/config.h>
#include <sched.h>
#include <stdbool.h>
#include <string.h>

/* Otherwise the functions by which a thread finds its task (pthread_key_create and others) are missing at the link. */
#if !defined(CONFIG_TLS_NELEM) || (CONFIG_TLS_NELEM < 1)
#error "defconfig: set CONFIG_TLS_NELEM=1, or more if other programs use pthread_key_create"
#endif

enum { STACK_FILL = 0xa5 };

static const uint32_t own_fill = 0xa5a5a5a5u;
#ifdef CONFIG_STACK_COLORATION
static const uint32_t kernel_fill = 0xdeadbeefu; /* the kernel fills the stack as well */
#else
static const uint32_t kernel_fill = 0xa5a5a5a5u;
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

static bool is_unused(uint32_t word)
{
  return word == own_fill || word == kernel_fill;
}

/* The lowest addresses have what the kernel keeps of the thread: the unused words are above it. All of them are unused where
 * the kernel takes another stack, as its simulator may: then the mark is 0, not known. */
uint32_t port_posix_task_unused(const void * stack, uint32_t size)
{
  const uint32_t * words = (const uint32_t *)stack;
  const uint32_t count = size / (uint32_t)sizeof(own_fill);
  uint32_t first = 0;
  uint32_t last;

  while (first < count && !is_unused(words[first])) {
    ++first;
  }
  last = first;
  while (last < count && is_unused(words[last])) {
    ++last;
  }
  return (last - first) * (uint32_t)sizeof(own_fill);
}
