/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Validation of topic and service names as a source writes them: relative, private (~/x), with
 * substitutions. */
#ifndef MICROROS_RCL_VALIDATE_TOPIC_NAME_H
#define MICROROS_RCL_VALIDATE_TOPIC_NAME_H

#include <stddef.h>

#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_TOPIC_NAME_VALID 0
#define RCL_TOPIC_NAME_INVALID_IS_EMPTY_STRING 1
#define RCL_TOPIC_NAME_INVALID_ENDS_WITH_FORWARD_SLASH 2
#define RCL_TOPIC_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS 3
#define RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER 4
#define RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE 5
#define RCL_TOPIC_NAME_INVALID_MISPLACED_TILDE 6
#define RCL_TOPIC_NAME_INVALID_TILDE_NOT_FOLLOWED_BY_FORWARD_SLASH 7
#define RCL_TOPIC_NAME_INVALID_SUBSTITUTION_CONTAINS_UNALLOWED_CHARACTERS 8
#define RCL_TOPIC_NAME_INVALID_SUBSTITUTION_STARTS_WITH_NUMBER 9

/* Sets one of the above, and for an invalid name the position of the fault, unless `invalid_index` is
 * NULL. RCL_RET_INVALID_ARGUMENT. */
rcl_ret_t rcl_validate_topic_name(const char * topic_name, int * validation_result, size_t * invalid_index);

/* Same for the first `topic_name_length` bytes. */
rcl_ret_t rcl_validate_topic_name_with_size(
  const char * topic_name, size_t topic_name_length, int * validation_result, size_t * invalid_index);

/* Returns a description of the result; NULL for RCL_TOPIC_NAME_VALID. */
const char * rcl_topic_name_validation_result_string(int validation_result);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_VALIDATE_TOPIC_NAME_H */
