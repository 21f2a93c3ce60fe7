/* SPDX-License-Identifier: Apache-2.0 */
/* Levels are set and read as rclpy's nodes do it. Requests and replies of all nodes share their memory. */
#include "microros/rcl_logger_services.h"

#include "microros/lock.h"
#include "microros/rmw_by_place.h"
#include "microros/rmw_node.h"
#include "microros/rmw_service.h"
#include "microros/text.h"
#include "microros_config.h"
#include "rcl/error_handling.h"
#include "rcl/service.h"
#include "rcl_interfaces/srv/get_logger_levels.h"
#include "rcl_interfaces/srv/set_logger_levels.h"
#include "rcutils/logging.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

typedef struct logger_services_t {
  rcl_service_t get;
  rcl_service_t set;
} logger_services_t;

static logger_services_t logger_services[MICROROS_NODES_MAX];
static rcl_interfaces__msg__LoggerLevel logger_levels[MICROROS_LOGGER_REQUEST_MAX];
static char logger_names[MICROROS_LOGGER_REQUEST_MAX][MICROROS_LOGGER_NAME_SIZE];
static char logger_reasons[MICROROS_LOGGER_REQUEST_MAX][MICROROS_LOGGER_REASON_SIZE];
static bool logger_services_busy;

/* As in rmw_qos_profile_services_default. */
enum { LOGGER_SERVICES_DEPTH = 10 };

static rcl_ret_t services_open(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type, uint16_t * at)
{
  *service = rcl_get_zero_initialized_service();
  return rmw_replier_open_by_place(node->impl, type, (uint16_t)LOGGER_SERVICES_DEPTH, at, &service->impl);
}

rcl_ret_t rcl_logger_services_open(rcl_node_t * node)
{
  logger_services_t * const services = &logger_services[rmw_node_index(node->impl)];
  uint16_t at = 0;
  rcl_ret_t result = services_open(
    &services->get, node, ROSIDL_GET_SRV_TYPE_SUPPORT(rcl_interfaces, srv, GetLoggerLevels), &at);

  if (result == RCL_RET_OK) {
    result = services_open(
      &services->set, node, ROSIDL_GET_SRV_TYPE_SUPPORT(rcl_interfaces, srv, SetLoggerLevels), &at);
    if (result != RCL_RET_OK) {
      (void)rcl_service_fini(&services->get, node); /* cannot fail: it was opened above */
    }
  }
  return result;
}

void rcl_logger_services_close(rcl_node_t * node)
{
  logger_services_t * const services = &logger_services[rmw_node_index(node->impl)];

  /* Cannot fail: the node is open. */
  (void)rcl_service_fini(&services->get, node);
  (void)rcl_service_fini(&services->set, node);
}

static bool services_has_request(const rcl_service_t * service)
{
  return rcl_service_is_valid(service) && rmw_replier_is_ready(service->impl);
}

/* Gives the name of a request its memory. */
static void services_bind(rosidl_runtime_c__String * name, size_t index)
{
  name->data = logger_names[index];
  name->size = 0;
  name->capacity = MICROROS_LOGGER_NAME_SIZE;
}

static void services_answer_get(const rcl_service_t * service)
{
  static rosidl_runtime_c__String names[MICROROS_LOGGER_REQUEST_MAX];
  rcl_interfaces__srv__GetLoggerLevels_Request request;
  rcl_interfaces__srv__GetLoggerLevels_Response response;
  rmw_request_id_t header;

  for (size_t i = 0; i < MICROROS_LOGGER_REQUEST_MAX; ++i) {
    services_bind(&names[i], i);
  }
  request.names.data = names;
  request.names.size = 0;
  request.names.capacity = MICROROS_LOGGER_REQUEST_MAX;
  if (rcl_take_request(service, &header, &request) != RCL_RET_OK) {
    return; /* a request above the limits: counted, and its text is set */
  }
  for (size_t i = 0; i < request.names.size; ++i) {
    const int level = rcutils_logging_get_logger_level(request.names.data[i].data);

    logger_levels[i].name = request.names.data[i];
    logger_levels[i].level = level > 0 ? (uint32_t)level : 0u;
  }
  response.levels.data = logger_levels;
  response.levels.size = request.names.size;
  response.levels.capacity = MICROROS_LOGGER_REQUEST_MAX;
  (void)rcl_send_response(
    service, &header, &response); /* there is room for what was taken; else it is counted */
}

/* Copies as much as has room; returns the length. */
static size_t services_copy(char * reason, const char * words)
{
  size_t size = microros_text_size(words);

  if (size >= MICROROS_LOGGER_REASON_SIZE) {
    size = MICROROS_LOGGER_REASON_SIZE - 1u;
  }
  (void)memcpy(reason, words, size);
  reason[size] = '\0';
  return size;
}

/* Sets a level. Returns the length of the reason why not; 0: it was set. */
static size_t services_set(const rcl_interfaces__msg__LoggerLevel * requested, char * reason)
{
  rcutils_ret_t result = RCUTILS_RET_INVALID_ARGUMENT;
  size_t size = 0;

  if (requested->level <= (uint32_t)RCUTILS_LOG_SEVERITY_FATAL) {
    result = rcutils_logging_set_logger_level(requested->name.data, (int)requested->level);
  }
  if (result == RCUTILS_RET_INVALID_ARGUMENT) {
    size = services_copy(reason, "Failed reason: Invalid logger level.");
  } else if (result != RCUTILS_RET_OK) {
    const rcutils_error_string_t text = rcutils_get_error_string();

    size = services_copy(reason, text.str);
  } else {
    reason[0] = '\0';
  }
  if (result != RCUTILS_RET_OK) {
    rcutils_reset_error(); /* the reply contains the reason */
  }
  return size;
}

static void services_answer_set(const rcl_service_t * service)
{
  static rcl_interfaces__msg__SetLoggerLevelsResult results[MICROROS_LOGGER_REQUEST_MAX];
  rcl_interfaces__srv__SetLoggerLevels_Request request;
  rcl_interfaces__srv__SetLoggerLevels_Response response;
  rmw_request_id_t header;

  for (size_t i = 0; i < MICROROS_LOGGER_REQUEST_MAX; ++i) {
    services_bind(&logger_levels[i].name, i);
  }
  request.levels.data = logger_levels;
  request.levels.size = 0;
  request.levels.capacity = MICROROS_LOGGER_REQUEST_MAX;
  if (rcl_take_request(service, &header, &request) != RCL_RET_OK) {
    return;
  }
  for (size_t i = 0; i < request.levels.size; ++i) {
    results[i].reason.data = logger_reasons[i];
    results[i].reason.size = services_set(&request.levels.data[i], logger_reasons[i]);
    results[i].reason.capacity = MICROROS_LOGGER_REASON_SIZE;
    results[i].successful = results[i].reason.size == 0u;
  }
  response.results.data = results;
  response.results.size = request.levels.size;
  response.results.capacity = MICROROS_LOGGER_REQUEST_MAX;
  (void)rcl_send_response(service, &header, &response);
}

/* Returns whether this task answers. With several tasks that receive, one at a time does, because all requests share
 * their memory; the others go on, and it answers theirs. A lock would not do: a reply can wait for room in the stream. */
static bool services_begin(void)
{
  bool is_free;

  if (MICROROS_TASKS_SHARE == 0u) {
    return true;
  }
  microros_lock();
  is_free = !logger_services_busy;
  logger_services_busy = true;
  microros_unlock();
  return is_free;
}

static void services_end(void)
{
  if (MICROROS_TASKS_SHARE != 0u) {
    microros_lock();
    logger_services_busy = false;
    microros_unlock();
  }
}

void rcl_logger_services_answer(void)
{
  if (!services_begin()) {
    return;
  }
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    if (services_has_request(&logger_services[i].get)) {
      services_answer_get(&logger_services[i].get);
    }
    if (services_has_request(&logger_services[i].set)) {
      services_answer_set(&logger_services[i].set);
    }
  }
  services_end();
}
