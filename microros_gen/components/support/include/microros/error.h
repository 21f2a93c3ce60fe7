/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Errors of the library. The place that fails names a code and the facts; the words are in one file (error_text.c),
 * which `errors: code` replaces by one without words (error_code.c: "E" and the number below).
 */
#ifndef MICROROS_ERROR_H
#define MICROROS_ERROR_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum microros_error_t {
  MICROROS_ERROR_NONE = 0,
  MICROROS_ERROR_APPLICATION = 1, /* set by rcutils_set_error_state */
  MICROROS_ERROR_ARGUMENT = 2,
  MICROROS_ERROR_CONTEXT_IN_USE = 3,
  MICROROS_ERROR_TRANSPORT = 4,
  MICROROS_ERROR_AGENT_SILENT = 5,
  MICROROS_ERROR_AGENT_REFUSED = 6,
  MICROROS_ERROR_ADDRESS = 7,
  MICROROS_ERROR_NAME = 8,
  MICROROS_ERROR_NAME_LONG = 9,
  MICROROS_ERROR_NODE_UNDECLARED = 10,
  MICROROS_ERROR_NODE_OPEN = 11,
  MICROROS_ERROR_NODES_FULL = 12,
  MICROROS_ERROR_PUBLISHER_UNDECLARED = 13,
  MICROROS_ERROR_PUBLISHER_OPEN = 14,
  MICROROS_ERROR_PUBLISHERS_FULL = 15,
  MICROROS_ERROR_STREAM_SMALL = 16,
  MICROROS_ERROR_QOS = 17,
  MICROROS_ERROR_ENTITY_SILENT = 18,
  MICROROS_ERROR_ENTITY_REFUSED = 19,
  MICROROS_ERROR_FIELD = 20,
  MICROROS_ERROR_STREAM_FULL = 21,
  MICROROS_ERROR_NO_SESSION = 22,
  MICROROS_ERROR_NOT_SENT = 23,
  MICROROS_ERROR_ARENA = 24,
  MICROROS_ERROR_SERIALIZED = 25,
  MICROROS_ERROR_DOMAIN = 26
} microros_error_t;

/*
 * Makes this the last error. What `name`, `detail`, `found` and `fits` mean is said beside each text in error_text.c;
 * the strings are only read during the call.
 */
void microros_error_set(
  microros_error_t error, const char * name, const char * detail, uint32_t found, uint32_t fits);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ERROR_H */
