/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_FREERTOS_SOCKETS_H
#define STAND_IN_FREERTOS_SOCKETS_H

#include "FreeRTOS_IP.h"

#include <stddef.h>

#define FREERTOS_AF_INET 2
#define FREERTOS_SOCK_DGRAM 2
#define FREERTOS_SOCK_STREAM 1
#define FREERTOS_IPPROTO_UDP 17
#define FREERTOS_IPPROTO_TCP 6
#define FREERTOS_SO_RCVTIMEO 0
#define FREERTOS_SO_SNDTIMEO 1
#define FREERTOS_SO_WAKEUP_CALLBACK 17
#define FREERTOS_ZERO_COPY 1
#define FREERTOS_INVALID_SOCKET ((Socket_t)~(uintptr_t)0)

typedef struct xSOCKET * Socket_t;
typedef const struct xSOCKET * ConstSocket_t;
typedef uint32_t socklen_t;

struct freertos_sockaddr {
  uint8_t sin_len;
  uint8_t sin_family;
  uint16_t sin_port;
  uint32_t sin_flowinfo;
  union {
    uint32_t ulIP_IPv4;
    uint8_t ipv6[16];
  } sin_address;
};

uint16_t kernel_swap(uint16_t value);

#define FreeRTOS_htons(value) kernel_swap(value)
#define FreeRTOS_ntohs(value) kernel_swap(value)

Socket_t FreeRTOS_socket(BaseType_t domain, BaseType_t type, BaseType_t protocol);
BaseType_t FreeRTOS_bind(Socket_t socket, const struct freertos_sockaddr * address, socklen_t size);
BaseType_t FreeRTOS_connect(Socket_t socket, const struct freertos_sockaddr * address, socklen_t size);
BaseType_t FreeRTOS_setsockopt(Socket_t socket, int32_t level, int32_t name, const void * value, size_t size);
BaseType_t FreeRTOS_closesocket(Socket_t socket);
int32_t FreeRTOS_sendto(
  Socket_t socket, const void * bytes, size_t size, BaseType_t flags, const struct freertos_sockaddr * to,
  socklen_t to_size);
int32_t FreeRTOS_recvfrom(
  ConstSocket_t socket, void * bytes, size_t size, BaseType_t flags, struct freertos_sockaddr * from,
  socklen_t * from_size);
size_t FreeRTOS_GetLocalAddress(ConstSocket_t socket, struct freertos_sockaddr * address);
BaseType_t FreeRTOS_send(Socket_t socket, const void * bytes, size_t size, BaseType_t flags);
BaseType_t FreeRTOS_recv(Socket_t socket, void * bytes, size_t size, BaseType_t flags);
BaseType_t FreeRTOS_maywrite(ConstSocket_t socket);
BaseType_t FreeRTOS_inet_pton(BaseType_t family, const char * text, void * address);

#endif /* STAND_IN_FREERTOS_SOCKETS_H */
