/* SPDX-License-Identifier: Apache-2.0 */
/* The store of parameters, requests as they are on the wire, and what became of each set. Internal. */
#ifndef MICROROS_RCLC_PARAMETERS_H
#define MICROROS_RCLC_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/cdr_decode.h"
#include "microros/rclc_parameter_in.h"
#include "rclc_parameter/rclc_parameter.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What an event says of a parameter. */
enum { PARAMETER_EVENT_NONE, PARAMETER_EVENT_NEW, PARAMETER_EVENT_CHANGED, PARAMETER_EVENT_DELETED };

/* Whether a server can hold values of a type; NOT_SET is none. */
static inline bool rclc_parameter_holds(uint32_t type)
{
#if MICROROS_PARAMETER_STRINGS_MAX > 0u
  const uint32_t last = RCLC_PARAMETER_STRING_ARRAY;
#elif MICROROS_PARAMETER_ARRAY_SIZE > 0u
  const uint32_t last = RCLC_PARAMETER_DOUBLE_ARRAY;
#elif MICROROS_PARAMETER_STRING_SIZE > 0u
  const uint32_t last = RCLC_PARAMETER_STRING;
#else
  const uint32_t last = RCLC_PARAMETER_DOUBLE;
#endif

#if MICROROS_PARAMETER_STRING_SIZE == 0u
  if (type == (uint32_t)RCLC_PARAMETER_STRING) {
    return false;
  }
#endif
  return type != (uint32_t)RCLC_PARAMETER_NOT_SET && type <= last;
}

/* What became of a parameter of a set request. */
typedef enum parameter_outcome_t {
  PARAMETER_SET,
  PARAMETER_NONE, /* nothing was asked for */
  PARAMETER_UNNAMED,
  PARAMETER_UNDECLARED,
  PARAMETER_READ_ONLY,
  PARAMETER_STATIC, /* not to be deleted */
  PARAMETER_OTHER_TYPE,
  PARAMETER_OUTSIDE_INTEGER,
  PARAMETER_OUTSIDE_FLOATING_POINT,
  PARAMETER_REJECTED,
  PARAMETER_NAME_LONG,
  PARAMETER_FULL,
  PARAMETER_STRING_LONG,
  PARAMETER_ARRAY_LONG,
  PARAMETER_NOT_ONE_OF,  /* a value that is not listed */
  PARAMETER_UNSUPPORTED, /* a value of a type that a server cannot hold */
  PARAMETER_CUT          /* its request was too large to arrive */
} parameter_outcome_t;

/* A parameter of a request. `type` may be any number; `value` has one for the types that a server holds. */
typedef struct parameter_requested_t {
  parameter_text_t name;
  uint8_t type;
  rclc_parameter_scalar_t value;
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  parameter_text_t string;
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  cdr_in_t array; /* at the first element */
  uint32_t array_count;
#endif
} parameter_requested_t;

/* A parameter as the callback sees it; the name belongs to a place. */
typedef struct parameter_state_t {
  char * name;
  uint8_t type;
  rclc_parameter_scalar_t value;
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  char * string;
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  rclc_parameter_array_t * array;
  uint32_t array_count;
#endif
} parameter_state_t;

/* --- requests: rclc_parameter_request.c --- */

/* Begins to read the request that the server has. It was checked when it arrived, so nothing in it fails. */
cdr_in_t rclc_parameter_request_begin(const rclc_parameter_server_t * server, cdr_fault_t * fault);

/* Reads a parameter and moves on. */
parameter_requested_t rclc_parameter_request_parameter(cdr_in_t * in);

/* Decoders of message types whose message is the server: they check the request and keep it there. Of one that was too
 * large to arrive they only note the number of its entries, in `request_cut`: it is read as an empty one. */
void rclc_parameter_decode_names(cdr_in_t * in, void * server);
void rclc_parameter_decode_parameters(cdr_in_t * in, void * server);
void rclc_parameter_decode_list(cdr_in_t * in, void * server);

/* --- numbers: rclc_parameter_divide.c --- */

/* Returns value / by, and value % by in *rest; `by` is not 0. The division of 64 bits that a compiler brings along takes
 * more code than it is worth here. */
uint64_t rclc_parameter_divide(uint64_t value, uint64_t by, uint64_t * rest);

/* --- the store: rclc_parameter_store.c --- */

/* Returns the place of that name, or NULL; what is deleted only waits for its event. */
const rclc_parameter_place_t * rclc_parameter_find(
  const rclc_parameter_server_t * server, const parameter_text_t * name);

/* Fills a free place, whose name and value fit; there is one. It counts when `count` is raised. */
rclc_parameter_place_t * rclc_parameter_place(
  rclc_parameter_server_t * server, const parameter_text_t * name, uint8_t type);

/* Notes what the next event says of a place that changed. */
void rclc_parameter_note(rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t event);

/* Removes the place, and moves those after it. */
void rclc_parameter_remove(rclc_parameter_server_t * server, const rclc_parameter_place_t * place);

/* Whether the callback accepts a change; either state may be NULL. */
bool rclc_parameter_accepts(
  rclc_parameter_server_t * server, const parameter_state_t * old_state, const parameter_state_t * new_state);

/* --- calls of the application: rclc_parameter_look.c --- */

/* Notes an error of a parameter; returns `result`. */
rcl_ret_t rclc_parameter_refuse(rcl_ret_t result, const char * name, const char * why);
rcl_ret_t rclc_parameter_refuse_argument(void);

/* Returns the place of a parameter; NULL: *result says why. */
rclc_parameter_place_t * rclc_parameter_look(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result);

/* The same where the parameter is to be changed, which its callback must not. */
rclc_parameter_place_t * rclc_parameter_look_to_change(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result);

/* Whether there is a place, of that type; another type becomes `error` in *result. */
bool rclc_parameter_is(
  const rclc_parameter_place_t * place, const char * name, rclc_parameter_type_t type, rcl_ret_t * result,
  rcl_ret_t error);

/* --- set requests: rclc_parameter_set.c --- */

/* Applies each parameter of the request by itself; fills the outcomes. */
void rclc_parameter_set_each(rclc_parameter_server_t * server);

/* Applies all parameters of the request, or none. */
void rclc_parameter_set_all(rclc_parameter_server_t * server);

/* --- replies and events: rclc_parameter_reply.c, rclc_parameter_event.c --- */

/* Publishes the places that have an `event`, clears it, and removes those that are deleted. Without room for the event all
 * stays as it is, and is published together with what changes meanwhile. */
void rclc_parameter_publish(rclc_parameter_server_t * server);

/* The type of /parameter_events whose message is the server. */
extern const rosidl_message_type_support_t rclc_parameter_event_type;

/* The types of the services whose messages are the server. */
extern const rosidl_service_type_support_t rclc_parameter_get_type;
extern const rosidl_service_type_support_t rclc_parameter_get_types_type;
extern const rosidl_service_type_support_t rclc_parameter_set_type;
extern const rosidl_service_type_support_t rclc_parameter_set_atomically_type;
extern const rosidl_service_type_support_t rclc_parameter_list_type;
extern const rosidl_service_type_support_t rclc_parameter_describe_type;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETERS_H */
