/* SPDX-License-Identifier: Apache-2.0 */
/* No topic leads to another image of the chip. Internal. */
#ifndef MICROROS_RMW_LOCAL_SHARED_H
#define MICROROS_RMW_LOCAL_SHARED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

static inline bool rmw_shared_has_ring(const xrce_endpoint_t * endpoint)
{
  (void)endpoint;
  return false;
}

static inline void rmw_shared_opened(const xrce_endpoint_t * endpoint)
{
  (void)endpoint;
}

static inline rmw_ret_t rmw_shared_publish(const xrce_endpoint_t * writer, const void * message)
{
  (void)writer;
  (void)message;
  return RMW_RET_ERROR;
}

static inline rmw_ret_t rmw_shared_publish_body(
  const xrce_endpoint_t * writer, const uint8_t * body, size_t size)
{
  (void)writer;
  (void)body;
  (void)size;
  return RMW_RET_ERROR;
}

static inline bool rmw_shared_is_wrong(const xrce_endpoint_t * reader)
{
  (void)reader;
  return false;
}

static inline rmw_ret_t rmw_shared_report(const xrce_endpoint_t * reader)
{
  (void)reader;
  return RMW_RET_OK;
}

#endif /* MICROROS_RMW_LOCAL_SHARED_H */
