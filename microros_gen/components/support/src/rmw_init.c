/* SPDX-License-Identifier: Apache-2.0 */
/* What rmw/init.h, rmw/init_options.h and rmw/time.h declare. */
#include "rmw/init.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_init_reason.h"
#include "microros/rmw_open.h"
#include "microros/rmw_transport.h"
#include "microros/xrce_client.h"
#include "microros/xrce_place.h"
#include "microros/xrce_routes.h"
#include "rmw/init_options.h"
#include "rmw/rmw.h"
#include "rmw/time.h"
#include "rmw/types.h"

#include <stdbool.h>
#include <string.h>

#define NS_PER_S 1000000000u

const char * rmw_get_implementation_identifier(void)
{
  return rmw_implementation_identifier;
}

const char * rmw_get_serialization_format(void)
{
  return "cdr";
}

rmw_context_t rmw_get_zero_initialized_context(void)
{
  rmw_context_t context;

  (void)memset(&context, 0, sizeof(context));
  return context;
}

static rmw_ret_t init_report(const xrce_client_t * client)
{
  const xrce_session_t * session = &client->session;
  const char * const name = xrce_transport_name(&session->transport);
  const uint16_t port = xrce_transport_port(&session->transport);

  if (session->refusal != 0u) {
    microros_error_set(microros_error_agent_refused, name, NULL, session->refusal, port);
    return RMW_RET_ERROR;
  }
  /* cppcheck-suppress knownConditionTrueFalse ; a constant unless a component replaces the header */
  if (rmw_init_reason(client)) {
    return RMW_RET_ERROR;
  }
  if (!session->transport_open) {
    microros_error_set(microros_error_transport, name, NULL, port, 0);
    return RMW_RET_ERROR;
  }
  microros_error_set(microros_error_agent_silent, name, NULL, port, MICROROS_CONNECT_TIMEOUT_MS);
  return RMW_RET_TIMEOUT;
}

/* There is one client and therefore one session. */
static bool init_is_free(void)
{
  const bool is_free = rmw_client_instance()->session.state == XRCE_CLOSED;

  if (!is_free) {
    microros_error_set(microros_error_context_in_use, NULL, NULL, 0, 0);
  }
  return is_free;
}

/* Returns the application's key, otherwise that of the plan. */
static uint32_t init_key(const rmw_uxrce_transport_params_t * params)
{
  return params->client_key != 0u ? params->client_key : MICROROS_CLIENT_KEY;
}

/* Opens a session with context->options. */
static rmw_ret_t init_open_session(rmw_context_t * context)
{
  xrce_client_t * client = rmw_client_instance();
  const rmw_uxrce_transport_params_t * params = &context->options.transport_params;
  const bool resumes = xrce_place_can_resume(client, params->client_key);
  rmw_ret_t result = RMW_RET_ERROR;

  if (!resumes) {
    xrce_session_open(client, init_key(params));
  }
  if (rmw_transport_prepare(&client->session.transport, params)) {
    if (resumes) {
      xrce_place_resume(client);
    }
    /* cppcheck-suppress knownConditionTrueFalse ; a constant of the plan */
    result = xrce_image_is_local() || xrce_session_await(client, MICROROS_CONNECT_TIMEOUT_MS)
               ? RMW_RET_OK
               : init_report(client);
  }
  if (result != RMW_RET_OK) {
    xrce_session_close(client);
    return result;
  }
  ++context->instance_id;
  context->implementation_identifier = rmw_implementation_identifier;
  context->actual_domain_id =
    context->options.domain_id == RMW_DEFAULT_DOMAIN_ID ? 0u : context->options.domain_id;
  context->impl = client;
  return RMW_RET_OK;
}

static rmw_ret_t init_open(rmw_context_t * context)
{
  rmw_ret_t result;

  microros_lock();
  result = init_open_session(context);
  microros_unlock();
  return result;
}

rmw_ret_t rmw_open_as_planned(rmw_context_t * context)
{
  if (!init_is_free()) {
    return RMW_RET_ERROR;
  }
  (void)memset(&context->options, 0, sizeof(context->options));
  context->options.domain_id = RMW_DEFAULT_DOMAIN_ID;
  return init_open(context);
}

rmw_ret_t rmw_init(const rmw_init_options_t * options, rmw_context_t * context)
{
  if (options == NULL || context == NULL || options->implementation_identifier == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "options or context");
  }
  if (!init_is_free()) {
    return RMW_RET_ERROR;
  }
  context->options = *options; /* the session needs them, so the context stores a copy */
  return init_open(context);
}

rmw_ret_t rmw_shutdown(rmw_context_t * context)
{
  if (context == NULL || context->impl == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "context");
  }
  microros_lock();
  xrce_route_close(context->impl);
  context->impl = NULL;
  microros_unlock();
  return RMW_RET_OK;
}

rmw_ret_t rmw_context_fini(rmw_context_t * context)
{
  if (context == NULL || context->impl != NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "context");
  }
  context->implementation_identifier = NULL;
  return RMW_RET_OK;
}

rmw_init_options_t rmw_get_zero_initialized_init_options(void)
{
  rmw_init_options_t options;

  (void)memset(&options, 0, sizeof(options));
  return options;
}

rmw_ret_t rmw_init_options_init(rmw_init_options_t * init_options, rcutils_allocator_t allocator)
{
  if (init_options == NULL || init_options->implementation_identifier != NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "init_options");
  }
  (void)memset(init_options, 0, sizeof(*init_options));
  init_options->implementation_identifier = rmw_implementation_identifier;
  init_options->domain_id = RMW_DEFAULT_DOMAIN_ID;
  init_options->allocator = allocator;
  return RMW_RET_OK;
}

rmw_ret_t rmw_init_options_copy(const rmw_init_options_t * src, rmw_init_options_t * dst)
{
  if (
    src == NULL || dst == NULL || src->implementation_identifier == NULL ||
    dst->implementation_identifier != NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "init_options");
  }
  *dst = *src;
  return RMW_RET_OK;
}

rmw_ret_t rmw_init_options_fini(rmw_init_options_t * init_options)
{
  if (init_options == NULL || init_options->implementation_identifier == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "init_options");
  }
  init_options->implementation_identifier = NULL;
  return RMW_RET_OK;
}

rmw_message_info_t rmw_get_zero_initialized_message_info(void)
{
  rmw_message_info_t info;

  (void)memset(&info, 0, sizeof(info));
  return info;
}

rmw_duration_t rmw_time_total_nsec(const rmw_time_t time)
{
  const uint64_t most = (uint64_t)INT64_MAX;
  uint64_t total;

  if (time.sec > most / NS_PER_S || time.nsec > most - time.sec * NS_PER_S) {
    return INT64_MAX;
  }
  total = time.sec * NS_PER_S + time.nsec;
  return (rmw_duration_t)total;
}

rmw_time_t rmw_time_from_nsec(const rmw_duration_t nanoseconds)
{
  rmw_time_t time = RMW_DURATION_INFINITE;

  if (nanoseconds >= 0) {
    const uint64_t left = (uint64_t)nanoseconds;

    time.sec = left / NS_PER_S;
    time.nsec = left % NS_PER_S;
  }
  return time;
}

rmw_time_t rmw_time_normalize(const rmw_time_t time)
{
  return rmw_time_from_nsec(rmw_time_total_nsec(time));
}

bool rmw_time_equal(const rmw_time_t left, const rmw_time_t right)
{
  return rmw_time_total_nsec(left) == rmw_time_total_nsec(right);
}
