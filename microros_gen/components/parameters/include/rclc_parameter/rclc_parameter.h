/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of a node, served to ROS 2: the six services below the node's name, and /parameter_events. The server
 * holds the values; names, types, ranges and texts of the parameters that the application file declares are constants.
 * If the application calls the functions below that add or change parameters, the library has static memory for them;
 * nothing is allocated. All functions and the executor that runs the server belong to one task.
 *
 * The services answer as rclcpp does, with its reasons. A function that returns another code than RCL_RET_OK has
 * changed nothing, and rcl_get_error_string() explains it.
 */
#ifndef MICROROS_RCLC_PARAMETER_H
#define MICROROS_RCLC_PARAMETER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros_config.h"
#include "rcl/error_handling.h"
#include "rcl/rcl.h"
#include "rcl/types.h"
#include "rcl_interfaces/msg/parameter.h"
#include "rcl_interfaces/msg/parameter_descriptor.h"
#include "rcl_interfaces/msg/parameter_value.h"
#if !MICROROS_PARAMETERS_HELD
#include "rcl_interfaces/msg/parameter_event.h"
#include "rcl_interfaces/msg/set_parameters_result.h"
#include "rcl_interfaces/srv/describe_parameters.h"
#include "rcl_interfaces/srv/get_parameter_types.h"
#include "rcl_interfaces/srv/get_parameters.h"
#include "rcl_interfaces/srv/list_parameters.h"
#include "rcl_interfaces/srv/set_parameters.h"
#include "rcl_interfaces/srv/set_parameters_atomically.h"
#endif
#include "rclc/executor.h"
#include "rclc/rclc.h"
#include "rclc_parameter/parameter_types.h"
#include "rclc_parameter/visibility_control.h"
#include "rosidl_runtime_c/primitives_sequence_functions.h"
#include "rosidl_runtime_c/string_functions.h"

#ifdef __cplusplus
extern "C" {
#endif

#if !MICROROS_PARAMETERS_HELD
typedef rcl_interfaces__srv__GetParameters_Request GetParameters_Request;
typedef rcl_interfaces__srv__GetParameters_Response GetParameters_Response;
typedef rcl_interfaces__srv__GetParameterTypes_Request GetParameterTypes_Request;
typedef rcl_interfaces__srv__GetParameterTypes_Response GetParameterTypes_Response;
typedef rcl_interfaces__srv__SetParameters_Request SetParameters_Request;
typedef rcl_interfaces__srv__SetParameters_Response SetParameters_Response;
typedef rcl_interfaces__msg__SetParametersResult SetParameters_Result;
typedef rcl_interfaces__srv__SetParametersAtomically_Request SetParametersAtomically_Request;
typedef rcl_interfaces__srv__SetParametersAtomically_Response SetParametersAtomically_Response;
typedef rcl_interfaces__srv__DescribeParameters_Request DescribeParameters_Request;
typedef rcl_interfaces__srv__DescribeParameters_Response DescribeParameters_Response;
typedef rcl_interfaces__srv__ListParameters_Request ListParameters_Request;
typedef rcl_interfaces__srv__ListParameters_Response ListParameters_Response;
typedef rcl_interfaces__msg__ParameterEvent ParameterEvent;
#endif
typedef rcl_interfaces__msg__Parameter Parameter;
typedef rcl_interfaces__msg__ParameterValue ParameterValue;
typedef rcl_interfaces__msg__Parameter__Sequence Parameter__Sequence;
typedef rcl_interfaces__msg__ParameterDescriptor ParameterDescriptor;
typedef rcl_interfaces__msg__ParameterDescriptor__Sequence ParameterDescriptor__Sequence;

/* Executor handles that a server needs. */
#if MICROROS_PARAMETERS_HELD
#define RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES 1
#else
#define RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES 6
#endif
/* A server in low-memory mode has no descriptions. */
#define RCLC_PARAMETER_UNSUPORTED_ON_LOW_MEM 4003
/* The callback called a function that changes parameters. */
#define RCLC_PARAMETER_DISABLED_ON_CALLBACK 40004

/*
 * Called before each change: false refuses it. `old_param` is NULL if a set request creates the parameter
 * (rclc_parameter_options_t), `new_param` if one deletes it. Both, and all that they point to, are only valid during
 * the call. It must not change parameters of its server.
 */
typedef bool (*rclc_parameter_callback_t)(
  const Parameter * old_param, const Parameter * new_param, void * context);

/*
 * `notify_changed_over_dds`: changes are published on /parameter_events. `max_params`: at most `pools: {parameters: N}`
 * of the application file. `allow_undeclared_parameters`: a set request may create parameters, change their type,
 * and delete them. `low_mem_mode`: parameters have no descriptions.
 */
typedef struct rclc_parameter_options_t {
  bool notify_changed_over_dds;
  size_t max_params;
  bool allow_undeclared_parameters;
  bool low_mem_mode;
} rclc_parameter_options_t;

/* The value of a parameter, by its type. */
typedef union rclc_parameter_scalar_t {
  bool bool_value;
  int64_t integer_value;
  double double_value;
} rclc_parameter_scalar_t;

/* The range of a parameter, by its type. */
typedef union rclc_parameter_range_t {
  struct {
    int64_t from_value;
    int64_t to_value;
    uint64_t step; /* 0: every value between the two */
  } integer;
  struct {
    double from_value;
    double to_value;
    double step; /* 0: every value between the two */
  } floating_point;
} rclc_parameter_range_t;

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
/* The elements of an array. Those of strings: one string after the other, each with its NUL. */
typedef union rclc_parameter_array_t {
  uint8_t bytes[MICROROS_PARAMETER_ARRAY_SIZE];
  bool bools[MICROROS_PARAMETER_ARRAY_SIZE];
  int64_t integers[(MICROROS_PARAMETER_ARRAY_SIZE + 7u) / 8u];
  double doubles[(MICROROS_PARAMETER_ARRAY_SIZE + 7u) / 8u];
  char texts[MICROROS_PARAMETER_ARRAY_SIZE];
} rclc_parameter_array_t;
#endif

struct rclc_parameter_about_t;
struct rclc_parameter_own_t;
struct rclc_parameter_undeclared_t;

/* One parameter. Its members are internal. */
typedef struct rclc_parameter_place_t {
  rclc_parameter_scalar_t value;
  const struct rclc_parameter_about_t *
    about;      /* name, texts and constraints: constants of a declared parameter */
  uint8_t type; /* an rclc_parameter_type_t */
  bool read_only;
  bool dynamic_typing; /* created by a set request */
  uint8_t
    event; /* in which part of the next event it is listed, or what the server that holds it does not know */
#if MICROROS_PARAMETERS_HELD
  uint32_t own_revision; /* of the last change by the node */
  int64_t changed_ns;    /* when that was, by the steady clock */
#endif
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  char string[MICROROS_PARAMETER_STRING_SIZE];
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  uint32_t array_count; /* elements */
  rclc_parameter_array_t array;
#endif
} rclc_parameter_place_t;

#if MICROROS_PARAMETERS_HELD
/* State of the exchange between a device and the server that holds its values. Its members are internal. */
typedef struct rclc_parameter_held_t {
  uint8_t what; /* of the request that is being answered */
  uint8_t status;
  uint32_t board;
  uint32_t session;
  uint32_t number;
  uint32_t first;
  uint32_t acknowledged;
  bool is_setting;
  bool notice_is_due;
  bool has_begun;        /* it is added to an executor */
  uint8_t wait_s;        /* until the next notice, while the server has not asked */
  uint32_t own_session;  /* with the server; 0: none since the node started */
  uint32_t own_number;   /* of its last request */
  uint32_t own_revision; /* changes by the node */
  uint32_t overruled;    /* of them, those that another writer overruled */
  uint32_t reconnects;   /* of the session with the agent, when a notice was due last */
  int64_t noticed_ns;    /* when the last notice was published */
  int64_t requested_ns;  /* when the server asked last, or the node started */
} rclc_parameter_held_t;
#endif

/* A server and its parameters. Its members are internal; do not move or copy the struct after its initialization. */
typedef struct rclc_parameter_server_t {
  rcl_service_t services[RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES];
  rcl_publisher_t event_publisher;
  const rcl_node_t * node;
  rclc_parameter_callback_t on_modification;
  void * context;
  bool (*floating_point_holds)(
    const rclc_parameter_range_t * range, double value); /* NULL: no parameter has a range */
  const struct rclc_parameter_undeclared_t * undeclared; /* NULL: set requests create no parameters */
  struct rclc_parameter_own_t * own;                     /* variable data of its parameters; NULL: none */
  bool on_callback;
  bool notify_changed_over_dds;
  bool low_mem_mode;
  bool request_swaps;    /* its numbers are in the other byte order */
  uint32_t request_size; /* of the request that is being answered */
  uint32_t request_cut;  /* entries of a request that was too large to be received; otherwise 0 */
  size_t max_params;
  size_t count;
  uint32_t revision; /* increases with each change */
#if MICROROS_PARAMETERS_HELD
  rclc_parameter_held_t held;
#endif
  rclc_parameter_place_t places[MICROROS_PARAMETERS_MAX];
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  char string_new[MICROROS_PARAMETER_STRING_SIZE]; /* the change that the callback checks */
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  rclc_parameter_array_t array_new; /* likewise */
#endif
#if MICROROS_PARAMETER_STRINGS_MAX > 0u
  rosidl_runtime_c__String
    strings[2][MICROROS_PARAMETER_STRINGS_MAX]; /* as they are passed to the callback: old and new */
#endif
  uint8_t outcomes[MICROROS_PARAMETER_OUTCOMES_MAX]; /* of the parameters of a set request */
  uint8_t request[MICROROS_PARAMETER_REQUEST_SIZE];
} rclc_parameter_server_t;

/* Like the following function, with events and room for all parameters of the plan. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_server_init_default(rclc_parameter_server_t * parameter_server, rcl_node_t * node);

/*
 * Opens the services and the publisher. Waits for the agent at most MICROROS_CREATE_TIMEOUT_MS for each of the seven.
 * RCL_RET_INVALID_ARGUMENT: max_params is 0 or exceeds the plan; otherwise the codes of rcl_service_init. `node` must
 * outlive the server.
 */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_server_init_with_option(
  rclc_parameter_server_t * parameter_server, rcl_node_t * node, const rclc_parameter_options_t * options);

/* Closes them, and forgets all parameters. Finalize its executor before the executor spins again. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_server_fini(rclc_parameter_server_t * parameter_server, rcl_node_t * node);

/* `on_modification` may be NULL: every change is accepted. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_executor_add_parameter_server(
  rclc_executor_t * executor, rclc_parameter_server_t * parameter_server,
  rclc_parameter_callback_t on_modification);

/* The same with a context for the callback. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_executor_add_parameter_server_with_context(
  rclc_executor_t * executor, rclc_parameter_server_t * parameter_server,
  rclc_parameter_callback_t on_modification, void * context);

/* Adds a parameter with the value false, 0, "" or without elements; the name is copied. RCL_RET_ERROR: all places are
 * in use, the name exists, is empty or longer than MICROROS_PARAMETER_NAME_SIZE - 1 bytes, or the type is not that of a
 * value. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, rclc_parameter_type_t type);

/* RCL_RET_ERROR: unknown parameter. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_delete_parameter(rclc_parameter_server_t * parameter_server, const char * parameter_name);

/*
 * Set a value if the callback accepts it. `read_only` and ranges are not checked here; they apply to requests of
 * other nodes. RCL_RET_ERROR: unknown parameter; RCLC_PARAMETER_TYPE_MISMATCH, RCLC_PARAMETER_MODIFICATION_REJECTED. An event
 * without room in the stream waits until the executor can publish it, together with changes in between.
 */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_bool(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool value);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_int(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t value);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double value);

/* RCL_RET_ERROR: unknown parameter; RCL_RET_INVALID_ARGUMENT: it has another type. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_bool(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool * output);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_int(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t * output);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double * output);

#if MICROROS_PARAMETER_STRING_SIZE > 0u
/* Sets a string, which is copied. Codes as above, and RCL_RET_ERROR for a string that is too long. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * value);

/* Returns a pointer to the string, without a copy. It is valid until the parameter changes; only the functions above
 * and a spin of the executor change it. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char ** output);

/* Refuses strings longer than `size` bytes, without the NUL. RCL_RET_ERROR: unknown parameter, another type, or its
 * string is already longer; RCL_RET_INVALID_ARGUMENT: `size` exceeds the limit of the plan. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, size_t size);
#endif

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
/* Set an array of `count` elements, which is copied; `values` may be NULL if `count` is 0. Codes as above, and
 * RCL_RET_ERROR for an array that is too long. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_byte_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const uint8_t * values,
  size_t count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_bool_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const bool * values, size_t count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_int_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const int64_t * values,
  size_t count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_double_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const double * values,
  size_t count);

/* Return a pointer to an array, without a copy; it is valid as long as that of rclc_parameter_get_string. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_byte_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const uint8_t ** output,
  size_t * count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_bool_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const bool ** output,
  size_t * count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_int_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const int64_t ** output,
  size_t * count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_double_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const double ** output,
  size_t * count);

/* Refuses arrays of more than `size` elements. RCL_RET_ERROR: unknown parameter, not an array, or it already has more
 * elements; RCL_RET_INVALID_ARGUMENT: `size` exceeds the limit of the plan. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, size_t size);
#endif

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_string_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * const * values,
  size_t count);

/* Returns a pointer to the first of `count` strings; each following string begins after the NUL of the one before. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_string_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char ** output,
  size_t * count);
#endif

/* Copies both texts. RCL_RET_ERROR: unknown parameter, or a text longer than MICROROS_PARAMETER_TEXT_SIZE - 1 bytes;
 * RCLC_PARAMETER_UNSUPORTED_ON_LOW_MEM. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_description(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * parameter_description,
  const char * additional_constraints);

/* Requests of other nodes cannot change the parameter. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_set_parameter_read_only(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool read_only);

/* Refuses requests of other nodes for a value outside of the range, or that is not a multiple of `step` above
 * `from_value` (`to_value` is always accepted). RCL_RET_ERROR: unknown parameter, or another type. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_integer(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t from_value,
  int64_t to_value, uint64_t step);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double from_value, double to_value,
  double step);

#if MICROROS_PARAMETER_ONE_OF
/* Refuses requests of other nodes for a value that is not in `values`. The list is not copied and must outlive the
 * server. RCL_RET_ERROR: unknown parameter, or another type. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_one_of_int(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const int64_t * values,
  size_t count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_one_of_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const double * values,
  size_t count);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_one_of_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * const * values,
  size_t count);
#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_H */
