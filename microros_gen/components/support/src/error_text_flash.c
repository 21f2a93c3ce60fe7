/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text, where constants are in program memory. */
#include "microros/error.h"

#include <stddef.h>

#ifdef MICROROS_FLASH_IS_SEPARATE
/* The name of an argument, or of several: longer ones are truncated. */
enum { ARGUMENT_SIZE = 48 };

int32_t microros_error_refuse_flash(int32_t result, const MICROROS_FLASH char * argument)
{
  char words[ARGUMENT_SIZE];
  size_t size = 0;

  while ((size < sizeof(words) - 1u) && (argument[size] != '\0')) {
    words[size] = argument[size];
    ++size;
  }
  words[size] = '\0';
  return microros_error_named(result, microros_error_argument, words);
}
#endif
