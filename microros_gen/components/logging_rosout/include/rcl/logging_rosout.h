/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions of rcl for /rosout. The publisher is opened and closed with the first node; a device has one for all of
 * its nodes, and each line has the name of its logger.
 */
#ifndef MICROROS_RCL_LOGGING_ROSOUT_H
#define MICROROS_RCL_LOGGING_ROSOUT_H

#include "rcl/allocator.h"
#include "rcl/node.h"
#include "rcl/types.h"
#include "rcutils/logging.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Need not be called. RCL_RET_INVALID_ARGUMENT for NULL. */
rcl_ret_t rcl_logging_rosout_init(const rcl_allocator_t * allocator);
rcl_ret_t rcl_logging_rosout_fini(void);

/*
 * Open the publisher if it was closed, and close it; while it is closed, lines wait. RCL_RET_NODE_INVALID for a node
 * that is not open. Opening waits for the agent.
 */
rcl_ret_t rcl_logging_rosout_init_publisher_for_node(rcl_node_t * node);
rcl_ret_t rcl_logging_rosout_fini_publisher_for_node(rcl_node_t * node);

/*
 * Add a logger below that of an open node or below another sublogger, and remove it. Its name is `logger_name.sublogger_name`.
 * What is added several times is removed as many times; closing its node removes it. Lines go to /rosout whether or not
 * their logger was added, also after its removal: no line of a board is lost for want of a name.
 * RCL_RET_OK; RCL_RET_INVALID_ARGUMENT for NULL or an empty sublogger name; RCL_RET_NOT_FOUND: no such logger, or
 * /rosout is closed; RCL_RET_BAD_ALLOC: MICROROS_LOGGERS_MAX subloggers exist, or the name is longer than
 * MICROROS_LOG_ROSOUT_NAME. Every task may call them.
 */
rcl_ret_t rcl_logging_rosout_add_sublogger(const char * logger_name, const char * sublogger_name);
rcl_ret_t rcl_logging_rosout_remove_sublogger(const char * logger_name, const char * sublogger_name);

/* Keeps a message for /rosout, whatever the level of that writer; for output handlers. */
void rcl_logging_rosout_output_handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LOGGING_ROSOUT_H */
