/* SPDX-License-Identifier: Apache-2.0 */
/* Services of nodes with a life cycle that the library answers by itself. Internal. */
#ifndef MICROROS_RCL_LIFECYCLE_ANSWER_H
#define MICROROS_RCL_LIFECYCLE_ANSWER_H

#include "rcl_lifecycle/data_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Begin and end to answer the requests of a state machine, whose services are open. */
void rcl_lifecycle_answer_for(rcl_lifecycle_state_machine_t * state_machine);
void rcl_lifecycle_answer_no_longer(const rcl_lifecycle_state_machine_t * state_machine);

/* Called when a waiting function has received. */
void rcl_lifecycle_answer(void);

/* Called before a node is closed: its state machine is forgotten. */
void rcl_lifecycle_leave(const rcl_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_ANSWER_H */
