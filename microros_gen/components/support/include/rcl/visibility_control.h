/* SPDX-License-Identifier: Apache-2.0 */
/* A static library exports everything: these are empty, for sources that use them. */
#ifndef MICROROS_RCL_VISIBILITY_CONTROL_H
#define MICROROS_RCL_VISIBILITY_CONTROL_H

#define RCL_PUBLIC
#define RCL_LOCAL

#endif /* MICROROS_RCL_VISIBILITY_CONTROL_H */
