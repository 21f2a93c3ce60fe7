/* SPDX-License-Identifier: Apache-2.0 */
/* Message storage of the declared services and clients. */
#include "microros/rmw_service.h"
#include "std_srvs/srv/detail/set_bool__storage.h"

#include <stddef.h>

typedef void (*service_bind_t)(void * ros_message);

static void service_bind(service_bind_t bind, void * ros_message)
{
  if (bind != NULL && ros_message != NULL) {
    bind(ros_message);
  }
}

/* /set */
static void bind_service_0_response(void * ros_message)
{
  static std_srvs__srv__SetBool_Response__Storage storage;
  std_srvs__srv__SetBool_Response * message = ros_message;

  if (
    message->message.capacity <= 1u) {
    std_srvs__srv__SetBool_Response__bind(message, &storage);
  }
}

/* /ask */
static void bind_client_0_response(void * ros_message)
{
  static std_srvs__srv__SetBool_Response__on__ask__Storage storage;
  std_srvs__srv__SetBool_Response * message = ros_message;

  if (
    message->message.capacity <= 1u) {
    std_srvs__srv__SetBool_Response__on__ask__bind(message, &storage);
  }
}

void rmw_replier_bind(const rmw_service_t * service, void * ros_request, void * ros_response)
{
  static const service_bind_t requests[MICROROS_SERVICES_MAX] = {
    NULL,
  };
  static const service_bind_t responses[MICROROS_SERVICES_MAX] = {
    bind_service_0_response,
  };

  const xrce_endpoint_t * endpoint;
  size_t index;

  if (!rmw_replier_is_open(service)) {
    return;
  }
  endpoint = service->data;
  index = endpoint->index - (XRCE_REPLIERS_AT - MICROROS_NODES_MAX);
  service_bind(requests[index], ros_request);
  service_bind(responses[index], ros_response);
}

void rmw_requester_bind(const rmw_client_t * client, void * ros_response)
{
  static const service_bind_t responses[MICROROS_CLIENTS_MAX] = {
    bind_client_0_response,
  };

  const xrce_endpoint_t * endpoint = client->data;
  const size_t index = endpoint->index - (XRCE_REQUESTERS_AT - MICROROS_NODES_MAX);

  service_bind(responses[index], ros_response);
}
