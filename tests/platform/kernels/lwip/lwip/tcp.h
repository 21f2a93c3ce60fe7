/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_LWIP_TCP_H
#define STAND_IN_LWIP_TCP_H

#include "lwip/api.h"

void tcp_nagle_disable(struct tcp_pcb * pcb);

#endif /* STAND_IN_LWIP_TCP_H */
