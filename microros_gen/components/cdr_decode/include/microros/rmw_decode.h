/* SPDX-License-Identifier: Apache-2.0 */
/* Decodes the bytes of a body into a message and sets the error text. Internal to the middleware layer. */
#ifndef MICROROS_RMW_DECODE_H
#define MICROROS_RMW_DECODE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/message_type.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Decodes into the storage of the message. Returns RMW_RET_ERROR or RMW_RET_UNSUPPORTED, with a text, as
 * rmw_deserialize does. */
rmw_ret_t rmw_decode(
  const microros_message_type_t * type, const uint8_t * body, uint32_t size, bool big_endian, void * message);

/* Sets the text for a refused body; returns RMW_RET_ERROR. */
rmw_ret_t rmw_decode_refuse(const microros_message_type_t * type, const cdr_fault_t * fault);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_DECODE_H */
