/* SPDX-License-Identifier: Apache-2.0 */
/* The store of parameters, requests in their encoded form, and the outcome of each set. Internal. */
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

#if MICROROS_PARAMETER_RULES > 0u
typedef struct rclc_parameter_rule_t rclc_parameter_rule_t;
#endif

/* The description and constraints of a parameter. */
typedef struct rclc_parameter_about_t {
  const char * name;
  const char *
    texts; /* the description, then the constraints in words, each with its NUL; NULL: both are empty */
  const rclc_parameter_range_t * range; /* NULL: none */
#if MICROROS_PARAMETER_ONE_OF
  const void * one_of; /* the values that are accepted; NULL: all */
  size_t one_of_count;
#endif
#if MICROROS_PARAMETER_RULES > 0u
  const rclc_parameter_rule_t * rules; /* rules_count of them, checked in this order */
  uint32_t rules_count;
#endif
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  uint32_t string_most; /* bytes without the NUL */
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  uint32_t array_most; /* elements, where it is declared with a size */
#endif
} rclc_parameter_about_t;

/* The variable data of a server's parameters. */
typedef struct rclc_parameter_own_t {
  const rclc_parameter_server_t * server;                 /* NULL: it belongs to none */
  rclc_parameter_about_t abouts[MICROROS_PARAMETERS_MAX]; /* without a name: free */
} rclc_parameter_own_t;

/* The part of an event in which a parameter is listed. */
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

/* The outcome of one parameter of a set request. */
typedef enum parameter_outcome_t {
  PARAMETER_SET,
  PARAMETER_NONE, /* no value was requested */
  PARAMETER_UNNAMED,
  PARAMETER_UNDECLARED,
  PARAMETER_SOME_UNDECLARED, /* the same of a request that is applied as a whole */
  PARAMETER_READ_ONLY,
  PARAMETER_STATIC, /* cannot be deleted */
  PARAMETER_OTHER_TYPE,
  PARAMETER_OUTSIDE_INTEGER,
  PARAMETER_OUTSIDE_FLOATING_POINT,
  PARAMETER_REJECTED,
  PARAMETER_STRING_LONG,
  PARAMETER_ARRAY_LONG,
  PARAMETER_NOT_ONE_OF, /* a value that is not listed */
#if MICROROS_PARAMETER_RULES > 0u
  PARAMETER_BREAKS_RULE, /* of generate_parameter_library */
#endif
  PARAMETER_UNSUPPORTED, /* a value of a type that a server cannot hold */
  PARAMETER_CUT,         /* its request was too large to be received */
  PARAMETER_NAME_LONG,   /* this and the last: of a parameter that would be created */
  PARAMETER_FULL
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

/* A parameter as it is passed to the callback; the name belongs to a place. */
typedef struct parameter_state_t {
  const char * name;
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

/* Parameters that set requests create: rclc_parameter_own.c. */
typedef struct rclc_parameter_undeclared_t {
  /* For one of `created` parameters that the request creates; 0: for one that gets another type. */
  parameter_outcome_t (*check)(
    const rclc_parameter_server_t * server, const parameter_requested_t * requested, size_t created);
  /* Whether the callback accepts one with that name, which new_state gets. */
  bool (*accepts)(
    rclc_parameter_server_t * server, const parameter_text_t * name, parameter_state_t * new_state);
  /* Adds it, without its value. */
  void (*add)(rclc_parameter_server_t * server, const parameter_requested_t * requested);
  /* Changes the type of such a parameter; its constraints, which are of the type before, end. */
  void (*retype)(rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint8_t type);
  const char * name_long; /* words of PARAMETER_NAME_LONG */
  const char * full;      /* of PARAMETER_FULL */
} rclc_parameter_undeclared_t;

extern const rclc_parameter_undeclared_t rclc_parameter_undeclared;

/* --- requests: rclc_parameter_request.c --- */

/* Begins to read the request that the server has. It was checked when it arrived, so nothing in it fails: faults of all
 * servers go to the same place, which is not read. */
cdr_in_t rclc_parameter_request_begin(const rclc_parameter_server_t * server);

/* Reads a parameter and moves on. */
void rclc_parameter_request_parameter(cdr_in_t * in, parameter_requested_t * requested);

/* Decoders of message types whose message is the server: they check the request and keep it there. If the request was
 * too large to be received, they only store the number of its entries in `request_cut`, and the request is read as an
 * empty one. */
void rclc_parameter_decode_names(cdr_in_t * in, void * server);
void rclc_parameter_decode_parameters(cdr_in_t * in, void * server);
void rclc_parameter_decode_list(cdr_in_t * in, void * server);

/* --- numbers: rclc_parameter_set.c --- */

/* Returns value / by, and value % by in *rest; `by` is not 0. The 64-bit division of the compiler's library takes more
 * code than this. */
uint64_t rclc_parameter_divide(uint64_t value, uint64_t by, uint64_t * rest);

/* Returns whether a value is in a range: rclc_parameter_floating.c. */
bool rclc_parameter_floating_point_holds(const rclc_parameter_range_t * range, double value);

/* --- the store: rclc_parameter_store.c --- */

/* Returns a text of the application. */
parameter_text_t rclc_parameter_text(const char * text);

/* Returns whether a name begins with a text that contains no NUL. */
bool rclc_parameter_begins(const char * name, const parameter_text_t * text);

/* Returns the place of that name, or NULL. A deleted parameter, which only waits for its event, is not found. */
const rclc_parameter_place_t * rclc_parameter_find(
  const rclc_parameter_server_t * server, const parameter_text_t * name);

/* Clears a free place, which must exist. It is in use when `count` is raised. */
rclc_parameter_place_t * rclc_parameter_place(
  rclc_parameter_server_t * server, const rclc_parameter_about_t * about, uint8_t type);

/* Frees the variable data of a place. */
void rclc_parameter_disown(const rclc_parameter_server_t * server, const rclc_parameter_place_t * place);

/* Returns a place as it is passed to the callback. */
parameter_state_t rclc_parameter_state(rclc_parameter_place_t * place);

/* Notes in which part of the next event a changed place is listed. A new one that changes before that event is new. */
void rclc_parameter_note(rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t event);

/* Removes the place, and moves those after it. */
void rclc_parameter_remove(rclc_parameter_server_t * server, const rclc_parameter_place_t * place);

/* Returns whether the callback accepts a change; either state may be NULL. */
bool rclc_parameter_accepts(
  rclc_parameter_server_t * server, const parameter_state_t * old_state, const parameter_state_t * new_state);

/* --- variable data, linked only if it is needed: rclc_parameter_own.c --- */

/* Fills a free place with a name and value that fit. NULL: all are in use, or more servers than nodes are open. */
rclc_parameter_place_t * rclc_parameter_create(
  rclc_parameter_server_t * server, const parameter_text_t * name, uint8_t type);

/* Returns the description of a place for changes, and its index among those of all servers. NULL: *result has the
 * error. */
rclc_parameter_about_t * rclc_parameter_own(
  rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t * number, rcl_ret_t * result);

/* One for each parameter of all servers. */
enum { PARAMETERS_OWN = MICROROS_NODES_MAX * MICROROS_PARAMETERS_MAX };

/* --- calls of the application: rclc_parameter.c --- */

/* Notes an error of a parameter; returns `result`. */
rcl_ret_t rclc_parameter_refuse(rcl_ret_t result, const char * name, const char * why);
rcl_ret_t rclc_parameter_refuse_argument(void);

/* Returns the place of a parameter; NULL: *result has the error. */
rclc_parameter_place_t * rclc_parameter_look(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result);

/* The same for a change of the parameter, which its callback must not make. */
rclc_parameter_place_t * rclc_parameter_look_to_change(
  rclc_parameter_server_t * server, const char * name, rcl_ret_t * result);

/*
 * Returns whether a parameter of that name can be added; if not, *result has the error. Without `others` none of the
 * server's parameters can have the name. */
bool rclc_parameter_may_add(
  const rclc_parameter_server_t * server, const char * name, size_t others, rcl_ret_t * result);

/* Returns whether the place exists and has that type; for another type *result is `error`. */
bool rclc_parameter_is(
  const rclc_parameter_place_t * place, const char * name, rclc_parameter_type_t type, rcl_ret_t * result,
  rcl_ret_t error);

/* --- set requests: rclc_parameter_set.c --- */

/* Applies each parameter of the request by itself; fills the outcomes. */
void rclc_parameter_set_each(rclc_parameter_server_t * server);

/* Applies all parameters of the request, or none. */
void rclc_parameter_set_all(rclc_parameter_server_t * server);

/* --- replies and events: rclc_parameter_reply.c, rclc_parameter_event.c --- */

/* Publishes the places that have an `event`, clears it, and removes those that are deleted. If the stream has no room
 * for the event, it is published later, together with changes in between. */
void rclc_parameter_publish(rclc_parameter_server_t * server);

/* The type of /parameter_events, whose message is the server. */
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
