/* SPDX-License-Identifier: Apache-2.0 */
/* Message type as the runtime sees it: wire name, largest size, encoder and decoder. */
#ifndef MICROROS_MESSAGE_TYPE_H
#define MICROROS_MESSAGE_TYPE_H

#include "microros/flash.h"

#include <stdint.h>

struct cdr_in_t;

typedef enum cdr_fault_kind_t {
  CDR_FAULT_LIMIT,    /* above the limit of the application file: bytes of a string, elements of a sequence */
  CDR_FAULT_END,      /* the body ends inside the member: `found` bytes needed, `fits` left */
  CDR_FAULT_VALUE,    /* a value that the type does not have: `found`; `fits` is the largest */
  CDR_FAULT_BOUND,    /* above the bound of the interface file */
  CDR_FAULT_CAPACITY, /* above the capacity of the destination message */
  CDR_FAULT_DATA      /* a size, `found`, with NULL data */
} cdr_fault_kind_t;

/* No index: the nested message is not an element. Where a size has 16 bits, no array has so many elements either. */
#define CDR_NO_INDEX ((uint32_t)SIZE_MAX)

/*
 * Why a message was refused. If the member belongs to a nested message (`depth` above 0), `within` is the
 * outermost message's member that contains it, with the `index` of the element. Names in between, from
 * `depth` 2 on, are not stored.
 */
typedef struct cdr_fault_t {
  const char * field;  /* name of the member, static */
  const char * within; /* outermost enclosing member, static; NULL: the message itself */
  uint32_t found;      /* actual size: bytes of a string, elements of a sequence */
  uint32_t fits;       /* its limit, in the same unit */
  uint32_t index;      /* of the element of `within`, or CDR_NO_INDEX */
  cdr_fault_kind_t kind;
  uint8_t depth; /* number of messages around the one with the member */
} cdr_fault_t;

/*
 * One message type. Sizes are bytes of the CDR body (XCDR1, without encapsulation header), whose first
 * byte is the origin of alignment. The functions keep no state and may run concurrently for different
 * messages.
 */
typedef struct microros_message_type_t {
  const MICROROS_FLASH char * dds_type_name; /* "std_msgs::msg::dds_::Int32_" */
  uint32_t max_encoded_size;                 /* largest body within the limits */
  /* Writes the body and returns its length, never 0; 0 if refused, with *fault filled. `body` holds
   * encoded_size bytes. */
  uint32_t (*encode)(const void * message, uint8_t * body, cdr_fault_t * fault);
  /* Returns the exact length of the body; 0 if refused, with *fault filled. */
  uint32_t (*encoded_size)(const void * message, cdr_fault_t * fault);
  /* Reads the body into the storage of the message. NULL for a type that is only sent. Called by
   * cdr_decode (microros/cdr_decode.h), which returns whether it was read. */
  void (*decode)(struct cdr_in_t * in, void * message);
} microros_message_type_t;

#endif /* MICROROS_MESSAGE_TYPE_H */
