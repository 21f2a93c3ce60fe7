/* SPDX-License-Identifier: Apache-2.0 */
/* Rules of generate_parameter_library. Requests are judged where they arrived: no element is copied before. */
#include "microros/rclc_parameter_rules.h"

#if MICROROS_PARAMETER_RULES > 0u

#include "microros/rclc_parameter_show.h"
#include "microros/rclc_parameter_words.h"

#include <stddef.h>

/* Parts of a reason: a value, the name, and words around them. */
enum { RULE_PARTS_MAX = 6 };

/* A value, or an element of an array; the text of a string. */
typedef struct rule_element_t {
  rclc_parameter_scalar_t value;
  parameter_text_t text;
} rule_element_t;

/* The values of a request that are still to be read. */
typedef struct rule_walk_t {
  const parameter_requested_t * requested;
  uint8_t type; /* of each */
  uint32_t left;
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  cdr_in_t in;
#endif
} rule_walk_t;

/* The first rule that a request breaks, and its value that does. */
typedef struct rule_broken_t {
  const rclc_parameter_rule_t * rule; /* NULL: it follows all */
  uint8_t type;
  rule_element_t element;
} rule_broken_t;

static uint32_t rule_size(const parameter_requested_t * requested)
{
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  if (requested->type == (uint8_t)RCLC_PARAMETER_STRING) {
    return requested->string.size;
  }
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  return requested->array_count;
#else
  return 0;
#endif
}

static rule_walk_t rule_walk(const parameter_requested_t * requested)
{
  rule_walk_t walk = {.requested = requested, .type = requested->type, .left = 1u};

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  if (requested->type >= (uint8_t)RCLC_PARAMETER_BYTE_ARRAY) {
    walk.type = (uint8_t)(requested->type - (uint8_t)RCLC_PARAMETER_BYTE_ARRAY);
    walk.left = requested->array_count;
    walk.in = requested->array;
  }
#endif
  return walk;
}

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
static void rule_read(rule_walk_t * walk, rule_element_t * element)
{
  if (walk->type == (uint8_t)RCLC_PARAMETER_STRING) {
    element->text = rclc_parameter_in_text(&walk->in);
  } else if (walk->type == (uint8_t)RCLC_PARAMETER_BOOL) {
    cdr_get_bool(&walk->in, &element->value.bool_value, 1u, "message");
  } else {
    cdr_get_8(&walk->in, &element->value, 1u, "message");
  }
}
#endif

/* Reads the next value; returns false after the last one. */
static bool rule_next(rule_walk_t * walk, rule_element_t * element)
{
  const parameter_requested_t * const requested = walk->requested;

  if (walk->left == 0u) {
    return false;
  }
  --walk->left;
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  if (requested->type >= (uint8_t)RCLC_PARAMETER_BYTE_ARRAY) {
    rule_read(walk, element);
    return true;
  }
#endif
  element->value = requested->value;
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  element->text = requested->string;
#endif
  return true;
}

/* Returns a value that a rule has. */
static rule_element_t rule_value(const rclc_parameter_rule_t * rule, uint8_t type, uint32_t index)
{
  rule_element_t element = {.value = {.integer_value = 0}, .text = {NULL, 0}};

  switch (type) {
    case RCLC_PARAMETER_BOOL:
      element.value.bool_value = ((const bool *)rule->values)[index];
      break;
    case RCLC_PARAMETER_INT:
      element.value.integer_value = ((const int64_t *)rule->values)[index];
      break;
    case RCLC_PARAMETER_DOUBLE:
      element.value.double_value = ((const double *)rule->values)[index];
      break;
    default:
      element.text = rclc_parameter_text(((const char * const *)rule->values)[index]);
      break;
  }
  return element;
}

/* For numbers. */
static bool rule_is_less(uint8_t type, const rule_element_t * one, const rule_element_t * other)
{
#if MICROROS_PARAMETER_RULES > 1u
  if (type == (uint8_t)RCLC_PARAMETER_DOUBLE) {
    return one->value.double_value < other->value.double_value;
  }
#endif
  (void)type;
  return one->value.integer_value < other->value.integer_value;
}

static bool rule_is_same_text(const parameter_text_t * one, const parameter_text_t * other)
{
  uint32_t i = 0;

  while (i < one->size && i < other->size && one->data[i] == other->data[i]) {
    ++i;
  }
  return i == one->size && i == other->size;
}

static bool rule_is_same(uint8_t type, const rule_element_t * one, const rule_element_t * other)
{
  switch (type) {
    case RCLC_PARAMETER_BOOL:
      return one->value.bool_value == other->value.bool_value;
    case RCLC_PARAMETER_INT:
      return one->value.integer_value == other->value.integer_value;
#if MICROROS_PARAMETER_RULES > 1u
    case RCLC_PARAMETER_DOUBLE: /* NaN is not the same as itself */
      return one->value.double_value <= other->value.double_value &&
             one->value.double_value >= other->value.double_value;
#endif
    default:
      return rule_is_same_text(&one->text, &other->text);
  }
}

static bool rule_lists(const rclc_parameter_rule_t * rule, uint8_t type, const rule_element_t * element)
{
  bool found = false;

  for (uint32_t i = 0; i < rule->count && !found; ++i) {
    const rule_element_t listed = rule_value(rule, type, i);

    found = rule_is_same(type, element, &listed);
  }
  return found;
}

/* Returns whether none of the elements before the one that was read last is the same. */
static bool rule_is_new(const rule_walk_t * walk, const rule_element_t * element)
{
  rule_walk_t before = rule_walk(walk->requested);
  rule_element_t earlier = {.value = {.integer_value = 0}, .text = {NULL, 0}};
  bool found = false;

  while (!found && before.left > walk->left + 1u && rule_next(&before, &earlier)) {
    found = rule_is_same(walk->type, element, &earlier);
  }
  return !found;
}

static bool rule_compares(const rclc_parameter_rule_t * rule, uint8_t type, const rule_element_t * element)
{
  const rule_element_t first = rule_value(rule, type, 0u);
  const rule_element_t last = rule_value(rule, type, rule->count - 1u);

  switch (rule->kind) {
    case PARAMETER_RULE_FROM:
      return !rule_is_less(type, element, &first);
    case PARAMETER_RULE_TO:
      return !rule_is_less(type, &first, element);
    case PARAMETER_RULE_WITHIN:
      return !rule_is_less(type, element, &first) && !rule_is_less(type, &last, element);
    case PARAMETER_RULE_ABOVE:
      return rule_is_less(type, &first, element);
    case PARAMETER_RULE_BELOW:
    default:
      return rule_is_less(type, element, &first);
  }
}

static bool rule_holds_for(
  const rclc_parameter_rule_t * rule, const rule_walk_t * walk, const rule_element_t * element)
{
  if (rule->kind == (uint8_t)PARAMETER_RULE_UNIQUE) {
    return rule_is_new(walk, element);
  }
  if (rule->kind == (uint8_t)PARAMETER_RULE_LISTED) {
    return rule_lists(rule, walk->type, element);
  }
  return rule_compares(rule, walk->type, element);
}

/* Fills `broken` with the value that breaks a rule, and returns false; true: none does. */
static bool rule_holds(
  const rclc_parameter_rule_t * rule, const parameter_requested_t * requested, rule_broken_t * broken)
{
  const uint32_t size = rule_size(requested);
  rule_walk_t walk;

  switch (rule->kind) {
    case PARAMETER_RULE_SIZE_IS:
      return size == rule->count;
    case PARAMETER_RULE_SIZE_ABOVE:
      return size > rule->count;
    case PARAMETER_RULE_SIZE_BELOW:
      return size < rule->count;
    default:
      break;
  }
  walk = rule_walk(requested);
  broken->type = walk.type;
  while (rule_next(&walk, &broken->element)) {
    if (!rule_holds_for(rule, &walk, &broken->element)) {
      return false;
    }
  }
  return true;
}

static rule_broken_t rule_find(const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  rule_broken_t broken = {
    .rule = NULL,
    .type = (uint8_t)RCLC_PARAMETER_NOT_SET,
    .element = {.value = {.integer_value = 0}, .text = {NULL, 0}}};

  for (uint32_t i = 0; i < place->about->rules_count && broken.rule == NULL; ++i) {
    const rclc_parameter_rule_t * const rule = &place->about->rules[i];

    if (!rule_holds(rule, requested, &broken)) {
      broken.rule = rule;
    }
  }
  return broken;
}

bool rclc_parameter_rules_hold(const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  return rule_find(place, requested).rule == NULL;
}

/* Returns the value that breaks a rule; `room`: for a number. */
static parameter_text_t rule_shown(const rule_broken_t * broken, char * room)
{
  parameter_text_t result = {room, 0};

  switch (broken->type) {
    case RCLC_PARAMETER_BOOL:
      return rclc_parameter_text(broken->element.value.bool_value ? "true" : "false");
    case RCLC_PARAMETER_INT:
      result.size = rclc_parameter_show_integer(room, broken->element.value.integer_value);
      return result;
#if MICROROS_PARAMETER_RULES > 1u
    case RCLC_PARAMETER_DOUBLE:
      result.size = rclc_parameter_show_double(room, broken->element.value.double_value);
      return result;
#endif
    default:
      /* one that is longer than any value is cut */
      return rclc_parameter_words_cut(&broken->element.text, (uint32_t)MICROROS_PARAMETER_SHOWN_SIZE);
  }
}

/* Returns what is inserted in the words. */
static parameter_text_t rule_insertion(
  char letter, const parameter_requested_t * requested, const rule_broken_t * broken, char * room)
{
  parameter_text_t result = {room, 0};

  if (letter == 'n') {
    return requested->name;
  }
  if (letter == 'v') {
    return rule_shown(broken, room);
  }
  result.size = rclc_parameter_show_integer(room, (int64_t)rule_size(requested));
  return result;
}

void rclc_parameter_out_rule(
  parameter_out_t * out, const rclc_parameter_server_t * server, const parameter_requested_t * requested)
{
  const rclc_parameter_place_t * place = rclc_parameter_find(server, &requested->name);
  rule_broken_t broken;
  const char * words;
  char room[PARAMETER_SHOWN_MAX];
  parameter_text_t parts[RULE_PARTS_MAX];
  uint32_t count = 0;

  if (place == NULL) {
    rclc_parameter_out_text(out, ""); /* the program deleted it meanwhile */
    return;
  }
  broken = rule_find(place, requested);
  words = broken.rule != NULL ? broken.rule->words : "\0";
  while (*words != '\0' && count < (uint32_t)RULE_PARTS_MAX - 1u) {
    if (*words == '%') {
      parts[count] = rule_insertion(words[1], requested, &broken, room);
      words = &words[2];
    } else {
      parts[count] = rclc_parameter_words_next(&words);
    }
    ++count;
  }
  parts[count] = rclc_parameter_text(&words[1]);
  rclc_parameter_out_parts(out, parts, count + 1u);
}

#endif
