/* SPDX-License-Identifier: Apache-2.0 */
/* What the tasks of systems with POSIX threads differ in. Internal. */
#ifndef MICROROS_PORT_POSIX_TASK_H
#define MICROROS_PORT_POSIX_TASK_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the priority of SCHED_FIFO of a level: 1 is the lowest. */
int port_posix_task_priority(uint8_t level);

/* Fills a stack before its thread is made. */
void port_posix_task_fill(void * stack, uint32_t size);

/* Returns the bytes of a filled stack that were never used. */
uint32_t port_posix_task_unused(const void * stack, uint32_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_POSIX_TASK_H */
