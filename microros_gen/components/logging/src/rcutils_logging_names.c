/* SPDX-License-Identifier: Apache-2.0 */
#include "rcutils/logging.h"

#include "microros/error.h"

const char * const g_rcutils_log_severity_names[RCUTILS_LOG_SEVERITY_FATAL + 1] = {
  [RCUTILS_LOG_SEVERITY_UNSET] = "UNSET", [RCUTILS_LOG_SEVERITY_DEBUG] = "DEBUG",
  [RCUTILS_LOG_SEVERITY_INFO] = "INFO",   [RCUTILS_LOG_SEVERITY_WARN] = "WARN",
  [RCUTILS_LOG_SEVERITY_ERROR] = "ERROR", [RCUTILS_LOG_SEVERITY_FATAL] = "FATAL",
};

static char name_upper(char character)
{
  return character >= 'a' && character <= 'z' ? (char)(character - 'a' + 'A') : character;
}

static bool name_is(const char * word, const char * name)
{
  size_t i = 0;

  while (name[i] != '\0' && name_upper(word[i]) == name[i]) {
    ++i;
  }
  return name[i] == '\0' && word[i] == '\0';
}

rcutils_ret_t rcutils_logging_severity_level_from_string(
  const char * severity_string, rcutils_allocator_t allocator, int * severity)
{
  (void)allocator; /* nothing is allocated */
  if (severity_string == NULL || severity == NULL) {
    return (rcutils_ret_t)microros_error_refuse(RCUTILS_RET_INVALID_ARGUMENT, "severity_string or severity");
  }
  for (int level = RCUTILS_LOG_SEVERITY_UNSET; level <= RCUTILS_LOG_SEVERITY_FATAL; level += 10) {
    if (name_is(severity_string, g_rcutils_log_severity_names[level])) {
      *severity = level;
      return RCUTILS_RET_OK;
    }
  }
  return RCUTILS_RET_LOGGING_SEVERITY_STRING_INVALID;
}
