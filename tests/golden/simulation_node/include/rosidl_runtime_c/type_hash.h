/* SPDX-License-Identifier: Apache-2.0 */
/* The hash of an interface's description (RIHS01). */
#ifndef MICROROS_ROSIDL_RUNTIME_C_TYPE_HASH_H
#define MICROROS_ROSIDL_RUNTIME_C_TYPE_HASH_H

#include <stdint.h>

#define ROSIDL_TYPE_HASH_VERSION_UNSET 0
#define ROSIDL_TYPE_HASH_SIZE 32

typedef struct rosidl_type_hash_s {
  uint8_t version;
  uint8_t value[ROSIDL_TYPE_HASH_SIZE];
} rosidl_type_hash_t;

#endif /* MICROROS_ROSIDL_RUNTIME_C_TYPE_HASH_H */
