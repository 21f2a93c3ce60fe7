/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_tasks.h"

static uint32_t total_overruns;
static uint32_t total_missed;

void rcl_tasks_count(uint32_t overruns, uint32_t missed)
{
  total_overruns += overruns;
  total_missed += missed;
}

uint32_t rcl_tasks_overruns(void)
{
  return total_overruns;
}

uint32_t rcl_tasks_missed(void)
{
  return total_missed;
}
