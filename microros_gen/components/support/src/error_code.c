/* SPDX-License-Identifier: Apache-2.0 */
/* errors: code. The text is "E" and the number of microros/error.h. */
#include "microros/error.h"
#include "microros/error_state.h"

#include <stddef.h>

static void error_write(microros_error_t error, const char * file, size_t line_number)
{
  rcutils_error_state_t * state = microros_error_state();
  const uint32_t number = (uint32_t)error;

  state->message[0] = 'E';
  state->message[1] = (char)('0' + (char)(number / 10u));
  state->message[2] = (char)('0' + (char)(number % 10u));
  state->message[3] = '\0';
  state->file = file;
  state->line_number = line_number;
}

void microros_error_set(
  microros_error_t error, const char * name, const char * detail, uint32_t found, uint32_t fits)
{
  (void)name;
  (void)detail;
  (void)found;
  (void)fits;
  error_write(error, NULL, 0);
}

void rcutils_set_error_state(const char * error_string, const char * file, size_t line_number)
{
  (void)error_string;
  error_write(MICROROS_ERROR_APPLICATION, file, line_number);
}
