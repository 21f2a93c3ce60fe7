/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of lwIP that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_LWIP_OPT_H
#define STAND_IN_LWIP_OPT_H

#define LWIP_NETCONN 1
#define LWIP_SO_RCVTIMEO 1
#ifndef LWIP_IPV6
#define LWIP_IPV6 1
#endif
#ifndef LWIP_NETIF_TX_SINGLE_PBUF
#define LWIP_NETIF_TX_SINGLE_PBUF 0
#endif

#endif /* STAND_IN_LWIP_OPT_H */
