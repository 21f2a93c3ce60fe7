/* SPDX-License-Identifier: Apache-2.0 */
/* The byte stream below the frames of a custom transport. */
#include "microros/xrce_custom_read.h"
#include "microros/xrce_transport.h"

#include <string.h>

size_t xrce_line_room(struct xrce_transport_t * line)
{
  (void)line;
  return SIZE_MAX; /* unknown until the write function is called */
}

bool xrce_line_write(struct xrce_transport_t * line, const uint8_t * data, size_t size)
{
  uint8_t error = 0;

  while (size != 0u) {
    const size_t taken = line->custom.write(&line->custom, data, size, &error);

    if (taken == 0u || taken > size) {
      return false;
    }
    data += taken;
    size -= taken;
  }
  return true;
}

size_t xrce_line_read(struct xrce_transport_t * line, uint8_t * buffer, size_t capacity)
{
  return xrce_custom_read(line, buffer, capacity, 0);
}

bool xrce_plain_open(xrce_transport_t * transport)
{
  (void)memset(&transport->framing, 0, sizeof(transport->framing));
  return transport->custom.open(&transport->custom);
}
