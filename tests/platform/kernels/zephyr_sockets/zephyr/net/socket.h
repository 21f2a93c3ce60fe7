/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of Zephyr's sockets that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_ZEPHYR_SOCKET_H
#define STAND_IN_ZEPHYR_SOCKET_H

#include "zephyr/kernel.h"

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#define AF_INET 1
#define AF_INET6 2
#define SOCK_STREAM 1
#define SOCK_DGRAM 2
#define IPPROTO_TCP 6
#define IPPROTO_UDP 17
#define TCP_NODELAY 1
#define SOL_SOCKET 1
#define SO_ERROR 4
#define ZSOCK_POLLIN 1
#define ZSOCK_POLLOUT 4
#define ZSOCK_MSG_TRUNC 0x20
#define ZSOCK_MSG_DONTWAIT 0x40
#define ZVFS_F_GETFL 3
#define ZVFS_F_SETFL 4
#define ZVFS_O_NONBLOCK 0x4000

typedef size_t socklen_t;
typedef unsigned short sa_family_t;

struct in_addr {
  uint8_t bytes[4];
};

struct in6_addr {
  uint8_t bytes[16];
};

struct sockaddr {
  sa_family_t sa_family;
  char data[22];
};

struct sockaddr_in {
  sa_family_t sin_family;
  uint16_t sin_port;
  struct in_addr sin_addr;
};

struct sockaddr_in6 {
  sa_family_t sin6_family;
  uint16_t sin6_port;
  struct in6_addr sin6_addr;
  uint8_t sin6_scope_id;
};

struct zsock_pollfd {
  int fd;
  short events;
  short revents;
};

uint16_t htons(uint16_t value);
uint16_t ntohs(uint16_t value);
int zsock_socket(int family, int type, int proto);
int zsock_close(int sock);
int zsock_bind(int sock, const struct sockaddr * address, socklen_t size);
int zsock_connect(int sock, const struct sockaddr * address, socklen_t size);
ssize_t zsock_send(int sock, const void * bytes, size_t size, int flags);
ssize_t zsock_sendto(
  int sock, const void * bytes, size_t size, int flags, const struct sockaddr * to, socklen_t to_size);
ssize_t zsock_recv(int sock, void * bytes, size_t size, int flags);
ssize_t zsock_recvfrom(
  int sock, void * bytes, size_t size, int flags, struct sockaddr * from, socklen_t * from_size);
int zsock_fcntl(int sock, int command, int flags);
int zsock_poll(struct zsock_pollfd * descriptors, int count, int timeout);
int zsock_getsockopt(int sock, int level, int name, void * value, socklen_t * size);
int zsock_setsockopt(int sock, int level, int name, const void * value, socklen_t size);
int zsock_getsockname(int sock, struct sockaddr * address, socklen_t * size);
int zsock_inet_pton(sa_family_t family, const char * text, void * address);

#endif /* STAND_IN_ZEPHYR_SOCKET_H */
