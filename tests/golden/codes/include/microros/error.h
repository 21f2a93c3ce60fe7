/* SPDX-License-Identifier: Apache-2.0 */
/*
 * errors: code. The text returned by rcl_get_error_string is "E" and the error's number; the compiler
 * drops all other arguments. E01 is an error set by the application (rcutils_set_error_state).
 */
#ifndef MICROROS_ERROR_H
#define MICROROS_ERROR_H

#include "microros/flash.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Keeps words that would become `detail` out of the image: callers only test whether they are NULL. */
#define MICROROS_ERROR_WORDS(words) ("?")
/* The same of the name of a message type, for an initializer outside of functions. */
#define MICROROS_ERROR_TYPE(words) MICROROS_FLASH_NAME("?")

typedef uint8_t microros_error_t;

enum {
  microros_error_argument = 2,
  microros_error_context_in_use = 3,
  microros_error_transport = 4,
  microros_error_agent_silent = 5,
  microros_error_agent_refused = 6,
  microros_error_address = 7,
  microros_error_name = 8,
  microros_error_name_long = 9,
  microros_error_node_undeclared = 10,
  microros_error_node_open = 11,
  microros_error_nodes_full = 12,
  microros_error_publisher_undeclared = 13,
  microros_error_publisher_open = 14,
  microros_error_publishers_full = 15,
  microros_error_stream_small = 16,
  microros_error_qos = 17,
  microros_error_entity_silent = 18,
  microros_error_entity_refused = 19,
  microros_error_field = 20,
  microros_error_stream_full = 21,
  microros_error_no_session = 22,
  microros_error_not_sent = 23,
  microros_error_arena = 24,
  microros_error_serialized = 25,
  microros_error_domain = 26,
  microros_error_memory_given = 35,
  microros_error_pool_full = 44,
  microros_error_field_bound = 48,
  microros_error_field_data = 50,
  microros_error_pool_most = 63,
  microros_error_block_large = 64,
  microros_error_blocks_taken = 65,
};

/* The largest number of an error of the selected components. */
#define MICROROS_ERROR_LARGEST 65u

/* Sets the last error; returns `result`. */
int32_t microros_error_code(int32_t result, microros_error_t error);

static inline void microros_error_set(
  microros_error_t error, const MICROROS_ANYWHERE char * name, const MICROROS_ANYWHERE char * detail,
  uint32_t found, uint32_t fits)
{
  (void)name;
  (void)detail;
  (void)found;
  (void)fits;
  (void)microros_error_code(0, error);
}

static inline int32_t microros_error_refuse(int32_t result, const char * argument)
{
  (void)argument;
  return microros_error_code(result, microros_error_argument);
}

static inline int32_t microros_error_named(
  int32_t result, microros_error_t error, const MICROROS_ANYWHERE char * name)
{
  (void)name;
  return microros_error_code(result, error);
}

static inline int32_t microros_error_fits(
  int32_t result, microros_error_t error, const MICROROS_ANYWHERE char * name, uint32_t fits)
{
  (void)name;
  (void)fits;
  return microros_error_code(result, error);
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
