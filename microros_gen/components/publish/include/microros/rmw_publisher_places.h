/* SPDX-License-Identifier: Apache-2.0 */
/* The handles of publishers by place. For this component and `by_place` only. */
#ifndef MICROROS_RMW_PUBLISHER_PLACES_H
#define MICROROS_RMW_PUBLISHER_PLACES_H

#include "microros/rmw_client.h"
#include "microros/xrce_objects.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern rmw_publisher_t rmw_publishers[MICROROS_PUBLISHERS_MAX];

/* Returns the handle of an open place. */
static inline rmw_publisher_t * rmw_publisher_prepare(xrce_endpoint_t * writer)
{
  rmw_publisher_t * publisher = &rmw_publishers[writer->index];

  publisher->implementation_identifier = rmw_implementation_identifier;
  publisher->data = writer;
  publisher->topic_name = writer->name;
  return publisher;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PUBLISHER_PLACES_H */
