/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the sources of this port. Internal. lwIP's netconn API: what arrives wakes port_wait, without a descriptor. */
#ifndef MICROROS_PORT_LWIP_H
#define MICROROS_PORT_LWIP_H

#include "lwip/api.h"
#include "lwip/opt.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if !LWIP_NETCONN
#error "lwipopts.h: set NO_SYS to 0 and LWIP_NETCONN to 1"
#endif

/* Makes a connection of `type`, NETCONN_UDP or NETCONN_TCP, that never waits; for an IPv6 address the type for IPv6.
 * Returns NULL without a free one (MEMP_NUM_NETCONN). */
struct netconn * port_lwip_open(enum netconn_type type, const ip_addr_t * peer);

/* Makes an UDP connection to one peer; `local` 0: any port. Returns NULL for an invalid address or without a free one. */
struct netconn * port_lwip_udp(const char * host, uint16_t port, uint16_t local);

/* Removes it; NULL: nothing. */
void port_lwip_close(struct netconn * connection);

/* Puts bytes, which stay as they are until it was sent, into a buffer of lwIP, which the caller deletes. Returns NULL
 * without a free one (MEMP_NUM_NETBUF). */
struct netbuf * port_lwip_datagram(const uint8_t * data, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_LWIP_H */
