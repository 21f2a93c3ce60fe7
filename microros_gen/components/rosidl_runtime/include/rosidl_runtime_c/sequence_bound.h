/* SPDX-License-Identifier: Apache-2.0 */
/* Bounds argument of rmw_get_serialized_message_size; opaque, since the limits of the plan apply instead. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_SEQUENCE_BOUND_H
#define MICROROS_ROSIDL_RUNTIME_C_SEQUENCE_BOUND_H

typedef struct rosidl_runtime_c__Sequence__bound rosidl_runtime_c__Sequence__bound;

#endif /* MICROROS_ROSIDL_RUNTIME_C_SEQUENCE_BOUND_H */
