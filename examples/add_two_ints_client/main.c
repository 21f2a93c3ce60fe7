/* SPDX-License-Identifier: Apache-2.0 */
/* Has three sums under way at once, and ends when all answers are there; which is whose, its number says. */
#include "../example.h"

#include <example_interfaces/srv/add_two_ints.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <inttypes.h>

enum { SUMS = 3 };

typedef struct {
  int64_t number; /* of its request, from 1 on */
  example_interfaces__srv__AddTwoInts_Request request;
} sum_t;

static rclc_support_t support;
static rcl_node_t node;
static rcl_client_t client;
static rclc_executor_t executor;
static example_interfaces__srv__AddTwoInts_Response response;
static sum_t sums[SUMS];
static int answers;

static void ask(int64_t first)
{
  for (size_t i = 0; i < SUMS; ++i) {
    sums[i].request.a = first + (int64_t)i;
    sums[i].request.b = 10 * sums[i].request.a;
    example_check(rcl_send_request(&client, &sums[i].request, &sums[i].number), "request");
  }
}

static void print_answer(const void * message, rmw_request_id_t * id)
{
  const example_interfaces__srv__AddTwoInts_Response * answer = message;

  for (size_t i = 0; i < SUMS; ++i) {
    if (sums[i].number == id->sequence_number) {
      const example_interfaces__srv__AddTwoInts_Request * asked = &sums[i].request;

      (void)printf("%" PRId64 " + %" PRId64 " = %" PRId64 "\n", asked->a, asked->b, answer->sum);
      ++answers;
    }
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "asker", "", &support), "node");
  example_check(
    rclc_client_init_default(
      &client, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "add_two_ints"),
    "client");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  example_check(
    rclc_executor_add_client_with_request_id(&executor, &client, &response, print_answer), "add client");
  ask(1);
  while (example_runs() && answers < SUMS) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_client_fini(&client, &node), "end of the client");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
