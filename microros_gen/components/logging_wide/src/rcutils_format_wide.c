/* SPDX-License-Identifier: Apache-2.0 */
/* The conversions ls and lc. The C library's functions for wide characters depend on a locale, which a board has not. */
#include "microros/rcutils_format_wide.h"

#include <wchar.h>

enum { WIDE_BYTES_MOST = 4, WIDE_FALLBACK_TEXT = 6, WIDE_WIDTH_MOST = 4095 };

/* A character as UTF-8. */
typedef struct wide_bytes_t {
  char bytes[WIDE_BYTES_MOST];
  uint32_t size;
} wide_bytes_t;

/* Surrogates and numbers above the last code point are none. */
static uint32_t wide_code_point(uint32_t character)
{
  const bool is_valid = character < 0xd800u || (character > 0xdfffu && character <= 0x10ffffu);

  return is_valid ? character : 0xfffdu;
}

static uint32_t wide_size(uint32_t code_point)
{
  if (code_point < 0x80u) {
    return 1u;
  }
  if (code_point < 0x800u) {
    return 2u;
  }
  return code_point < 0x10000u ? 3u : 4u;
}

static wide_bytes_t wide_encode(uint32_t character)
{
  static const uint8_t firsts[WIDE_BYTES_MOST] = {0x00u, 0xc0u, 0xe0u, 0xf0u};
  uint32_t rest = wide_code_point(character);
  wide_bytes_t result = {{'\0', '\0', '\0', '\0'}, wide_size(rest)};

  for (uint32_t i = result.size - 1u; i != 0u; --i) { /* at most WIDE_BYTES_MOST - 1 rounds */
    result.bytes[i] = (char)(0x80u | (rest & 0x3fu));
    rest >>= 6;
  }
  result.bytes[0] = (char)(firsts[result.size - 1u] | rest);
  return result;
}

static void wide_put(microros_format_t * out, const wide_bytes_t * character)
{
  for (uint32_t i = 0; i < character->size; ++i) { /* at most WIDE_BYTES_MOST rounds */
    microros_format_put(out, character->bytes[i]);
  }
}

/* Puts a text that has `size` bytes as UTF-8. */
static void wide_put_text(microros_format_t * out, const wchar_t * text, uint32_t size)
{
  uint32_t used = 0;

  /* at most MICROROS_LOG_LONGEST + 1 rounds of all loops in each microros_format_arguments */
  for (const wchar_t * next = text; used < size && !out->truncated; ++next) {
    const wide_bytes_t character = wide_encode((uint32_t)*next);

    wide_put(out, &character);
    used += character.size;
  }
}

/*
 * Returns the bytes of the characters that fit the precision; the text need not end with a NUL after them. It ends where
 * they have no room and fill the field, with one more: see format_text in rcutils_format.c.
 */
static uint32_t wide_text_size(
  const microros_format_t * out, const microros_conversion_t * how, const wchar_t * text)
{
  const uint32_t free_size = (uint32_t)(out->size - out->used);
  const uint32_t room =
    (free_size < (uint32_t)how->width ? (uint32_t)how->width : free_size) + (uint32_t)WIDE_BYTES_MOST;
  const uint32_t wanted = how->precision < 0 ? UINT32_MAX : (uint32_t)how->precision;
  const uint32_t most = wanted < room ? wanted : room;
  const wchar_t * next = text;
  uint32_t size = 0;

  /* at most WIDE_WIDTH_MOST + MICROROS_LOG_LONGEST + 5 rounds in each microros_format_arguments */
  while (size < most && *next != L'\0') {
    const uint32_t more = wide_size(wide_code_point((uint32_t)*next));

    if (more > most - size) {
      break;
    }
    size += more;
    ++next;
  }
  return size;
}

static void wide_text(microros_format_t * out, const microros_conversion_t * how, const wchar_t * text)
{
  const bool is_short = how->precision >= 0 && how->precision < WIDE_FALLBACK_TEXT;
  const wchar_t * const instead = is_short ? L"" : L"(null)";
  const wchar_t * const shown = text == NULL ? instead : text;
  const uint32_t size = wide_text_size(out, how, shown);
  const int32_t fill = size < (uint32_t)how->width ? how->width - (int32_t)size : 0;

  microros_format_repeat(out, ' ', how->minus ? 0 : fill);
  wide_put_text(out, shown, size);
  microros_format_repeat(out, ' ', how->minus ? fill : 0);
}

static void wide_character(microros_format_t * out, const microros_conversion_t * how, wint_t given)
{
  const wide_bytes_t character = wide_encode((uint32_t)given);
  const int32_t fill = how->width - (int32_t)character.size;

  microros_format_repeat(out, ' ', how->minus ? 0 : fill);
  wide_put(out, &character);
  microros_format_repeat(out, ' ', how->minus ? fill : 0);
}

bool microros_format_wide(microros_format_t * out, const microros_conversion_t * how, va_list * args)
{
  if (how->kind == 'c') {
    wide_character(out, how, va_arg(*args, wint_t));
  } else {
    wide_text(out, how, va_arg(*args, const wchar_t *));
  }
  return true;
}
