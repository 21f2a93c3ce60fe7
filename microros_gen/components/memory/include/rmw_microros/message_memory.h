/* SPDX-License-Identifier: Apache-2.0 */
/* Storage of messages, seen from the application: an addition of this client to rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_MESSAGE_MEMORY_H
#define MICROROS_RMW_MICROROS_MESSAGE_MEMORY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Returns how many times a function of a message, string or sequence (__init, __create, __Sequence__init, __assign,
 * __copy, those of micro_ros_utilities) got no memory and returned false or NULL since the start; at 2^32 - 1 it stays. The
 * reason of the last one is behind rcl_get_error_string: more than a limit of the application file, or all blocks are
 * taken (memory.messages). Does not wait.
 */
uint32_t rmw_uros_get_refused_memory(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_MESSAGE_MEMORY_H */
