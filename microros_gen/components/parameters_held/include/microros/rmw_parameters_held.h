/* SPDX-License-Identifier: Apache-2.0 */
/* Members of a notice that describe the client. Internal. */
#ifndef MICROROS_RMW_PARAMETERS_HELD_H
#define MICROROS_RMW_PARAMETERS_HELD_H

#include <stdint.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the client key of an open publisher. */
uint32_t rmw_parameters_board(const rmw_publisher_t * publisher);

/* Returns how many sessions were opened after a loss; a restarted agent has no earlier notices. */
uint32_t rmw_parameters_reconnects(const rmw_publisher_t * publisher);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PARAMETERS_HELD_H */
