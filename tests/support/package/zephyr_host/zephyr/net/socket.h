/* SPDX-License-Identifier: Apache-2.0 */
/* Zephyr's sockets are those of this computer. */
#ifndef HOST_ZEPHYR_SOCKET_H
#define HOST_ZEPHYR_SOCKET_H

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#define CONFIG_NET_UDP 1
#define CONFIG_NET_SOCKETS 1
#define ZSOCK_POLLIN POLLIN
#define ZSOCK_MSG_DONTWAIT MSG_DONTWAIT
#define zsock_pollfd pollfd
#define zsock_socket socket
#define zsock_close close
#define zsock_connect connect
#define zsock_send send
#define zsock_recv recv
#define zsock_poll poll
#define zsock_inet_pton inet_pton

#endif /* HOST_ZEPHYR_SOCKET_H */
