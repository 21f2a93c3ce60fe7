/* SPDX-License-Identifier: Apache-2.0 */
/* Functions of rcl for logging. Writers and levels are those of `logging:`; arguments do not change them. */
#ifndef MICROROS_RCL_LOGGING_H
#define MICROROS_RCL_LOGGING_H

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/types.h"
#include "rcutils/logging.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef rcutils_logging_output_handler_t rcl_logging_output_handler_t;

/* Need not be called. RCL_RET_INVALID_ARGUMENT for NULL. */
rcl_ret_t rcl_logging_configure(const rcl_arguments_t * global_args, const rcl_allocator_t * allocator);

/* As above, and sets the output handler (rcutils_logging_set_output_handler). */
rcl_ret_t rcl_logging_configure_with_output_handler(
  const rcl_arguments_t * global_args, const rcl_allocator_t * allocator,
  rcl_logging_output_handler_t output_handler);

/* Restores the levels of the build and removes the output handler. */
rcl_ret_t rcl_logging_fini(void);

/* Returns whether `rosout` is among the writers. */
bool rcl_logging_rosout_enabled(void);

/* Passes a message to the writers of `logging:` that take its level. For an output handler, which otherwise replaces them:
 * it can change or count a message and pass it on. Takes from `args`. */
void rcl_logging_multiple_output_handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LOGGING_H */
