/* SPDX-License-Identifier: Apache-2.0 */
/* Parameters that the application file declares, as constants. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_DECLARED_H
#define MICROROS_RCLC_PARAMETER_DECLARED_H

#include "microros/rclc_parameters.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rclc_parameter_declared_t {
  rclc_parameter_scalar_t value; /* at the start */
  rclc_parameter_about_t about;
#if MICROROS_PARAMETER_STRING_SIZE > 0u || MICROROS_PARAMETER_ARRAY_SIZE > 0u
  const void * start;   /* a string with its NUL, or elements as rclc_parameter_array_t has them */
  uint32_t start_bytes; /* of both */
  uint32_t start_count; /* elements */
#endif
  uint8_t type; /* an rclc_parameter_type_t */
  bool has_value;
  bool read_only;
} rclc_parameter_declared_t;

/* Adds parameters, whose declarations are not copied. Returns the first error. */
rcl_ret_t rclc_parameter_declare(
  rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared, size_t count);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_DECLARED_H */
