/* SPDX-License-Identifier: Apache-2.0 */
/* The conversions ls and lc with the component logging_wide, against vsnprintf in a locale of UTF-8. */
#define UNIT_TEXT_SIZE 160

#include "unit.h"
#include "unit_log_compare.h"

#include <locale.h>
#include <stdlib.h>
#include <wchar.h>

static const char * const widths[] = {"", "1", "7", "30", "-7", "-30"};

static void texts(void)
{
  static const wchar_t * const values[] = {
    L"", L"a", L"motor", L"\u00e9", L"\u20ac 3", L"\U0001f916 and more words", L"\u07ff\u0800\uffff\U00010000",
    L"\uefff\uf000\U0010ffff\ud7ff\ue000\u00a0", NULL};
  char format[32];

  for (size_t w = 0; w < sizeof(widths) / sizeof(widths[0]); ++w) {
    for (size_t v = 0; v < sizeof(values) / sizeof(values[0]); ++v) {
      (void)snprintf(format, sizeof(format), "a%%%slsz%%d", widths[w]);
      compare(format, values[v], 42);
      for (int precision = -1; precision < 12; ++precision) {
        (void)snprintf(format, sizeof(format), "a%%%s.*lsz%%s", widths[w]);
        compare(format, precision, values[v], "after");
      }
    }
  }
}

static void characters(void)
{
  static const wint_t values[] = {L'a', 0x7f, 0x80, 0x7ff, 0x800, 0xd7ff, 0xe000, 0xffff, 0x10000, 0x10ffff};
  char format[32];

  for (size_t w = 0; w < sizeof(widths) / sizeof(widths[0]); ++w) {
    for (size_t v = 0; v < sizeof(values) / sizeof(values[0]); ++v) {
      (void)snprintf(format, sizeof(format), "a%%%slcz%%d", widths[w]);
      compare(format, values[v], 42);
    }
  }
}

static size_t formatted(char * text, size_t size, const char * format, ...)
{
  size_t length = 0;
  va_list args;

  va_start(args, format);
  length = rcutils_logging_format(text, size, format, &args);
  va_end(args);
  return length;
}

/* Where vsnprintf fails: what is no code point, and a text without a NUL after its precision. */
static void others(void)
{
  static const wchar_t open[] = {L'o', L'p', L'e', L'n'};
  static const wchar_t invalid[] = {(wchar_t)0xd800, (wchar_t)0xdfff, (wchar_t)0x110000, (wchar_t)-1, L'\0'};
  char text[16];

  CHECK(formatted(text, sizeof(text), "%.4ls", open) == 4u);
  CHECK(strcmp(text, "open") == 0);
  CHECK(formatted(text, sizeof(text), "%ls|", invalid) == 13u);
  CHECK(strcmp(text, "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd|") == 0);
  CHECK(formatted(text, sizeof(text), "%lc|", (wint_t)0xdc00) == 4u);
  CHECK(formatted(text, sizeof(text), "%ls", L"a text that is longer") == 15u);
  CHECK(strcmp(text, "a text that ...") == 0);
}

int main(void)
{
  CHECK(setlocale(LC_ALL, "C.UTF-8") != NULL);
  texts();
  characters();
  others();
  return compare_end();
}
