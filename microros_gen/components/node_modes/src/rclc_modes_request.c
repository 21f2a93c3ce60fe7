/* SPDX-License-Identifier: Apache-2.0 */
/* Modes that a contingency requests. Whichever task receives requests them; the task of their executor changes them. */
#include "microros/rclc_modes_request.h"

#include "microros/lock.h"
#include "microros/rclc_modes_known.h"
#include "microros/rclc_modes_table.h"
#include "microros/rmw_node.h"
#include "microros/wake.h"
#include "microros_config.h"
#include "rcl/error_handling.h"

#include <stddef.h>

/* With the lock. */
typedef struct modes_request_t {
  rclc_modes_t * modes;
  uint8_t wanted;
  bool is_due;
} modes_request_t;

static modes_request_t modes_requests[MICROROS_NODES_MAX];

static modes_request_t * request_of(const rclc_modes_t * modes)
{
  return &modes_requests[rmw_node_index(modes->lifecycle_node->node->impl)];
}

static void request_set(const rclc_modes_t * modes, rclc_modes_t * registered)
{
  modes_request_t * request = request_of(modes);

  microros_lock();
  request->modes = registered;
  request->is_due = false;
  microros_unlock();
}

void rclc_modes_register(rclc_modes_t * modes)
{
  request_set(modes, modes);
}

void rclc_modes_remove(const rclc_modes_t * modes)
{
  request_set(modes, NULL);
}

bool rclc_modes_is_requested(const rclc_modes_t * modes)
{
  bool is_due;

  microros_lock();
  is_due = request_of(modes)->is_due;
  microros_unlock();
  return is_due;
}

bool rclc_modes_request(uint16_t node, const char * mode)
{
  bool is_done = false;
  bool is_due = false;

  microros_lock();
  if (node < (uint16_t)MICROROS_NODES_MAX && modes_requests[node].modes != NULL) {
    modes_request_t * request = &modes_requests[node];

    request->wanted = rclc_modes_find(request->modes, mode);
    is_done = rclc_modes_get(request->modes) == request->wanted;
    is_due = !is_done;
    request->is_due = is_due;
  }
  microros_unlock();
  if (is_due) {
    microros_wake(); /* the executor begins a round */
  }
  return is_done;
}

static void request_do(rclc_modes_t * modes)
{
  modes_request_t * request = request_of(modes);
  uint8_t wanted = (uint8_t)RCLC_MODES_NONE;
  bool is_due;

  microros_lock();
  is_due = request->is_due;
  if (is_due) {
    wanted = request->wanted;
    request->is_due = false;
  }
  microros_unlock();
  /* The callbacks are the application's, so it is done without the lock. What fails is requested again. */
  if (is_due && rclc_modes_reconfigure(modes, wanted) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void rclc_modes_round_begins(const rclc_executor_t * executor)
{
  for (size_t i = 0; i < executor->index; ++i) {
    if (rclc_modes_has_handle(&executor->handles[i])) {
      request_do(executor->handles[i].callback_context);
    }
  }
}
