/*
 * An application for pure_reader, to start from: copy it out of this folder and change it.
 * It answers what it is asked as set (std_srvs/srv/SetBool) and asks every EXAMPLE_PERIOD_MS milliseconds ask (std_srvs/srv/SetBool).
 */
#include <microros/port.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rosidl_runtime_c/string.h>
#include <std_srvs/srv/detail/set_bool__storage.h>
#include <std_srvs/srv/set_bool.h>

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifndef EXAMPLE_PERIOD_MS
#define EXAMPLE_PERIOD_MS 100
#endif

/* Number of samples before the program ends: by default enough for years. */
#ifndef EXAMPLE_SAMPLES
#define EXAMPLE_SAMPLES UINT32_MAX
#endif

static rclc_support_t support;
static rcl_node_t node;
static rcl_service_t service_0;
static std_srvs__srv__SetBool_Response set_bool_0_response;
static std_srvs__srv__SetBool_Response__Storage set_bool_0_response_storage;
static std_srvs__srv__SetBool_Request set_bool_0_request;
static rcl_client_t client_0;
static std_srvs__srv__SetBool_Request asked_set_bool_0_request;
static std_srvs__srv__SetBool_Response asked_set_bool_0_response;
static std_srvs__srv__SetBool_Response__on__ask__Storage asked_set_bool_0_response_storage;
static rclc_executor_t executor;
static uint32_t failed;
static uint32_t ticks; /* of timers; without timers: of EXAMPLE_PERIOD_MS */

static void serve_set_bool_0(const void * request, void * response);
static void on_reply_of_set_bool_0(const void * response);

/* Copies into the storage that the message is bound to. rosidl_runtime_c__String__assign does that, too,
 * but links further storage for longer texts, which a bound message does not need. */
static bool put_text(rosidl_runtime_c__String * string, const char * text)
{
  const size_t size = strlen(text);

  if (size >= string->capacity) {
    return false;
  }
  (void)memcpy(string->data, text, size + 1u);
  string->size = size;
  return true;
}

static rcl_ret_t executors_init(rcl_allocator_t * allocator)
{
  rcl_ret_t result = RCL_RET_OK;

  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 2, allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_service(
      &executor, &service_0, &set_bool_0_request, &set_bool_0_response, serve_set_bool_0);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_client(
      &executor, &client_0, &asked_set_bool_0_response, on_reply_of_set_bool_0);
  }
  return result;
}

static rcl_ret_t application_init(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "probe", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_service_init_default(
      &service_0, &node,
      ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool), "set");
  }
  std_srvs__srv__SetBool_Response__bind(&set_bool_0_response, &set_bool_0_response_storage);
  if (result == RCL_RET_OK && !std_srvs__srv__SetBool_Request__init(&set_bool_0_request)) {
    result = RCL_RET_ERROR;
  }
  if (
    result == RCL_RET_OK &&
    !put_text(&set_bool_0_response.message, "text")) {
    result = RCL_RET_ERROR;
  }
  if (result == RCL_RET_OK) {
    result = rclc_client_init_default(
      &client_0, &node,
      ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool), "ask");
  }
  if (result == RCL_RET_OK && !std_srvs__srv__SetBool_Request__init(&asked_set_bool_0_request)) {
    result = RCL_RET_ERROR;
  }
  std_srvs__srv__SetBool_Response__on__ask__bind(&asked_set_bool_0_response, &asked_set_bool_0_response_storage);
  return result == RCL_RET_OK ? executors_init(&allocator) : result;
}

static void application_fini(void)
{
  (void)rclc_executor_fini(&executor);
  (void)rcl_client_fini(&client_0, &node);
  (void)rcl_service_fini(&service_0, &node);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

/* Reports why a call failed: the library keeps the text of the last error. */
static void report(const char * what)
{
  (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
  rcl_reset_error();
}

/* Fills set_bool_0_response from set_bool_0_request; the executor sends it. */
static void serve_set_bool_0(const void * request, void * response)
{
  const uint32_t count = ticks;

  (void)request;
  (void)response;
  set_bool_0_response.success = (count % 2u) == 1u;
  (void)printf("request of set: %lld\n", (long long)set_bool_0_request.data);
  (void)fflush(stdout);
}

/* The reply is asked_set_bool_0_response. */
static void on_reply_of_set_bool_0(const void * response)
{
  (void)response;
  (void)printf("reply of ask: %lld\n", (long long)asked_set_bool_0_response.success);
  (void)fflush(stdout);
}

static rcl_ret_t ask_set_bool_0(uint32_t count)
{
  int64_t sequence_number;

  asked_set_bool_0_request.data = (count % 2u) == 1u;
  return rcl_send_request(&client_0, &asked_set_bool_0_request, &sequence_number);
}

/* Runs the executors for EXAMPLE_PERIOD_MS. */
static void run(void)
{
  const uint32_t begin = port_time_ms();
  uint32_t passed = 0;

  while (passed < EXAMPLE_PERIOD_MS) {
    if (rclc_executor_spin_some(&executor, (uint64_t)(EXAMPLE_PERIOD_MS - passed) * 1000000u) != RCL_RET_OK) {
      report("executor");
      ++failed;
    }
    passed = port_time_ms() - begin;
  }
}

int main(void)
{
  if (application_init() != RCL_RET_OK) {
    report("start");
    application_fini();
    return 1;
  }
  for (; ticks < EXAMPLE_SAMPLES; ++ticks) {
    if (ask_set_bool_0(ticks) != RCL_RET_OK) {
      report("ask");
      ++failed;
    }
    run();
  }
  application_fini();
  return failed == 0 ? 0 : 1;
}
