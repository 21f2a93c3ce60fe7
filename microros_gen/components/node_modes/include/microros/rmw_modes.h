/* SPDX-License-Identifier: Apache-2.0 */
/* The mode of each node as the client stores it. Internal. */
#ifndef MICROROS_RMW_MODES_H
#define MICROROS_RMW_MODES_H

#include <stdint.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Return and set the mode of a node that is open, as its position. It survives a sleep with the session. */
uint8_t rmw_modes_get(const rmw_node_t * node);
void rmw_modes_set(const rmw_node_t * node, uint8_t mode);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MODES_H */
