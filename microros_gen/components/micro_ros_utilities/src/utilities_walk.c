/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/utilities_walk.h"

#include "microros/cdr.h"
#include "microros/error.h"
#include "microros/text.h"

#include <string.h>

const microros_type_members_t * utilities_type(const rosidl_message_type_support_t * type_support)
{
  const microros_message_type_t * type;

  if (
    type_support == NULL ||
    strcmp(type_support->typesupport_identifier, MICROROS_TYPE_SUPPORT_IDENTIFIER) != 0) {
    (void)microros_error_refuse(0, "type_support");
    return NULL;
  }
  type = type_support->data;
  for (const microros_type_members_t * const * at = microros_type_tables; *at != NULL; ++at) {
    if (microros_text_equals((*at)->dds_type_name, type->dds_type_name)) {
      return *at;
    }
  }
  (void)microros_error_refuse(0, "type_support");
  return NULL;
}

void utilities_walk_begin(utilities_walk_t * walk, const microros_type_members_t * type, uint8_t * message)
{
  const utilities_level_t first = {type, message, 0, 0, false};

  walk->levels[0] = first;
  walk->depth = 1;
  walk->member = NULL;
  walk->place = NULL;
}

/* Reports the current member of the level. */
static utilities_event_t walk_report(
  utilities_walk_t * walk, const utilities_level_t * level, utilities_event_t event)
{
  walk->member = &level->type->members[level->member];
  walk->place = level->message == NULL ? NULL : &level->message[walk->member->offset];
  return event;
}

utilities_event_t utilities_walk_next(utilities_walk_t * walk)
{
  while (walk->depth != 0u) {
    utilities_level_t * level = &walk->levels[walk->depth - 1u];

    if (level->inside) {
      const utilities_event_t event = walk_report(walk, level, UTILITIES_AFTER);

      level->inside = false;
      ++level->member;
      return event;
    }
    if (level->member < level->type->count) {
      level->inside = true;
      return walk_report(walk, level, UTILITIES_MEMBER);
    }
    if (level->left != 0u) {
      --level->left;
      level->member = 0;
      level->message = level->message == NULL ? NULL : &level->message[level->type->size];
    } else {
      --walk->depth;
    }
  }
  return UTILITIES_END;
}

void utilities_walk_enter(utilities_walk_t * walk, uint8_t * messages, size_t count)
{
  if (count != 0u && walk->depth < (uint32_t)MICROROS_TYPE_DEPTH) {
    const utilities_level_t nested = {walk->member->nested, messages, count - 1u, 0, false};

    walk->levels[walk->depth] = nested;
    ++walk->depth;
  }
}

bool utilities_is_sequence(const microros_type_member_t * member)
{
  return member->shape == (uint8_t)MICROROS_MEMBER_SEQUENCE ||
         member->shape == (uint8_t)MICROROS_MEMBER_BOUNDED;
}

bool utilities_is_text(const microros_type_member_t * member)
{
  return member->type == (uint8_t)MICROROS_MEMBER_STRING || member->type == (uint8_t)MICROROS_MEMBER_WSTRING;
}

size_t utilities_element_size(const microros_type_member_t * member)
{
  /* Indexed by the type's number; 0 for types that .msg files do not have. */
  static const uint8_t sizes[] = {0, 4, 8, 0, 0, 0, sizeof(bool), 1, 1, 1, 2, 2, 4, 4, 8, 8};

  if (member->nested != NULL) {
    return (size_t)member->nested->size;
  }
  return utilities_is_text(member) ? sizeof(microros_type_sequence_t) : sizes[member->type];
}
