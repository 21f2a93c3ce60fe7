/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of other nodes: get, set, list and watch. The application file declares each of them below
 * `parameter_clients` of a local node, with the operations that are called. Nothing is allocated.
 *
 * Every call has two forms. The form that ends with _async returns at once; its callback receives the result in a spin
 * of the executor that runs the client. The other form waits for the result, and is refused in callbacks of that
 * executor. A client has one call at a time. The functions below (rclc_parameter_client_value and others) read the
 * result of either form; their results are valid until the client's next call or spin.
 *
 * All functions and the executor of a client belong to one task. After any other code than RCL_RET_OK,
 * rcl_get_error_string() has a text; likewise during a callback with such a result.
 */
#ifndef MICROROS_RCLC_PARAMETER_CLIENT_H
#define MICROROS_RCLC_PARAMETER_CLIENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros_config.h"
#include "rcl/client.h"
#include "rcl/error_handling.h"
#include "rcl/rcl.h"
#include "rcl/types.h"
#include "rclc/executor.h"
#include "rclc/rclc.h"
#include "rclc_parameter/parameter_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The node does not have this parameter. */
#define RCLC_PARAMETER_CLIENT_UNKNOWN 4011
/* A call has no result yet. */
#define RCLC_PARAMETER_CLIENT_BUSY 4012
/* A waiting form was called in a callback of the client's executor. */
#define RCLC_PARAMETER_CLIENT_IN_CALLBACK 4013
/* More parameters, a longer name or a larger value than the limits of the application file, in a request or response. */
#define RCLC_PARAMETER_CLIENT_LIMIT 4014

/* A value. Strings end with a NUL; `count` is the number of elements of an array. */
typedef struct rclc_parameter_client_value_t {
  rclc_parameter_type_t type;
  size_t count;
  union {
    bool bool_value;
    int64_t integer_value;
    double double_value;
    const char * string_value;
    const uint8_t * byte_array_value;
    const bool * bool_array_value;
    const int64_t * integer_array_value;
    const double * double_array_value;
    const char * const * string_array_value;
  } as;
} rclc_parameter_client_value_t;

/* A parameter to set, or to delete with the type RCLC_PARAMETER_NOT_SET. */
typedef struct rclc_parameter_client_parameter_t {
  const char * name;
  rclc_parameter_client_value_t value;
} rclc_parameter_client_parameter_t;

/* A change of a watched parameter. */
typedef enum rclc_parameter_client_change_t {
  RCLC_PARAMETER_CLIENT_NEW,
  RCLC_PARAMETER_CLIENT_CHANGED,
  RCLC_PARAMETER_CLIENT_DELETED,
  RCLC_PARAMETER_CLIENT_MISSED /* an event did not fit, or was damaged: any parameter may have changed */
} rclc_parameter_client_change_t;

struct rclc_parameter_client_t;
struct rclc_parameter_client_remote_t; /* microros/rclc_parameter_client.h */

/* `result` is the code that the waiting form returns. The callback may begin the next call. */
typedef void (*rclc_parameter_client_callback_t)(
  struct rclc_parameter_client_t * client, rcl_ret_t result, void * context);

/* Called once for each parameter of an event; `name` is "" and `value` NULL for RCLC_PARAMETER_CLIENT_MISSED. Both are
 * only valid during the callback, which must neither call nor finalize the client. */
typedef void (*rclc_parameter_client_event_callback_t)(
  struct rclc_parameter_client_t * client, rclc_parameter_client_change_t change, const char * name,
  const rclc_parameter_client_value_t * value, void * context);

/* The services of a client, and its calls. */
enum {
  RCLC_PARAMETER_CLIENT_GET,
  RCLC_PARAMETER_CLIENT_SET,
  RCLC_PARAMETER_CLIENT_SET_ATOMICALLY,
  RCLC_PARAMETER_CLIENT_LIST,
#if MICROROS_PARAMETER_CLIENT_DESCRIBES
  RCLC_PARAMETER_CLIENT_DESCRIBE,
#endif
#if MICROROS_PARAMETER_CLIENT_GETS_TYPES
  RCLC_PARAMETER_CLIENT_GET_TYPES,
#endif
  RCLC_PARAMETER_CLIENT_CALLS
};

/* A client. Its members are internal; do not move or copy the struct after its initialization. */
typedef struct rclc_parameter_client_t {
  rcl_client_t services[RCLC_PARAMETER_CLIENT_CALLS];
  const rcl_node_t * node;
  const struct rclc_parameter_client_remote_t * remote; /* the other node */
  struct rclc_parameter_client_t * next;
  const rclc_executor_t * executor;
  rclc_parameter_client_callback_t callback;
  void * context;
  rclc_parameter_client_event_callback_t event_callback;
  void * event_context;
  const void * items; /* names or parameters of the request, while it is written */
  size_t count;       /* of them; then of the response */
  size_t requested;   /* items of the request */
  uint64_t depth;
  int64_t sequence;
  uint32_t start_ms;
  uint32_t timeout_ms;
  uint32_t size;    /* bytes of `message` */
  uint32_t start;   /* of what is read */
  uint8_t call;     /* that `message` is the response of; RCLC_PARAMETER_CLIENT_CALLS: none */
  bool swaps;       /* its numbers are in the other byte order */
  bool is_busy;     /* a call has no result yet */
  bool is_calling;  /* the executor calls callbacks */
  bool in_event;    /* the event's callback is called */
  uint16_t exceeds; /* elements of an array of the last response, above their limit; 0: all fit */
#if MICROROS_PARAMETER_CLIENT_STRINGS > 0u
  const char * strings[MICROROS_PARAMETER_CLIENT_STRINGS]; /* of the array that was read last */
#endif
  union {
    uint8_t bytes[MICROROS_PARAMETER_CLIENT_MESSAGE_SIZE];
    int64_t integer; /* aligns the numbers of arrays */
    double number;
  } message;
} rclc_parameter_client_t;

/*
 * Opens the declared endpoints for `remote`, the fully qualified name of another node ("/arm/motor"), which need not be
 * running. Waits for the agent at most MICROROS_CREATE_TIMEOUT_MS for each. `client` may be uninitialized; `node` must
 * outlive it. RCL_RET_INVALID_ARGUMENT; otherwise the codes of rcl_client_init.
 */
rcl_ret_t rclc_parameter_client_init_default(
  rclc_parameter_client_t * client, rcl_node_t * node, const char * remote);

/* Closes the endpoints. A pending call never gets a result. First remove the client from its executor. */
rcl_ret_t rclc_parameter_client_fini(rclc_parameter_client_t * client, rcl_node_t * node);

/* Adds a client, as one handle. All watching clients of a node belong to the same executor. */
rcl_ret_t rclc_executor_add_parameter_client(rclc_executor_t * executor, rclc_parameter_client_t * client);
rcl_ret_t rclc_executor_remove_parameter_client(rclc_executor_t * executor, rclc_parameter_client_t * client);

/* --- calls --- */
/*
 * `timeout_ms`: how long the response may take, 1 ms to 24 days. Arguments are only read during the call.
 *
 * The waiting forms return RCL_RET_OK, or RCL_RET_TIMEOUT: no response, the node does not run or was restarted;
 * RCL_RET_ERROR: no session, or it was lost during the call (a value may have been set), the response is damaged, or
 * the operation is not declared; RCLC_PARAMETER_CLIENT_LIMIT: the request or response exceeds the limits (in case of
 * the response, values have been set); RCLC_PARAMETER_CLIENT_BUSY and _IN_CALLBACK; RCL_RET_INVALID_ARGUMENT. The
 * asynchronous forms return the same codes if no request was sent; otherwise they call the callback.
 */

#if MICROROS_PARAMETER_CLIENT_GETS
/* Gets parameters. RCLC_PARAMETER_CLIENT_UNKNOWN: the node does not know all of them and returns no value, as rclcpp
 * nodes do. rclpy nodes return the others; rclc_parameter_client_value reports the unknown ones. */
rcl_ret_t rclc_parameter_client_get(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_async(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context);

/* Returns value `index`, in the order of the requested names. RCLC_PARAMETER_CLIENT_UNKNOWN: the node does not know the
 * parameter, or it has no value; RCL_RET_INVALID_ARGUMENT: `index` is out of range. */
rcl_ret_t rclc_parameter_client_value(
  rclc_parameter_client_t * client, size_t index, rclc_parameter_client_value_t * value);

/* Get one value and wait for it. RCLC_PARAMETER_TYPE_MISMATCH: it has another type; RCLC_PARAMETER_CLIENT_UNKNOWN. */
rcl_ret_t rclc_parameter_client_get_bool(
  rclc_parameter_client_t * client, const char * name, bool * output, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_int(
  rclc_parameter_client_t * client, const char * name, int64_t * output, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_double(
  rclc_parameter_client_t * client, const char * name, double * output, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_string(
  rclc_parameter_client_t * client, const char * name, const char ** output, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_byte_array(
  rclc_parameter_client_t * client, const char * name, const uint8_t ** output, size_t * count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_bool_array(
  rclc_parameter_client_t * client, const char * name, const bool ** output, size_t * count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_int_array(
  rclc_parameter_client_t * client, const char * name, const int64_t ** output, size_t * count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_double_array(
  rclc_parameter_client_t * client, const char * name, const double ** output, size_t * count,
  uint32_t timeout_ms);
/* `output` gets `count` strings; RCLC_PARAMETER_CLIENT_LIMIT: there are more than `capacity`. */
rcl_ret_t rclc_parameter_client_get_string_array(
  rclc_parameter_client_t * client, const char * name, const char ** output, size_t capacity, size_t * count,
  uint32_t timeout_ms);
#endif

#if MICROROS_PARAMETER_CLIENT_SETS
/* Sets parameters, each independently. RCLC_PARAMETER_MODIFICATION_REJECTED: the node refused one of them, for the
 * reason in the text. */
rcl_ret_t rclc_parameter_client_set(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_async(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms, rclc_parameter_client_callback_t callback, void * context);

/* Set one value and wait for it to be set. */
rcl_ret_t rclc_parameter_client_set_bool(
  rclc_parameter_client_t * client, const char * name, bool value, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_int(
  rclc_parameter_client_t * client, const char * name, int64_t value, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_double(
  rclc_parameter_client_t * client, const char * name, double value, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_string(
  rclc_parameter_client_t * client, const char * name, const char * value, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_byte_array(
  rclc_parameter_client_t * client, const char * name, const uint8_t * values, size_t count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_bool_array(
  rclc_parameter_client_t * client, const char * name, const bool * values, size_t count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_int_array(
  rclc_parameter_client_t * client, const char * name, const int64_t * values, size_t count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_double_array(
  rclc_parameter_client_t * client, const char * name, const double * values, size_t count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_string_array(
  rclc_parameter_client_t * client, const char * name, const char * const * values, size_t count,
  uint32_t timeout_ms);
#endif

#if MICROROS_PARAMETER_CLIENT_SETS_ATOMICALLY
/* Sets all parameters, or none. */
rcl_ret_t rclc_parameter_client_set_atomically(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_set_atomically_async(
  rclc_parameter_client_t * client, const rclc_parameter_client_parameter_t * parameters, size_t count,
  uint32_t timeout_ms, rclc_parameter_client_callback_t callback, void * context);
#endif

#if MICROROS_PARAMETER_CLIENT_SETS || MICROROS_PARAMETER_CLIENT_SETS_ATOMICALLY
/* Returns the result for parameter `index` of a set; an atomic set has one result for all. *reason gets the text of the
 * node, "" for success; `reason` may be NULL. RCLC_PARAMETER_MODIFICATION_REJECTED; RCL_RET_INVALID_ARGUMENT. */
rcl_ret_t rclc_parameter_client_outcome(rclc_parameter_client_t * client, size_t index, const char ** reason);
#endif

#if MICROROS_PARAMETER_CLIENT_LISTS
/* Lists the names of parameters that begin with one of `count` prefixes; without prefixes all names. `depth` as in
 * rcl_interfaces/srv/ListParameters; 0: any. */
rcl_ret_t rclc_parameter_client_list(
  rclc_parameter_client_t * client, const char * const * prefixes, size_t count, uint64_t depth,
  uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_list_async(
  rclc_parameter_client_t * client, const char * const * prefixes, size_t count, uint64_t depth,
  uint32_t timeout_ms, rclc_parameter_client_callback_t callback, void * context);

/* Returns name `index` of a list, or NULL. */
const char * rclc_parameter_client_name(rclc_parameter_client_t * client, size_t index);
#endif

#if MICROROS_PARAMETER_CLIENT_DESCRIBES
/* The descriptor of a parameter. Texts may be "". A step of 0: any value of the range. */
typedef struct rclc_parameter_client_descriptor_t {
  const char * name;
  const char * description;
  const char * additional_constraints;
  rclc_parameter_type_t type;
  bool read_only;
  bool dynamic_typing;
  bool has_integer_range;
  bool has_floating_point_range;
  struct {
    int64_t from_value;
    int64_t to_value;
    uint64_t step;
  } integer_range;
  struct {
    double from_value;
    double to_value;
    double step;
  } floating_point_range;
} rclc_parameter_client_descriptor_t;

/* Gets the descriptors of parameters. RCLC_PARAMETER_CLIENT_UNKNOWN: the node does not know all of them. */
rcl_ret_t rclc_parameter_client_describe(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_describe_async(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context);

/* Returns descriptor `index`, in the order of the requested names. RCL_RET_INVALID_ARGUMENT: `index` is out of range.
 */
rcl_ret_t rclc_parameter_client_descriptor(
  rclc_parameter_client_t * client, size_t index, rclc_parameter_client_descriptor_t * descriptor);

/* Gets one descriptor and waits for it. */
rcl_ret_t rclc_parameter_client_get_descriptor(
  rclc_parameter_client_t * client, const char * name, rclc_parameter_client_descriptor_t * output,
  uint32_t timeout_ms);
#endif

#if MICROROS_PARAMETER_CLIENT_GETS_TYPES
/* Gets the types of parameters. RCLC_PARAMETER_CLIENT_UNKNOWN: the node does not know all of them. */
rcl_ret_t rclc_parameter_client_get_types(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms);
rcl_ret_t rclc_parameter_client_get_types_async(
  rclc_parameter_client_t * client, const char * const * names, size_t count, uint32_t timeout_ms,
  rclc_parameter_client_callback_t callback, void * context);

/* Returns type `index`, in the order of the requested names. RCLC_PARAMETER_CLIENT_UNKNOWN: the parameter has no value;
 * RCL_RET_INVALID_ARGUMENT: `index` is out of range. */
rcl_ret_t rclc_parameter_client_type(
  rclc_parameter_client_t * client, size_t index, rclc_parameter_type_t * type);

/* Gets one type and waits for it. */
rcl_ret_t rclc_parameter_client_get_type(
  rclc_parameter_client_t * client, const char * name, rclc_parameter_type_t * output, uint32_t timeout_ms);
#endif

/* Returns the number of values, results, names, descriptors or types of the last call's response; 0 if it failed. */
size_t rclc_parameter_client_count(const rclc_parameter_client_t * client);

#if MICROROS_PARAMETER_CLIENT_WATCHES
/* Calls `callback` for each change of the node's parameters from now on; NULL ends this. RCL_RET_ERROR: the operation
 * is not declared, or another executor runs a watching client of this node. */
rcl_ret_t rclc_parameter_client_watch(
  rclc_parameter_client_t * client, rclc_parameter_client_event_callback_t callback, void * context);
#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_CLIENT_H */
