/* SPDX-License-Identifier: Apache-2.0 */
/* Services and clients. */
#include "rcl/service.h"

#include "microros/error.h"
#include "microros/rcl_client_open.h"
#include "microros/rcl_names_take.h"
#include "microros/rcl_service_open.h"
#include "microros/rmw_service.h"
#include "rcl/client.h"

#include <string.h>

rcl_service_t rcl_get_zero_initialized_service(void)
{
  const rcl_service_t service = {NULL};

  return service;
}

rcl_service_options_t rcl_service_get_default_options(void)
{
  rcl_service_options_t options;

  (void)memset(&options, 0, sizeof(options));
  options.qos = rmw_qos_profile_services_default;
  options.allocator = rcl_get_default_allocator();
  return options;
}

rcl_ret_t rcl_service_open(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rmw_qos_profile_t * qos)
{
  rcl_names_topic_t taken;
  const char * fault;

  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (type_support == NULL || service_name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "type_support or service_name");
  }
  if (service->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_service_open, service_name);
  }
  fault = rcl_names_take(&taken, service_name, node->impl);
  if (fault != NULL) {
    microros_error_set(microros_error_name, service_name, fault, 0, 0);
    return RCL_RET_SERVICE_NAME_INVALID;
  }
  return rmw_replier_open(node->impl, type_support, taken.name, qos, &service->impl);
}

rcl_ret_t rcl_service_init(
  rcl_service_t * service, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rcl_service_options_t * options)
{
  if (options == NULL || service == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "service or options");
  }
  return rcl_service_open(service, node, type_support, service_name, &options->qos);
}

rcl_ret_t rcl_service_fini(rcl_service_t * service, rcl_node_t * node)
{
  if (service == NULL) {
    return microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
  }
  if (!rcl_node_is_valid_except_context(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (rmw_replier_is_open(service->impl)) {
    rmw_replier_close(service->impl);
  }
  service->impl = NULL;
  return RCL_RET_OK;
}

bool rcl_service_is_valid(const rcl_service_t * service)
{
  if (service == NULL) {
    return false;
  }
  return rmw_replier_is_open(service->impl);
}

rcl_ret_t rcl_take_request_with_info(
  const rcl_service_t * service, rmw_service_info_t * request_header, void * ros_request)
{
  bool taken = false;
  rmw_ret_t result;

  if (!rcl_service_is_valid(service)) {
    return microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
  }
  if (request_header == NULL || ros_request == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "request_header or ros_request");
  }
  rmw_replier_pump(service->impl);
  result = rmw_replier_take(service->impl, request_header, ros_request, &taken);
  if (result != RMW_RET_OK) {
    return result;
  }
  return taken ? RCL_RET_OK : RCL_RET_SERVICE_TAKE_FAILED;
}

rcl_ret_t rcl_take_request(
  const rcl_service_t * service, rmw_request_id_t * request_header, void * ros_request)
{
  rmw_service_info_t info;
  rcl_ret_t result;

  if (request_header == NULL) {
    return rcl_take_request_with_info(service, NULL, ros_request);
  }
  result = rcl_take_request_with_info(service, &info, ros_request);
  if (result == RCL_RET_OK) {
    *request_header = info.request_id;
  }
  return result;
}

rcl_ret_t rcl_send_response(
  const rcl_service_t * service, rmw_request_id_t * response_header, void * ros_response)
{
  if (!rcl_service_is_valid(service)) {
    return microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
  }
  if (response_header == NULL || ros_response == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "response_header or ros_response");
  }
  return rmw_replier_respond(service->impl, response_header, ros_response);
}

const char * rcl_service_get_service_name(const rcl_service_t * service)
{
  return rcl_service_is_valid(service) ? service->impl->service_name : NULL;
}

rmw_service_t * rcl_service_get_rmw_handle(const rcl_service_t * service)
{
  return rcl_service_is_valid(service) ? service->impl : NULL;
}

rcl_client_t rcl_get_zero_initialized_client(void)
{
  const rcl_client_t client = {NULL};

  return client;
}

rcl_client_options_t rcl_client_get_default_options(void)
{
  rcl_client_options_t options;

  (void)memset(&options, 0, sizeof(options));
  options.qos = rmw_qos_profile_services_default;
  options.allocator = rcl_get_default_allocator();
  return options;
}

rcl_ret_t rcl_client_open(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rmw_qos_profile_t * qos)
{
  rcl_names_topic_t taken;
  const char * fault;

  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (type_support == NULL || service_name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "type_support or service_name");
  }
  if (client->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_client_open, service_name);
  }
  fault = rcl_names_take(&taken, service_name, node->impl);
  if (fault != NULL) {
    microros_error_set(microros_error_name, service_name, fault, 0, 0);
    return RCL_RET_SERVICE_NAME_INVALID;
  }
  return rmw_requester_open(node->impl, type_support, taken.name, qos, &client->impl);
}

rcl_ret_t rcl_client_init(
  rcl_client_t * client, const rcl_node_t * node, const rosidl_service_type_support_t * type_support,
  const char * service_name, const rcl_client_options_t * options)
{
  if (options == NULL || client == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client or options");
  }
  return rcl_client_open(client, node, type_support, service_name, &options->qos);
}

rcl_ret_t rcl_client_fini(rcl_client_t * client, rcl_node_t * node)
{
  if (client == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client");
  }
  if (!rcl_node_is_valid_except_context(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (rmw_requester_is_open(client->impl)) {
    rmw_requester_close(client->impl);
  }
  client->impl = NULL;
  return RCL_RET_OK;
}

bool rcl_client_is_valid(const rcl_client_t * client)
{
  if (client == NULL) {
    return false;
  }
  return rmw_requester_is_open(client->impl);
}

rcl_ret_t rcl_take_response_with_info(
  const rcl_client_t * client, rmw_service_info_t * request_header, void * ros_response)
{
  bool taken = false;
  rmw_ret_t result;

  if (!rcl_client_is_valid(client)) {
    return microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
  }
  if (request_header == NULL || ros_response == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "request_header or ros_response");
  }
  rmw_requester_pump(client->impl);
  result = rmw_requester_take(client->impl, request_header, ros_response, &taken);
  if (result != RMW_RET_OK) {
    return result;
  }
  return taken ? RCL_RET_OK : RCL_RET_CLIENT_TAKE_FAILED;
}

rcl_ret_t rcl_take_response(
  const rcl_client_t * client, rmw_request_id_t * request_header, void * ros_response)
{
  rmw_service_info_t info;
  rcl_ret_t result;

  if (request_header == NULL) {
    return rcl_take_response_with_info(client, NULL, ros_response);
  }
  result = rcl_take_response_with_info(client, &info, ros_response);
  if (result == RCL_RET_OK) {
    *request_header = info.request_id;
  }
  return result;
}

rcl_ret_t rcl_send_request(const rcl_client_t * client, const void * ros_request, int64_t * sequence_number)
{
  if (!rcl_client_is_valid(client)) {
    return microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
  }
  if (ros_request == NULL || sequence_number == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "ros_request or sequence_number");
  }
  return rmw_requester_send(client->impl, ros_request, sequence_number);
}

const char * rcl_client_get_service_name(const rcl_client_t * client)
{
  return rcl_client_is_valid(client) ? client->impl->service_name : NULL;
}

rmw_client_t * rcl_client_get_rmw_handle(const rcl_client_t * client)
{
  return rcl_client_is_valid(client) ? client->impl : NULL;
}
