/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. All words of the library are here. */
#include "microros/error.h"
#include "microros/error_state.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/*
 * %s name, %d detail, %n found, %m fits; %t name is a DDS type, written as ROS does; %D the same of detail; %a found is a
 * status of the agent. The order is that of microros_error_t.
 */
static const char * const texts[] = {
  "",
  "",
  "%s is NULL or not initialized",
  "a context is open already: there is one session",
  "no transport to %s:%n",
  "no agent answers at %s:%n within %m ms",
  "the agent at %s:%m refuses the session: %a",
  "address %s or port %d is not valid (host: up to %m bytes)",
  "name '%s': %d",
  "name '%s' takes %n bytes: set pools: {name_size: %m} in microros.yaml",
  "node not declared: add to nodes: in microros.yaml: {name: %s, namespace: %d}",
  "node %s is open already",
  "all %n nodes are open: set pools: {nodes: %m} in microros.yaml",
  "publisher not declared: add to its node's publishers: in microros.yaml: {topic: %s, type: %D}",
  "publisher %s is open already",
  "all %n publishers are open: set pools: {publishers: %m} in microros.yaml",
  "%t takes %n bytes and its stream holds %m: declare the publisher with its qos in microros.yaml",
  "publisher %s: XRCE carries no such QoS: %d",
  "%d %s: no answer of the agent within %m ms",
  "%d %s: the agent refuses it: %a",
  "%t.%d: %n, limit %m: raise limits in microros.yaml",
  "publisher %s: stream full, %n unacknowledged: raise pools: {history: %m} in microros.yaml",
  "publisher %s: no session with the agent",
  "publisher %s: the transport takes nothing",
  "no memory for %n bytes: raise memory: {arena: %m} in microros.yaml",
  "serialized message: not little endian CDR, or %n bytes above %m",
  "domain %n is above %m"
};

typedef struct text_t {
  char * at;
  size_t left; /* without the NUL */
} text_t;

static void text_put(text_t * text, const char * words, size_t size)
{
  const size_t fits = size < text->left ? size : text->left;

  memcpy(text->at, words, fits);
  text->at += fits;
  text->left -= fits;
}

static void text_put_string(text_t * text, const char * words)
{
  if (words != NULL) {
    text_put(text, words, strlen(words));
  }
}

static void text_put_number(text_t * text, uint32_t number)
{
  char digits[10];
  size_t first = sizeof(digits);

  do {
    digits[--first] = (char)('0' + (char)(number % 10u));
    number /= 10u;
  } while (number != 0u);
  text_put(text, &digits[first], sizeof(digits) - first);
}

/* "std_msgs::msg::dds_::Int32_" becomes "std_msgs/msg/Int32". */
static void text_put_type(text_t * text, const char * dds_type)
{
  static const char dds_part[] = "dds_::";

  for (const char * at = dds_type; *at != '\0'; ++at) {
    if (strncmp(at, dds_part, sizeof(dds_part) - 1u) == 0) {
      at += sizeof(dds_part) - 2u;
    } else if (at[0] == ':' && at[1] == ':') {
      text_put(text, "/", 1);
      ++at;
    } else if (at[0] != '_' || at[1] != '\0') {
      text_put(text, at, 1);
    }
  }
}

static void text_put_status(text_t * text, uint32_t status)
{
  static const char * const names[] = {"DDS_ERROR",         "MISMATCH",     "ALREADY_EXISTS", "DENIED",
                                       "UNKNOWN_REFERENCE", "INVALID_DATA", "INCOMPATIBLE",   "RESOURCES"};
  const uint32_t index = status - 0x80u;

  if (index < sizeof(names) / sizeof(names[0])) {
    text_put_string(text, names[index]);
  } else {
    text_put_number(text, status);
  }
}

static void error_finish(text_t * text, const char * file, size_t line_number)
{
  *text->at = '\0';
  microros_error_state()->file = file;
  microros_error_state()->line_number = line_number;
}

static text_t error_begin(void)
{
  const text_t text = {microros_error_state()->message, sizeof(microros_error_state()->message) - 1u};

  return text;
}

void microros_error_set(
  microros_error_t error, const char * name, const char * detail, uint32_t found, uint32_t fits)
{
  text_t text = error_begin();

  for (const char * at = texts[error]; *at != '\0'; ++at) {
    if (*at != '%') {
      text_put(&text, at, 1);
      continue;
    }
    ++at;
    switch (*at) {
      case 's':
        text_put_string(&text, name);
        break;
      case 'd':
        text_put_string(&text, detail);
        break;
      case 't':
        text_put_type(&text, name);
        break;
      case 'D':
        text_put_type(&text, detail);
        break;
      case 'n':
        text_put_number(&text, found);
        break;
      case 'm':
        text_put_number(&text, fits);
        break;
      default:
        text_put_status(&text, found);
        break;
    }
  }
  error_finish(&text, NULL, 0);
}

void rcutils_set_error_state(const char * error_string, const char * file, size_t line_number)
{
  text_t text = error_begin();

  text_put_string(&text, error_string);
  error_finish(&text, file, line_number);
}
