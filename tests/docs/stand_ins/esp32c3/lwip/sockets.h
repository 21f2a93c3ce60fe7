/* SPDX-License-Identifier: Apache-2.0 */
/* Sockets as lwIP has them: on a computer those of POSIX, for another compiler their declarations. */
#ifndef STAND_IN_LWIP_SOCKETS_H
#define STAND_IN_LWIP_SOCKETS_H

#ifdef __linux__
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/uio.h>
#else
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#define AF_INET 2
#define SOCK_DGRAM 2
#define MSG_TRUNC 0x04

typedef uint32_t socklen_t;

struct in_addr {
  uint32_t s_addr;
};

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

struct iovec {
  void * iov_base;
  size_t iov_len;
};

struct msghdr {
  void * msg_name;
  socklen_t msg_namelen;
  struct iovec * msg_iov;
  int msg_iovlen;
  void * msg_control;
  socklen_t msg_controllen;
  int msg_flags;
};

int socket(int domain, int type, int protocol);
int connect(int s, const struct sockaddr * name, socklen_t namelen);
ssize_t send(int s, const void * data, size_t size, int flags);
ssize_t recvmsg(int s, struct msghdr * message, int flags);
uint16_t htons(uint16_t x);
int inet_pton(int af, const char * src, void * dst);
#endif

#endif /* STAND_IN_LWIP_SOCKETS_H */
