/* SPDX-License-Identifier: Apache-2.0 */
/* Small macros of rcl. */
#ifndef MICROROS_RCL_MACROS_H
#define MICROROS_RCL_MACROS_H

#include "rcutils/macros.h"

#define RCL_WARN_UNUSED RCUTILS_WARN_UNUSED
#define RCL_UNUSED(x) RCUTILS_UNUSED(x)

#endif /* MICROROS_RCL_MACROS_H */
