/* SPDX-License-Identifier: Apache-2.0 */
/* on_full: error. The message is refused at once. */
#include "microros/xrce_drops.h"
#include "microros/xrce_write.h"

xrce_write_t xrce_write_on_full(xrce_endpoint_t * writer, uint8_t ** room)
{
  (void)room;
  xrce_drops_add(writer->client, writer->index);
  return xrce_write_failure(writer);
}

xrce_write_t xrce_write_on_unsent(xrce_endpoint_t * writer, size_t size)
{
  (void)size;
  xrce_drops_add(writer->client, writer->index);
  return XRCE_WRITE_NOT_SENT;
}
