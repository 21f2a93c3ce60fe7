/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Subloggers of /rosout. One data writer has the lines of all loggers, so they decide nothing about lines: this is what
 * programs are told about their names. An image has the names only if the functions are called. */
#include "rcl/logging_rosout.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_rosout.h"
#include "microros/text.h"
#include "microros/xrce_client.h"
#include "microros/xrce_rosout.h"
#include "microros_config.h"

#include <stddef.h>
#include <string.h>

typedef struct sublogger_t {
  char name[MICROROS_LOG_ROSOUT_NAME + 1u];
  uint16_t node;  /* index of the node that its logger belongs to */
  uint32_t count; /* how often it was added; 0: the place is free */
} sublogger_t;

/* The name of a sublogger in two parts. */
typedef struct sublogger_name_t {
  const char * logger;
  const char * sub;
} sublogger_name_t;

static sublogger_t subloggers[MICROROS_LOGGERS_MAX];

static void sublogger_clear_closed(void)
{
  for (uint16_t node = 0; node < MICROROS_NODES_MAX; ++node) {
    if (rcl_rosout_was_closed(node)) {
      for (size_t i = 0; i < MICROROS_LOGGERS_MAX; ++i) {
        subloggers[i].count = subloggers[i].node == node ? 0u : subloggers[i].count;
      }
    }
  }
}

/* Returns what of `text` follows `start`, or NULL. */
static const char * sublogger_after(const char * text, const char * start)
{
  const size_t size = microros_text_size(start);

  return strncmp(text, start, size) == 0 ? &text[size] : NULL;
}

/* Compares as rcl_node_get_logger_name writes it: `name`, or the namespace with dots and `.name`. */
static bool sublogger_is_of_node(const char * logger, const xrce_participant_t * node)
{
  const char * rest = logger;

  for (const char * next = &node->namespace_[1]; *next != '\0'; ++next) {
    if (*rest != (*next == '/' ? '.' : *next)) {
      return false;
    }
    ++rest;
  }
  if (node->namespace_[1] != '\0') {
    if (*rest != '.') {
      return false;
    }
    ++rest;
  }
  return strcmp(rest, node->name) == 0;
}

/* Returns the sublogger of that name, or of that one as a whole where `sub` is NULL. */
static sublogger_t * sublogger_find(const sublogger_name_t * name)
{
  for (size_t i = 0; i < MICROROS_LOGGERS_MAX; ++i) {
    const char * rest = sublogger_after(subloggers[i].name, name->logger);

    if (subloggers[i].count != 0u && rest != NULL) {
      const bool is_whole = name->sub == NULL && *rest == '\0';

      if (is_whole || (name->sub != NULL && *rest == '.' && strcmp(&rest[1], name->sub) == 0)) {
        return &subloggers[i];
      }
    }
  }
  return NULL;
}

/* Returns the index of the node that a logger belongs to; MICROROS_NODES_MAX for an unknown logger. */
static uint16_t sublogger_node(const char * logger)
{
  const sublogger_name_t whole = {logger, NULL};
  const sublogger_t * const above = sublogger_find(&whole);
  const xrce_client_t * const client = xrce_rosout_client();

  if (above != NULL) {
    return above->node;
  }
  for (uint16_t i = 0; client != NULL && i < MICROROS_NODES_MAX; ++i) {
    if (client->states[i].wanted && sublogger_is_of_node(logger, &client->participants[i])) {
      return i;
    }
  }
  return MICROROS_NODES_MAX;
}

static sublogger_t * sublogger_free(void)
{
  for (size_t i = 0; i < MICROROS_LOGGERS_MAX; ++i) {
    if (subloggers[i].count == 0u) {
      return &subloggers[i];
    }
  }
  return NULL;
}

static rcl_ret_t sublogger_unknown(const char * logger)
{
  microros_error_set(
    microros_error_sublogger, logger, MICROROS_ERROR_WORDS("no open node has it, nor was it added"), 0, 0);
  return RCL_RET_NOT_FOUND;
}

static rcl_ret_t sublogger_new(const sublogger_name_t * name)
{
  const size_t size = microros_text_size(name->logger);
  const size_t sub_size = microros_text_size(name->sub);
  const uint16_t node = sublogger_node(name->logger);
  sublogger_t * const place = sublogger_free();

  if (node == MICROROS_NODES_MAX) {
    return sublogger_unknown(name->logger);
  }
  if (size + 1u + sub_size > MICROROS_LOG_ROSOUT_NAME) {
    return microros_error_fits(
      RCL_RET_BAD_ALLOC, microros_error_logger_name, name->sub, (uint32_t)(size + sub_size) + 2u);
  }
  if (place == NULL) {
    microros_error_set(
      microros_error_of_pool(microros_error_subloggers_full, MICROROS_LOGGERS_MAX), name->sub, NULL,
      MICROROS_LOGGERS_MAX, MICROROS_LOGGERS_MAX + 1u);
    return RCL_RET_BAD_ALLOC;
  }
  (void)memcpy(place->name, name->logger, size);
  place->name[size] = '.';
  (void)memcpy(&place->name[size + 1u], name->sub, sub_size + 1u);
  place->node = node;
  place->count = 1;
  return RCL_RET_OK;
}

static rcl_ret_t sublogger_add(const sublogger_name_t * name)
{
  sublogger_t * const found = sublogger_find(name);

  if (found == NULL) {
    return sublogger_new(name);
  }
  ++found->count;
  return RCL_RET_OK;
}

static rcl_ret_t sublogger_remove(const sublogger_name_t * name)
{
  sublogger_t * const found = sublogger_find(name);

  if (found == NULL) {
    return sublogger_unknown(name->sub);
  }
  --found->count;
  return RCL_RET_OK;
}

static rcl_ret_t sublogger_change(const char * logger, const char * sub, bool adds)
{
  const sublogger_name_t name = {logger, sub};
  rcl_ret_t result;

  if (logger == NULL || sub == NULL || sub[0] == '\0') {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "logger_name or sublogger_name");
  }
  microros_lock();
  sublogger_clear_closed();
  result = adds ? sublogger_add(&name) : sublogger_remove(&name);
  microros_unlock();
  return result;
}

rcl_ret_t rcl_logging_rosout_add_sublogger(const char * logger_name, const char * sublogger_name)
{
  return sublogger_change(logger_name, sublogger_name, true);
}

rcl_ret_t rcl_logging_rosout_remove_sublogger(const char * logger_name, const char * sublogger_name)
{
  return sublogger_change(logger_name, sublogger_name, false);
}
