/* SPDX-License-Identifier: Apache-2.0 */
/* The handle of a service type. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_SERVICE_TYPE_SUPPORT_STRUCT_H
#define MICROROS_ROSIDL_RUNTIME_C_SERVICE_TYPE_SUPPORT_STRUCT_H

#include "rosidl_runtime_c/visibility_control.h"
#include "rosidl_typesupport_interface/macros.h"

/* `data` points to a `const microros_service_type_t` (microros/service_type.h). Handles are constants. */
typedef struct rosidl_service_type_support_t {
  const char * typesupport_identifier;
  const void * data;
} rosidl_service_type_support_t;

/* An expression of type `const rosidl_service_type_support_t *`. */
#define ROSIDL_GET_SRV_TYPE_SUPPORT(PkgName, SrvSubfolder, SrvName) \
  ROSIDL_TYPESUPPORT_INTERFACE__SERVICE_SYMBOL_NAME(rosidl_typesupport_c, PkgName, SrvSubfolder, SrvName)()

#endif /* MICROROS_ROSIDL_RUNTIME_C_SERVICE_TYPE_SUPPORT_STRUCT_H */
