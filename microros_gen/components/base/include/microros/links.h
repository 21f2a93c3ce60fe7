/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Transports besides that of the agent for which a wait ends, too: of links with other boards. For ports whose port_wait
 * looks at the handle; where everything that arrives ends a wait, it needs nothing of this. */
#ifndef MICROROS_LINKS_H
#define MICROROS_LINKS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { MICROROS_LINKS = 0 };

/* Returns the handle of a transport, -1 while it is not open. Callable from any task without the lock. */
static inline intptr_t microros_link_handle(int link)
{
  (void)link;
  return -1;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_LINKS_H */
