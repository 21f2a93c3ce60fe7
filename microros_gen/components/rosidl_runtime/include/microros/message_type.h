/* SPDX-License-Identifier: Apache-2.0 */
/* What a message type gives the runtime: its name on the wire, its largest size, its encoder and decoder. */
#ifndef MICROROS_MESSAGE_TYPE_H
#define MICROROS_MESSAGE_TYPE_H

#include <stdint.h>

struct cdr_in_t;

typedef enum cdr_fault_kind_t {
  CDR_FAULT_LIMIT, /* more than the limit of the application file: bytes of a string, elements of a sequence */
  CDR_FAULT_END,   /* the body ends before the member does: `found` bytes needed, `fits` left */
  CDR_FAULT_VALUE,    /* a value that the type does not have: `found`, and `fits` is the largest */
  CDR_FAULT_BOUND,    /* more than the bound of the interface file */
  CDR_FAULT_CAPACITY, /* more than the capacity of the message that is read into */
  CDR_FAULT_DATA      /* a size, `found`, and NULL for data */
} cdr_fault_kind_t;

/* No index: the nested message is no element. */
#define CDR_NO_INDEX UINT32_MAX

/*
 * Why a message was refused. Where the member is not one of the message itself but of a nested one (`depth` above 0),
 * `within` is the message's own member that holds it, with the `index` of the element. Names between the two, from
 * `depth` 2 on, are not kept.
 */
typedef struct cdr_fault_t {
  const char * field;  /* name of the member, static */
  const char * within; /* name of the outermost member around it, static; NULL: it is the message's own */
  uint32_t found;      /* what it has: bytes of a string, elements of a sequence */
  uint32_t fits;       /* what its limit is, in the same unit */
  uint32_t index;      /* of the element of `within`, or CDR_NO_INDEX */
  cdr_fault_kind_t kind;
  uint8_t depth; /* how many messages are around the one with the member */
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
  /* Reads the body into the storage that the message has. NULL for a type that is only sent. Called by cdr_decode
   * (microros/cdr_decode.h), which says whether it was read. */
  void (*decode)(struct cdr_in_t * in, void * message);
} microros_message_type_t;

#endif /* MICROROS_MESSAGE_TYPE_H */
