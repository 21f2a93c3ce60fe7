/* SPDX-License-Identifier: Apache-2.0 */
/* Forward declaration of the client (xrce_client.h) for headers that only use pointers to it. */
#ifndef MICROROS_XRCE_FORWARD_H
#define MICROROS_XRCE_FORWARD_H

typedef struct xrce_client_t xrce_client_t;

#endif /* MICROROS_XRCE_FORWARD_H */
