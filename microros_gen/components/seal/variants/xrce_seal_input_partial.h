/* SPDX-License-Identifier: Apache-2.0 */
/* Variant: a part of a record waits for its rest while others are sent. Internal. */
#ifndef MICROROS_XRCE_SEAL_INPUT_H
#define MICROROS_XRCE_SEAL_INPUT_H

#include "microros/xrce_transport.h"

/* Returns XRCE_SEAL_RECORD bytes, in which a record is received; they belong to the transport. */
static inline uint8_t * xrce_seal_input(xrce_transport_t * transport)
{
  return transport->record;
}

#endif /* MICROROS_XRCE_SEAL_INPUT_H */
