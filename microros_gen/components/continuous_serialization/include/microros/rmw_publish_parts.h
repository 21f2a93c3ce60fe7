/* SPDX-License-Identifier: Apache-2.0 */
/* A publisher with callbacks publishes its messages in parts. Internal. */
#ifndef MICROROS_RMW_PUBLISH_PARTS_H
#define MICROROS_RMW_PUBLISH_PARTS_H

#include <stdbool.h>

#include "microros/xrce_objects.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether it has published the message itself, with *result as that of rmw_publish. */
bool rmw_publish_parts(const xrce_endpoint_t * writer, const void * ros_message, rmw_ret_t * result);

/* Called when a publisher has a new owner. */
void rmw_publish_parts_clear(const xrce_endpoint_t * writer);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PUBLISH_PARTS_H */
