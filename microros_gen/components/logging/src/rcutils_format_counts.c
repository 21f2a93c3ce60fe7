/* SPDX-License-Identifier: Apache-2.0 */
/* Texts that are complete, and what was lost of others. */
#include "microros/lock.h"
#include "microros/rcutils_format.h"
#include "rcutils/logging.h"

enum { MARK_SIZE = 3, UTF8_MORE = 3 }; /* bytes of a character after its first one */

static rcutils_logging_counts_t format_counts;

rcutils_logging_counts_t rcutils_logging_get_counts(void)
{
  rcutils_logging_counts_t counts;

  microros_lock();
  counts = format_counts;
  microros_unlock();
  return counts;
}

void microros_format_dropped(void)
{
  microros_lock();
  ++format_counts.dropped;
  microros_unlock();
}

void microros_format_end(microros_format_t * out)
{
  const size_t marks = out->used < MARK_SIZE ? out->used : MARK_SIZE;

  if (!out->truncated) {
    return;
  }
  microros_lock();
  ++format_counts.truncated;
  microros_unlock();
  /* Not in the middle of a character of UTF-8, which ROS would refuse to read. */
  /* at most UTF8_MORE rounds */
  for (uint32_t left = UTF8_MORE;
       left != 0u && out->used > marks && ((uint8_t)out->text[out->used - marks] & 0xc0u) == 0x80u; --left) {
    --out->used;
  }
  for (size_t i = 1; i <= marks; ++i) { /* at most MARK_SIZE rounds */
    out->text[out->used - i] = '.';
  }
}

size_t rcutils_logging_format(char * text, size_t size, const char * format, va_list * args)
{
  microros_format_t out = {text, size - 1u, 0, false};

  if (text == NULL || size == 0u || format == NULL || args == NULL) {
    return 0;
  }
  microros_format_arguments(&out, format, args);
  microros_format_end(&out);
  text[out.used] = '\0';
  return out.used;
}
