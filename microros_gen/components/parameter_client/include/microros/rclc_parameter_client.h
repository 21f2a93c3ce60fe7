/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of a client of parameters, and the messages that it exchanges. Internal. */
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

/* A node that is declared in the application file: its fully qualified name, the index of the own node whose clients it
 * has, and the operations, a bit for each call. */
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

/* The same with RCLC_PARAMETER_CLIENT_LIMIT, for `what` that has `found` where `fits` is the limit. */
rcl_ret_t rclc_parameter_client_refuse_limit(
  const rclc_parameter_client_t * client, const char * what, size_t found, size_t fits);

/* --- rclc_parameter_client_request.c: requests, whose message is the client --- */

/* Whether `count` names, or parameters, are within the limits; else the result, with a text. */
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

/* --- rclc_parameter_client_response.c: responses, which the client keeps as they are on the wire --- */

/* Copies the body that is not read yet, the first byte to a place of the same alignment, and begins to read it. */
cdr_in_t rclc_parameter_client_keep(rclc_parameter_client_t * client, cdr_in_t * in);

/* Begins to read the message of the client. It was checked when it arrived, so nothing in it fails. */
cdr_in_t rclc_parameter_client_begin(const rclc_parameter_client_t * client, cdr_fault_t * fault);

/* Returns a string, which ends with its NUL. */
const char * rclc_parameter_client_read_text(cdr_in_t * in);

/* Reads a value. `value` is NULL to pass over it. */
void rclc_parameter_client_read_value(
  rclc_parameter_client_t * client, cdr_in_t * in, rclc_parameter_client_value_t * value);

/* Passes over a value when it arrives, and changes its arrays to those of this processor. */
void rclc_parameter_client_settle_value(rclc_parameter_client_t * client, cdr_in_t * in);

/* Decoders of responses, whose message is the client. */
void rclc_parameter_client_decode_values(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_results(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_result(cdr_in_t * in, void * client);
void rclc_parameter_client_decode_names(cdr_in_t * in, void * client);

/* --- by call: the result of a response that was kept, with the text of an error --- */

rcl_ret_t rclc_parameter_client_judge_values(rclc_parameter_client_t * client);
rcl_ret_t rclc_parameter_client_judge_results(rclc_parameter_client_t * client);

/* --- rclc_parameter_client_types.c --- */

/* The type of the service of a call; NULL: no client has it. */
extern const rosidl_service_type_support_t * const rclc_parameter_client_types[RCLC_PARAMETER_CLIENT_CALLS];

/* --- rclc_parameter_client_call.c --- */

/* Begins a call; its items were checked. */
rcl_ret_t rclc_parameter_client_send(
  rclc_parameter_client_t * client, uint8_t call, const void * items, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context);

/* Begins a call and waits for its result. */
rcl_ret_t rclc_parameter_client_send_and_wait(
  rclc_parameter_client_t * client, uint8_t call, const void * items, size_t count, uint32_t timeout_ms);

/* Returns whether a call has a response, or none in its time. */
bool rclc_parameter_client_is_due(const rclc_parameter_client_t * client);

/* For a call that is due: returns whether it is over, with its result, and the text of an error. */
bool rclc_parameter_client_is_done(rclc_parameter_client_t * client, rcl_ret_t * result);

/* Milliseconds until a call fails for want of a response. */
uint32_t rclc_parameter_client_left_ms(const rclc_parameter_client_t * client);

/* --- rclc_parameter_client_watch.c --- */

#if MICROROS_PARAMETER_CLIENT_WATCHES
/* Returns whether there is an event for clients of the same node. */
bool rclc_parameter_client_has_event(const rclc_parameter_client_t * client);

/* Takes an event and calls the callback of the client that watches its node, if any. */
void rclc_parameter_client_take_event(const rclc_parameter_client_t * client);

/* Whether the clients of the same node that watch have this executor, or none; else a text is set. */
bool rclc_parameter_client_may_watch(
  const rclc_parameter_client_t * client, const rclc_executor_t * executor);

/* Closes the subscription of the client's node where no other client watches. */
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
