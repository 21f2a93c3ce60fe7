/* SPDX-License-Identifier: Apache-2.0 */
/*
 * errors: text. The failing function passes an error and its facts. The words are in error_text.c, one
 * object per text, so that the linker drops unused ones.
 */
#ifndef MICROROS_ERROR_H
#define MICROROS_ERROR_H

#include "microros/flash.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Words that become `detail`. */
#define MICROROS_ERROR_WORDS(words) (words)
/* The name of a message type, for an initializer outside of functions. */
#define MICROROS_ERROR_TYPE(words) MICROROS_FLASH_NAME(words)

typedef const MICROROS_FLASH char * microros_error_t;

extern const MICROROS_FLASH char microros_error_argument[];
extern const MICROROS_FLASH char microros_error_context_in_use[];
extern const MICROROS_FLASH char microros_error_transport[];
extern const MICROROS_FLASH char microros_error_agent_silent[];
extern const MICROROS_FLASH char microros_error_agent_refused[];
extern const MICROROS_FLASH char microros_error_address[];
extern const MICROROS_FLASH char microros_error_name[];
extern const MICROROS_FLASH char microros_error_name_long[];
extern const MICROROS_FLASH char microros_error_node_undeclared[];
extern const MICROROS_FLASH char microros_error_node_open[];
extern const MICROROS_FLASH char microros_error_nodes_full[];
extern const MICROROS_FLASH char microros_error_publisher_undeclared[];
extern const MICROROS_FLASH char microros_error_publisher_open[];
extern const MICROROS_FLASH char microros_error_publishers_full[];
extern const MICROROS_FLASH char microros_error_stream_small[];
extern const MICROROS_FLASH char microros_error_qos[];
extern const MICROROS_FLASH char microros_error_entity_silent[];
extern const MICROROS_FLASH char microros_error_entity_refused[];
extern const MICROROS_FLASH char microros_error_field[];
extern const MICROROS_FLASH char microros_error_stream_full[];
extern const MICROROS_FLASH char microros_error_no_session[];
extern const MICROROS_FLASH char microros_error_not_sent[];
extern const MICROROS_FLASH char microros_error_arena[];
extern const MICROROS_FLASH char microros_error_serialized[];
extern const MICROROS_FLASH char microros_error_domain[];
extern const MICROROS_FLASH char microros_error_memory_given[];
extern const MICROROS_FLASH char microros_error_pool_full[];
extern const MICROROS_FLASH char microros_error_clock[];
extern const MICROROS_FLASH char microros_error_timer[];
extern const MICROROS_FLASH char microros_error_executor[];
extern const MICROROS_FLASH char microros_error_field_bound[];
extern const MICROROS_FLASH char microros_error_field_data[];
extern const MICROROS_FLASH char microros_error_pool_most[];
extern const MICROROS_FLASH char microros_error_block_large[];
extern const MICROROS_FLASH char microros_error_blocks_taken[];

/*
 * Sets the last error. The texts' file explains `name`, `detail`, `found` and `fits`. The strings are only
 * read during the call.
 */
void microros_error_set(
  microros_error_t error, const MICROROS_ANYWHERE char * name, const MICROROS_ANYWHERE char * detail,
  uint32_t found, uint32_t fits);

/* Shorthands for microros_error_argument, and for errors with only a name. Both return `result`. */
int32_t microros_error_refuse(int32_t result, const char * argument);
int32_t microros_error_named(
  int32_t result, microros_error_t error, const MICROROS_ANYWHERE char * name);
#ifdef MICROROS_FLASH_IS_SEPARATE
int32_t microros_error_refuse_flash(int32_t result, const MICROROS_FLASH char * argument);
#define microros_error_refuse(result, argument) \
  microros_error_refuse_flash((result), MICROROS_FLASH_TEXT(argument))
#endif

/* Sets an error with a name and the size that would do; returns `result`. */
static inline int32_t microros_error_fits(
  int32_t result, microros_error_t error, const MICROROS_ANYWHERE char * name, uint32_t fits)
{
  microros_error_set(error, name, "", 0, fits);
  return result;
}

/* Largest pool of one kind that a session can have. */
#define MICROROS_POOL_MOST 250u

/*
 * Returns the error for a full pool of `places`: `error` suggests a larger pool, unless the pool cannot
 * grow. */
static inline microros_error_t microros_error_of_pool(microros_error_t error, uint32_t places)
{
  return places < MICROROS_POOL_MOST ? error : (microros_error_t)microros_error_pool_most;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ERROR_H */
