/* SPDX-License-Identifier: Apache-2.0 */
/* With the bytes of a record. Replaces the header of `session`. Internal. */
#ifndef MICROROS_XRCE_LARGEST_SENT_H
#define MICROROS_XRCE_LARGEST_SENT_H

#include "microros_config.h"

#include "microros/xrce_messages.h"

/* Bytes of the largest message that the transport itself sends. */
#define XRCE_LARGEST_SENT \
  (MICROROS_MTU + XRCE_SEAL_OVERHEAD > XRCE_SEAL_FIRST ? MICROROS_MTU + XRCE_SEAL_OVERHEAD : XRCE_SEAL_FIRST)

#endif /* MICROROS_XRCE_LARGEST_SENT_H */
