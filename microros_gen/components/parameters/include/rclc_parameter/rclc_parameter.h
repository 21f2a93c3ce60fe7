/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of a node, served to ROS 2: the six services below the node's name, and /parameter_events. The server holds
 * names, values and descriptions by itself; nothing is allocated. All functions and the executor that runs the server
 * belong to one task.
 *
 * The services answer as rclcpp does, with its reasons. A function below that returns no RCL_RET_OK leaves a text behind
 * rcl_get_error_string(), and has changed nothing.
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

/* Handles of an executor that a server takes. */
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
 * Decides about a change, before it is made: false refuses it. `old_param` is NULL for a parameter that is created by a set
 * request (rclc_parameter_options_t), `new_param` for one that is deleted by one. Both, and all that they point to, are
 * only valid during the call. It must not change parameters of its server.
 */
typedef bool (*rclc_parameter_callback_t)(
  const Parameter * old_param, const Parameter * new_param, void * context);

/*
 * `notify_changed_over_dds`: changes are published on /parameter_events. `max_params`: at most `pools: {parameters: N}` of
 * the application file. `allow_undeclared_parameters`: a set request may create parameters, change the type of these, and
 * delete them. `low_mem_mode`: there are no descriptions.
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

/* One parameter. The members are the library's. */
typedef struct rclc_parameter_place_t {
  rclc_parameter_scalar_t value;
  rclc_parameter_range_t range; /* where has_range is set */
  uint8_t type;                 /* an rclc_parameter_type_t */
  bool read_only;
  bool dynamic_typing; /* created by a set request */
  bool has_range;
  uint8_t event; /* what the next event says of it, or what the server that holds it does not know */
#if MICROROS_PARAMETERS_HELD
  uint32_t own_revision; /* of the last change by the node */
  int64_t changed_ns;    /* when that was, by the steady clock */
#endif
#if MICROROS_PARAMETER_ONE_OF
  const void * one_of; /* the values that are accepted; NULL: all */
  size_t one_of_count;
#endif
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  uint32_t string_most; /* bytes without the NUL */
  char string[MICROROS_PARAMETER_STRING_SIZE];
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  uint32_t array_count; /* elements */
  uint32_t array_most;  /* of them, where it is declared with a size */
  rclc_parameter_array_t array;
#endif
  char name[MICROROS_PARAMETER_NAME_SIZE];
  char description[MICROROS_PARAMETER_TEXT_SIZE];
  char additional_constraints[MICROROS_PARAMETER_TEXT_SIZE];
} rclc_parameter_place_t;

#if MICROROS_PARAMETERS_HELD
/* What a device and the server that holds its values said to each other. The members are the library's. */
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
  uint32_t own_session;  /* with the server; 0: none since the node started */
  uint32_t own_number;   /* of its last request */
  uint32_t own_revision; /* changes by the node */
  uint32_t overruled;    /* of them, those that another writer overruled */
  uint32_t reconnects;   /* of the session with the agent, when a notice was due last */
  int64_t noticed_ns;    /* when the last notice was published */
  int64_t requested_ns;  /* when the server asked last, or the node started */
} rclc_parameter_held_t;
#endif

/* A server and its parameters. The members are the library's; the struct stays where it was initialized. */
typedef struct rclc_parameter_server_t {
  rcl_service_t services[RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES];
  rcl_publisher_t event_publisher;
  const rcl_node_t * node;
  rclc_parameter_callback_t on_modification;
  void * context;
  bool (*floating_point_holds)(
    const rclc_parameter_range_t * range, double value); /* NULL: none has a range */
  bool on_callback;
  bool notify_changed_over_dds;
  bool allow_undeclared_parameters;
  bool low_mem_mode;
  bool request_swaps;    /* its numbers are in the other byte order */
  uint32_t request_size; /* of the request that is being answered */
  uint32_t request_cut;  /* entries of one that was too large to arrive; 0: it arrived */
  size_t max_params;
  size_t count;
  uint32_t revision; /* goes up with each change */
#if MICROROS_PARAMETERS_HELD
  rclc_parameter_held_t held;
#endif
  rclc_parameter_place_t places[MICROROS_PARAMETERS_MAX];
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  char string_new[MICROROS_PARAMETER_STRING_SIZE]; /* what the callback is asked about */
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  rclc_parameter_array_t array_new; /* likewise */
#endif
#if MICROROS_PARAMETER_STRINGS_MAX > 0u
  rosidl_runtime_c__String
    strings[2][MICROROS_PARAMETER_STRINGS_MAX]; /* as the callback sees them: old and new */
#endif
  uint8_t outcomes[MICROROS_PARAMETER_OUTCOMES_MAX]; /* of the parameters of a set request */
  uint8_t request[MICROROS_PARAMETER_REQUEST_SIZE];
} rclc_parameter_server_t;

/* Events are published, and there is a place for every parameter of the plan. Otherwise as the following. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_server_init_default(rclc_parameter_server_t * parameter_server, rcl_node_t * node);

/*
 * Opens the services and the publisher. Waits for the agent at most MICROROS_CREATE_TIMEOUT_MS for each of the seven.
 * RCL_RET_INVALID_ARGUMENT: max_params is 0 or above the plan's; else what rcl_service_init returns. `node` must outlive
 * the server.
 */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_server_init_with_option(
  rclc_parameter_server_t * parameter_server, rcl_node_t * node, const rclc_parameter_options_t * options);

/* Closes them, and forgets all parameters. The executor must not spin again before it is ended as well. */
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

/* Adds a parameter of the value false, 0, "" or no elements; the name is copied. RCL_RET_ERROR: no place left, a name that is taken, empty
 * or longer than MICROROS_PARAMETER_NAME_SIZE - 1 bytes, or no type of a value. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, rclc_parameter_type_t type);

/* RCL_RET_ERROR: no such parameter. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_delete_parameter(rclc_parameter_server_t * parameter_server, const char * parameter_name);

/*
 * Set a value, if the callback accepts it, also that of a read-only parameter and one outside its range: these two hold for
 * requests of other nodes. RCL_RET_ERROR: no such parameter; RCLC_PARAMETER_TYPE_MISMATCH,
 * RCLC_PARAMETER_MODIFICATION_REJECTED. An event that finds no room in the stream waits for it, and then has
 * what changed meanwhile as well: the executor publishes it.
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

/* RCL_RET_ERROR: no such parameter; RCL_RET_INVALID_ARGUMENT: it has another type. */
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
/* Sets a string, which is copied. As the functions above, and RCL_RET_ERROR for one that is too long. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * value);

/* Gives the string where it is, without a copy: valid until the parameter changes, which it does in no other function
 * than those above and a spin of the executor. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char ** output);

/* Longer strings than `size` bytes, without the NUL, are refused. RCL_RET_ERROR: no such parameter, it has another type,
 * or a string that is longer already; RCL_RET_INVALID_ARGUMENT: `size` is above the plan's limit. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_string(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, size_t size);
#endif

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
/* Set an array of `count` elements, which is copied; `values` may be NULL for none. As the functions above, and
 * RCL_RET_ERROR for one that is too long. */
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

/* Give an array where it is, without a copy: valid as what rclc_parameter_get_string gives. */
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

/* More than `size` elements are refused. RCL_RET_ERROR: no such parameter, it is no array, or has more already;
 * RCL_RET_INVALID_ARGUMENT: `size` is above the plan's limit. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, size_t size);
#endif

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_set_string_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * const * values,
  size_t count);

/* Gives the first of `count` strings; each following one begins after the NUL of the one before. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_parameter_get_string_array(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char ** output,
  size_t * count);
#endif

/* Both texts are copied. RCL_RET_ERROR: no such parameter, or a text longer than MICROROS_PARAMETER_TEXT_SIZE - 1 bytes;
 * RCLC_PARAMETER_UNSUPORTED_ON_LOW_MEM. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_description(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, const char * parameter_description,
  const char * additional_constraints);

/* Requests of other nodes cannot change it. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_set_parameter_read_only(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, bool read_only);

/* Requests of other nodes are refused where the value is outside, or no multiple of `step` above `from_value` (`to_value`
 * is always one of the values). RCL_RET_ERROR: no such parameter, or it has another type. */
RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_integer(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, int64_t from_value,
  int64_t to_value, uint64_t step);

RCLC_PARAMETER_PUBLIC
rcl_ret_t rclc_add_parameter_constraint_double(
  rclc_parameter_server_t * parameter_server, const char * parameter_name, double from_value, double to_value,
  double step);

#if MICROROS_PARAMETER_ONE_OF
/* Requests of other nodes are refused where the value is none of `values`, which are not copied: they outlive the server.
 * RCL_RET_ERROR: no such parameter, or it has another type. */
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
