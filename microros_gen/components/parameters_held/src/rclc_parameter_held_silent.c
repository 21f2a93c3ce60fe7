/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_held_log.h"

/* Without log messages there is the count alone. */
void rclc_parameter_held_log(const char * name)
{
  (void)name;
}
