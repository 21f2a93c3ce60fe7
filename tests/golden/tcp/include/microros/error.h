/* SPDX-License-Identifier: Apache-2.0 */
/*
 * errors: text. The place that fails names an error and the facts; the words are in error_text.c, each an object of
 * its own, so that what nobody names is not linked.
 */
#ifndef MICROROS_ERROR_H
#define MICROROS_ERROR_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Words that become `detail`: for those who only see that there are any. */
#define MICROROS_ERROR_WORDS(words) (words)

typedef const char * microros_error_t;

extern const char microros_error_argument[];
extern const char microros_error_context_in_use[];
extern const char microros_error_transport[];
extern const char microros_error_agent_silent[];
extern const char microros_error_agent_refused[];
extern const char microros_error_address[];
extern const char microros_error_name[];
extern const char microros_error_name_long[];
extern const char microros_error_node_undeclared[];
extern const char microros_error_node_open[];
extern const char microros_error_nodes_full[];
extern const char microros_error_publisher_undeclared[];
extern const char microros_error_publisher_open[];
extern const char microros_error_publishers_full[];
extern const char microros_error_stream_small[];
extern const char microros_error_qos[];
extern const char microros_error_entity_silent[];
extern const char microros_error_entity_refused[];
extern const char microros_error_field[];
extern const char microros_error_stream_full[];
extern const char microros_error_no_session[];
extern const char microros_error_not_sent[];
extern const char microros_error_arena[];
extern const char microros_error_serialized[];
extern const char microros_error_domain[];
extern const char microros_error_memory_given[];
extern const char microros_error_pool_full[];
extern const char microros_error_clock[];
extern const char microros_error_field_bound[];
extern const char microros_error_field_data[];
extern const char microros_error_pool_most[];
extern const char microros_error_block_large[];
extern const char microros_error_blocks_taken[];

/*
 * Makes this the last error. What `name`, `detail`, `found` and `fits` mean is said beside the texts; the
 * strings are only read during the call.
 */
void microros_error_set(
  microros_error_t error, const char * name, const char * detail, uint32_t found, uint32_t fits);

/* The same for microros_error_argument, and for errors with a name and nothing else. Both return `result`. */
int32_t microros_error_refuse(int32_t result, const char * argument);
int32_t microros_error_named(int32_t result, microros_error_t error, const char * name);

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
