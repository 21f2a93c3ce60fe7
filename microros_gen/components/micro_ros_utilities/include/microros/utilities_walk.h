/* SPDX-License-Identifier: Apache-2.0 */
/* Iterative walk over the members of a message and of its nested messages. */
#ifndef MICROROS_UTILITIES_WALK_H
#define MICROROS_UTILITIES_WALK_H

#include "micro_ros_utilities/type_utilities.h"
#include "microros/type_members.h"
#include "microros/type_tables.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum utilities_event_t {
  UTILITIES_MEMBER, /* a member begins: utilities_walk_enter may descend into it */
  UTILITIES_AFTER,  /* a member ends, after everything that was entered */
  UTILITIES_END     /* the walk is complete */
} utilities_event_t;

/* One message, or the consecutive messages of an array or a sequence. */
typedef struct utilities_level_t {
  const microros_type_members_t * type;
  uint8_t * message; /* the current one; NULL if a type is walked without a message */
  size_t left;       /* messages after it */
  uint32_t member;   /* index of the current member */
  bool inside;       /* that member has begun */
} utilities_level_t;

typedef struct utilities_walk_t {
  utilities_level_t levels[MICROROS_TYPE_DEPTH];
  uint32_t depth;                        /* levels in use, never 0 */
  const microros_type_member_t * member; /* of the last event */
  uint8_t * place;                       /* its address in the message, or NULL */
} utilities_walk_t;

/* Returns the table of a handle; NULL, with the error set, if the handle is not from this library. */
const microros_type_members_t * utilities_type(const rosidl_message_type_support_t * type_support);

/* Starts before the first member of `message` (which may be NULL). */
void utilities_walk_begin(utilities_walk_t * walk, const microros_type_members_t * type, uint8_t * message);

utilities_event_t utilities_walk_next(utilities_walk_t * walk);

/* Descends into `count` messages of the current member's type; `messages` may be NULL. */
void utilities_walk_enter(utilities_walk_t * walk, uint8_t * messages, size_t count);

/* Returns whether the member has the `size` and `capacity` of a sequence. */
bool utilities_is_sequence(const microros_type_member_t * member);

/* Returns whether it is a string, or an array or sequence of strings. */
bool utilities_is_text(const microros_type_member_t * member);

/* Returns the size of one element in memory, in bytes. */
size_t utilities_element_size(const microros_type_member_t * member);

/* Returns false, with the error set, if a rule names no string and no sequence of the type. */
bool utilities_rules_check(
  const microros_type_members_t * type, const micro_ros_utilities_memory_conf_t * conf);

/* Return the number of elements of the current sequence, and the bytes of the current string. */
size_t utilities_sequence_capacity(
  const utilities_walk_t * walk, const micro_ros_utilities_memory_conf_t * conf);
size_t utilities_text_capacity(const utilities_walk_t * walk, const micro_ros_utilities_memory_conf_t * conf);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_UTILITIES_WALK_H */
