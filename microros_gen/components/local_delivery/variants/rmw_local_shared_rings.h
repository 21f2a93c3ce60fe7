/* SPDX-License-Identifier: Apache-2.0 */
/* Topics and services that lead to another image of the chip. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_LOCAL_SHARED_H
#define MICROROS_RMW_LOCAL_SHARED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

bool rmw_shared_has_ring(const xrce_endpoint_t * endpoint);

/* Called when the application opens an endpoint that receives: it begins with the next message. */
void rmw_shared_opened(const xrce_endpoint_t * endpoint);

/*
 * Encode or copy a message into the ring of a publisher that has one. RMW_RET_ERROR, with a text: it is above its limits; the
 * platform has no shared memory; the other image was built for another type, size or depth; the publisher is reliable and
 * the ring is full. Best effort: a full ring drops the message, which is counted. Without another image it is dropped as without
 * a subscription. */
rmw_ret_t rmw_shared_publish(const xrce_endpoint_t * writer, const void * message);
rmw_ret_t rmw_shared_publish_body(const xrce_endpoint_t * writer, const uint8_t * body, size_t size);

/* Returns whether nothing can arrive for a subscription or service, which was not reported yet: there is no memory, or the other
 * image was built for other rings. */
bool rmw_shared_is_wrong(const xrce_endpoint_t * reader);

/* Reports that once: RMW_RET_ERROR with a text. */
rmw_ret_t rmw_shared_report(const xrce_endpoint_t * reader);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOCAL_SHARED_H */
