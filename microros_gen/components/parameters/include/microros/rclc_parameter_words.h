/* SPDX-License-Identifier: Apache-2.0 */
/* Words of a reason: a constant text; % and a letter mark an insertion. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_WORDS_H
#define MICROROS_RCLC_PARAMETER_WORDS_H

#include <stdint.h>

#include "microros/rclc_parameters.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns a text of at most `most` bytes, cut between two characters of UTF-8. */
static inline parameter_text_t rclc_parameter_words_cut(const parameter_text_t * text, uint32_t most)
{
  parameter_text_t result = *text;

  if (result.size > most) {
    result.size = most;
    while (result.size != 0u && ((uint8_t)result.data[result.size] & 0xC0u) == 0x80u) {
      --result.size;
    }
  }
  return result;
}

/* Returns the text before the next insertion, and moves *words to it or to the end. */
static inline parameter_text_t rclc_parameter_words_next(const char ** words)
{
  parameter_text_t result = {*words, 0};

  while ((*words)[result.size] != '\0' && (*words)[result.size] != '%') {
    ++result.size;
  }
  *words = &(*words)[result.size];
  return result;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_WORDS_H */
