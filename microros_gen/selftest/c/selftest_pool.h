/* SPDX-License-Identifier: Apache-2.0 */
/* Tasks of the checks, with the numbers 0 to 2, and their stacks. */
#ifndef SELFTEST_POOL_H
#define SELFTEST_POOL_H

#include "microros/port_tasks.h"

#include <stdbool.h>
#include <stdint.h>

enum { SELFTEST_LOW, SELFTEST_MIDDLE, SELFTEST_HIGH, SELFTEST_POOL };

/* Starts a task with the priority of its number; returns false, after a FAIL, if the port refuses. Each task that was
 * started is joined by the caller, which reads what it wrote only then. */
bool selftest_start(uint8_t task, port_task_entry_t entry);

#endif /* SELFTEST_POOL_H */
