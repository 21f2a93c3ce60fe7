/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_lifecycle/rcl_lifecycle.h"
#include "rcutils/logging_macros.h"

void rcl_print_state_machine(const rcl_lifecycle_state_machine_t * state_machine)
{
  const rcl_lifecycle_transition_map_t * map = &state_machine->transition_map;

  for (unsigned int i = 0; i < map->states_size; ++i) {
    const rcl_lifecycle_state_t * state = &map->states[i];

    RCUTILS_LOG_INFO_NAMED(
      "rcl_lifecycle", "state %s (%u): %u transitions", state->label, state->id,
      state->valid_transition_size);
    for (unsigned int k = 0; k < state->valid_transition_size; ++k) {
      RCUTILS_LOG_INFO_NAMED(
        "rcl_lifecycle", "  %s to %s", state->valid_transitions[k].label,
        state->valid_transitions[k].goal->label);
    }
  }
}
