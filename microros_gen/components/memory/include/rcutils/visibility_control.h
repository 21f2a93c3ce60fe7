/* SPDX-License-Identifier: Apache-2.0 */
/* A static library exports everything: these are empty, for sources that use them. */
#ifndef MICROROS_RCUTILS_VISIBILITY_CONTROL_H
#define MICROROS_RCUTILS_VISIBILITY_CONTROL_H

#define RCUTILS_PUBLIC
#define RCUTILS_PUBLIC_TYPE
#define RCUTILS_LOCAL

#endif /* MICROROS_RCUTILS_VISIBILITY_CONTROL_H */
