/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tasks of the operating system, as the component `tasks` asks for them (capability `tasks`). A task is identified by
 * its number, below MICROROS_TASKS. The library owns the stacks; what else a task needs is a static object of the port.
 */
#ifndef MICROROS_PORT_TASKS_H
#define MICROROS_PORT_TASKS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The caller is none of these tasks. */
enum { PORT_TASK_NONE = 255 };

typedef void (*port_task_entry_t)(uint8_t task);

typedef struct port_task_t {
  const char * name;
  port_task_entry_t entry; /* called in the task; the task ends when it returns */
  void * stack;            /* aligned to 8 bytes */
  uint32_t stack_size;     /* bytes, a multiple of 8 */
  uint8_t priority;        /* 1 is the lowest; MICROROS_TASKS priorities, each of one task */
} port_task_t;

/* Makes the task and its event, and starts it. A task that was joined can be made again, while other tasks go on.
 * Returns false if the system refuses. The caller holds the library's lock, which a task that runs at once may wait
 * for. Another task is never in a function of this header for the same task meanwhile, here and in port_task_join. */
bool port_task_create(uint8_t task, const port_task_t * setting);

/* Waits until the entry of a task that was made has returned, and releases what the system has of it. */
void port_task_join(uint8_t task);

/* Returns the number of the calling task; PORT_TASK_NONE: none that was made here. From any task. */
uint8_t port_task_self(void);

/* Returns whether the system keeps to the priorities of the tasks that were made. */
bool port_task_has_priorities(void);

/* Gives a task that was made, and is not joined yet, another priority: 1 is the lowest, MICROROS_TASKS the highest. Returns
 * false if the system keeps to no priorities. From any task. */
bool port_task_set_priority(uint8_t task, uint8_t priority);

/* Sets the event of a task: it ends the wait in progress, or the next one. From any task. */
void port_task_set(uint8_t task);

/* Waits for the event of the calling task, `task`, for at most `timeout_ms`. May return early. */
void port_task_wait(uint8_t task, uint32_t timeout_ms);

/* Returns microseconds since an arbitrary start; monotonic, wraps to 0 after 2^32 - 1. From any task. */
uint32_t port_task_time_us(void);

/* Returns the time of the first release of a task that begins now, from which its period counts: port_task_time_us, or the
 * time of the next tick where a sleep ends at ticks of the system that are coarser than that clock. A grid shortly after
 * the ticks would have each release a tick late, or some of them. From any task. */
uint32_t port_task_first_release_us(void);

/* Sleeps until port_task_time_us has reached `time_us`, at most 2^31 - 1 microseconds; returns at once if it has. */
void port_task_sleep_until(uint32_t time_us);

/* Returns the high-water mark of the stack of a task since it was made, bytes; 0 if the port forgets it when the task
 * is joined. It reads the stack while the task may run, so the mark may already be higher. */
uint32_t port_task_stack_peak(uint8_t task);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_TASKS_H */
