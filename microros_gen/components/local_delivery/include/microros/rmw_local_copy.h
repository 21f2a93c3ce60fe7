/* SPDX-License-Identifier: Apache-2.0 */
/* Copies of strings into existing memory. Internal. */
#ifndef MICROROS_RMW_LOCAL_COPY_H
#define MICROROS_RMW_LOCAL_COPY_H

#include <stdbool.h>

#include "rosidl_runtime_c/string.h"
#include "rosidl_runtime_c/u16string.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Copies the characters and a terminator; false, with nothing changed, if `to` has no room for them. A string without
 * data is empty. */
bool rmw_local_copy_text(const rosidl_runtime_c__String * from, rosidl_runtime_c__String * to);

bool rmw_local_copy_wide(const rosidl_runtime_c__U16String * from, rosidl_runtime_c__U16String * to);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOCAL_COPY_H */
