/* SPDX-License-Identifier: Apache-2.0 */
/* The client (xrce_client.h), for headers that only point to it. */
#ifndef MICROROS_XRCE_FORWARD_H
#define MICROROS_XRCE_FORWARD_H

typedef struct xrce_client_t xrce_client_t;

#endif /* MICROROS_XRCE_FORWARD_H */
