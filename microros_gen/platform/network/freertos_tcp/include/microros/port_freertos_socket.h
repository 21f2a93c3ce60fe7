/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shared by the sockets of this port. Internal. FreeRTOS+TCP 4.0 or newer, which takes the memory of its sockets from the
 * kernel's heap: nothing of this port does. Its task calls port_wake when something has arrived.
 */
#ifndef MICROROS_PORT_FREERTOS_SOCKET_H
#define MICROROS_PORT_FREERTOS_SOCKET_H

#include "FreeRTOS.h"

#include "FreeRTOS_IP.h"
#include "FreeRTOS_Sockets.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if !defined(ipconfigSOCKET_HAS_USER_WAKE_CALLBACK) || ipconfigSOCKET_HAS_USER_WAKE_CALLBACK != 1
#error "FreeRTOSIPConfig.h: set ipconfigSOCKET_HAS_USER_WAKE_CALLBACK to 1"
#endif

/* Reads a numeric IPv4 address. Returns false if it is none. */
bool port_freertos_address(struct freertos_sockaddr * address, const char * host, uint16_t port);

/* Makes a socket that never waits, bound to the port `local`; 0: the library selects one. Returns FREERTOS_INVALID_SOCKET
 * without a network or without memory. */
Socket_t port_freertos_socket(BaseType_t type, BaseType_t protocol, uint16_t local);

/* Receives a datagram. Returns its length, 0 if none has arrived, -1 if it did not fit into `capacity`: then the part that
 * fits is in `buffer`. */
int32_t port_freertos_receive(Socket_t socket, struct freertos_sockaddr * from, uint8_t * buffer, size_t capacity);

/* Returns the socket of a handle, and back: 0 has none. */
Socket_t port_freertos_socket_of(intptr_t handle);
intptr_t port_freertos_handle_of(Socket_t socket);

/* Opens a socket that exchanges datagrams with one peer. Returns its handle; 0 as above, or for an invalid address. */
intptr_t port_freertos_udp(const char * host, uint16_t port, uint16_t local);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_FREERTOS_SOCKET_H */
