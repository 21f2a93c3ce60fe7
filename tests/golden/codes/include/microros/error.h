/* SPDX-License-Identifier: Apache-2.0 */
/*
 * errors: code. An error is its number, and the text behind rcl_get_error_string "E" and that number; what a place
 * says beside it is dropped by the compiler. E01 is an error that the application set (rcutils_set_error_state).
 */
#ifndef MICROROS_ERROR_H
#define MICROROS_ERROR_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Words that would become `detail`: there are some, and nobody reads them. */
#define MICROROS_ERROR_WORDS(words) ("?")

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

/* Makes this the last error, and returns `result`. */
int32_t microros_error_code(int32_t result, microros_error_t error);

static inline void microros_error_set(
  microros_error_t error, const char * name, const char * detail, uint32_t found, uint32_t fits)
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

static inline int32_t microros_error_named(int32_t result, microros_error_t error, const char * name)
{
  (void)name;
  return microros_error_code(result, error);
}

/* A session holds no more places of one kind. */
#define MICROROS_POOL_MOST 250u

/* Returns what a full pool of this many places says: `error` advises one more, where one more can be. */
static inline microros_error_t microros_error_of_pool(microros_error_t error, uint32_t places)
{
  return places < MICROROS_POOL_MOST ? error : (microros_error_t)microros_error_pool_most;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ERROR_H */
