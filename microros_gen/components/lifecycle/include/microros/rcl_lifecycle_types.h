/* SPDX-License-Identifier: Apache-2.0 */
/* Types of the messages of a life cycle. Internal. */
#ifndef MICROROS_RCL_LIFECYCLE_TYPES_H
#define MICROROS_RCL_LIFECYCLE_TYPES_H

#include <stdint.h>

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of ~/get_available_transitions and ~/get_transition_graph, whose response is written from a state of the constants. */
extern const rosidl_service_type_support_t rcl_lifecycle_transitions_type;

extern const rosidl_service_type_support_t rcl_lifecycle_state_type;
extern const rosidl_service_type_support_t rcl_lifecycle_states_type;
extern const rosidl_message_type_support_t rcl_lifecycle_event_type;

/* Writes a part of ~/get_transition_graph's response: see xrce_parts_body_t. */
uint32_t rcl_lifecycle_write_graph(uint32_t from, uint32_t size, uint8_t * to);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_TYPES_H */
