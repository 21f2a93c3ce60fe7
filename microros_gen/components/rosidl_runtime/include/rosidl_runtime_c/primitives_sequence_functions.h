/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions on sequences of primitive types. `init` takes a block for `size` zeroed elements from the
 * storage that the build plans for sent messages (`memory.messages` of each declared sender, within its
 * `limits`), or from the allocator set by rcutils_set_default_allocator; previous contents are overwritten
 * without being freed. The sequence owns the block until `fini`, which ignores a buffer of the
 * application; `copy` reuses an output with enough room. False: an argument is NULL, `size` exceeds every
 * limit of such a sequence, or all blocks are in use (rcl_get_error_string has the reason,
 * rmw_uros_get_refused_memory counts); the sequence is then empty.
 */
#ifndef MICROROS_ROSIDL_RUNTIME_C_PRIMITIVES_SEQUENCE_FUNCTIONS_H
#define MICROROS_ROSIDL_RUNTIME_C_PRIMITIVES_SEQUENCE_FUNCTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "rosidl_runtime_c/primitives_sequence.h"
#include "rosidl_runtime_c/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#define ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(STRUCT_NAME, SEQUENCE) \
  bool rosidl_runtime_c__##STRUCT_NAME##__Sequence__init( \
    rosidl_runtime_c__##SEQUENCE##__Sequence * sequence, size_t size); \
  void rosidl_runtime_c__##STRUCT_NAME##__Sequence__fini( \
    rosidl_runtime_c__##SEQUENCE##__Sequence * sequence); \
  bool rosidl_runtime_c__##STRUCT_NAME##__Sequence__are_equal( \
    const rosidl_runtime_c__##SEQUENCE##__Sequence * lhs, \
    const rosidl_runtime_c__##SEQUENCE##__Sequence * rhs); \
  bool rosidl_runtime_c__##STRUCT_NAME##__Sequence__copy( \
    const rosidl_runtime_c__##SEQUENCE##__Sequence * input, \
    rosidl_runtime_c__##SEQUENCE##__Sequence * output);

ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(float, float)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(double, double)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(long_double, long_double)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(char, char)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(wchar, wchar)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(boolean, boolean)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(octet, octet)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint8, uint8)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int8, int8)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint16, uint16)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int16, int16)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint32, uint32)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int32, int32)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint64, uint64)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int64, int64)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(bool, boolean)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(byte, octet)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(float32, float)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(float64, double)

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ROSIDL_RUNTIME_C_PRIMITIVES_SEQUENCE_FUNCTIONS_H */
