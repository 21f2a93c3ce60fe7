/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest_pool.h"

#include "selftest_config.h"
#include "selftest_report.h"

/* A stack is aligned to 8 bytes. */
static uint64_t stacks[SELFTEST_POOL][(uint32_t)SELFTEST_TASK_STACK / sizeof(uint64_t)];
static port_task_t settings[SELFTEST_POOL]; /* the port reads it as long as the task exists */

static bool is_refused; /* one line says so for all checks */

bool selftest_start(uint8_t task, port_task_entry_t entry)
{
  port_task_t * setting = &settings[task];
  bool is_made;

  setting->name = "selftest";
  setting->entry = entry;
  setting->stack = stacks[task];
  setting->stack_size = (uint32_t)sizeof(stacks[task]);
  setting->priority = (uint8_t)(task + 1u);
  is_made = port_task_create(task, setting);
  if (!is_made && !is_refused) {
    is_refused = true;
    selftest_true("task_create", false, "a task that was refused", "a task");
  }
  return is_made;
}
