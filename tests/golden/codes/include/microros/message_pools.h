/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The pools of the plan, by the kind of their elements. `text` are characters, `string` strings of a sequence; a kind
 * that no sender needs is NULL. Written by microros-gen: change `limits` and `memory.messages` in the application file.
 */
#ifndef MICROROS_MESSAGE_POOLS_H
#define MICROROS_MESSAGE_POOLS_H

#include "microros/message_memory.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MICROROS_POOL_text NULL
#define MICROROS_POOL_u16text NULL
#define MICROROS_POOL_string NULL
#define MICROROS_POOL_u16string NULL
#define MICROROS_POOL_float NULL
#define MICROROS_POOL_double NULL
#define MICROROS_POOL_long_double NULL
#define MICROROS_POOL_char NULL
#define MICROROS_POOL_wchar NULL
#define MICROROS_POOL_boolean NULL
#define MICROROS_POOL_octet NULL
#define MICROROS_POOL_uint8 NULL
#define MICROROS_POOL_int8 NULL
#define MICROROS_POOL_uint16 NULL
#define MICROROS_POOL_int16 NULL
#define MICROROS_POOL_uint32 NULL
#define MICROROS_POOL_int32 NULL
#define MICROROS_POOL_uint64 NULL
#define MICROROS_POOL_int64 NULL

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_MESSAGE_POOLS_H */
