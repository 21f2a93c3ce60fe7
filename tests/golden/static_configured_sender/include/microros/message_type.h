/* SPDX-License-Identifier: Apache-2.0 */
/* What a message type gives the runtime: its name on the wire, its largest size, its encoder and decoder. */
#ifndef MICROROS_MESSAGE_TYPE_H
#define MICROROS_MESSAGE_TYPE_H

#include <stdbool.h>
#include <stdint.h>

typedef enum cdr_fault_kind_t {
  CDR_FAULT_LIMIT, /* more bytes of a string, or elements of a sequence, than fit */
  CDR_FAULT_END,   /* the body ends before the member does: `found` bytes needed, `fits` left */
  CDR_FAULT_VALUE  /* a value that the type does not have: `found`, and `fits` is the largest */
} cdr_fault_kind_t;

/* Why a message was refused. */
typedef struct cdr_fault_t {
  const char * field; /* name of the member, static */
  uint32_t found;     /* what it has: bytes of a string, elements of a sequence */
  uint32_t fits;      /* what its limit is, in the same unit */
  cdr_fault_kind_t kind;
} cdr_fault_t;

/*
 * One message type. Sizes are bytes of the CDR body (XCDR1, no encapsulation header), whose first byte is the
 * origin of alignment. The functions keep nothing, and may run at the same time for different messages.
 */
typedef struct microros_message_type_t {
  const char * dds_type_name; /* "std_msgs::msg::dds_::Int32_" */
  uint32_t max_encoded_size;  /* largest body under the limits */
  /* Writes the body, returns its length, never 0; 0: refused, *fault is filled. `body` holds encoded_size
   * bytes. */
  uint32_t (*encode)(const void * message, uint8_t * body, cdr_fault_t * fault);
  /* Returns the exact length of the body; 0: refused, *fault is filled. */
  uint32_t (*encoded_size)(const void * message, cdr_fault_t * fault);
  /* Reads `size` bytes, `swap` where they are big endian on a little endian target or the reverse, into the
   * storage that the message has. False: refused, *fault is filled, the contents of the message are unspecified
   * (sizes stay within capacities). NULL for a type that is only sent. */
  bool (*decode)(const uint8_t * body, uint32_t size, bool swap, void * message, cdr_fault_t * fault);
} microros_message_type_t;

#endif /* MICROROS_MESSAGE_TYPE_H */
