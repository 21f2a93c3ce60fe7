/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the sockets of this port. Internal. */
#ifndef MICROROS_PORT_POSIX_SOCKET_H
#define MICROROS_PORT_POSIX_SOCKET_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Opens a non-blocking socket of this kind (SOCK_DGRAM, SOCK_STREAM), and connects it or begins to. `host` is a numeric
 * IPv4 or IPv6 address without a zone; `local` is the local port, 0 for any. Returns the descriptor, or -1.
 */
int port_posix_socket_connect(const char * host, uint16_t port, int kind, uint16_t local);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_POSIX_SOCKET_H */
