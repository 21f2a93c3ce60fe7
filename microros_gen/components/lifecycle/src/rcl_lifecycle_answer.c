/* SPDX-License-Identifier: Apache-2.0 */
/* The transitions of one state go into the stream, the whole graph in fragments. */
#include "microros/rcl_lifecycle_answer.h"

#include "lifecycle_msgs/srv/get_available_transitions.h"
#include "microros/lock.h"
#include "microros/rcl_lifecycle_events.h"
#include "microros/rcl_lifecycle_types.h"
#include "microros/rmw_lifecycle.h"
#include "microros/rmw_node.h"
#include "microros/rmw_service.h"
#include "microros_config.h"
#include "rcl/error_handling.h"
#include "rcl/service.h"

#include <stddef.h>

static rcl_lifecycle_state_machine_t * answer_machines[MICROROS_NODES_MAX];

void rcl_lifecycle_answer_for(rcl_lifecycle_state_machine_t * state_machine)
{
  const rcl_node_t * node = state_machine->com_interface.node_handle;

  rmw_lifecycle_use(node->impl, rcl_lifecycle_write_graph); /* first: an answer needs it */
  microros_lock();
  answer_machines[rmw_node_index(node->impl)] = state_machine;
  microros_unlock();
}

void rcl_lifecycle_answer_no_longer(const rcl_lifecycle_state_machine_t * state_machine)
{
  microros_lock();
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    if (answer_machines[i] == state_machine) {
      answer_machines[i] = NULL;
    }
  }
  microros_unlock();
}

void rcl_lifecycle_leave(const rcl_node_t * node)
{
  microros_lock();
  answer_machines[rmw_node_index(node->impl)] = NULL;
  rmw_lifecycle_set_state(node->impl, 0u);
  rcl_lifecycle_events_clear(node);
  microros_unlock();
}

/* Takes a request that can be answered; false: none has arrived, or it is not of its type. */
static bool answer_take(const rcl_service_t * service, rmw_request_id_t * request)
{
  lifecycle_msgs__srv__GetAvailableTransitions_Request nothing;
  bool taken = false;

  if (
    rcl_service_is_valid(service) &&
    rmw_replier_begin(service->impl, request, &nothing, &taken) != RMW_RET_OK) {
    rcl_reset_error(); /* counted */
  }
  return taken;
}

static void answer_requests(rcl_lifecycle_state_machine_t * machine)
{
  rcl_lifecycle_com_interface_t * offers = &machine->com_interface;
  rmw_request_id_t request;

  rcl_lifecycle_events_send(offers);
  if (answer_take(&offers->srv_get_available_transitions, &request)) {
    if (
      rmw_replier_end(offers->srv_get_available_transitions.impl, &request, machine->current_state) !=
      RMW_RET_OK) {
      rcl_reset_error(); /* there is room for what was taken; else it is counted */
    }
  }
  if (
    !rmw_lifecycle_is_replying(offers->node_handle->impl) &&
    answer_take(&offers->srv_get_transition_graph, &request)) {
    rmw_replier_abandon(); /* it takes no slot */
    rmw_lifecycle_reply(offers->srv_get_transition_graph.impl, &request);
  }
}

void rcl_lifecycle_answer(void)
{
  microros_lock(); /* whichever task receives answers, while that of the node changes its state */
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    if (answer_machines[i] != NULL) {
      answer_requests(answer_machines[i]);
    }
  }
  microros_unlock();
}
