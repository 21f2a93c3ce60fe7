/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board of test_peer_services.py. Serves /OWN/check, and calls /OTHER/check PEER_LAST times in each life, one request
 * at a time, with texts of different lengths; a reply has the text of its request twice. What happened is where the
 * test's monitor finds it: in peer_report. */
#include <diagnostic_msgs/srv/add_diagnostics.h>
#include <microros/port_bare.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <string.h>

enum { HANDLES = 2, SHORTEST = 3, STEP = 7, LONGEST = 100 };

typedef diagnostic_msgs__srv__AddDiagnostics_Request request_t;
typedef diagnostic_msgs__srv__AddDiagnostics_Response response_t;

typedef struct peer_report_t {
  uint32_t ready;   /* support_init and everything after it succeeded */
  uint32_t served;  /* callbacks of the service */
  uint32_t replies; /* to requests of this board */
  uint32_t refused; /* calls of rcl_send_request that had to be repeated */
  uint32_t wrong;   /* texts that are not as they were sent */
  uint32_t errors;  /* of the executor */
  uint32_t malformed;
  uint32_t fault; /* its cause, 0 without one */
} peer_report_t;

volatile peer_report_t peer_report;

static rclc_support_t support;
static rcl_node_t node;
static rcl_service_t service;
static rcl_client_t client;
static rclc_executor_t executor;
static char texts[4][2 * LONGEST + 1];
static request_t request = {{texts[0], 0, sizeof(texts[0])}};
static response_t response = {true, {texts[1], 0, sizeof(texts[1])}};
static response_t reply = {false, {texts[2], 0, sizeof(texts[2])}};
static bool is_waiting;

static char letter(size_t size, size_t i)
{
  return (char)('a' + (int)((size + i) % 26u));
}

static bool is_text(const char * text, size_t size)
{
  for (size_t i = 0; i < size; ++i) {
    if (text[i] != letter(size, i)) {
      return false;
    }
  }
  return true;
}

static void serve(const void * asked, void * answered)
{
  const rosidl_runtime_c__String * text = &((const request_t *)asked)->load_namespace;
  rosidl_runtime_c__String * twice = &((response_t *)answered)->message;

  peer_report.served = peer_report.served + 1u;
  if (!is_text(text->data, text->size)) {
    peer_report.wrong = peer_report.wrong + 1u;
  }
  (void)memcpy(twice->data, text->data, text->size);
  (void)memcpy(&twice->data[text->size], text->data, text->size);
  twice->size = 2u * text->size;
  twice->data[twice->size] = '\0';
}

static void hear_reply(const void * answered)
{
  const rosidl_runtime_c__String * text = &((const response_t *)answered)->message;
  const size_t size = text->size / 2u;

  peer_report.replies = peer_report.replies + 1u;
  is_waiting = false;
  if (!is_text(text->data, size) || !is_text(&text->data[size], size)) {
    peer_report.wrong = peer_report.wrong + 1u;
  }
}

static bool start(void)
{
  const rosidl_service_type_support_t * type =
    ROSIDL_GET_SRV_TYPE_SUPPORT(diagnostic_msgs, srv, AddDiagnostics);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  executor = rclc_executor_get_zero_initialized_executor();
  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "board", "", &support) == RCL_RET_OK &&
         rclc_service_init_default(&service, &node, type, "/" OWN "/check") == RCL_RET_OK &&
         rclc_client_init_default(&client, &node, type, "/" OTHER "/check") == RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, HANDLES, &allocator) == RCL_RET_OK &&
         rclc_executor_add_service(&executor, &service, &request, &response, serve) == RCL_RET_OK &&
         rclc_executor_add_client(&executor, &client, &reply, hear_reply) == RCL_RET_OK;
}

static void ask_next(void)
{
  const size_t size = SHORTEST + (peer_report.replies * STEP) % (LONGEST - SHORTEST + 1u);
  const request_t next = {{texts[3], size, sizeof(texts[3])}};
  int64_t sequence = 0;

  for (size_t i = 0; i < size; ++i) {
    texts[3][i] = letter(size, i);
  }
  texts[3][size] = '\0';
  is_waiting = rcl_send_request(&client, &next, &sequence) == RCL_RET_OK;
  if (!is_waiting) {
    rcl_reset_error();
    peer_report.refused = peer_report.refused + 1u;
  }
}

int main(void)
{
  port_bare_fault_t fault;
  rmw_uros_statistics_t statistics;

  if (port_bare_fault_take(&fault)) {
    peer_report.fault = fault.cause;
  }
  if (!start()) {
    return 1;
  }
  peer_report.ready = 1;
  for (;;) {
    rcl_ret_t code;

    if (!is_waiting && peer_report.replies < PEER_LAST) {
      ask_next();
    }
    code = rclc_executor_spin_some(&executor, RCL_MS_TO_NS(5));
    if (code != RCL_RET_OK && code != RCL_RET_TIMEOUT) {
      rcl_reset_error();
      peer_report.errors = peer_report.errors + 1u;
      is_waiting = false; /* the other board has restarted */
    }
    if (rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics) == RMW_RET_OK) {
      peer_report.malformed = statistics.malformed;
    }
  }
}
