/* SPDX-License-Identifier: Apache-2.0 */
/* The level of each logger. */
#include "rcutils/logging.h"

#include "microros/error.h"
#include "microros_config.h"

#include <string.h>

typedef struct logger_t {
  char name[MICROROS_LOGGER_NAME_SIZE]; /* "": the place is free */
  uint8_t level;
} logger_t;

static logger_t loggers[MICROROS_LOGGERS_MAX];
static uint8_t logger_default = MICROROS_LOG_LEVEL;

rcutils_ret_t rcutils_logging_shutdown(void)
{
  (void)memset(loggers, 0, sizeof(loggers));
  logger_default = MICROROS_LOG_LEVEL;
  rcutils_logging_set_output_handler(NULL);
  g_rcutils_logging_initialized = false;
  return RCUTILS_RET_OK;
}

static logger_t * logger_find(const char * name, size_t size)
{
  if (size == 0u || size >= MICROROS_LOGGER_NAME_SIZE) {
    return NULL;
  }
  for (size_t i = 0; i < MICROROS_LOGGERS_MAX; ++i) {
    if (strncmp(loggers[i].name, name, size) == 0 && loggers[i].name[size] == '\0') {
      return &loggers[i];
    }
  }
  return NULL;
}

static logger_t * logger_free(void)
{
  for (size_t i = 0; i < MICROROS_LOGGERS_MAX; ++i) {
    if (loggers[i].name[0] == '\0') {
      return &loggers[i];
    }
  }
  return NULL;
}

static bool level_is_valid(int level)
{
  return level >= RCUTILS_LOG_SEVERITY_UNSET && level <= RCUTILS_LOG_SEVERITY_FATAL && level % 10 == 0;
}

int rcutils_logging_get_default_logger_level(void)
{
  return (int)logger_default;
}

void rcutils_logging_set_default_logger_level(int level)
{
  if (level_is_valid(level)) {
    logger_default = level == RCUTILS_LOG_SEVERITY_UNSET ? MICROROS_LOG_LEVEL : (uint8_t)level;
  }
}

int rcutils_logging_get_logger_leveln(const char * name, size_t name_length)
{
  const logger_t * found = NULL;

  if (name == NULL) {
    return -1;
  }
  if (name_length == 0u) {
    return (int)logger_default;
  }
  found = logger_find(name, name_length);
  return found == NULL ? RCUTILS_LOG_SEVERITY_UNSET : (int)found->level;
}

int rcutils_logging_get_logger_level(const char * name)
{
  return name == NULL ? -1 : rcutils_logging_get_logger_leveln(name, strlen(name));
}

static rcutils_ret_t logger_add(const char * name, size_t size, uint8_t level)
{
  logger_t * const found = logger_free();

  if (size >= MICROROS_LOGGER_NAME_SIZE) {
    return microros_error_named(RCUTILS_RET_NOT_ENOUGH_SPACE, microros_error_logger_name, name);
  }
  if (found == NULL) {
    microros_error_set(
      microros_error_of_pool(microros_error_loggers_full, MICROROS_LOGGERS_MAX), name, NULL,
      MICROROS_LOGGERS_MAX, MICROROS_LOGGERS_MAX + 1u);
    return RCUTILS_RET_ERROR;
  }
  (void)memcpy(found->name, name, size + 1u);
  found->level = level;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_logging_set_logger_level(const char * name, int level)
{
  logger_t * found = NULL;

  if (name == NULL || !level_is_valid(level)) {
    return microros_error_refuse(RCUTILS_RET_INVALID_ARGUMENT, "name or level");
  }
  if (name[0] == '\0') {
    rcutils_logging_set_default_logger_level(level);
    return RCUTILS_RET_OK;
  }
  found = logger_find(name, strlen(name));
  if (found == NULL) {
    return level == RCUTILS_LOG_SEVERITY_UNSET ? RCUTILS_RET_OK
                                               : logger_add(name, strlen(name), (uint8_t)level);
  }
  found->level = (uint8_t)level;
  if (level == RCUTILS_LOG_SEVERITY_UNSET) {
    found->name[0] = '\0';
  }
  return RCUTILS_RET_OK;
}

int rcutils_logging_get_logger_effective_level(const char * name)
{
  const logger_t * found = NULL;
  size_t size = 0;

  if (name == NULL) {
    return -1;
  }
  for (size = strlen(name); size != 0u; --size) {
    const bool ends = name[size] == '\0' || name[size] == RCUTILS_LOGGING_SEPARATOR_CHAR;

    found = ends ? logger_find(name, size) : NULL;
    if (found != NULL) {
      return (int)found->level;
    }
  }
  return (int)logger_default;
}

bool rcutils_logging_logger_is_enabled_for(const char * name, int severity)
{
  return severity >= (name == NULL ? (int)logger_default : rcutils_logging_get_logger_effective_level(name));
}
