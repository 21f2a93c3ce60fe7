/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_names_expand.h"

#include "microros/error.h"
#include "microros/rcl_names.h"
#include "microros/text.h"

#include <stdbool.h>

typedef struct names_output_t {
  char * text;
  size_t room; /* including the NUL */
  size_t size; /* of everything written, including what had no room */
} names_output_t;

static void names_append(names_output_t * output, char c)
{
  if (output->size + 1u < output->room) {
    output->text[output->size] = c;
  }
  ++output->size;
}

static void names_put_text(names_output_t * output, const char * text)
{
  for (; *text != '\0'; ++text) {
    names_append(output, *text);
  }
}

static bool names_key_is(const char * key, size_t size, const char * name)
{
  size_t i = 0;

  while (i < size && name[i] != '\0' && key[i] == name[i]) {
    ++i;
  }
  return i == size && name[i] == '\0';
}

/* Returns the value of the substitution at the brace *at, and moves *at past it; NULL if it is unknown. */
static const char * names_value(const char ** at, const rcl_names_scope_t * scope)
{
  const char * key = *at + 1;
  size_t size = 0;

  while (key[size] != '}') {
    ++size;
  }
  *at = &key[size + 1u];
  if (names_key_is(key, size, "node")) {
    return scope->node;
  }
  if (names_key_is(key, size, "ns") || names_key_is(key, size, "namespace")) {
    return scope->namespace_;
  }
  return scope->lookup != NULL ? scope->lookup(scope->values, key, size) : NULL;
}

/* Returns the first character of the name with its substitutions replaced. */
static char names_first(const char * topic, const rcl_names_scope_t * scope)
{
  while (*topic == '{') {
    const char * value = names_value(&topic, scope);

    if (value != NULL && *value != '\0') {
      return *value;
    }
  }
  return *topic;
}

static void names_put_node_prefix(names_output_t * output, const char * namespace_)
{
  if (namespace_[1] != '\0') {
    names_put_text(output, namespace_);
  }
  names_append(output, '/');
}

size_t rcl_names_expand(const char * topic, const rcl_names_scope_t * scope, char * full, size_t size)
{
  names_output_t output = {full, size, 0};
  const char * at = topic;

  if (*at == '~') {
    names_put_node_prefix(&output, scope->namespace_);
    names_put_text(&output, scope->node);
    ++at;
  } else if (names_first(at, scope) != '/') {
    names_put_node_prefix(&output, scope->namespace_);
  } else {
    /* already fully qualified */
  }
  while (*at != '\0') {
    if (*at == '{') {
      const char * value = names_value(&at, scope);

      if (value == NULL) {
        return 0;
      }
      names_put_text(&output, value);
    } else {
      names_append(&output, *at);
      ++at;
    }
  }
  if (size != 0u) {
    full[output.size < size ? output.size : size - 1u] = '\0';
  }
  return output.size;
}

const char * rcl_names_check_full(const char * full, size_t size)
{
  if (size >= (size_t)RCL_NAMES_FULL_SIZE) {
    return MICROROS_ERROR_WORDS("more than 247 bytes");
  }
  if (full[1] == '\0') {
    return MICROROS_ERROR_WORDS("a part is empty");
  }
  return rcl_names_check_namespace(full); /* the rules of a namespace are the same */
}
