/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_reason.h"

#include "microros/rclc_parameter_rules.h"
#include "microros/rclc_parameter_words.h"

#include <stddef.h>

enum { PARTS_MAX = 7 };

/* The text of an outcome: %n becomes the name, %o the type that the parameter has, %t the requested type. */
static const char * reason_words(uint8_t outcome)
{
  switch (outcome) {
    case PARAMETER_SET:
      return "";
    case PARAMETER_NONE:
      return "parameter list cannot be empty";
    case PARAMETER_UNNAMED:
      return "parameter name must not be empty";
    case PARAMETER_UNDECLARED:
      return "parameter '%n' cannot be set because it was not declared";
    case PARAMETER_SOME_UNDECLARED:
      return "One or more parameters were not declared before setting";
    case PARAMETER_READ_ONLY:
      return "parameter '%n' cannot be set because it is read-only";
    case PARAMETER_STATIC:
      return "cannot undeclare a statically typed parameter";
    case PARAMETER_OTHER_TYPE:
      return "Wrong parameter type, parameter {%n} is of type {%o}, setting it to {%t} is not allowed.";
    case PARAMETER_OUTSIDE_INTEGER:
      return "Parameter {%n} doesn't comply with integer range.";
    case PARAMETER_OUTSIDE_FLOATING_POINT:
      return "Parameter {%n} doesn't comply with floating point range.";
    case PARAMETER_REJECTED:
      return "rejected by the callback";
    case PARAMETER_CUT:
      return "the request is too large, none of it was set";
#if MICROROS_PARAMETER_STRING_SIZE > 0u
    case PARAMETER_STRING_LONG:
      return "the string for parameter '%n' is too long";
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
    case PARAMETER_ARRAY_LONG:
      return "the array for parameter '%n' is too long";
#endif
#if MICROROS_PARAMETER_ONE_OF
    case PARAMETER_NOT_ONE_OF:
      return "Parameter {%n} doesn't comply with its list of values.";
#endif
    case PARAMETER_UNSUPPORTED:
    default:
      return "parameter '%n' cannot have a value of type {%t}";
  }
}

/* Those of a parameter that would be created are linked only where that is allowed. */
static const char * reason_words_of(const rclc_parameter_server_t * server, uint8_t outcome)
{
  if (server->undeclared != NULL && outcome >= (uint8_t)PARAMETER_NAME_LONG) {
    return outcome == (uint8_t)PARAMETER_NAME_LONG ? server->undeclared->name_long : server->undeclared->full;
  }
  return reason_words(outcome);
}

static const char * reason_type(uint8_t type)
{
  static const char * const names[] = {"not set",      "bool",        "integer",    "double",
                                       "string",       "byte_array",  "bool_array", "integer_array",
                                       "double_array", "string_array"};

  return type < sizeof(names) / sizeof(names[0]) ? names[type] : "unknown type";
}

static parameter_text_t reason_insertion(
  char letter, const rclc_parameter_server_t * server, const parameter_requested_t * requested)
{
  /*
   * A name that no parameter has may be longer by this many bytes: the longest reason with such a name is shorter than the
   * one for which a reply has room, by at least 48 bytes. */
  static const uint32_t longer_name = 40;
  const rclc_parameter_place_t * place;

  if (letter == 'n') {
    return rclc_parameter_words_cut(
      &requested->name, (uint32_t)MICROROS_PARAMETER_NAME_SIZE - 1u + longer_name);
  }
  if (letter == 't') {
    return rclc_parameter_text(reason_type(requested->type));
  }
  place = rclc_parameter_find(server, &requested->name);
  return rclc_parameter_text(reason_type(place != NULL ? place->type : (uint8_t)RCLC_PARAMETER_NOT_SET));
}

void rclc_parameter_out_reason(
  parameter_out_t * out, const rclc_parameter_server_t * server, const parameter_requested_t * requested,
  uint8_t outcome)
{
  const char * words = reason_words_of(server, outcome);
  parameter_text_t parts[PARTS_MAX];
  uint32_t count = 0;

#if MICROROS_PARAMETER_RULES > 0u
  if (outcome == (uint8_t)PARAMETER_BREAKS_RULE) {
    rclc_parameter_out_rule(out, server, requested);
    return;
  }
#endif
  while (*words != '\0' && count < (uint32_t)PARTS_MAX) {
    if (*words == '%') {
      parts[count] = reason_insertion(words[1], server, requested);
      words = &words[2];
    } else {
      parts[count] = rclc_parameter_words_next(&words);
    }
    ++count;
  }
  rclc_parameter_out_parts(out, parts, count);
}
