/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_held_log.h"

/* Without log messages, overruled values are only counted. */
void rclc_parameter_held_log(const char * name)
{
  (void)name;
}
