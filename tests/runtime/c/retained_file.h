/* SPDX-License-Identifier: Apache-2.0 */
/* A client that sleeps and wakes with what it retains in a file, for programs with one call for each line. */
#ifndef RETAINED_FILE_H
#define RETAINED_FILE_H

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <rmw_microros/sleep.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

static rmw_uros_retained_t retained;

static rcl_ret_t store(const char * file, bool sleeps)
{
  FILE * stream = fopen(file, sleeps ? "wb" : "rb");
  size_t count = 0;

  if (stream != NULL) {
    count =
      sleeps ? fwrite(&retained, sizeof(retained), 1, stream) : fread(&retained, sizeof(retained), 1, stream);
    (void)fclose(stream);
  }
  return count == 1u ? RCL_RET_OK : RCL_RET_ERROR;
}

static rcl_ret_t go_to_sleep(rclc_support_t * support, const char * file)
{
  const rmw_ret_t result = rmw_uros_sleep(rcl_context_get_rmw_context(&support->context), &retained, 300);

  return result == RMW_RET_OK ? store(file, true) : result;
}

static rcl_ret_t wake_up(const char * file)
{
  const rcl_ret_t result = store(file, false);

  return result == RCL_RET_OK && !rmw_uros_wake(&retained) ? RCL_RET_ERROR : result;
}

#endif
