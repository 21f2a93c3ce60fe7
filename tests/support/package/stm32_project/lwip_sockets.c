/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of lwIP's sockets over those of this computer; constants and addresses have lwIP's form. */
#define _DEFAULT_SOURCE
#include <arpa/inet.h>
#include <stdint.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#define LWIP_AF_INET 2
#define LWIP_SOCK_DGRAM 2
#define LWIP_SOL_SOCKET 0xfff
#define LWIP_SO_RCVTIMEO 0x1006
#define LWIP_MSG_DONTWAIT 0x08

void hal_begin(void)
{
}

uint16_t lwip_htons(uint16_t value)
{
  return htons(value);
}

int lwip_socket(int domain, int type, int protocol)
{
  return domain == LWIP_AF_INET && type == LWIP_SOCK_DGRAM ? socket(AF_INET, SOCK_DGRAM, protocol) : -1;
}

/* Length, family, port and address, of 1, 1, 2 and 4 bytes. */
int lwip_connect(int handle, const void * name, uint32_t size)
{
  struct sockaddr_in address;
  const uint8_t * bytes = name;

  if (size != 16u || bytes[1] != LWIP_AF_INET) {
    return -1;
  }
  (void)memset(&address, 0, sizeof(address));
  address.sin_family = AF_INET;
  (void)memcpy(&address.sin_port, &bytes[2], sizeof(address.sin_port));
  (void)memcpy(&address.sin_addr, &bytes[4], sizeof(address.sin_addr));
  return connect(handle, (const struct sockaddr *)&address, sizeof(address));
}

int lwip_close(int handle)
{
  return close(handle);
}

ssize_t lwip_send(int handle, const void * data, size_t size, int flags)
{
  return flags == 0 ? send(handle, data, size, 0) : -1;
}

ssize_t lwip_recv(int handle, void * data, size_t size, int flags)
{
  return recv(handle, data, size, flags == LWIP_MSG_DONTWAIT ? MSG_DONTWAIT : 0);
}

int lwip_setsockopt(int handle, int level, int name, const void * value, uint32_t size)
{
  if (level != LWIP_SOL_SOCKET || name != LWIP_SO_RCVTIMEO || size != sizeof(struct timeval)) {
    return -1;
  }
  return setsockopt(handle, SOL_SOCKET, SO_RCVTIMEO, value, (socklen_t)size);
}
