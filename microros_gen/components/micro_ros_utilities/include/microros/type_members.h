/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Structure of a message as constants, for functions that work on any type; defined in
 * microros/type_tables.h. */
#ifndef MICROROS_TYPE_MEMBERS_H
#define MICROROS_TYPE_MEMBERS_H

#include "microros/message_memory.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Type of a value, or of each element. Numbers are those of rosidl_typesupport_introspection_c. */
typedef enum microros_member_type_t {
  MICROROS_MEMBER_FLOAT = 1,
  MICROROS_MEMBER_DOUBLE = 2,
  MICROROS_MEMBER_CHAR = 4,
  MICROROS_MEMBER_WCHAR = 5,
  MICROROS_MEMBER_BOOLEAN = 6,
  MICROROS_MEMBER_OCTET = 7,
  MICROROS_MEMBER_UINT8 = 8,
  MICROROS_MEMBER_INT8 = 9,
  MICROROS_MEMBER_UINT16 = 10,
  MICROROS_MEMBER_INT16 = 11,
  MICROROS_MEMBER_UINT32 = 12,
  MICROROS_MEMBER_INT32 = 13,
  MICROROS_MEMBER_UINT64 = 14,
  MICROROS_MEMBER_INT64 = 15,
  MICROROS_MEMBER_STRING = 16,
  MICROROS_MEMBER_WSTRING = 17,
  MICROROS_MEMBER_MESSAGE = 18
} microros_member_type_t;

typedef enum microros_member_shape_t {
  MICROROS_MEMBER_VALUE,
  MICROROS_MEMBER_ARRAY,
  MICROROS_MEMBER_SEQUENCE,
  MICROROS_MEMBER_BOUNDED /* a sequence with a bound */
} microros_member_shape_t;

struct microros_type_members_t;

typedef struct microros_type_member_t {
  const char * name;
  const struct microros_type_members_t * nested; /* type of a message; NULL for any other type */
  uint32_t offset;
  uint32_t count; /* elements of an array, bound of a bounded sequence, 1 of a value, 0 of a sequence */
  uint32_t string_bound; /* of a string or of each string; 0: none */
  uint8_t type;          /* microros_member_type_t */
  uint8_t shape;         /* microros_member_shape_t */
} microros_type_member_t;

typedef struct microros_type_members_t {
  const char * dds_type_name; /* "std_msgs::msg::dds_::Int32_" */
  const microros_type_member_t * members;
  const microros_pool_t * pool; /* pool for sequences of this type, or NULL */
  uint32_t size;                /* of the struct, in bytes */
  uint32_t count;
} microros_type_members_t;

/* Common layout of all strings and sequences, asserted by the tables. Values are copied from and to the
 * message, never accessed by a pointer of this type: the object there has another type. */
typedef struct microros_type_sequence_t {
  void * data;
  size_t size;
  size_t capacity;
} microros_type_sequence_t;

/* Whether `place` has this layout, with elements of `element` bytes. A constant expression. */
#define MICROROS_MEMBER_IS_SEQUENCE(place, element) \
  (sizeof(place) == sizeof(microros_type_sequence_t) && sizeof((place).data[0]) == (element))

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_TYPE_MEMBERS_H */
