/* SPDX-License-Identifier: Apache-2.0 */
/* Storage of messages, for the application: an addition of this client to rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_MESSAGE_MEMORY_H
#define MICROROS_RMW_MICROROS_MESSAGE_MEMORY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Returns how often a function of a message, string or sequence (__init, __create, __Sequence__init,
 * __assign, __copy, those of micro_ros_utilities) got no memory and returned false or NULL since the
 * start; saturates at 2^32 - 1. rcl_get_error_string returns the reason of the last one: a limit of the
 * application file was exceeded, or all blocks are in use (memory.messages). Does not wait.
 */
uint32_t rmw_uros_get_refused_memory(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_MESSAGE_MEMORY_H */
