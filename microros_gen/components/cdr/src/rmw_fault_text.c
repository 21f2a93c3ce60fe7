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

static void path_put_index(path_t * path, uint32_t index)
{
  char text[DIGITS + 1];
  size_t first = DIGITS;

  text[first] = '\0';
  do { /* at most DIGITS rounds */
    text[--first] = (char)('0' + (char)(index % 10u));
    index /= 10u;
  } while (index != 0u);
  path_put(path, "[");
  path_put(path, &text[first]);
  path_put(path, "]");
}

rmw_ret_t rmw_fault_report(
  microros_error_t error, const microros_message_type_t * type, const cdr_fault_t * fault)
{
  path_t path = {{0}, 0};

  if (fault->within != NULL) {
    path_put(&path, fault->within);
    if (fault->index != CDR_NO_INDEX) {
      path_put_index(&path, fault->index);
    }
    path_put(&path, (fault->depth > 1u) ? "..." : ".");
  }
  path_put(&path, fault->field);
  microros_error_set(error, type->dds_type_name, path.text, fault->found, fault->fits);
  return RMW_RET_ERROR;
}
