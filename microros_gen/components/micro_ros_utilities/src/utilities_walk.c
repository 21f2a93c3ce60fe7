/* SPDX-License-Identifier: Apache-2.0 */
/* The members of a message, one after another. Capacities: from the rules, otherwise from the interface file, otherwise from
 * the configuration. */
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

static const char strings_of_sequence[] = "data";

/* Returns the member with this name of `length` characters, or NULL. */
static const microros_type_member_t * rules_find(
  const microros_type_members_t * type, const char * name, size_t length)
{
  for (uint32_t i = 0; i < type->count; ++i) {
    const char * known = type->members[i].name;

    if (strncmp(known, name, length) == 0 && known[length] == '\0') {
      return &type->members[i];
    }
  }
  return NULL;
}

static bool rules_names_member(const microros_type_members_t * type, const char * rule)
{
  const microros_type_members_t * in = type;
  const char * at = rule;

  while (in != NULL) {
    const size_t length = strcspn(at, ".");
    const microros_type_member_t * member = rules_find(in, at, length);

    if (member == NULL) {
      return false;
    }
    at = &at[length];
    at = &at[*at == '.' ? 1u : 0u];
    if (*at == '\0') {
      return utilities_is_sequence(member) || utilities_is_text(member);
    }
    if (utilities_is_sequence(member) && utilities_is_text(member)) {
      return strcmp(at, strings_of_sequence) == 0;
    }
    in = member->nested;
  }
  return false;
}

bool utilities_rules_check(
  const microros_type_members_t * type, const micro_ros_utilities_memory_conf_t * conf)
{
  if (conf->n_rules != 0u && conf->rules == NULL) {
    (void)microros_error_refuse(0, "conf.rules");
    return false;
  }
  for (size_t i = 0; i < conf->n_rules; ++i) {
    const char * rule = conf->rules[i].rule;

    if (rule == NULL) {
      (void)microros_error_refuse(0, "conf.rules[].rule");
      return false;
    }
    if (!rules_names_member(type, rule)) {
      microros_error_set(microros_error_memory_rule, type->dds_type_name, rule, 0, 0);
      return false;
    }
  }
  return true;
}

/* Returns whether the rule is the path of the current member followed by `ending`. */
static bool rules_match(const utilities_walk_t * walk, const char * rule, const char * ending)
{
  const char * at = rule;

  for (uint32_t i = 0; i < walk->depth; ++i) {
    const utilities_level_t * level = &walk->levels[i];
    const char * name = level->type->members[level->member].name;
    const size_t length = strlen(name);

    if (strncmp(at, name, length) != 0 || (at[length] != '.' && at[length] != '\0')) {
      return false;
    }
    at = &at[length];
    at = &at[*at == '.' ? 1u : 0u];
  }
  return strcmp(at, ending) == 0;
}

static size_t rules_capacity(
  const utilities_walk_t * walk, const micro_ros_utilities_memory_conf_t * conf, const char * ending,
  size_t otherwise)
{
  for (size_t i = 0; i < conf->n_rules; ++i) {
    if (rules_match(walk, conf->rules[i].rule, ending)) {
      return conf->rules[i].size;
    }
  }
  return otherwise;
}

static size_t rules_or(size_t chosen, size_t otherwise)
{
  return chosen == 0u ? otherwise : chosen;
}

size_t utilities_sequence_capacity(
  const utilities_walk_t * walk, const micro_ros_utilities_memory_conf_t * conf)
{
  const micro_ros_utilities_memory_conf_t * usual = &micro_ros_utilities_memory_conf_default;
  size_t capacity;

  if (walk->member->shape == (uint8_t)MICROROS_MEMBER_BOUNDED) {
    capacity = (size_t)walk->member->count;
  } else if (walk->member->nested != NULL) {
    capacity = rules_or(conf->max_ros2_type_sequence_capacity, usual->max_ros2_type_sequence_capacity);
  } else {
    capacity = rules_or(conf->max_basic_type_sequence_capacity, usual->max_basic_type_sequence_capacity);
  }
  return rules_capacity(walk, conf, "", capacity);
}

size_t utilities_text_capacity(const utilities_walk_t * walk, const micro_ros_utilities_memory_conf_t * conf)
{
  const size_t usual =
    rules_or(conf->max_string_capacity, micro_ros_utilities_memory_conf_default.max_string_capacity);
  const char * ending = utilities_is_sequence(walk->member) ? strings_of_sequence : "";
  const size_t bound = (size_t)walk->member->string_bound; /* characters without the terminator */

  return rules_capacity(walk, conf, ending, bound != 0u ? bound + 1u : usual);
}
