/* SPDX-License-Identifier: Apache-2.0 */
/* Variant: records arrive as a whole. Internal. */
#ifndef MICROROS_XRCE_SEAL_INPUT_H
#define MICROROS_XRCE_SEAL_INPUT_H

#include "microros/xrce_transport.h"

/* Returns XRCE_SEAL_RECORD bytes or more, in which a record is received. */
static inline uint8_t * xrce_seal_input(xrce_transport_t * transport)
{
  (void)transport;
  return xrce_seal_record;
}

#endif /* MICROROS_XRCE_SEAL_INPUT_H */
