/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_guard_condition.h"
#include "microros/rmw_service.h"
#include "microros/rcl_wait_events.h"
#include "microros/rcl_wait_set.h"
#include "microros/rcl_waiting.h"

/* State of one wait; `settle`: set entries that are not ready to NULL. */
typedef struct wait_look_t {
  int64_t look_again_ns;
  bool settle;
  bool any;
} wait_look_t;

static void look_at_clients(const rcl_wait_set_t * wait_set, wait_look_t * look)
{
  for (size_t i = 0; i < wait_set->size_of_clients; ++i) {
    const rcl_client_t * client = wait_set->clients[i];

    if (client != NULL && rmw_requester_is_open(client->impl) && rmw_requester_is_ready(client->impl)) {
      look->any = true;
    } else if (look->settle) {
      wait_set->clients[i] = NULL;
    }
  }
}

static void look_at_services(const rcl_wait_set_t * wait_set, wait_look_t * look)
{
  for (size_t i = 0; i < wait_set->size_of_services; ++i) {
    const rcl_service_t * service = wait_set->services[i];

    if (service != NULL && rmw_replier_is_open(service->impl) && rmw_replier_is_ready(service->impl)) {
      look->any = true;
    } else if (look->settle) {
      wait_set->services[i] = NULL;
    }
  }
}

static void look_at_guard_conditions(const rcl_wait_set_t * wait_set, wait_look_t * look)
{
  for (size_t i = 0; i < wait_set->size_of_guard_conditions; ++i) {
    const rcl_guard_condition_t ** guard_condition = &wait_set->guard_conditions[i];

    if (rcl_guard_condition_is_valid(*guard_condition) && rcl_guard_condition_is_ready(*guard_condition)) {
      look->any = true;
      if (look->settle) {
        rcl_guard_condition_acknowledge(*guard_condition);
      }
    } else if (look->settle) {
      *guard_condition = NULL;
    }
  }
}

static rcl_ret_t wait_look(const rcl_wait_set_t * wait_set, wait_look_t * look)
{
  rcl_ret_t result = RCL_RET_OK;

  look->any = false;
  look->look_again_ns = INT64_MAX;
  look_at_clients(wait_set, look);
  look_at_services(wait_set, look);
  look_at_guard_conditions(wait_set, look);
  look->any = rcl_wait_events_look(wait_set, look->settle) || look->any;
  return result;
}

rcl_ret_t rcl_wait(rcl_wait_set_t * wait_set, int64_t timeout)
{
  rcl_waiting_t waiting = rcl_waiting_begin(timeout);
  wait_look_t look = {0, false, false};
  rcl_ret_t result;

  if (wait_set == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "wait_set");
  }
  if (wait_set->impl == NULL) {
    return microros_error_refuse(RCL_RET_WAIT_SET_INVALID, "wait_set");
  }
  if (
    wait_set->size_of_subscriptions + wait_set->size_of_guard_conditions + wait_set->size_of_timers +
      wait_set->size_of_clients + wait_set->size_of_services + rcl_wait_events_size(wait_set) ==
    0u) {
    return microros_error_named(RCL_RET_WAIT_SET_EMPTY, microros_error_executor, "the wait set is empty");
  }
  for (;;) {
    rcl_waiting_receive();
    result = wait_look(wait_set, &look);
    if (result != RCL_RET_OK) {
      return result;
    }
    if (look.any || rcl_waiting_is_over(&waiting)) {
      break;
    }
    rcl_waiting_rest(&waiting, look.look_again_ns);
  }
  look.settle = true;
  result = wait_look(wait_set, &look);
  if (result != RCL_RET_OK) {
    return result;
  }
  return look.any ? RCL_RET_OK : RCL_RET_TIMEOUT;
}
