/* SPDX-License-Identifier: Apache-2.0 */
/* A string: `size` bytes without the terminating NUL, `capacity` bytes including it. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_STRING_H
#define MICROROS_ROSIDL_RUNTIME_C_STRING_H

#include <stddef.h>

#include "rosidl_runtime_c/primitives_sequence.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rosidl_runtime_c__String {
  char * data;
  size_t size;
  size_t capacity;
} rosidl_runtime_c__String;

ROSIDL_RUNTIME_C__PRIMITIVE_SEQUENCE(String, rosidl_runtime_c__String)

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ROSIDL_RUNTIME_C_STRING_H */
