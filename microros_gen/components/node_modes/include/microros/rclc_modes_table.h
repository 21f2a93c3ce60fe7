/* SPDX-License-Identifier: Apache-2.0 */
/* Modes of a node as constants, and how they are applied. Internal. */
#ifndef MICROROS_RCLC_MODES_TABLE_H
#define MICROROS_RCLC_MODES_TABLE_H

#include <stdbool.h>
#include <stdint.h>

#include "rclc/executor_handle.h"
#include "rclc_modes/rclc_modes.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The value of a parameter in a mode, as a declaration has it. */
typedef struct rclc_modes_value_t {
  rclc_parameter_scalar_t value;
#if MICROROS_PARAMETER_STRING_SIZE > 0u || MICROROS_PARAMETER_ARRAY_SIZE > 0u
  const void * start;   /* a string with its NUL, or elements as rclc_parameter_array_t has them */
  uint32_t start_bytes; /* of both */
  uint32_t start_count; /* elements */
#endif
} rclc_modes_value_t;

typedef struct rclc_modes_mode_t {
  const char * name;
  const rclc_modes_value_t * values; /* of all parameters of the table */
  const bool * given;                /* for each parameter whether the mode sets it; NULL: all */
} rclc_modes_mode_t;

/* A parameter that modes set. */
typedef struct rclc_modes_parameter_t {
  const char * name;
  uint8_t type; /* an rclc_parameter_type_t */
} rclc_modes_parameter_t;

struct rclc_modes_table_t {
  const rclc_modes_mode_t * modes; /* the first is __DEFAULT__ */
  const rclc_modes_parameter_t * parameters;
  uint8_t mode_count;
  uint8_t parameter_count;
};

/* Sets the parameters of a mode, all or none, and publishes them in one event. `asks`: the callback of the parameter
 * server can refuse a value. The codes are those of rclc_modes_change. */
rcl_ret_t rclc_modes_apply(
  rclc_parameter_server_t * server, const rclc_modes_table_t * table, uint8_t mode, bool asks);

/* Returns RCL_RET_OK if the mode exists, the node can change it, and no callback is being called. */
rcl_ret_t rclc_modes_may_change(const rclc_modes_t * modes, uint8_t mode);

/* Goes to a mode without an event. `asks`: the callbacks can refuse it. */
rcl_ret_t rclc_modes_switch(rclc_modes_t * modes, uint8_t mode, bool asks);

/* Publishes a change of mode now, or when there is room. */
void rclc_modes_notify(rclc_modes_t * modes, uint8_t start_mode);
void rclc_modes_publish(rclc_modes_t * modes);

/* Notes an error of a mode; returns `result`. */
rcl_ret_t rclc_modes_refuse(rcl_ret_t result, const char * name, const char * why);

/* Returns whether a handle of an executor is that of modes, which are its context then. */
bool rclc_modes_has_handle(const rclc_executor_handle_t * handle);

/* Returns the state of the node's life cycle. */
uint8_t rclc_modes_state(const rclc_modes_t * modes);

/* Types whose messages are the rclc_modes_t of the node; the first three are those of its services, in their order. */
extern const rosidl_service_type_support_t rclc_modes_change_type;
extern const rosidl_service_type_support_t rclc_modes_get_available_type;
extern const rosidl_service_type_support_t rclc_modes_get_type;
extern const rosidl_message_type_support_t rclc_modes_event_type;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_MODES_TABLE_H */
