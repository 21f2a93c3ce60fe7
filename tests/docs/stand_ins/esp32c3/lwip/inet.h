/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_LWIP_INET_H
#define STAND_IN_LWIP_INET_H

#include "lwip/sockets.h"

#endif /* STAND_IN_LWIP_INET_H */
