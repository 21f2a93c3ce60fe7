/* SPDX-License-Identifier: Apache-2.0 */
/* errors: code. Numbers replace the texts. */
#include "microros/error.h"
#include "microros/error_count.h"
#include "microros/error_state.h"
#include "microros/lock.h"

#include <stddef.h>

enum { OF_THE_APPLICATION = 1 };

/* Two digits, or three; a plan without such an error has no code for the third. */
static void error_write_number(char * to, uint32_t code)
{
  uint32_t rest = code;
  size_t at = 0;

  if (MICROROS_ERROR_LARGEST > 99u && code > 99u) {
    to[0] = (char)('0' + (char)(code / 100u));
    rest = code % 100u;
    at = 1;
  }
  to[at] = (char)('0' + (char)(rest / 10u));
  to[at + 1u] = (char)('0' + (char)(rest % 10u));
  to[at + 2u] = '\0';
}

static void error_write(uint32_t code, const char * file, size_t line_number)
{
  rcutils_error_state_t * state = microros_error_state();

  microros_lock();
  microros_error_count();
  state->message[0] = 'E';
  error_write_number(&state->message[1], code);
  state->file = file;
  state->line_number = line_number;
  microros_unlock();
}

int32_t microros_error_code(int32_t result, microros_error_t error)
{
  error_write(error, NULL, 0);
  return result;
}

void rcutils_set_error_state(const char * error_string, const char * file, size_t line_number)
{
  (void)error_string;
  error_write(OF_THE_APPLICATION, file, line_number);
}
