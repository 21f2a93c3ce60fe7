/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/text.h"

size_t microros_text_size(const MICROROS_ANYWHERE char * text)
{
  size_t size = 0;

  while (text[size] != '\0') {
    ++size;
  }
  return size;
}

/* The linker stores equal constants once, so that the names of types mostly have one address. */
bool microros_text_equals(const MICROROS_ANYWHERE char * a, const MICROROS_ANYWHERE char * b)
{
  while (*a == *b) {
    if (a == b || *a == '\0') {
      return true;
    }
    ++a;
    ++b;
  }
  return false;
}
