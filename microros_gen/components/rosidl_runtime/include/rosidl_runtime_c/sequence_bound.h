/* SPDX-License-Identifier: Apache-2.0 */
/* The bounds that rmw_get_serialized_message_size takes; the limits of the plan stand in its place, so it is
 * opaque. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_SEQUENCE_BOUND_H
#define MICROROS_ROSIDL_RUNTIME_C_SEQUENCE_BOUND_H

typedef struct rosidl_runtime_c__Sequence__bound rosidl_runtime_c__Sequence__bound;

#endif /* MICROROS_ROSIDL_RUNTIME_C_SEQUENCE_BOUND_H */
