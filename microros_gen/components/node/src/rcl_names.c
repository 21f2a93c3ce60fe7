/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_names.h"

#include "microros/error.h"

#include <stdbool.h>
#include <stddef.h>

static bool names_is_digit(char c)
{
  return c >= '0' && c <= '9';
}

static bool names_is_word(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || names_is_digit(c) || c == '_';
}

/* Parts of letters, digits and underscores that do not start with a digit, separated by single slashes. */
static const char * names_check_parts(const char * name)
{
  bool at_start = true;

  for (const char * at = name; *at != '\0'; ++at) {
    if (*at == '/') {
      if (at_start) {
        return MICROROS_ERROR_WORDS("a part is empty");
      }
      at_start = true;
    } else if (!names_is_word(*at)) {
      return MICROROS_ERROR_WORDS("only letters, digits and _");
    } else if (at_start && names_is_digit(*at)) {
      return MICROROS_ERROR_WORDS("a part begins with a digit");
    } else {
      at_start = false;
    }
  }
  return at_start ? MICROROS_ERROR_WORDS("a part is empty") : NULL;
}

const char * rcl_names_check_node(const char * name)
{
  for (const char * at = name; *at != '\0'; ++at) {
    if (*at == '/') {
      return MICROROS_ERROR_WORDS("only letters, digits and _");
    }
  }
  return names_check_parts(name);
}

const char * rcl_names_check_namespace(const char * namespace_)
{
  if (namespace_[0] == '/') {
    ++namespace_;
  }
  return namespace_[0] == '\0' ? NULL : names_check_parts(namespace_);
}

const char * rcl_names_check_topic(const char * topic)
{
  if (topic[0] == '~') {
    ++topic;
    if (topic[0] == '\0') {
      return NULL;
    }
    if (topic[0] != '/') {
      return MICROROS_ERROR_WORDS("no / after ~");
    }
  }
  return names_check_parts(topic[0] == '/' ? topic + 1 : topic);
}
