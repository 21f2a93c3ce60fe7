/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the sockets of this port. Internal. */
#ifndef MICROROS_PORT_ZEPHYR_SOCKET_H
#define MICROROS_PORT_ZEPHYR_SOCKET_H

#include <stdint.h>
#include <zephyr/net/socket.h>

#ifdef __cplusplus
extern "C" {
#endif

#if !defined(CONFIG_NET_SOCKETS)
#error "prj.conf: set CONFIG_NET_SOCKETS=y"
#endif

/* An address of either family. */
typedef union port_zephyr_address_t {
  struct sockaddr any;
  struct sockaddr_in v4;
  struct sockaddr_in6 v6;
} port_zephyr_address_t;

/*
 * Opens a non-blocking socket of this kind (SOCK_DGRAM, SOCK_STREAM), and connects it or begins to. `host` is a numeric
 * IPv4 or IPv6 address; `local` is the local port, 0 for any. Returns the descriptor, or -1.
 */
int port_zephyr_socket_connect(const char * host, uint16_t port, int kind, uint16_t local);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_ZEPHYR_SOCKET_H */
