/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcutils_format.h"

#include "microros/rcutils_format_float.h"
#include "microros/rcutils_format_wide.h"

enum { WIDTH_MOST = 4095, FALLBACK_TEXT = 6 };

/*
 * What puts characters ends with the first one that has no room: for a text that is formatted with the lock, all of its loops
 * together have no more rounds than the longest line has characters, and one. A format may have FORMAT_EMPTY conversions that
 * put nothing, and each conversion FLAGS_MOST flags and numbers of NUMBER_MOST digits. The rest of others is cut off or put
 * unchanged.
 */
enum { FORMAT_EMPTY = 32, FLAGS_MOST = 5, NUMBER_MOST = 10 };

void microros_format_put(microros_format_t * out, char character)
{
  if (out->used < out->size) {
    out->text[out->used] = character;
    ++out->used;
  } else {
    out->truncated = true;
  }
}

void microros_format_repeat(microros_format_t * out, char character, int32_t count)
{
  /* at most MICROROS_LOG_LONGEST + 1 rounds of all loops in each microros_format_arguments
     or microros_format_begin or microros_format_integer */
  for (int32_t i = 0; i < count && !out->truncated; ++i) {
    microros_format_put(out, character);
  }
}

void microros_format_string(microros_format_t * out, const char * string)
{
  /* at most MICROROS_LOG_LONGEST + 1 rounds of all loops in each microros_format_arguments
     or microros_format_begin or microros_format_integer */
  for (const char * next = string; *next != '\0' && !out->truncated; ++next) {
    microros_format_put(out, *next);
  }
}

/* Puts `size` characters in a field of the conversion's width. */
static void format_field(
  microros_format_t * out, const microros_conversion_t * how, const char * text, size_t size)
{
  const int32_t fill = size < (size_t)how->width ? how->width - (int32_t)size : 0;

  if (!how->minus) {
    microros_format_repeat(out, ' ', fill);
  }
  /* at most MICROROS_LOG_LONGEST + 1 rounds of all loops in each microros_format_arguments
     or microros_format_begin or microros_format_integer */
  for (size_t i = 0; i < size && !out->truncated; ++i) {
    microros_format_put(out, text[i]);
  }
  if (how->minus) {
    microros_format_repeat(out, ' ', fill);
  }
}

/*
 * A text need not end with a NUL within its precision; without one the bound is above all sizes. No more of it is looked at
 * than has room or fills the field, but for one character, which says that the text is truncated. A field that is wider than
 * the room is the last one of its line, so that all fields together have no more than one of them, and the line.
 */
static void format_text(microros_format_t * out, const microros_conversion_t * how, const char * text)
{
  const size_t free_size = out->size - out->used;
  const size_t room = (free_size < (size_t)how->width ? (size_t)how->width : free_size) + 1u;
  const size_t most = (size_t)how->precision < room ? (size_t)how->precision : room;
  const char * shown = text;
  size_t size = 0;

  if (shown == NULL) {
    shown = (size_t)how->precision < (size_t)FALLBACK_TEXT ? "" : "(null)";
  }
  /* at most WIDTH_MOST + MICROROS_LOG_LONGEST + 2 rounds in each microros_format_arguments */
  while (size < most && shown[size] != '\0') {
    ++size;
  }
  format_field(out, how, shown, size);
}

static void format_pointer(microros_format_t * out, const microros_conversion_t * how, const void * pointer)
{
  microros_conversion_t as_number = *how;

  if (pointer == NULL) {
    format_field(out, how, "(nil)", sizeof("(nil)") - 1u);
    return;
  }
  as_number.kind = 'x';
  as_number.alternative = true;
  microros_format_integer(out, &as_number, (uint64_t)(uintptr_t)pointer, false);
}

static int64_t format_signed(char length, va_list * args)
{
  switch (length) {
    case 'H':
      return (int64_t)(signed char)va_arg(*args, int);
    case 'h':
      return (int64_t)(short)va_arg(*args, int);
    case 'l':
      return (int64_t)va_arg(*args, long);
    case 'q':
      return (int64_t)va_arg(*args, long long);
    case 'j':
      return (int64_t)va_arg(*args, intmax_t);
    case 'z':
    case 't':
      return (int64_t)va_arg(*args, ptrdiff_t);
    default:
      return (int64_t)va_arg(*args, int);
  }
}

static uint64_t format_unsigned(char length, va_list * args)
{
  switch (length) {
    case 'H':
      return (uint64_t)(unsigned char)va_arg(*args, unsigned int);
    case 'h':
      return (uint64_t)(unsigned short)va_arg(*args, unsigned int);
    case 'l':
      return (uint64_t)va_arg(*args, unsigned long);
    case 'q':
      return (uint64_t)va_arg(*args, unsigned long long);
    case 'j':
      return (uint64_t)va_arg(*args, uintmax_t);
    case 'z':
    case 't':
      return (uint64_t)va_arg(*args, size_t);
    default:
      return (uint64_t)va_arg(*args, unsigned int);
  }
}

static bool format_flag(microros_conversion_t * how, char character)
{
  switch (character) {
    case '-':
      how->minus = true;
      return true;
    case '0':
      how->zero = true;
      return true;
    case '+':
      how->plus = true;
      return true;
    case ' ':
      how->space = true;
      return true;
    case '#':
      how->alternative = true;
      return true;
    default:
      return false;
  }
}

/* Reads digits or `*`, a number of at most WIDTH_MOST. */
static int32_t format_number(const char ** next, va_list * args)
{
  int32_t number = 0;

  if (**next == '*') {
    const int given = va_arg(*args, int);

    ++*next;
    if (given < -WIDTH_MOST) {
      return -WIDTH_MOST;
    }
    return given > WIDTH_MOST ? WIDTH_MOST : (int32_t)given;
  }
  /* at most NUMBER_MOST rounds */
  for (uint32_t left = NUMBER_MOST; left != 0u && **next >= '0' && **next <= '9'; --left) {
    number = number * 10 + (int32_t)(**next - '0');
    number = number > WIDTH_MOST ? WIDTH_MOST : number;
    ++*next;
  }
  return number;
}

static bool format_is_length(char character)
{
  return character == 'h' || character == 'l' || character == 'j' || character == 'z' || character == 't' ||
         character == 'L';
}

/* f, e, g and a, and the upper-case ones. */
static bool format_is_floating(char kind)
{
  const uint8_t lower = (uint8_t)kind | 0x20u;

  return lower == (uint8_t)'f' || lower == (uint8_t)'e' || lower == (uint8_t)'g' || lower == (uint8_t)'a';
}

static char format_length(const char ** next)
{
  const char first = **next;

  if (!format_is_length(first)) {
    return '\0';
  }
  ++*next;
  if ((first == 'h' || first == 'l') && **next == first) {
    ++*next;
    return first == 'h' ? 'H' : 'q';
  }
  return first;
}

/* Reads a conversion after its `%`. */
static microros_conversion_t format_read(const char ** next, va_list * args)
{
  microros_conversion_t how = {false, false, false, false, false, 0, -1, '\0', '\0'};

  /* at most FLAGS_MOST rounds */
  for (uint32_t left = FLAGS_MOST; left != 0u && format_flag(&how, **next); --left) {
    ++*next;
  }
  how.width = format_number(next, args);
  if (how.width < 0) {
    how.minus = true;
    how.width = -how.width;
  }
  if (**next == '.') {
    ++*next;
    how.precision = format_number(next, args);
  }
  how.length = format_length(next);
  how.kind = **next;
  if (how.kind != '\0') {
    ++*next;
  }
  return how;
}

/* Puts a floating-point number, or its conversion unchanged (see microros/rcutils_format_float.h). */
static void format_floating(
  microros_format_t * out, const microros_conversion_t * how, const char * first, const char * end,
  va_list * args)
{
  if (microros_format_floating(out, how, args)) {
    return;
  }
  /* at most MICROROS_LOG_LONGEST + 1 rounds of all loops in each microros_format_arguments
     or microros_format_begin or microros_format_integer */
  for (const char * shown = first; shown != end && !out->truncated; ++shown) {
    microros_format_put(out, *shown);
  }
}

static void format_signed_integer(microros_format_t * out, const microros_conversion_t * how, va_list * args)
{
  const int64_t value = format_signed(how->length, args);

  microros_format_integer(out, how, value < 0 ? 0u - (uint64_t)value : (uint64_t)value, value < 0);
}

static void format_character(microros_format_t * out, const microros_conversion_t * how, va_list * args)
{
  const char character = (char)va_arg(*args, int);

  format_field(out, how, &character, 1);
}

/* Returns false for an unknown conversion: the types of its argument and of all later ones are unknown, too. */
static bool format_convert(
  microros_format_t * out, const microros_conversion_t * how, const char * first, const char * end,
  va_list * args)
{
  switch (how->kind) {
    case 'd':
    case 'i':
      format_signed_integer(out, how, args);
      return true;
    case 'u':
    case 'x':
    case 'X':
    case 'o':
      microros_format_integer(out, how, format_unsigned(how->length, args), false);
      return true;
    case 's':
      if (how->length == 'l') {
        return microros_format_wide(out, how, args);
      }
      format_text(out, how, va_arg(*args, const char *));
      return true;
    case 'p':
      format_pointer(out, how, va_arg(*args, const void *));
      return true;
    case 'c':
      if (how->length == 'l') {
        return microros_format_wide(out, how, args);
      }
      format_character(out, how, args);
      return true;
    case '%':
      microros_format_put(out, '%');
      return true;
    default:
      if (!format_is_floating(how->kind)) {
        return false;
      }
      format_floating(out, how, first, end, args);
      return true;
  }
}

void microros_format_arguments(microros_format_t * out, const char * format, va_list * args)
{
  const char * next = format;
  size_t left = out->size + (size_t)FORMAT_EMPTY;

  /* at most MICROROS_LOG_LONGEST + FORMAT_EMPTY + 1 rounds */
  while (*next != '\0' && !out->truncated) {
    if (left == 0u) {
      out->truncated = true;
      return;
    }
    --left;
    const char * const first = next;

    ++next;
    if (*first != '%') {
      microros_format_put(out, *first);
      continue;
    }
    const microros_conversion_t how = format_read(&next, args);
    if (!format_convert(out, &how, first, next, args)) {
      microros_format_string(out, first);
      return;
    }
  }
}
