/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/logging.h"

#include "microros/error.h"
#include "microros/rcutils_console.h"
#include "microros/rcutils_rosout.h"
#include "microros_config.h"

rcl_ret_t rcl_logging_configure(const rcl_arguments_t * global_args, const rcl_allocator_t * allocator)
{
  if (global_args == NULL || allocator == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "global_args or allocator");
  }
  return rcutils_logging_initialize();
}

rcl_ret_t rcl_logging_configure_with_output_handler(
  const rcl_arguments_t * global_args, const rcl_allocator_t * allocator,
  rcl_logging_output_handler_t output_handler)
{
  const rcl_ret_t result = rcl_logging_configure(global_args, allocator);

  if (result == RCL_RET_OK) {
    rcutils_logging_set_output_handler(output_handler);
  }
  return result;
}

rcl_ret_t rcl_logging_fini(void)
{
  return rcutils_logging_shutdown();
}

bool rcl_logging_rosout_enabled(void)
{
  return MICROROS_LOG_HAS_ROSOUT != 0u;
}

void rcl_logging_multiple_output_handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  const char * const logger = name == NULL ? "" : name;
  va_list copy; /* both read the same arguments */

  va_copy(copy, *args);
  microros_rosout_log(location, severity, logger, timestamp, format, &copy);
  va_end(copy);
  microros_console_log(severity, logger, timestamp, format, args);
}
