/* SPDX-License-Identifier: Apache-2.0 */
/* What the parts of the client program share. */
#ifndef CLIENT_H
#define CLIENT_H

#include <rcl/publisher.h>

extern rcl_publisher_t publishers[];

#endif /* CLIENT_H */
