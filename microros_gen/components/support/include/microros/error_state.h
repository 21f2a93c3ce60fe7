/* SPDX-License-Identifier: Apache-2.0 */
/* Storage of the last error: internal to the files that write it. */
#ifndef MICROROS_ERROR_STATE_H
#define MICROROS_ERROR_STATE_H

#include "rcutils/error_handling.h"

#ifdef __cplusplus
extern "C" {
#endif

rcutils_error_state_t * microros_error_state(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ERROR_STATE_H */
