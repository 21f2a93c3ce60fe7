/* SPDX-License-Identifier: Apache-2.0 */
/* No service leads to another image of the chip. Internal. */
#ifndef MICROROS_RMW_SHARED_CALL_H
#define MICROROS_RMW_SHARED_CALL_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_local.h"
#include "microros/rmw_local_service.h"
#include "microros/rmw_local_shared.h"
#include "rmw/ret_types.h"

struct rmw_shared_ring_t;

static inline uint32_t rmw_shared_call_words(const struct rmw_shared_ring_t * ring)
{
  (void)ring;
  return 0;
}

static inline bool rmw_shared_call_is_wanted(const struct rmw_shared_ring_t * ring, const uint32_t * slot)
{
  (void)ring;
  (void)slot;
  return true;
}

static inline void rmw_shared_call_note(
  const struct rmw_shared_ring_t * ring, const uint32_t * slot, const rmw_local_queue_t * queue,
  uint8_t place)
{
  (void)ring;
  (void)slot;
  (void)queue;
  (void)place;
}

static inline void rmw_shared_call_opened(const xrce_endpoint_t * endpoint)
{
  (void)endpoint;
}

static inline bool rmw_shared_call_is_open(const xrce_endpoint_t * client)
{
  (void)client;
  return false;
}

static inline rmw_ret_t rmw_shared_call_request(
  const xrce_endpoint_t * client, const microros_message_type_t * sent, const rmw_local_number_t * number,
  const void * message)
{
  (void)client;
  (void)sent;
  (void)number;
  (void)message;
  return RMW_RET_ERROR;
}

static inline rmw_ret_t rmw_shared_call_reply(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const rmw_local_origin_t * origin,
  const void * message)
{
  (void)service;
  (void)sent;
  (void)origin;
  (void)message;
  return RMW_RET_ERROR;
}

#endif /* MICROROS_RMW_SHARED_CALL_H */
