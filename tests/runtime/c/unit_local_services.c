/* SPDX-License-Identifier: Apache-2.0 */
/* Services inside one image without an agent: the application file is that of test_local_services.py. */
#include "unit.h"

#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_srvs/srv/trigger.h>

#include <string.h>

enum { SLOTS = 2 };

static rcl_allocator_t allocator;
static rclc_support_t support;
static rcl_node_t node;
static rcl_node_t other_node;
static rcl_service_t sum;
static rcl_client_t sum_client;
static rcl_service_t trigger;
static rcl_client_t trigger_client;

static const rosidl_service_type_support_t * sum_type(void)
{
  return ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts);
}

static void open_sum(void)
{
  CHECK(rclc_service_init_default(&sum, &node, sum_type(), "sum") == RCL_RET_OK);
  CHECK(rclc_client_init_default(&sum_client, &other_node, sum_type(), "/sum") == RCL_RET_OK);
}

static void open(void)
{
  const rosidl_service_type_support_t * type = ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, Trigger);

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK); /* without an agent */
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&other_node, "other", "", &support) == RCL_RET_OK);
  open_sum();
  CHECK(rclc_service_init_default(&trigger, &node, type, "trigger") == RCL_RET_OK);
  CHECK(rclc_client_init_default(&trigger_client, &node, type, "trigger") == RCL_RET_OK);
}

static int64_t ask(int64_t a, int64_t b)
{
  example_interfaces__srv__AddTwoInts_Request request = {.a = a, .b = b};
  int64_t sequence = 0;

  CHECK(rcl_send_request(&sum_client, &request, &sequence) == RCL_RET_OK);
  request.a = -1; /* the copy is the library's */
  return sequence;
}

static rmw_request_id_t take(int64_t a, int64_t b)
{
  example_interfaces__srv__AddTwoInts_Request request;
  rmw_request_id_t id;

  CHECK(rcl_take_request(&sum, &id, &request) == RCL_RET_OK && request.a == a && request.b == b);
  return id;
}

static void reply(rmw_request_id_t id, int64_t value)
{
  example_interfaces__srv__AddTwoInts_Response response = {.sum = value};

  CHECK(rcl_send_response(&sum, &id, &response) == RCL_RET_OK);
}

static void hear(int64_t sequence, int64_t value)
{
  example_interfaces__srv__AddTwoInts_Response response;
  rmw_request_id_t id;

  CHECK(rcl_take_response(&sum_client, &id, &response) == RCL_RET_OK);
  CHECK(id.sequence_number == sequence && response.sum == value);
}

static bool hears_nothing(void)
{
  example_interfaces__srv__AddTwoInts_Response response;
  rmw_request_id_t id;

  return rcl_take_response(&sum_client, &id, &response) == RCL_RET_CLIENT_TAKE_FAILED;
}

static bool is_asked_nothing(void)
{
  example_interfaces__srv__AddTwoInts_Request request;
  rmw_request_id_t id;

  return rcl_take_request(&sum, &id, &request) == RCL_RET_SERVICE_TAKE_FAILED;
}

/* Sequence numbers count from 1; replies may come in any order, and each request gets one. */
static void test_order(void)
{
  const int64_t first = ask(1, 2);
  const int64_t second = ask(3, 4);
  rmw_request_id_t first_id;
  rmw_request_id_t second_id;

  CHECK(first == 1 && second == 2);
  CHECK(hears_nothing());
  first_id = take(1, 2);
  second_id = take(3, 4);
  CHECK(is_asked_nothing() && first_id.sequence_number == 1 && second_id.sequence_number == 2);
  reply(second_id, 7);
  reply(second_id, 70);
  hear(second, 7);
  CHECK(hears_nothing()); /* a second reply to a request is none */
  reply(first_id, 3);
  hear(first, 3);
  CHECK(hears_nothing());
}

/* Returns how many messages the image has dropped. */
static uint32_t dropped(void)
{
  rmw_uros_statistics_t statistics;

  CHECK(rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics) == RMW_RET_OK);
  return statistics.dropped;
}

/* A request without room is refused; one to a server that is not open gets no reply, as in ROS. */
static void test_no_room(void)
{
  const example_interfaces__srv__AddTwoInts_Request request = {.a = 9};
  int64_t sequence = 0;
  uint32_t before;

  for (int64_t i = 0; i < SLOTS; ++i) {
    (void)ask(i, 0);
  }
  CHECK(rcl_send_request(&sum_client, &request, &sequence) == RCL_RET_ERROR && sequence == 0);
  CHECK(strstr(rcl_get_error_string().str, "service /sum: its server has not taken") != NULL);
  rcl_reset_error();
  for (int64_t i = 0; i < SLOTS; ++i) {
    reply(take(i, 0), i);
  }
  for (int64_t i = 0; i < SLOTS; ++i) {
    hear(3 + i, i);
  }
  CHECK(rcl_service_fini(&sum, &node) == RCL_RET_OK);
  before = dropped();
  CHECK(ask(0, 0) == 3 + SLOTS);
  CHECK(dropped() == before + 1u);
  CHECK(rclc_service_init_default(&sum, &node, sum_type(), "sum") == RCL_RET_OK);
  CHECK(is_asked_nothing() && hears_nothing());
}

/* What a former owner of a place asked is not answered to the next one, whose numbers begin again. */
static void test_next_owner(void)
{
  rmw_request_id_t id;
  const uint32_t before = dropped();

  (void)ask(5, 5);
  id = take(5, 5);
  CHECK(rcl_client_fini(&sum_client, &other_node) == RCL_RET_OK);
  reply(id, 10);
  CHECK(dropped() == before + 1u);
  CHECK(rclc_client_init_default(&sum_client, &other_node, sum_type(), "/sum") == RCL_RET_OK);
  reply(id, 11);
  CHECK(hears_nothing());
  CHECK(ask(6, 6) == 1);
  reply(take(6, 6), 12);
  hear(1, 12);
}

/* Strings have their own memory, and limits hold. */
static void test_texts(void)
{
  static const char long_text[] = "a text that is longer than the limit of the application";
  char memory[32] = "";
  std_srvs__srv__Trigger_Request request;
  std_srvs__srv__Trigger_Response response = {.success = true};
  std_srvs__srv__Trigger_Response heard = {.message = {memory, 0, sizeof(memory)}};
  rmw_request_id_t id;
  rmw_request_id_t heard_id;
  char said[] = "started";
  int64_t sequence = 0;

  (void)memset(&request, 0, sizeof(request));
  CHECK(rcl_send_request(&trigger_client, &request, &sequence) == RCL_RET_OK);
  CHECK(rcl_take_request(&trigger, &id, &request) == RCL_RET_OK);
  response.message.data = (char *)long_text;
  response.message.size = sizeof(long_text) - 1u;
  CHECK(rcl_send_response(&trigger, &id, &response) == RCL_RET_ERROR);
  rcl_reset_error();
  response.message.data = said;
  response.message.size = sizeof(said) - 1u;
  CHECK(rcl_send_response(&trigger, &id, &response) == RCL_RET_OK);
  said[0] = 'S';
  CHECK(rcl_take_response(&trigger_client, &heard_id, &heard) == RCL_RET_OK);
  CHECK(heard.success && strcmp(heard.message.data, "started") == 0 && heard_id.sequence_number == sequence);
}

static example_interfaces__srv__AddTwoInts_Request executed_request;
static example_interfaces__srv__AddTwoInts_Response executed_response;
static example_interfaces__srv__AddTwoInts_Response received;
static uint32_t replies;

static void on_request(const void * request, void * response)
{
  const example_interfaces__srv__AddTwoInts_Request * asked = request;
  example_interfaces__srv__AddTwoInts_Response * answer = response;

  answer->sum = asked->a + asked->b;
}

static void on_reply(const void * response)
{
  const example_interfaces__srv__AddTwoInts_Response * answer = response;

  CHECK(answer->sum == 42);
  ++replies;
}

/* One executor runs both ends: a round for the request, and one for the reply. */
static void test_executor(void)
{
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();

  CHECK(rclc_executor_init(&executor, &support.context, 2, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_add_client(&executor, &sum_client, &received, on_reply) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_service(&executor, &sum, &executed_request, &executed_response, on_request) ==
    RCL_RET_OK);
  (void)ask(40, 2);
  (void)ask(2, 40);
  for (uint32_t i = 0; i < 4u; ++i) {
    CHECK(rclc_executor_spin_some(&executor, 0) == RCL_RET_OK);
  }
  CHECK(replies == 2u);
  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
}

int main(void)
{
  open();
  test_order();
  test_no_room();
  test_next_owner();
  test_texts();
  test_executor();
  CHECK(rcl_client_fini(&sum_client, &other_node) == RCL_RET_OK);
  CHECK(rcl_service_fini(&sum, &node) == RCL_RET_OK);
  CHECK(rcl_client_fini(&trigger_client, &node) == RCL_RET_OK);
  CHECK(rcl_service_fini(&trigger, &node) == RCL_RET_OK);
  CHECK(rcl_node_fini(&node) == RCL_RET_OK && rcl_node_fini(&other_node) == RCL_RET_OK);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
  return 0;
}
