/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The last error as one bounded text of MICROROS_ERROR_TEXT_SIZE bytes including the NUL (`errors:` of the
 * application file); with `errors: code` the text is a letter and a number (microros/error.h). It is kept
 * until the next error or rcutils_reset_error. One state per process, not thread-safe.
 */
#ifndef MICROROS_RCUTILS_ERROR_HANDLING_H
#define MICROROS_RCUTILS_ERROR_HANDLING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros_config.h"
#include "rcutils/allocator.h"
#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_ERROR_MESSAGE_MAX_LENGTH MICROROS_ERROR_TEXT_SIZE
#define RCUTILS_ERROR_STATE_MESSAGE_MAX_LENGTH MICROROS_ERROR_TEXT_SIZE

typedef struct rcutils_error_string_s {
  char str[RCUTILS_ERROR_MESSAGE_MAX_LENGTH];
} rcutils_error_string_t;

/*
 * `file` and `line_number` are those passed to rcutils_set_error_state; NULL and 0 for an error of the
 * library. */
typedef struct rcutils_error_state_s {
  char message[RCUTILS_ERROR_STATE_MESSAGE_MAX_LENGTH];
  const char * file;
  uint64_t line_number;
} rcutils_error_state_t;

/* Stores a copy of `error_string`, truncated to the available size; `file` must stay valid (a literal). */
void rcutils_set_error_state(const char * error_string, const char * file, size_t line_number);

bool rcutils_error_is_set(void);

/* Returns the state, owned by the library, or NULL if no error is set. */
const rcutils_error_state_t * rcutils_get_error_state(void);

/* Returns a copy of the text, empty if no error is set. */
rcutils_error_string_t rcutils_get_error_string(void);

void rcutils_reset_error(void);

#define RCUTILS_SET_ERROR_MSG(msg) \
  do { \
    rcutils_set_error_state(msg, __FILE__, __LINE__); \
  } while (0)

#define RCUTILS_CHECK_FOR_NULL_WITH_MSG(value, msg, error_statement) \
  do { \
    if (NULL == (value)) { \
      RCUTILS_SET_ERROR_MSG(msg); \
      error_statement; \
    } \
  } while (0)

#define RCUTILS_CHECK_ARGUMENT_FOR_NULL(argument, error_return_type) \
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(argument, #argument " argument is null", return error_return_type)

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_ERROR_HANDLING_H */
