/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/text.h"

size_t microros_text_size(const char * text)
{
  const char * end = text;

  while (*end != '\0') {
    ++end;
  }
  return (size_t)(end - text);
}

bool microros_text_equals(const char * a, const char * b)
{
  while (*a == *b && *a != '\0') {
    ++a;
    ++b;
  }
  return *a == *b;
}
