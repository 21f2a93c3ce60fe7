/* SPDX-License-Identifier: Apache-2.0 */
/* Opening a session; internal. */
#ifndef MICROROS_RMW_OPEN_H
#define MICROROS_RMW_OPEN_H

#include "rmw/init.h"

#ifdef __cplusplus
extern "C" {
#endif

/* rmw_init without options: everything as planned. `context` is not NULL. */
rmw_ret_t rmw_open_as_planned(rmw_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_OPEN_H */
