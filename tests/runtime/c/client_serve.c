/* SPDX-License-Identifier: Apache-2.0 */
/* Services and clients of the application in the hands of the test. The service type asks and answers with an Int32. */
#include "types.h"

#include <microros/rmw_service.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLACES = 4, HEADERS = 8 };

int client_serve(char ** word, rcl_node_t * node_list);

static rcl_service_t services[PLACES];
static rcl_client_t clients[PLACES];
static rmw_request_id_t headers[HEADERS];
static microros_message_type_t request_type;
static microros_message_type_t response_type;
static const microros_service_type_t service_type = {"test::srv::dds_::Ask_", &request_type, &response_type};
static const rosidl_service_type_support_t support = {"microros", &service_type};

static const rosidl_service_type_support_t * ask_type(void)
{
  const microros_message_type_t * int32 = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32)->data;

  request_type = *int32;
  request_type.dds_type_name = "test::srv::dds_::Ask_Request_";
  response_type = *int32;
  response_type.dds_type_name = "test::srv::dds_::Ask_Response_";
  return &support;
}

/* serve_take INDEX HEADER */
static rcl_ret_t take_request(char ** word)
{
  rmw_request_id_t * header = &headers[atoi(word[2])];
  std_msgs__msg__Int32 request;
  const rcl_ret_t result = rcl_take_request(&services[atoi(word[1])], header, &request);

  if (result == RCL_RET_OK) {
    printf("request %" PRId32 " %" PRId64 " ", request.data, header->sequence_number);
    for (size_t i = 0; i < sizeof(header->writer_guid); ++i) {
      printf("%02x", header->writer_guid[i]);
    }
    printf("\n");
  }
  return result;
}

/* serve_ask INDEX VALUE */
static rcl_ret_t ask(char ** word)
{
  std_msgs__msg__Int32 request;
  int64_t sequence = 0;
  rcl_ret_t result;

  request.data = (int32_t)strtol(word[2], NULL, 10);
  result = rcl_send_request(&clients[atoi(word[1])], &request, &sequence);
  printf("sequence %" PRId64 "\n", sequence);
  return result;
}

/* serve_reply INDEX */
static rcl_ret_t take_reply(char ** word)
{
  rmw_service_info_t info;
  std_msgs__msg__Int32 response;
  const rcl_ret_t result = rcl_take_response_with_info(&clients[atoi(word[1])], &info, &response);

  if (result == RCL_RET_OK) {
    printf("reply %" PRId32 " %" PRId64 "\n", response.data, info.request_id.sequence_number);
  }
  return result;
}

static rcl_ret_t statistics(char ** word)
{
  rmw_uros_client_statistics_t of_client;
  rmw_uros_service_statistics_t of_service;
  rcl_ret_t result;

  if (strcmp(word[2], "client") == 0) {
    result = rmw_uros_get_client_statistics(rcl_client_get_rmw_handle(&clients[atoi(word[1])]), &of_client);
    if (result == RCL_RET_OK) {
      printf(
        "counted %" PRIu32 " %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", of_client.dropped, of_client.refused,
        of_client.given_up, of_client.interrupted);
    }
    return result;
  }
  result = rmw_uros_get_service_statistics(rcl_service_get_rmw_handle(&services[atoi(word[1])]), &of_service);
  if (result == RCL_RET_OK) {
    printf("counted %" PRIu32 " %" PRIu32 "\n", of_service.dropped, of_service.refused);
  }
  return result;
}

static rcl_ret_t open_or_close(char ** word, rcl_node_t * node_list)
{
  const int index = atoi(word[1]);
  rcl_node_t * node = &node_list[atoi(word[2])];

  if (strcmp(word[0], "serve_init") == 0) {
    return rclc_service_init_default(&services[index], node, ask_type(), word[3]);
  }
  if (strcmp(word[0], "serve_client") == 0) {
    return rclc_client_init_best_effort(&clients[index], node, ask_type(), word[3]);
  }
  if (strcmp(word[0], "serve_fini") == 0) {
    return rcl_service_fini(&services[index], node);
  }
  if (strcmp(word[0], "serve_client_fini") == 0) {
    return rcl_client_fini(&clients[index], node);
  }
  return -1;
}

int client_serve(char ** word, rcl_node_t * node_list)
{
  if (strcmp(word[0], "serve_take") == 0) {
    return take_request(word);
  }
  if (strcmp(word[0], "serve_answer") == 0) { /* INDEX HEADER VALUE */
    std_msgs__msg__Int32 response;

    response.data = (int32_t)strtol(word[3], NULL, 10);
    return rcl_send_response(&services[atoi(word[1])], &headers[atoi(word[2])], &response);
  }
  if (strcmp(word[0], "serve_ask") == 0) {
    return ask(word);
  }
  if (strcmp(word[0], "serve_reply") == 0) {
    return take_reply(word);
  }
  if (strcmp(word[0], "serve_ready") == 0) {
    rmw_service_t * service = rcl_service_get_rmw_handle(&services[atoi(word[1])]);

    printf("ready %d\n", service != NULL && rmw_replier_is_ready(service) ? 1 : 0);
    return RCL_RET_OK;
  }
  if (strcmp(word[0], "serve_names") == 0) {
    printf(
      "names %s %s\n", rcl_service_get_service_name(&services[0]), rcl_client_get_service_name(&clients[0]));
    return RCL_RET_OK;
  }
  if (strcmp(word[0], "serve_statistics") == 0) {
    return statistics(word);
  }
  return open_or_close(word, node_list);
}
