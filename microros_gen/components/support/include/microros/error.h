/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Errors of the library. The place that fails names an error and the facts; the words are in error_text.c,
 * each an object of its own, so that what nobody names is not linked. With `errors: code` error_code.c stands
 * for it: there each is "E" and the number below. E01 is an error that the application set
 * (rcutils_set_error_state).
 */
#ifndef MICROROS_ERROR_H
#define MICROROS_ERROR_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

extern const char microros_error_argument[];             /* 2 */
extern const char microros_error_context_in_use[];       /* 3 */
extern const char microros_error_transport[];            /* 4 */
extern const char microros_error_agent_silent[];         /* 5 */
extern const char microros_error_agent_refused[];        /* 6 */
extern const char microros_error_address[];              /* 7 */
extern const char microros_error_name[];                 /* 8 */
extern const char microros_error_name_long[];            /* 9 */
extern const char microros_error_node_undeclared[];      /* 10 */
extern const char microros_error_node_open[];            /* 11 */
extern const char microros_error_nodes_full[];           /* 12 */
extern const char microros_error_publisher_undeclared[]; /* 13 */
extern const char microros_error_publisher_open[];       /* 14 */
extern const char microros_error_publishers_full[];      /* 15 */
extern const char microros_error_stream_small[];         /* 16 */
extern const char microros_error_qos[];                  /* 17 */
extern const char microros_error_entity_silent[];        /* 18 */
extern const char microros_error_entity_refused[];       /* 19 */
extern const char microros_error_field[];                /* 20 */
extern const char microros_error_stream_full[];          /* 21 */
extern const char microros_error_no_session[];           /* 22 */
extern const char microros_error_not_sent[];             /* 23 */
extern const char microros_error_arena[];                /* 24 */
extern const char microros_error_serialized[];           /* 25 */
extern const char microros_error_domain[];               /* 26 */
extern const char microros_error_device[];               /* 27 */
extern const char microros_error_custom_unset[];         /* 28 */
extern const char microros_error_framing[];              /* 29 */

/*
 * Makes this the last error. What `name`, `detail`, `found` and `fits` mean is said beside the texts; the
 * strings are only read during the call.
 */
void microros_error_set(
  const char * error, const char * name, const char * detail, uint32_t found, uint32_t fits);

/* The same for microros_error_argument, and for errors with a name and nothing else. Both return `result`. */
int32_t microros_error_refuse(int32_t result, const char * argument);
int32_t microros_error_named(int32_t result, const char * error, const char * name);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ERROR_H */
