/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. */
#include "microros/rmw_fault.h"

#include <stddef.h>

enum { PATH_SIZE = 80, DIGITS = 10 };

typedef struct path_t {
  char text[PATH_SIZE];
  size_t length;
} path_t;

/* Text beyond PATH_SIZE is truncated, as is the error's text. */
static void path_put(path_t * path, const char * words)
{
  /* at most PATH_SIZE rounds */
  while (*words != '\0' && path->length < (size_t)PATH_SIZE - 1u) {
    path->text[path->length++] = *words++;
  }
  path->text[path->length] = '\0';
}

static void path_put_number(path_t * path, uint32_t index)
{
  char text[DIGITS + 1];
  size_t first = DIGITS;

  text[first] = '\0';
  do { /* at most DIGITS rounds */
    text[--first] = (char)('0' + (char)(index % 10u));
    index /= 10u;
  } while (index != 0u);
  path_put(path, &text[first]);
}

/* "markers[2].text" */
static void path_put_place(path_t * path, const cdr_fault_t * fault)
{
  if (fault->within != NULL) {
    path_put(path, fault->within);
    if (fault->index != CDR_NO_INDEX) {
      path_put(path, "[");
      path_put_number(path, fault->index);
      path_put(path, "]");
    }
    path_put(path, (fault->depth > 1u) ? "..." : ".");
  }
  path_put(path, fault->field);
}

/* "markers: {text: 9}", as the application file has it; of a sequence's strings "names: {string: 9}". */
static void path_put_limit(path_t * path, const cdr_fault_t * fault)
{
  uint8_t open = 0; /* braces */

  if (fault->within != NULL) {
    open = (fault->depth > 1u) ? 2u : 1u;
    path_put(path, fault->within);
    path_put(path, (open == 2u) ? ": {...: {" : ": {");
  }
  path_put(path, fault->field);
  if (path->length > 1u && path->text[path->length - 1u] == ']') { /* "names[]" */
    path->length -= 2u;
    path_put(path, ": {string");
    ++open;
  }
  path_put(path, ": ");
  path_put_number(path, fault->found);
  for (; open != 0u; --open) { /* at most 3 rounds */
    path_put(path, "}");
  }
}

rmw_ret_t rmw_fault_report(
  microros_error_t error, const microros_message_type_t * type, const cdr_fault_t * fault)
{
  path_t path = {{0}, 0};

  if (fault->kind == CDR_FAULT_LIMIT || fault->kind == CDR_FAULT_CAPACITY) {
    path_put_limit(&path, fault);
  } else {
    path_put_place(&path, fault);
  }
  microros_error_set(error, type->dds_type_name, path.text, fault->found, fault->fits);
  return RMW_RET_ERROR;
}
