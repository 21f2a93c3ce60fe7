/* SPDX-License-Identifier: Apache-2.0 */
/* Whether the application has chosen an agent itself: its address. Internal. */
#ifndef MICROROS_RMW_AGENTS_CHOSEN_H
#define MICROROS_RMW_AGENTS_CHOSEN_H

#include <stdbool.h>

#include "microros/rmw_transport_params.h"

static inline bool rmw_agents_is_chosen(const rmw_uxrce_transport_params_t * params)
{
  return params->agent_address[0] != '\0';
}

#endif /* MICROROS_RMW_AGENTS_CHOSEN_H */
