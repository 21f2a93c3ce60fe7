/* SPDX-License-Identifier: Apache-2.0 */
/* Types of parameters, and result codes of servers and clients. */
#ifndef MICROROS_RCLC_PARAMETER_TYPES_H
#define MICROROS_RCLC_PARAMETER_TYPES_H

/* The callback refused the value. */
#define RCLC_PARAMETER_MODIFICATION_REJECTED 4001
/* The parameter has another type. */
#define RCLC_PARAMETER_TYPE_MISMATCH 4002

/* Values of rcl_interfaces/msg/ParameterType. */
typedef enum rclc_parameter_type_t {
  RCLC_PARAMETER_NOT_SET = 0,
  RCLC_PARAMETER_BOOL,
  RCLC_PARAMETER_INT,
  RCLC_PARAMETER_DOUBLE,
  RCLC_PARAMETER_STRING, /* this and arrays: where the application file declares one, or its limits have a size for them */
  RCLC_PARAMETER_BYTE_ARRAY,
  RCLC_PARAMETER_BOOL_ARRAY,
  RCLC_PARAMETER_INT_ARRAY,
  RCLC_PARAMETER_DOUBLE_ARRAY,
  RCLC_PARAMETER_STRING_ARRAY
} rclc_parameter_type_t;

#endif /* MICROROS_RCLC_PARAMETER_TYPES_H */
