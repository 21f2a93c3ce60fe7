/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_ring.h"

#include "microros/port_bare.h"
#include "microros/port_board.h"

/* The size is a power of two, so that positions may run on and wrap: their difference is what the ring holds. The interrupt
 * alone writes `put` and `lost`, the task alone `taken`. */
static struct {
  volatile uint16_t put;
  volatile uint16_t taken;
  volatile uint32_t lost;
  volatile uint8_t bytes[PORT_BOARD_RING_SIZE];
} port_ring;

void port_ring_put(uint8_t byte)
{
  const uint16_t put = port_ring.put;

  if ((uint16_t)(put - port_ring.taken) == PORT_BOARD_RING_SIZE) {
    port_ring_count_loss();
    return;
  }
  port_ring.bytes[put % PORT_BOARD_RING_SIZE] = byte;
  port_ring.put = (uint16_t)(put + 1u);
}

void port_ring_count_loss(void)
{
  port_ring.lost = port_ring.lost + 1u;
}

size_t port_ring_take(uint8_t * buffer, size_t capacity)
{
  uint16_t taken = port_ring.taken;
  size_t count = 0;

  while (count < capacity && taken != port_ring.put) {
    buffer[count] = port_ring.bytes[taken % PORT_BOARD_RING_SIZE];
    taken = (uint16_t)(taken + 1u);
    ++count;
  }
  port_ring.taken = taken;
  return count;
}

uint32_t port_bare_serial_lost(void)
{
  return port_ring.lost;
}
