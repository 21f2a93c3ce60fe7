/* SPDX-License-Identifier: Apache-2.0 */
/* CAN FD: what the transport needs from the port. */
#ifndef MICROROS_PORT_CAN_H
#define MICROROS_PORT_CAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PORT_CAN_DATA = 64 }; /* bytes of data in the longest frame of CAN FD */

/* One controller. `handle` is that of port_wait, -1 for none; it belongs to the port, the library only copies it. On a host,
 * where a device can be removed, send and receive set it to -2 when the device is gone: the library opens a link again. */
typedef struct port_can_t {
  intptr_t handle;
  uint32_t id; /* extended identifier of the frames that are sent, and of those from an agent, 29 bits */
  uint32_t received; /* extended identifier of the frames that are received; the library does not read it */
} port_can_t;

/*
 * Opens a controller for CAN FD. `device` is its name; it is not read after the call. From then on, data
 * frames with the extended identifier `id` are received, and no others. Returns false if there is no such
 * controller. Does not block. */
bool port_can_open(port_can_t * can, const char * device, uint32_t id);

/*
 * Same, for a link with another board, which sends with another identifier. It is called once for each link, with the
 * same device where several boards are on one bus: each link receives the frames with `received`, and no others. Only
 * images with links over CAN FD need it. */
bool port_can_open_link(port_can_t * can, const char * device, uint32_t sent, uint32_t received);

void port_can_close(port_can_t * can);

/*
 * Queues one CAN FD frame with the identifier without blocking; `size` is a length of CAN FD: 1 to 8, 12, 16, 20, 24,
 * 32, 48 or 64. Frames are sent in the order of the calls. Returns false if there is no room: nothing of it is
 * sent then. */
bool port_can_send(port_can_t * can, const uint8_t * data, size_t size);

/*
 * Takes the oldest received frame without blocking; `data` has room for PORT_CAN_DATA bytes. Returns how many it has,
 * 0 if none has arrived. The port keeps at least as many frames as arrive between two calls. */
size_t port_can_receive(port_can_t * can, uint8_t * data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_CAN_H */
