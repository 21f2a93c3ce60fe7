/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of lwIP's addresses that the package `stm32cube` calls. */
#ifndef LWIP_INET_H
#define LWIP_INET_H

#include <stdint.h>

struct in_addr {
  uint32_t s_addr;
};

int inet_aton(const char * text, struct in_addr * address);
uint16_t lwip_htons(uint16_t value);

#endif /* LWIP_INET_H */
