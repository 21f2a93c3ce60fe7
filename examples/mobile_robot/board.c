/* SPDX-License-Identifier: Apache-2.0 */
#include "board.h"

enum { LIFECYCLE_HANDLES = 3, SPIN_MS = 100 };

rclc_support_t board_support;
rcl_node_t board_node;
rclc_executor_t board_executor;
rclc_lifecycle_node_t board_lifecycle;
rclc_parameter_server_t board_parameters;

static rcl_allocator_t allocator;
static rcl_lifecycle_state_machine_t states;
static rclc_modes_t modes;
static rclc_lifecycle_service_context_t context = {&board_lifecycle};

static bool open_node(const board_t * board)
{
  allocator = rcl_get_default_allocator();
  return rclc_support_init(&board_support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&board_node, board->node, "", &board_support) == RCL_RET_OK &&
         rclc_make_node_a_lifecycle_node(&board_lifecycle, &board_node, &states, &allocator, true) ==
           RCL_RET_OK &&
         rclc_parameter_server_init_default(&board_parameters, &board_node) == RCL_RET_OK &&
         board->declare_parameters(&board_parameters) == RCL_RET_OK &&
         rclc_modes_init(&modes, board->modes, &board_lifecycle, &board_parameters) == RCL_RET_OK;
}

static bool open_executor(size_t handles)
{
  board_executor = rclc_executor_get_zero_initialized_executor();
  return rclc_executor_init(&board_executor, &board_support.context, handles, &allocator) == RCL_RET_OK &&
         rclc_executor_add_parameter_server(&board_executor, &board_parameters, NULL) == RCL_RET_OK &&
         rclc_executor_add_modes(&board_executor, &modes, NULL, NULL) == RCL_RET_OK &&
         rclc_lifecycle_init_change_state_server(&context, &board_executor) == RCL_RET_OK &&
         rclc_lifecycle_init_get_state_server(&context, &board_executor) == RCL_RET_OK &&
         rclc_lifecycle_init_get_available_states_server(&context, &board_executor) == RCL_RET_OK;
}

bool board_begin(const board_t * board, size_t handles)
{
  return open_node(board) && open_executor(
                               handles + LIFECYCLE_HANDLES + RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES +
                               RCLC_EXECUTOR_MODES_HANDLES);
}

void board_run(void)
{
  for (;;) {
    (void)rclc_executor_spin_some(
      &board_executor, RCL_MS_TO_NS(SPIN_MS)); /* a lost session comes back by itself */
  }
}
