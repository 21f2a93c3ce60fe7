/* SPDX-License-Identifier: Apache-2.0 */
/* What rcutils_logging_format_message and arrays of characters do, as lines: with this library, and with librcutils. */
#include <rcutils/allocator.h>
#include <rcutils/error_handling.h>
#include <rcutils/logging.h>
#include <rcutils/types/char_array.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void say(const char * what, rcutils_ret_t ret, const rcutils_char_array_t * array)
{
  (void)printf(
    "%s: %d owns %d length %d text '%s'\n", what, ret, array->owns_buffer, (int)array->buffer_length,
    array->buffer == NULL ? "(null)" : array->buffer);
  rcutils_reset_error();
}

static rcutils_ret_t print(rcutils_char_array_t * array, const char * format, ...)
{
  va_list args;
  rcutils_ret_t ret;

  va_start(args, format);
  ret = rcutils_char_array_vsprintf(array, format, args);
  va_end(args);
  return ret;
}

static rcutils_char_array_t lent(char * text, size_t size)
{
  rcutils_char_array_t array = rcutils_get_zero_initialized_char_array();

  array.owns_buffer = false;
  array.buffer = text;
  array.buffer_capacity = size;
  array.allocator = rcutils_get_default_allocator();
  return array;
}

static void messages(void)
{
  static const int levels[] = {10, 20, 30, 40, 50};
  static const int64_t times[] = {0, -1, 999999999, -1500000000, 1700000000123456789};
  const rcutils_log_location_t location = {"function", "file.c", 42};
  char text[200];

  for (size_t i = 0; i < sizeof(levels) / sizeof(levels[0]); ++i) {
    rcutils_char_array_t out = lent(text, sizeof(text));

    text[0] = '\0';
    say("level", rcutils_logging_format_message(&location, levels[i], "arm.left", times[i], "turns %d", &out), &out);
    say("again", rcutils_logging_format_message(NULL, levels[i], NULL, times[i], "", &out), &out);
    say("end", rcutils_char_array_strncat(&out, "\nmore", 1), &out);
    say("fini", rcutils_char_array_fini(&out), &out);
  }
}

/* A lent buffer that is too small is replaced with memory of the allocator. */
static void growing_messages(void)
{
  char text[16] = "";
  rcutils_char_array_t out = lent(text, sizeof(text));

  say("grown", rcutils_logging_format_message(NULL, 20, "arm", 1500000000, "a text that is longer", &out), &out);
  say("fini", rcutils_char_array_fini(&out), &out);
}

static void arrays(void)
{
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  const rcutils_allocator_t invalid = rcutils_get_zero_initialized_allocator();
  rcutils_char_array_t array = rcutils_get_zero_initialized_char_array();
  rcutils_ret_t ret;

  say("zero", RCUTILS_RET_OK, &array);
  say("invalid", rcutils_char_array_init(&array, 4, &invalid), &array);
  say("init 0", rcutils_char_array_init(&array, 0, &allocator), &array);
  say("copy to none", rcutils_char_array_strcpy(&array, "none"), &array);
  say("append", rcutils_char_array_strcat(&array, " of it"), &array);
  say("append 3", rcutils_char_array_strncat(&array, ", or more", 3), &array);
  say("append 1", rcutils_char_array_strncat(&array, "!", 1), &array);
  say("shorter", rcutils_char_array_strcpy(&array, "x"), &array);
  say("resize 0", rcutils_char_array_resize(&array, 0), &array);
  say("resize", rcutils_char_array_resize(&array, 40), &array);
  (void)printf("capacity %d\n", (int)array.buffer_capacity);
  say("enough", rcutils_char_array_expand_as_needed(&array, 10), &array);
  (void)printf("capacity %d\n", (int)array.buffer_capacity);
  say("bytes", rcutils_char_array_memcpy(&array, "ab\0cd", 6), &array);
  say("print", print(&array, "%s %d %05u", "number", -3, 42u), &array);
  say("print more", print(&array, "%s %s %s %s %s", "0123456789", "0123456789", "0123456789", "0123456789", "end"), &array);
  say("print nothing", print(&array, "%s", ""), &array);
  say("fini", rcutils_char_array_fini(&array), &array);
  say("fini again", rcutils_char_array_fini(&array), &array);
  say("init 5", rcutils_char_array_init(&array, 5, &allocator), &array);
  (void)printf("capacity %d\n", (int)array.buffer_capacity);
  say("fits", rcutils_char_array_strcpy(&array, "1234"), &array);
  ret = rcutils_char_array_resize(&array, 3);
  (void)printf("shrink %d, %.3s\n", ret, array.buffer);
  (void)printf("length %d capacity %d\n", (int)array.buffer_length, (int)array.buffer_capacity);
  say("fini", rcutils_char_array_fini(&array), &array);
}

int main(void)
{
  if (rcutils_logging_initialize() != RCUTILS_RET_OK) {
    return 1;
  }
  messages();
  growing_messages();
  arrays();
  return 0;
}
