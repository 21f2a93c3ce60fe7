/* SPDX-License-Identifier: Apache-2.0 */
/* Apart from xrce_messages.h, so that few objects depend on the MTU. The component `seal` replaces this header. Internal. */
#ifndef MICROROS_XRCE_LARGEST_SENT_H
#define MICROROS_XRCE_LARGEST_SENT_H

#include "microros_config.h"

/* Bytes of the largest message that the transport itself sends. */
#define XRCE_LARGEST_SENT MICROROS_MTU

#endif /* MICROROS_XRCE_LARGEST_SENT_H */
