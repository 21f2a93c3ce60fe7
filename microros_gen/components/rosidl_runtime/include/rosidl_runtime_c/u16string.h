/* SPDX-License-Identifier: Apache-2.0 */
/* A string of UTF-16 units: `size` units without the terminating zero, `capacity` units including it. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_U16STRING_H
#define MICROROS_ROSIDL_RUNTIME_C_U16STRING_H

#include <stddef.h>
#include <stdint.h>

#include "rosidl_runtime_c/primitives_sequence.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rosidl_runtime_c__U16String {
  uint_least16_t * data;
  size_t size;
  size_t capacity;
} rosidl_runtime_c__U16String;

ROSIDL_RUNTIME_C__PRIMITIVE_SEQUENCE(U16String, rosidl_runtime_c__U16String)

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ROSIDL_RUNTIME_C_U16STRING_H */
