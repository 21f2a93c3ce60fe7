/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of a parameter client and their messages. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_CLIENT_INTERNAL_H
#define MICROROS_RCLC_PARAMETER_CLIENT_INTERNAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/cdr_decode.h"
#include "rclc_parameter/parameter_client.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A remote node of the application file: its fully qualified name, the index of the local node with the client, and the
 * operations, one bit for each call. */
typedef struct rclc_parameter_client_remote_t {
  const char * name;
  uint16_t node;
  uint8_t calls;
} rclc_parameter_client_remote_t;

/* --- rclc_parameter_client_remotes.c --- */

extern const rclc_parameter_client_remote_t rclc_parameter_client_remotes[MICROROS_PARAMETER_CLIENTS];

/* --- rclc_parameter_client.c --- */

/* Returns the first open client; the lock is held. */
rclc_parameter_client_t * rclc_parameter_client_first(void);

/* Returns `result` with a text about the client's node. */
rcl_ret_t rclc_parameter_client_refuse(
  const rclc_parameter_client_t * client, rcl_ret_t result, const char * why);

/* The same with RCLC_PARAMETER_CLIENT_LIMIT: `what` has the size `found`, and the limit is `fits`. */
rcl_ret_t rclc_parameter_client_refuse_limit(
  const rclc_parameter_client_t * client, const char * what, size_t found, size_t fits);

/* --- rclc_parameter_client_request.c: requests, whose message is the client --- */

/* Returns RCL_RET_OK if `count` names or parameters are within the limits; otherwise the error, with a text. */
rcl_ret_t rclc_parameter_client_check_names(
  const rclc_parameter_client_t * client, const char * const * names, size_t count);
rcl_ret_t rclc_parameter_client_check_parameters(
  const rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count);

uint32_t rclc_parameter_client_write_names(
  const rclc_parameter_client_t * client, uint8_t * body, uint32_t room, cdr_fault_t * fault);
uint32_t rclc_parameter_client_write_prefixes(
  const rclc_parameter_client_t * client, uint8_t * body, uint32_t room, cdr_fault_t * fault);
uint32_t rclc_parameter_client_write_parameters(
  const rclc_parameter_client_t * client, uint8_t * body, uint32_t room, cdr_fault_t * fault);

/* --- rclc_parameter_client_response.c: responses, which the client keeps in their encoded form --- */

/* Copies the unread part of the body with the same alignment, and begins to read it. */
cdr_in_t rclc_parameter_client_keep(rclc_parameter_client_t * client, cdr_in_t * in);

/* Begins to read the message of the client. It was checked when it arrived, so reading cannot fail. */
cdr_in_t rclc_parameter_client_begin(const rclc_parameter_client_t * client, cdr_fault_t * fault);

/* Returns a string, which ends with its NUL. */
const char * rclc_parameter_client_read_text(cdr_in_t * in);

/* Reads a value, or skips it if `value` is NULL. */
void rclc_parameter_client_read_value(
  rclc_parameter_client_t * client, cdr_in_t * in, rclc_parameter_client_value_t * value);

/* Skips a value when it arrives, and converts its arrays to the byte order of this processor. */
void rclc_parameter_client_settle_value(rclc_parameter_client_t * client, cdr_in_t * in);

/* Decoders of responses, whose message is the client. */
void rclc_parameter_client_decode_values(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_results(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_result(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_names(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_descriptors(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_types(cdr_in_t * in, void * client);

/* Stores the number of items of a response that was read, or that it was refused. */
void rclc_parameter_client_settle(
  rclc_parameter_client_t * client, cdr_in_t * in, const cdr_in_t * kept, uint32_t count);

/* --- for each call: the result of a kept response, with the text of an error --- */

rcl_ret_t rclc_parameter_client_judge_names(rclc_parameter_client_t * client);
rcl_ret_t rclc_parameter_client_judge_results(rclc_parameter_client_t * client);

/* --- rclc_parameter_client_named.c --- */

/* Returns RCLC_PARAMETER_CLIENT_UNKNOWN with its text. */
rcl_ret_t rclc_parameter_client_refuse_name(const rclc_parameter_client_t * client);

/* Returns once the size of a response that was too large to be received; otherwise 0. */
uint16_t rclc_parameter_client_take_large(const rclc_parameter_client_t * client, uint16_t * fits);

/* --- rclc_parameter_client_types.c --- */

/* The name of the service of a call, relative to its node, and its type; NULL: no client uses it. */
extern const char * const rclc_parameter_client_services[RCLC_PARAMETER_CLIENT_CALLS];
extern const rosidl_service_type_support_t * const rclc_parameter_client_types[RCLC_PARAMETER_CLIENT_CALLS];

/* --- rclc_parameter_client_call.c --- */

/* Begins a call with checked items. */
rcl_ret_t rclc_parameter_client_send(
  rclc_parameter_client_t * client, uint8_t call, const void * items, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context);

/* Begins a call and waits for its result. */
rcl_ret_t rclc_parameter_client_send_and_wait(
  rclc_parameter_client_t * client, uint8_t call, const void * items, size_t count, uint32_t timeout_ms);

/* Returns whether a call has a response or has timed out. */
bool rclc_parameter_client_is_due(const rclc_parameter_client_t * client);

/* For such a call: returns whether it is complete, with its result and the text of an error. */
bool rclc_parameter_client_is_done(rclc_parameter_client_t * client, rcl_ret_t * result);

/* Returns the milliseconds until a call times out. */
uint32_t rclc_parameter_client_left_ms(const rclc_parameter_client_t * client);

/* --- rclc_parameter_client_watch.c --- */

#if MICROROS_PARAMETER_CLIENT_WATCHES
/* Returns whether there is an event for clients of the same node. */
bool rclc_parameter_client_has_event(const rclc_parameter_client_t * client);

/* Takes an event and calls the callback of the client that watches its node, if any. */
void rclc_parameter_client_take_event(const rclc_parameter_client_t * client);

/* Returns whether all watching clients of the same node have this executor or none; if not, a text is set. */
bool rclc_parameter_client_may_watch(
  const rclc_parameter_client_t * client, const rclc_executor_t * executor);

/* Closes the subscription of the client's node if no other client watches. */
void rclc_parameter_client_unwatch(rclc_parameter_client_t * client);
#else
static inline bool rclc_parameter_client_has_event(const rclc_parameter_client_t * client)
{
  (void)client;
  return false;
}

static inline void rclc_parameter_client_take_event(const rclc_parameter_client_t * client)
{
  (void)client;
}

static inline bool rclc_parameter_client_may_watch(
  const rclc_parameter_client_t * client, const rclc_executor_t * executor)
{
  (void)client;
  (void)executor;
  return true;
}

static inline void rclc_parameter_client_unwatch(const rclc_parameter_client_t * client)
{
  (void)client;
}
#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_CLIENT_INTERNAL_H */
