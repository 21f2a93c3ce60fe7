/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_RCL_LIFECYCLE_VISIBILITY_CONTROL_H
#define MICROROS_RCL_LIFECYCLE_VISIBILITY_CONTROL_H

/* A static library has no visibility to control. */
#define RCL_LIFECYCLE_PUBLIC

#endif /* MICROROS_RCL_LIFECYCLE_VISIBILITY_CONTROL_H */
