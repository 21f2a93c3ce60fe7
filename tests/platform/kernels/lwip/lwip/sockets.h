/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of lwIP's sockets that the package `stm32cube` calls. */
#ifndef LWIP_SOCKETS_H
#define LWIP_SOCKETS_H

#include "lwip/inet.h"

#include <stddef.h>
#include <stdint.h>
#include <sys/time.h>
#include <sys/types.h>

#define AF_INET 2
#define SOCK_DGRAM 2
#define SOL_SOCKET 0xfff
#define SO_RCVTIMEO 0x1006
#define MSG_DONTWAIT 0x08

typedef uint32_t socklen_t;
struct sockaddr {
  uint8_t sa_len;
  uint8_t sa_family;
  char sa_data[14];
};
struct sockaddr_in {
  uint8_t sin_len;
  uint8_t sin_family;
  uint16_t sin_port;
  struct in_addr sin_addr;
  char sin_zero[8];
};

int lwip_socket(int domain, int type, int protocol);
int lwip_connect(int socket, const struct sockaddr * name, socklen_t size);
int lwip_close(int socket);
ssize_t lwip_send(int socket, const void * data, size_t size, int flags);
ssize_t lwip_recv(int socket, void * data, size_t size, int flags);
int lwip_setsockopt(int socket, int level, int name, const void * value, socklen_t size);

#endif /* LWIP_SOCKETS_H */
