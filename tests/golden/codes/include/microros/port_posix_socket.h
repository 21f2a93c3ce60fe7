/* SPDX-License-Identifier: Apache-2.0 */
/* What the sockets of this port share; internal to it. */
#ifndef MICROROS_PORT_POSIX_SOCKET_H
#define MICROROS_PORT_POSIX_SOCKET_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Opens a socket of this kind (SOCK_DGRAM, SOCK_STREAM) that does not block, and connects it, or begins to. `host` is an
 * IPv4 or IPv6 address in digits, without a zone; `local` is the port of this side, 0 for any. Returns its descriptor, or
 * -1.
 */
int port_posix_socket_connect(const char * host, uint16_t port, int kind, uint16_t local);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_POSIX_SOCKET_H */
