/* SPDX-License-Identifier: Apache-2.0 */
/* The level of each logger. */
#include "rcutils/logging.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros_config.h"

#include <string.h>

typedef struct logger_t {
  char name[MICROROS_LOGGER_NAME_SIZE]; /* "": the place is free */
  uint8_t level;
} logger_t;

/* In the lock alone: a task or a logger service can set levels while others log. */
static logger_t loggers[MICROROS_LOGGERS_MAX];
static uint8_t logger_default = MICROROS_LOG_LEVEL;

rcutils_ret_t rcutils_logging_shutdown(void)
{
  microros_lock();
  (void)memset(loggers, 0, sizeof(loggers));
  logger_default = MICROROS_LOG_LEVEL;
  microros_unlock();
  rcutils_logging_set_output_handler(NULL);
  g_rcutils_logging_initialized = false;
  return RCUTILS_RET_OK;
}

static logger_t * logger_find(const char * name, size_t size)
{
  if (size >= MICROROS_LOGGER_NAME_SIZE) {
    return NULL;
  }
  for (size_t i = 0; i < MICROROS_LOGGERS_MAX; ++i) {
    /* at most MICROROS_LOGGER_NAME_SIZE bytes */
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
  uint8_t level;

  microros_lock();
  level = logger_default;
  microros_unlock();
  return (int)level;
}

void rcutils_logging_set_default_logger_level(int level)
{
  if (level_is_valid(level)) {
    microros_lock();
    logger_default = level == RCUTILS_LOG_SEVERITY_UNSET ? MICROROS_LOG_LEVEL : (uint8_t)level;
    microros_unlock();
  }
}

/* Returns the level that was set for a logger, UNSET without one. */
static int logger_level(const char * name, size_t size)
{
  const logger_t * found;
  int level;

  microros_lock();
  found = logger_find(name, size);
  level = found == NULL ? RCUTILS_LOG_SEVERITY_UNSET : (int)found->level;
  microros_unlock();
  return level;
}

int rcutils_logging_get_logger_leveln(const char * name, size_t name_length)
{
  if (name == NULL) {
    return -1;
  }
  return name_length == 0u ? rcutils_logging_get_default_logger_level() : logger_level(name, name_length);
}

int rcutils_logging_get_logger_level(const char * name)
{
  return name == NULL ? -1 : rcutils_logging_get_logger_leveln(name, strlen(name));
}

static rcutils_ret_t logger_add(const char * name, size_t size, uint8_t level)
{
  logger_t * const found = logger_free();

  if (size >= MICROROS_LOGGER_NAME_SIZE) {
    return (rcutils_ret_t)microros_error_fits(
      RCUTILS_RET_NOT_ENOUGH_SPACE, microros_error_logger_name, name, (uint32_t)size + 1u);
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

/* Sets or removes a level. */
static rcutils_ret_t logger_set(const char * name, int level)
{
  const size_t size = strlen(name);
  logger_t * const found = logger_find(name, size);

  if (found == NULL) {
    return level == RCUTILS_LOG_SEVERITY_UNSET ? RCUTILS_RET_OK : logger_add(name, size, (uint8_t)level);
  }
  found->level = (uint8_t)level;
  if (level == RCUTILS_LOG_SEVERITY_UNSET) {
    found->name[0] = '\0';
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_logging_set_logger_level(const char * name, int level)
{
  rcutils_ret_t result = RCUTILS_RET_OK;

  if (name == NULL || !level_is_valid(level)) {
    return (rcutils_ret_t)microros_error_refuse(RCUTILS_RET_INVALID_ARGUMENT, "name or level");
  }
  if (name[0] == '\0') {
    rcutils_logging_set_default_logger_level(level);
    return RCUTILS_RET_OK;
  }
  microros_lock();
  result = logger_set(name, level);
  microros_unlock();
  return result;
}

/* Returns how many characters of a name may be a logger's: no level has a longer one. */
static size_t logger_longest(const char * name)
{
  size_t size = 0;

  /* at most MICROROS_LOGGER_NAME_SIZE rounds */
  while (size < (size_t)MICROROS_LOGGER_NAME_SIZE - 1u && name[size] != '\0') {
    ++size;
  }
  return size;
}

int rcutils_logging_get_logger_effective_level(const char * name)
{
  if (name == NULL) {
    return -1;
  }
  /* at most MICROROS_LOGGER_NAME_SIZE rounds */
  for (size_t size = logger_longest(name); size != 0u; --size) {
    const bool ends = name[size] == '\0' || name[size] == RCUTILS_LOGGING_SEPARATOR_CHAR;
    const int level = ends ? logger_level(name, size) : RCUTILS_LOG_SEVERITY_UNSET;

    if (level != RCUTILS_LOG_SEVERITY_UNSET) {
      return level;
    }
  }
  return rcutils_logging_get_default_logger_level();
}

bool rcutils_logging_logger_is_enabled_for(const char * name, int severity)
{
  return severity >= (name == NULL ? rcutils_logging_get_default_logger_level()
                                   : rcutils_logging_get_logger_effective_level(name));
}
