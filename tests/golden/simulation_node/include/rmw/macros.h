/* SPDX-License-Identifier: Apache-2.0 */
/* Small macros of rmw. */
#ifndef MICROROS_RMW_MACROS_H
#define MICROROS_RMW_MACROS_H

#include "rcutils/macros.h"

#define RMW_WARN_UNUSED RCUTILS_WARN_UNUSED

#endif /* MICROROS_RMW_MACROS_H */
