/* SPDX-License-Identifier: Apache-2.0 */
/* Copies of values for the structs of declared_parameters.h. A deleted parameter leaves its copy unchanged. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_COPY_H
#define MICROROS_RCLC_PARAMETER_COPY_H

#include "rclc_parameter/rclc_parameter.h"

#ifdef __cplusplus
extern "C" {
#endif

void rclc_parameter_copy_bool(const rclc_parameter_server_t * server, const char * name, bool * to);
void rclc_parameter_copy_integer(const rclc_parameter_server_t * server, const char * name, int64_t * to);
void rclc_parameter_copy_double(const rclc_parameter_server_t * server, const char * name, double * to);

#if MICROROS_PARAMETER_STRING_SIZE > 0u
/* `room`: bytes with the NUL. */
void rclc_parameter_copy_string(
  const rclc_parameter_server_t * server, const char * name, char * to, size_t room);
#endif

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
/* `room`: elements. */
void rclc_parameter_copy_array(
  const rclc_parameter_server_t * server, const char * name, rclc_parameter_type_t type, void * to,
  size_t room, size_t * count);
#endif

#if MICROROS_PARAMETER_STRINGS_MAX > 0u
/* `room`: strings of MICROROS_PARAMETER_ARRAY_STRING_SIZE bytes each. */
void rclc_parameter_copy_strings(
  const rclc_parameter_server_t * server, const char * name, char (*to)[MICROROS_PARAMETER_ARRAY_STRING_SIZE],
  size_t room, size_t * count);
#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_COPY_H */
