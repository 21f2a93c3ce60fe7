/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. Formats the words of error_texts.c into a message; contains those that name the transport. */
#include "microros/error.h"
#include "microros/error_count.h"
#include "microros/error_state.h"
#include "microros/lock.h"
#include "microros/xrce_transport.h"

#include "microros_config.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * %s name, %d detail, %n found, %m fits; %t name, a DDS type, in ROS spelling, %D likewise for detail; %a
 * found, a status of the agent; %y key to change.
 */
const MICROROS_FLASH char microros_error_transport[] = "no transport to " XRCE_PLACE_N;
const MICROROS_FLASH char microros_error_agent_silent[] = "no agent answers at " XRCE_PLACE_N " within %m ms";
const MICROROS_FLASH char microros_error_agent_refused[] =
  "the agent at " XRCE_PLACE_M " refuses the session: %a";

/* From status 0x80 on (OMG DDS-XRCE 1.0, 7.7.2). */
static const MICROROS_FLASH char * const MICROROS_FLASH statuses[] = {
  MICROROS_FLASH_NAME("DDS_ERROR"),         MICROROS_FLASH_NAME("MISMATCH"),
  MICROROS_FLASH_NAME("ALREADY_EXISTS"),    MICROROS_FLASH_NAME("DENIED"),
  MICROROS_FLASH_NAME("UNKNOWN_REFERENCE"), MICROROS_FLASH_NAME("INVALID_DATA"),
  MICROROS_FLASH_NAME("INCOMPATIBLE"),      MICROROS_FLASH_NAME("RESOURCES")};

enum { STATUS_FIRST = 0x80, STATUS_LAST = 0x87, ERROR_DIGITS_MOST = 10 };

/* Of a type's name, `::dds_:` and the last `_` are not put; of a text, no more conversions put nothing. */
enum { TYPE_HIDDEN = 16, ERROR_CONVERSIONS = 8 };

typedef struct text_t {
  char * at;
  char * end; /* last possible position of the NUL */
} text_t;

static void text_put(text_t * text, char c)
{
  if (text->at != text->end) {
    *text->at++ = c;
  }
}

static void text_put_string(text_t * text, const MICROROS_ANYWHERE char * words)
{
  /* at most MICROROS_ERROR_TEXT_SIZE rounds of all loops in each microros_error_set */
  while (words != NULL && *words != '\0' && text->at != text->end) {
    text_put(text, *words++);
  }
}

static void text_put_number(text_t * text, uint32_t number)
{
  char digits[ERROR_DIGITS_MOST];
  size_t first = sizeof(digits);

  do { /* at most ERROR_CONVERSIONS * ERROR_DIGITS_MOST rounds in each microros_error_set */
    digits[--first] = (char)('0' + (char)(number % 10u));
    number /= 10u;
  } while (number != 0u);
  /* at most ERROR_CONVERSIONS * ERROR_DIGITS_MOST rounds in each microros_error_set */
  while (first < sizeof(digits)) {
    text_put(text, digits[first++]);
  }
}

/* "std_msgs::msg::dds_::Int32_" becomes "std_msgs/msg/Int32". */
static void text_put_type(text_t * text, const MICROROS_ANYWHERE char * dds_type)
{
  uint32_t part = 0;

  uint32_t hidden = TYPE_HIDDEN;

  /* at most MICROROS_ERROR_TEXT_SIZE + ERROR_CONVERSIONS * TYPE_HIDDEN rounds in each microros_error_set */
  for (const MICROROS_ANYWHERE char * at = dds_type; *at != '\0' && hidden != 0u && text->at != text->end;
       ++at) {
    if (at[0] == ':') {
      ++at;
      if (part != 2u) {
        text_put(text, '/');
      } else {
        --hidden;
      }
      ++part;
    } else if (part != 2u && (at[0] != '_' || at[1] != '\0')) {
      text_put(text, *at);
    } else {
      --hidden;
    }
  }
}

static void text_put_status(text_t * text, uint32_t status)
{
  if (status >= STATUS_FIRST && status <= STATUS_LAST) {
    text_put_string(text, statuses[status - STATUS_FIRST]);
  } else {
    text_put_number(text, status);
  }
}

static text_t error_begin(const char * file, size_t line_number)
{
  rcutils_error_state_t * state = microros_error_state();
  const text_t text = {state->message, &state->message[sizeof(state->message) - 1u]};

  microros_error_count();
  state->file = file;
  state->line_number = line_number;
  return text;
}

void microros_error_set(
  microros_error_t error, const MICROROS_ANYWHERE char * name, const MICROROS_ANYWHERE char * detail,
  uint32_t found, uint32_t fits)
{
  text_t text;

  microros_lock();
  text = error_begin(NULL, 0);
  /* at most MICROROS_ERROR_TEXT_SIZE + ERROR_CONVERSIONS rounds */
  for (microros_error_t at = error; *at != '\0' && text.at != text.end; ++at) {
    if (*at != '%') {
      text_put(&text, *at);
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
      case 'a':
        text_put_status(&text, found);
        break;
      default:
        text_put_string(&text, " in microros.yaml");
        break;
    }
  }
  *text.at = '\0';
  microros_unlock();
}

void rcutils_set_error_state(const char * error_string, const char * file, size_t line_number)
{
  text_t text;

  microros_lock();
  text = error_begin(file, line_number);
  text_put_string(&text, error_string);
  *text.at = '\0';
  microros_unlock();
}

int32_t microros_error_named(int32_t result, microros_error_t error, const MICROROS_ANYWHERE char * name)
{
  microros_error_set(error, name, "", 0, 0);
  return result;
}

/* In parentheses, as it may be a macro, too. */
int32_t(microros_error_refuse)(int32_t result, const char * argument)
{
  return microros_error_named(result, microros_error_argument, argument);
}
