/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_held_log.h"

#include "rcutils/logging_macros.h"

void rclc_parameter_held_log(const char * name)
{
  RCUTILS_LOG_WARN_NAMED("microros", "parameter %s: the value set here is overruled", name);
}
