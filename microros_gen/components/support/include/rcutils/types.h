/* SPDX-License-Identifier: Apache-2.0 */
/* The types of rcutils that this client provides. */
#ifndef MICROROS_RCUTILS_TYPES_H
#define MICROROS_RCUTILS_TYPES_H

#include "rcutils/types/rcutils_ret.h"
#include "rcutils/types/string_array.h"
#include "rcutils/types/uint8_array.h"

#endif /* MICROROS_RCUTILS_TYPES_H */
