/* SPDX-License-Identifier: Apache-2.0 */
/* What both sides of the comparison share (codec.py): the messages, and how their calls are timed and counted. */
#ifndef CODEC_H
#define CODEC_H

#include <stdbool.h>
#include <stdint.h>

#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Bytes of the buffer that both sides encode to. */
#define CODEC_BUFFER_SIZE 131072u

/** One message: what is encoded, and a second one that is decoded into. */
typedef struct codec_case_t {
  const char * name;
  const rosidl_message_type_support_t * handle;
  const void * message;
  void * target;
} codec_case_t;

/** The buffer; zero at first, so that padding which one side leaves as it is compares as zero. */
extern uint8_t codec_buffer[CODEC_BUFFER_SIZE];

/** Return the case of that name with its messages filled, or NULL. The side's headers decide the type support. */
const codec_case_t * codec_case(const char * name);

/** The calls that are timed and counted, one implementation a side. Encode returns the bytes of the body; 0: refused. */
uint32_t codec_encode(const rosidl_message_type_support_t * handle, const void * message);
bool codec_decode(const rosidl_message_type_support_t * handle, uint32_t size, void * message);

/**
 * The same where the side's stream object exists already and is set back to its start: a lower bound of that side's
 * work. The side without such an object does what codec_encode and codec_decode do.
 */
uint32_t codec_encode_again(const rosidl_message_type_support_t * handle, const void * message);
bool codec_decode_again(const rosidl_message_type_support_t * handle, uint32_t size, void * message);

/** One memcpy of the body, the limit of both; true. */
bool codec_copy(uint32_t size);

#ifdef __cplusplus
}
#endif

#endif /* CODEC_H */
