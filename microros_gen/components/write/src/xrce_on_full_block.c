/* SPDX-License-Identifier: Apache-2.0 */
/* on_full: block up to MICROROS_ON_FULL_BLOCK_MS, then refuse. */
#include "microros/port.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_rest.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_write.h"

xrce_write_t xrce_write_on_full(xrce_endpoint_t * writer, uint8_t ** room)
{
  const uint32_t start = port_time_ms();

  while (port_time_ms() - start < MICROROS_ON_FULL_BLOCK_MS) {
    xrce_rest(writer->client);
    xrce_session_pump(writer->client);
    *room = xrce_write_reserve(writer);
    if (*room != NULL) {
      return XRCE_WRITTEN;
    }
  }
  xrce_drops_add(writer->client, writer->index);
  return xrce_write_failure(writer);
}

/* The message occupies the stream, so the lock is held while the line makes room. */
xrce_write_t xrce_write_on_unsent(xrce_endpoint_t * writer, size_t size)
{
  const uint32_t start = port_time_ms();

  while (port_time_ms() - start < MICROROS_ON_FULL_BLOCK_MS) {
    port_sleep_ms(1);
    if (xrce_route_commit(writer->client, false, size)) {
      return XRCE_WRITTEN;
    }
  }
  xrce_drops_add(writer->client, writer->index);
  return XRCE_WRITE_NOT_SENT;
}
